"""`gaitwright teach --lesson practice`: trips in physics by what a book holds, on which trust grows."""

from argparse import Namespace
from typing import Any

from gaitwright.cli.book_files import skillbook_of
from gaitwright.cli.console import remark
from gaitwright.cli.driving import looked_up
from gaitwright.cli.trip_rows import as_figures, show_trips
from gaitwright.control.takeover import LEARNED
from gaitwright.errors import WrongUse
from gaitwright.knowledge.trust import grades_in
from gaitwright.learning.practice import Trip, practise
from gaitwright.model.robot import Robot
from gaitwright.skillbook.writer import Ledger

TRIPS = 6
"""Trips, unless so many are named."""


def run(robot: Robot, ledger: Ledger, args: Namespace) -> dict[str, Any]:
    """So many trips, drawn from the seed; the figures of each."""
    profiles = looked_up(robot, args.out).profiles
    driven: list[Trip] = []
    trips = args.trips or TRIPS
    for number in range(trips):
        driven.append(practise(robot, ledger, profiles, args.seed, number))
        remark(told(driven[-1], trips))
        for sentence in driven[-1].changed:
            remark(sentence)
    show_trips([(str(trip.number + 1), trip.report) for trip in driven], to_stderr=args.json == "-")
    return {
        "trips": [as_figures(str(trip.number + 1), trip.report) for trip in driven],
        "changed": [sentence for trip in driven for sentence in trip.changed],
        "grades": grades_in(ledger.book.trust),
    }


def check(path: str | None, robot: Robot, args: Namespace) -> None:
    """Raises `WrongUse` for a book without rules or profiles: there would be nothing to practise."""
    book = None if path is None else skillbook_of(path)
    if book is None or not book.rulebook.rules or not book.profiles or book.robot != robot.name:
        raise WrongUse(
            f"{args.out} has no rules or no profiles of {robot.name} to practise: teach them by `gaitwright "
            f"teach --lesson all --robot {robot.name} --out {args.out}`"
        )


def told(trip: Trip, trips: int) -> str:
    """One trip in a line."""
    share = trip.report.driver_share.get(LEARNED, 0.0)
    return f"trip {trip.number + 1} of {trips}, {trip.report.scene}: {share:.0%} by the learned controller"
