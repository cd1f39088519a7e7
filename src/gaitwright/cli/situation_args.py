"""The situation that a person asks about: what was said, what a recording tells, and the rest as last
taught."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import islice, product

from gaitwright.errors import WrongUse, unknown
from gaitwright.knowledge.compiled import compile_book
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.counterfactual import counterfactual
from gaitwright.knowledge.forest import Forest, Situation, leaf_in, replace_value
from gaitwright.knowledge.memory import Fact
from gaitwright.knowledge.rules import Rulebook
from gaitwright.knowledge.trees import FeatureTree

Lesson = tuple[str, Situation]
"""What a lesson is called, and the situation in it."""
SAID, RECORDED = "said", "recorded"
ENOUGH, FEW = 5, 4
"""From so many lessons on that are like what was asked, their decisions are told; so many of these."""
MOST = 64
"""So many ways to fill what was said in part are tried."""


@dataclass(frozen=True, slots=True)
class Asked:
    """A situation, and for each tree where its value comes from: said, recorded, or else what it was taken
    from."""

    situation: Situation
    sources: tuple[str, ...]
    partly: tuple[tuple[str, str], ...] = ()
    """Trees of which only a value above the leaves was said, with that value."""
    alike: tuple[tuple[str, int], ...] = ()
    """What is decided in lessons in which all was so that was said, and how often, the commonest first."""

    @property
    def open(self) -> tuple[str, ...]:
        """The trees whose leaf nobody told."""
        names = self.situation.trees
        return tuple(
            tree for tree, source in zip(names, self.sources, strict=True) if source not in (SAID, RECORDED)
        )


def said(words: Sequence[str], forest: Forest) -> dict[str, str]:
    """What `--situation TREE=VALUE …` says, by tree. Raises `WrongUse` for what is no tree's value."""
    values: dict[str, str] = {}
    for word in words:
        tree, equals, value = (part.strip() for part in word.partition("="))
        if not equals or not value:
            raise WrongUse(f"--situation {word}: write TREE=VALUE; the trees are {', '.join(forest.names)}")
        forest[tree]
        if tree in values:
            raise WrongUse(f"--situation says {tree} twice: {values[tree]} and {value}")
        values[tree] = value
    return values


def asked(
    rulebook: Rulebook, values: Mapping[str, str], facts: Mapping[str, Fact], taught: Sequence[Lesson] = ()
) -> Asked:
    """A leaf for every tree: what was said comes first, then the facts, then the lessons (`taught`, else
    those that the rules hold), those first in which all was so that was said, and of these the last one of
    the commonest decision: trees that belong together are taken from one lesson as far as any tells.

    Raises `WrongUse` for a value that does not exist, and where no lesson has one for a tree left open.
    """
    lessons, alike = typical_first(rulebook, taught or last_lessons(rulebook), values)
    found = [_leaf(tree, values.get(tree.name), facts, lessons) for tree in rulebook.forest.trees]
    pairs = zip(rulebook.forest.trees, found, strict=True)
    missing = [f"{tree.name} ({', '.join(tree.leaves)})" for tree, leaf in pairs if leaf is None]
    if missing:
        raise WrongUse(f"no lesson has a value of {'; '.join(missing)}: add it to --situation")
    leaves, sources = zip(*(leaf for leaf in found if leaf), strict=True)
    partly = tuple(
        (tree, value) for tree, value in values.items() if _said_leaf(rulebook.forest[tree], value) is None
    )
    return Asked(Situation(rulebook.forest.names, leaves), sources, partly, alike)


def last_lessons(rulebook: Rulebook) -> list[Lesson]:
    """The situations of the lessons: those that moved something, the last first, then the others."""
    taught = {
        instance.id: instance.situation
        for rule in rulebook.rules
        for instance in (*rule.positives, *rule.negatives)
        if instance.seen
    }
    taught |= {wish.instance: wish.situation for wish in rulebook.preferences}
    moved = [event.instance for event in reversed(rulebook.events) if event.instance in taught]
    return [(name, taught[name]) for name in dict.fromkeys([*moved, *reversed(taught)])]


