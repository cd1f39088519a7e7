"""A rulebook over more trees than it was taught in: what a tree that came later changes of it, which is
nothing."""

from collections.abc import Sequence
from dataclasses import replace

from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.rules import Instance, Marks, Rule, Rulebook
from gaitwright.knowledge.trees import FeatureTree


def widened(rulebook: Rulebook, trees: Sequence[FeatureTree]) -> Rulebook:
    """The rulebook with those of the trees that it does not have, behind its own; itself where it has all.

    Every rule is indifferent to a new tree: its upper mark is the root, so whatever fired fires at any value
    there. What an earlier situation was in a new tree is read from what was measured then, and stays open
    where that does not tell; so does the lower mark, and a decision is grey there until the rule was seen
    right at such a value.
    """
    new = tuple(tree for tree in trees if tree.name not in rulebook.forest.names)
    if not new:
        return rulebook
    forest = Forest((*rulebook.forest.trees, *new))
    wishes = tuple(
        replace(wish, situation=forest.read(dict(wish.situation.items()), {}))
        for wish in rulebook.preferences
    )
    wider = tuple(_over(forest, rule) for rule in rulebook.rules)
    return replace(rulebook, forest=forest, rules=wider, preferences=wishes)


def marks_around(tree: FeatureTree, positives: Sequence[Instance]) -> Marks:
    """The marks of a rule in a tree that is new to it: nothing is excluded, and the lower mark holds all that
    was right."""
    marks = Marks(tree.name)
    for positive in positives:
        value = positive.situation[tree.name]
        marks = marks if value is None else raised(tree, marks, value)
    return marks


def raised(tree: FeatureTree, marks: Marks, value: str) -> Marks:
    """One tree's marks, the lower raised just enough to hold the value (the thesis's algorithm D); the first
    value is a lower mark itself."""
    if marks.lower is None:
        return Marks(marks.tree, marks.upper, value)
    return Marks(marks.tree, marks.upper, tree.least_upper_bound(value, marks.lower))


def _over(forest: Forest, rule: Rule) -> Rule:
    positives, negatives = (
        tuple(seen_in(forest, instance) for instance in instances)
        for instances in (rule.positives, rule.negatives)
    )
    new = tuple(marks_around(tree, positives) for tree in forest.trees[len(rule.marks) :])
    return replace(rule, marks=(*rule.marks, *new), positives=positives, negatives=negatives)


def seen_in(forest: Forest, instance: Instance) -> Instance:
    """The instance over another forest: what its own trees do not tell is read from what was measured."""
    known = dict(instance.situation.items())
    return replace(instance, situation=forest.read(known, instance.raw))
