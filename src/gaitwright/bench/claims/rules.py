"""Claim: rules decide in microseconds, say truly why, and are learned from a few demonstrations (rows L5 to
L8, L11)."""

from collections.abc import Iterator

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.rule_decisions import decisions, explanations
from gaitwright.bench.evidence.rule_lessons import corrections, learning, pupils
from gaitwright.bench.measurement import Figure

NOTE = (
    "Rules: a decision is which of 14 rules over 12 trees fires, in situations in which every rule is right "
    "as often as any other; times are medians over rounds, of each the best of three passes. "
    "CLIPS gets the rules as defrules with the order as salience and decides by a function of its own "
    "(reset, assert, run 1), the quickest of the ways that we know; it would keep facts between decisions, "
    "and join several of them, which is not needed here. Counterfactuals: the change is made value by value "
    "and decided by plain consultation. Schools: a teacher with a random rulebook in mind (firm rules of up "
    "to three conditions, one for all the rest) demonstrates that situation of some drawn ones after which "
    "this pupil does best, and names a tree that speaks against what the pupil would have done; CART and "
    "k-NN learn from the same situations, with a number for each value of a tree, groups included, but "
    "cannot be told a reason. A variant of a fault has other values in about half of the trees, and the "
    "same mistake."
)


def measure(context: Context) -> Iterator[Figure]:
    """Decisions, explanations, learning, corrections."""
    yield from decisions(context)
    yield from explanations(context)
    taught = pupils(context)
    yield from learning(context, taught)
    yield from corrections(context, taught)
