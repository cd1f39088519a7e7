"""What was studied, put away in a skillbook step by step."""

from gaitwright.learning.apprentice import Studied
from gaitwright.skillbook.writer import Ledger


def keep(ledger: Ledger, studied: Studied) -> None:
    """Puts every step away, each durable before the next."""
    for step in studied.steps:
        if step.how == "edited":
            ledger.edit(step.result.book, "a new feature, named by the teacher")
        else:
            ledger.record(step.lesson, step.result, step.how)
