"""What was learned over one forest, said over another: trees that one book has and the other lacks."""

from collections.abc import Mapping
from dataclasses import replace

from gaitwright.knowledge.forest import Forest, Situation
from gaitwright.knowledge.mark_fitting import refit, tightened
from gaitwright.knowledge.memory import Fact
from gaitwright.knowledge.modifier import Lesson, audit
from gaitwright.knowledge.rules import Choice, Instance, Marks, Rule, Rulebook
from gaitwright.knowledge.trees import FeatureTree
from gaitwright.knowledge.widen import marks_around


def differing(ours: Forest, theirs: Forest) -> tuple[str, ...]:
    """Trees of one name that do not tell the same things apart; other groups of the same leaves do."""
    pairs = [(tree, theirs[tree.name]) for tree in ours.trees if tree.name in theirs.names]
    return tuple(our.name for our, their in pairs if (our.leaves, our.bounds) != (their.leaves, their.bounds))


def restate_situation(forest: Forest, situation: Situation, raw: Mapping[str, Fact]) -> Situation | str:
    """The situation over another forest, or the tree that does not know its value there.

    A tree that it has no value in takes the measurement, where one was taken, and else stays open.
    """
    known = dict(situation.items())
    for tree in forest.trees:
        value = known.get(tree.name)
        if value is not None and not tree.is_leaf(value):
            return tree.name
    return forest.read(known, raw)


def restated(rule: Rule, forest: Forest) -> Rule | str:
    """The rule over another forest, its marks as they are wherever the forest knows them, or why not."""
    sides: list[list[Instance]] = [[], []]
    for side, instances in zip(sides, (rule.positives, rule.negatives), strict=True):
        for instance in instances:
            situation = restate_situation(forest, instance.situation, instance.raw)
            if isinstance(situation, str):
                return f"{instance.id} has a value in {situation} that is not known here"
            side.append(replace(instance, situation=situation))
    stated = replace(rule, positives=tuple(sides[0]), negatives=tuple(sides[1]))
    kept = replace(stated, marks=tuple(_mark(tree, stated) for tree in forest.trees))
    old = {marks.tree for marks in rule.marks}
    if old <= set(forest.names) and not audit(Rulebook(forest, (kept,))):
        return kept
    choices = tuple(
        Choice(c.tree if c.tree in forest.names else "", tuple(o for o in c.others if o in forest.names))
        for c in rule.choices
    )
    bare = replace(stated, marks=tuple(Marks(tree) for tree in forest.names), choices=choices)
    fitted = refit(forest, tightened(forest, bare))
    if isinstance(fitted, Rule):
        return fitted
    return f"its values hold the wrong {', '.join(instance.id for instance in fitted)} too"


def _mark(tree: FeatureTree, stated: Rule) -> Marks:
    """The rule's marks in a tree; where it had none, around what its right situations measured there."""
    for marks in stated.marks:
        if marks.tree == tree.name and {marks.upper, marks.lower or marks.upper} <= tree.place.keys():
            return marks
    return marks_around(tree, stated.positives)


def lesson_over(forest: Forest, lesson: Lesson) -> Lesson | str:
    """The lesson over another forest, or the tree that does not know its value."""
    situation = restate_situation(forest, lesson.situation, lesson.raw)
    blame = lesson.blame if lesson.blame in forest.names else ""
    return situation if isinstance(situation, str) else replace(lesson, situation=situation, blame=blame)
