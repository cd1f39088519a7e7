"""`gaitwright teach --lesson operators`: how a leg gets over an obstacle, by the numerical controller."""

from argparse import Namespace
from typing import Any

from gaitwright.cli.console import remark, working
from gaitwright.learning.operator_books import notes_of, sentence
from gaitwright.learning.operator_lessons import shown
from gaitwright.model.robot import Robot
from gaitwright.skillbook.writer import Ledger


def run(robot: Robot, ledger: Ledger, args: Namespace) -> list[dict[str, Any]]:
    """Teaches an operator for obstacles and one for holes, unless there are some already; their figures."""
    known = ledger.book.operators
    if known:
        remark(f"{ledger.path.name} has {len(known)} terrain operators already: {known[0].name}, …")
        return []
    with working("an edit on one leg, in physics", worth_a_line=None):
        new = shown(robot, args.seed)
    ledger.keep_operators(map(notes_of, new))
    for one in new:
        remark(f"{one.name}: {sentence(one)}")
    return [
        {"name": one.name, "kinds": one.kinds, "largest_m": one.largest, "taught": one.taught} for one in new
    ]
