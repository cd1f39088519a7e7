"""Algorithm D: a positive instance raises lower marks (§5.4.2.1)."""

from gaitwright.knowledge.forest import Forest, Situation
from gaitwright.knowledge.rules import Marks
from gaitwright.knowledge.trees import FeatureTree


def generalise(forest: Forest, marks: tuple[Marks, ...], situation: Situation) -> tuple[Marks, ...]:
    """The marks with each lower one raised to the least upper bound of itself and the situation's value.

    It never lowers a mark and leaves upper marks alone: where the situation was outside one, the lower mark
    has now risen past it, and the upper must be fitted anew (`fitting.refit`).
    """
    return tuple(
        mark if value is None else raised(tree, mark, value)
        for tree, mark, value in zip(forest.trees, marks, situation.values, strict=True)
    )


def raised(tree: FeatureTree, marks: Marks, value: str) -> Marks:
    """One tree's marks, the lower raised just enough to hold the value; the first value is a lower mark
    itself."""
    if marks.lower is None:
        return Marks(marks.tree, marks.upper, value)
    if tree.is_below(value, marks.lower):
        return marks
    return Marks(marks.tree, marks.upper, tree.least_upper_bound(value, marks.lower))
