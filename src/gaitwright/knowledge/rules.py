"""Rules and rule shells as plain values: an action, two marks per tree, and the instances that moved them."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite
from types import MappingProxyType
from typing import Literal

from gaitwright.errors import WrongUse, unknown
from gaitwright.knowledge.forest import Forest, Situation
from gaitwright.knowledge.memory import Action, Fact
from gaitwright.knowledge.trees import ROOT, FeatureTree

MAX_RULES = 1024
QUIET = 5
"""A rule shell is stabilised when so many instances in a row moved none of its marks."""

Kind = Literal["positive", "omission", "commission", "analogy for", "analogy against"]
Status = Literal["proposed", "empty", "shell", "stabilised", "firm"]


@dataclass(frozen=True, slots=True)
class Marks:
    """How far one tree is decided: outside `upper` no, inside `lower` yes, grey between (`None`: none
    seen)."""

    tree: str
    upper: str = ROOT
    lower: str | None = None


@dataclass(frozen=True, slots=True)
class Instance:
    """One situation in which a rule was right or wrong, with what else was measured then (`raw`).

    `kind`: "positive" fired rightly, "omission" should have fired, "commission" fired wrongly; the analogies
    were never seen, they come from another rule and give way to what is seen.
    """

    id: str
    kind: Kind
    situation: Situation
    raw: Mapping[str, Fact] = field(default_factory=dict, hash=False)
    note: str = ""

    def __post_init__(self) -> None:
        """Copies the measurements; one that is not finite counts as not taken."""
        taken = {name: value if isinstance(value, str) else float(value) for name, value in self.raw.items()}
        finite = {name: value for name, value in taken.items() if isinstance(value, str) or isfinite(value)}
        object.__setattr__(self, "raw", MappingProxyType(finite))

    @property
    def speaks_for(self) -> bool:
        return self.kind in ("positive", "omission", "analogy for")

    @property
    def seen(self) -> bool:
        return not self.kind.startswith("analogy")


@dataclass(frozen=True, slots=True)
class Choice:
    """Which tree keeps a negative instance out, and which others could instead: none of these, a near
    miss."""

    tree: str
    others: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Rule:
    """A rule shell. `marks` stand in the forest's order; `choices` belong to `negatives`, one each.

    `quiet` counts the instances since a mark moved. A `proposed` rule came by analogy and does not fire yet.
    """

    name: str
    action: Action
    marks: tuple[Marks, ...]
    positives: tuple[Instance, ...] = ()
    negatives: tuple[Instance, ...] = ()
    choices: tuple[Choice, ...] = ()
    quiet: int = 0
    proposed: bool = False

    @property
    def may_fire(self) -> bool:
        """Whether it takes part in consultation: it was seen right at least once, or confirmed."""
        return bool(self.positives) and not self.proposed

    def marks_in(self, tree: str) -> Marks:
        for marks in self.marks:
            if marks.tree == tree:
                return marks
        raise unknown("tree", tree, [marks.tree for marks in self.marks])


@dataclass(frozen=True, slots=True)
class Event:
    """What one lesson did to one rule; `tree` is empty where no mark but the order or the forest changed."""

    instance: str
    rule: str
    tree: str
    mark: Literal["upper", "lower", "order", "tree", "rule"]
    before: str
    after: str
    why: str


@dataclass(frozen=True, slots=True)
class Preference:
    """Where both rules could fire, the teacher wants the better one."""

    better: str
    worse: str
    situation: Situation
    instance: str


@dataclass(frozen=True, slots=True)
class Rulebook:
    """All rules over one forest, the first of those that could fire first, and how they came to be so."""

    forest: Forest
    rules: tuple[Rule, ...] = ()
    preferences: tuple[Preference, ...] = ()
    events: tuple[Event, ...] = ()
    lessons: int = 0

    def __post_init__(self) -> None:
        """Raises `WrongUse` for two rules of one name, or more than `MAX_RULES`."""
        if len(self.rules) > MAX_RULES:
            raise WrongUse(f"a rulebook holds at most {MAX_RULES} rules, got {len(self.rules)}")
        counted = Counter(rule.name for rule in self.rules)
        if len(counted) < len(self.rules):
            raise WrongUse(f"the rulebook has two rules named {counted.most_common(1)[0][0]!r}")

    def __getitem__(self, name: str) -> Rule:
        """The rule of that name. Raises `WrongUse` naming the rules there are."""
        return self.rules[self.place(name)]

    def place(self, name: str) -> int:
        for k, rule in enumerate(self.rules):
            if rule.name == name:
                return k
        raise unknown("rule", name, [rule.name for rule in self.rules])


def status(rule: Rule) -> Status:
    """How far the rule has come: firm when the marks meet in every tree, stabilised when they rest."""
    if rule.proposed:
        return "proposed"
    if not rule.positives:
        return "empty"
    if all(marks.upper == marks.lower for marks in rule.marks):
        return "firm"
    return "stabilised" if rule.quiet >= QUIET else "shell"


def covers(tree: FeatureTree, mark: str | None, value: str | None) -> bool:
    """Whether the value is below the mark; a value that was not noted could be, below a mark nothing set
    no one is."""
    if mark is None:
        return value is None
    return value is None or tree.is_below(value, mark)


def outside(forest: Forest, rule: Rule, situation: Situation) -> list[str]:
    """The trees whose upper mark keeps the situation out; none where the rule may fire."""
    return [
        tree.name
        for tree, marks, value in zip(forest.trees, rule.marks, situation.values, strict=True)
        if not covers(tree, marks.upper, value)
    ]


def grey(forest: Forest, rule: Rule, situation: Situation) -> list[str]:
    """The trees in which nobody has seen the rule right at such a value: the situation is not below the
    lower mark."""
    return [
        tree.name
        for tree, marks, value in zip(forest.trees, rule.marks, situation.values, strict=True)
        if not covers(tree, marks.lower, value)
    ]
