"""Trips in a row as a table: who drove, what a tick took, what the way cost."""

from collections.abc import Iterable
from typing import Any

from gaitwright.cli.console import show_table
from gaitwright.control.takeover import LEARNED, NUMERICAL
from gaitwright.record.metrics import Report

PARTS = ("lap", LEARNED, NUMERICAL)
HEAD = (
    "trip",
    "scene",
    "learned",
    "numerical",
    "tick [µs]",
    "by learned",
    "by numerical",
    "cost",
    "J/m",
    "ended",
)
"""Shares of the ticks; medians of a whole tick, and of gait and control in it by either driver [µs]; cost of
transport."""


def show_trips(trips: Iterable[tuple[str, Report]], to_stderr: bool) -> None:
    """A line for each trip: what it is called, and its report."""
    if not to_stderr:
        show_table(HEAD, [row_of(name, report) for name, report in trips], right=HEAD[2:-1])


def row_of(name: str, report: Report) -> tuple[str, ...]:
    """A line of the table."""
    shares = tuple(f"{report.driver_share.get(driver, 0.0):.0%}" for driver in (LEARNED, NUMERICAL))
    took = tuple(microseconds(report, part) for part in PARTS)
    cost = f"{report.cost_of_transport:.2f}", f"{report.energy_j_per_m:.0f}"
    return name, report.scene, *shares, *took, *cost, report.stopped_because


def microseconds(report: Report, part: str) -> str:
    """The median of a part of the tick."""
    return f"{report.tick_us[part]['median']:.0f}" if part in report.tick_us else "–"


def as_figures(name: str, report: Report) -> dict[str, Any]:
    """The same as plain values."""
    return {
        "trip": name,
        "scene": report.scene,
        "driver_share": report.driver_share,
        "tick_us": {part: took["median"] for part, took in report.tick_us.items()},
        "cost_of_transport": report.cost_of_transport,
        "energy_j_per_m": report.energy_j_per_m,
        "falls": report.falls,
        "arrived": report.arrived,
        "stopped_because": report.stopped_because,
    }