def typical_first(
    rulebook: Rulebook, lessons: Sequence[Lesson], values: Mapping[str, str]
) -> tuple[list[Lesson], tuple[tuple[str, int], ...]]:
    """The lessons, those first that are like what was said, and of them those of the commonest decision; and
    how often what is decided in these."""
    alike = [lesson for lesson in lessons if is_like(rulebook.forest, lesson[1], values)] if values else []
    decided = {name: consult(rulebook, situation).rule or "no rule" for name, situation in alike}
    often = Counter(decided.values())
    order = {name: -often[rule] for name, rule in decided.items()}
    return sorted(lessons, key=lambda lesson: order.get(lesson[0], 1)), tuple(often.most_common())


def is_like(forest: Forest, situation: Situation, values: Mapping[str, str]) -> bool:
    """Whether a situation is as it was said to be."""
    for name, value in values.items():
        tree, here = forest[name], situation[name]
        leaf = _said_leaf(tree, value)
        if here is None or not (here == leaf or (leaf is None and tree.is_below(here, value))):
            return False
    return True


def whatever(rulebook: Rulebook, at: Asked) -> str:
    """Whether what was left open makes a difference, in a sentence: what is decided in lessons like that,
    where there are some, else what could be, tried with all values of the trees left open."""
    if sum(often for _, often in at.alike) >= ENOUGH:
        counts = ", ".join(f"{rule} in {often}" for rule, often in at.alike[:FEW])
        return f"Of {sum(often for _, often in at.alike)} lessons like that the rules decide for {counts}."
    names = [tree for tree in at.situation.trees if tree in at.open]
    trees = names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
    other = _decided_otherwise(rulebook, at)
    return f"What was left open matters: {other}." if other else f"That is so whatever {trees} may be."


def _decided_otherwise(rulebook: Rulebook, at: Asked) -> str:
    """What would have to be different in the open trees for another decision; empty where nothing can."""
    within = dict(at.partly)
    keep = [tree for tree in at.situation.trees if tree not in at.open or tree in within]
    now, table = consult(rulebook, at.situation).rule, compile_book(rulebook)
    choices = [rulebook.forest[tree].leaves_below(value) for tree, value in within.items()]
    for leaves in islice(product(*choices), MOST):
        situation = at.situation
        for tree, leaf in zip(within, leaves, strict=True):
            situation = replace_value(rulebook.forest, situation, tree, leaf)
        rule = consult(rulebook, situation).rule
        if rule != now:
            condition = " and ".join(f"{tree} is {leaf}" for tree, leaf in zip(within, leaves, strict=True))
            return f"{rule or 'no rule'} would fire if {condition}"
        other = counterfactual(rulebook, situation, keep=keep, compiled=table)
        if other.decision is not None:
            return other.sentence
    return ""


def _leaf(
    tree: FeatureTree, value: str | None, facts: Mapping[str, Fact], lessons: Sequence[tuple[str, Situation]]
) -> tuple[str, str] | None:
    """A tree's leaf and where it comes from; `None` where nothing tells."""
    if value is not None:
        leaf = _said_leaf(tree, value)
        if leaf is not None:
            return leaf, SAID
        if value not in tree.place:
            raise unknown(f"value of {tree.name}", value, tree.values)
        return _taught(tree, tree.leaves_below(value), lessons) or (
            tree.leaves_below(value)[0],
            "as the first",
        )
    recorded = leaf_in(tree, facts)
    if recorded is not None:
        return recorded, RECORDED
    return _taught(tree, tree.leaves, lessons)


def _said_leaf(tree: FeatureTree, value: str) -> str | None:
    """The leaf of that name, or the interval of that number, with or without its unit."""
    if tree.is_leaf(value):
        return value
    try:
        number = float(value.removesuffix(tree.unit))
    except ValueError:
        return None
    return tree.leaf_of(number) if tree.bounds else None


def _taught(
    tree: FeatureTree, leaves: Sequence[str], lessons: Sequence[tuple[str, Situation]]
) -> tuple[str, str] | None:
    """The leaf among these that the last lesson had which had one."""
    for name, situation in lessons:
        value = situation[tree.name]
        if value in leaves:
            return str(value), f"as at {name}"
    return None
