"""`gaitwright teach --lesson operators`: how a leg gets over an obstacle, by the numerical controller."""

from argparse import Namespace
from typing import Any

from gaitwright.cli.console import remark, working
from gaitwright.learning.operator_books import notes_of, sentence
from gaitwright.learning.operator_lessons import SHOWN_SIZE, Edit, learned_from
from gaitwright.model.robot import Robot
from gaitwright.skillbook.writer import Ledger


def run(robot: Robot, ledger: Ledger, args: Namespace) -> list[dict[str, Any]]:
    """Teaches one operator for all obstacles that a raised foot answers, unless the book has some already;
    its figures."""
    known = ledger.book.operators
    if known:
        remark(f"{ledger.path.name} has {len(known)} terrain operators already: {known[0].name}, …")
        return []
    with working("an edit on one leg, in physics", worth_a_line=None):
        new = learned_from(Edit(robot, SHOWN_SIZE * robot.step_limit), "over an obstacle", args.seed)
    ledger.keep_operators([notes_of(new)])
    remark(f"{new.name}: {sentence(new)}")
    return [{"name": new.name, "kinds": new.kinds, "largest_m": new.largest, "taught": new.taught}]
