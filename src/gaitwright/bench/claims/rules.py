"""Claim: rules decide in microseconds and say truly why (rows L7, L11)."""

from collections.abc import Iterator

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.rule_decisions import decisions, explanations
from gaitwright.bench.measurement import Figure

NOTE = (
    "Rules: a decision is which of 14 rules over 12 trees fires, in situations in which every rule is right "
    "as often as any other; times are medians over rounds, of each the best of three passes. "
    "CLIPS gets the rules as defrules with the order as salience and decides by a function of its own "
    "(reset, assert, run 1), the quickest of the ways that we know; it would keep facts between decisions, "
    "and join several of them, which is not needed here. Counterfactuals: the change is made value by value "
    "and decided by plain consultation. Explanations are of a book that a pupil of skills learned from "
    "moments of trips without physics, with its whole history."
)


def measure(context: Context) -> Iterator[Figure]:
    """Decisions and explanations."""
    yield from decisions(context)
    yield from explanations(context)
