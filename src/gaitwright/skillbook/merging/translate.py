"""What was learned over one forest, said over another: trees that one book has and the other lacks."""

from collections.abc import Mapping
from dataclasses import replace

from gaitwright.errors import WrongUse
from gaitwright.knowledge.forest import Forest, Situation
from gaitwright.knowledge.generalise import raised
from gaitwright.knowledge.mark_fitting import refit, tightened
from gaitwright.knowledge.memory import Fact
from gaitwright.knowledge.modifier import Lesson, audit
from gaitwright.knowledge.rules import Choice, Instance, Marks, Rule, Rulebook
from gaitwright.knowledge.trees import Tree


def joined(ours: Forest, theirs: Forest) -> Forest:
    """Our trees as they are, then those that only they have."""
    return Forest((*ours.trees, *(tree for tree in theirs.trees if tree.name not in ours.names)))


def differing(ours: Forest, theirs: Forest) -> tuple[str, ...]:
    """Trees of one name that do not tell the same things apart; other groups of the same leaves do."""
    pairs = [(tree, theirs[tree.name]) for tree in ours.trees if tree.name in theirs.names]
    return tuple(our.name for our, their in pairs if (our.leaves, our.bounds) != (their.leaves, their.bounds))


def placed(forest: Forest, situation: Situation, raw: Mapping[str, Fact]) -> Situation | str:
    """The situation over another forest, or the tree that does not know its value there.

    A tree that it has no value in takes the measurement, where one was taken, and else stays open.
    """
    known, values = dict(situation.items()), []
    for tree in forest.trees:
        value = known[tree.name] if tree.name in known else _measured(tree, raw)
        if value is not None and not tree.is_leaf(value):
            return tree.name
        values.append(value)
    return Situation(forest.names, tuple(values))


def _measured(tree: Tree, raw: Mapping[str, Fact]) -> str | None:
    """The leaf that a measurement is in, where there is one that the tree can place."""
    fact = raw.get(tree.source or tree.name)
    if isinstance(fact, str):
        return fact if tree.is_leaf(fact) else None
    return None if fact is None or not tree.bounds else tree.leaf_of(fact)


def widened(book: Rulebook, forest: Forest) -> Rulebook:
    """The rulebook over a forest with more trees behind its own; raises `WrongUse` where a rule does not fit,
    which open values cannot cause."""
    if forest == book.forest:
        return book
    rules = []
    for rule in book.rules:
        stated = restated(rule, forest)
        if not isinstance(stated, Rule):
            raise WrongUse(f"{rule.name} cannot be said over {', '.join(forest.names)}: {stated}")
        rules.append(stated)
    wishes = []
    for wish in book.preferences:
        situation = placed(forest, wish.situation, {})
        assert isinstance(situation, Situation), "a longer forest knows all values"
        wishes.append(replace(wish, situation=situation))
    return replace(book, forest=forest, rules=tuple(rules), preferences=tuple(wishes))


def restated(rule: Rule, forest: Forest) -> Rule | str:
    """The rule over another forest, its marks as they are wherever the forest knows them, or why not."""
    sides: list[list[Instance]] = [[], []]
    for side, instances in zip(sides, (rule.positives, rule.negatives), strict=True):
        for instance in instances:
            situation = placed(forest, instance.situation, instance.raw)
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


def _mark(tree: Tree, stated: Rule) -> Marks:
    """The rule's marks in a tree; where it had none, around what its right situations measured there."""
    for marks in stated.marks:
        if marks.tree == tree.name and {marks.upper, marks.lower or marks.upper} <= tree.place.keys():
            return marks
    marks = Marks(tree.name)
    for positive in stated.positives:
        value = positive.situation[tree.name]
        marks = marks if value is None else raised(tree, marks, value)
    return marks


def lesson_over(forest: Forest, lesson: Lesson) -> Lesson | str:
    """The lesson over another forest, or the tree that does not know its value."""
    situation = placed(forest, lesson.situation, lesson.raw)
    blame = lesson.blame if lesson.blame in forest.names else ""
    return situation if isinstance(situation, str) else replace(lesson, situation=situation, blame=blame)
