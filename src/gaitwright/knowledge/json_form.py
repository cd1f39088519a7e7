"""Rulebooks as plain data, for JSON: what comes back is checked as an untrusted file is."""

from collections.abc import Sequence
from typing import Annotated, Any, Literal

import msgspec
from msgspec import Meta

from gaitwright.errors import BadFile, WrongUse
from gaitwright.files import json_of
from gaitwright.knowledge.audit import audit
from gaitwright.knowledge.forest import MAX_TREES, Forest, Situation
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.rules import (
    MAX_RULES,
    Choice,
    Event,
    Instance,
    Kind,
    Marks,
    Preference,
    Rule,
    Rulebook,
)
from gaitwright.knowledge.tree_checks import MAX_LABEL, MAX_LEAVES
from gaitwright.knowledge.trees import FeatureTree

FORMAT = 1
MAX_BYTES = 50_000_000
MAX_INSTANCES = 100_000
MAX_EVENTS = 1_000_000

Label = Annotated[str, Meta(max_length=MAX_LABEL)]
Text = Annotated[str, Meta(max_length=10_000)]
Fact = Text | float
Facts = Annotated[dict[Label, Fact], Meta(max_length=1000)]
Count = Annotated[int, Meta(ge=0, le=1 << 53)]
Leaves = Annotated[tuple[Label | None, ...], Meta(min_length=1, max_length=MAX_TREES)]
Pairs = Annotated[tuple[tuple[Label, Fact], ...], Meta(max_length=1000)]


class Strict(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Refuses what it does not know."""


class TreeEntry(Strict, frozen=True):
    name: Label
    values: Annotated[tuple[Label, ...], Meta(max_length=2 * MAX_LEAVES)]
    parents: Annotated[tuple[int, ...], Meta(max_length=2 * MAX_LEAVES)]
    about: Label = ""
    unit: Label = ""
    bounds: Annotated[tuple[float, ...], Meta(max_length=MAX_LEAVES)] = ()
    source: Label = ""


class ActionEntry(Strict, frozen=True):
    skill: Label
    slowest: float = 0.0
    fastest: float = 0.0
    until: Text = ""
    adds: Pairs = ()
    deletes: Annotated[tuple[Label, ...], Meta(max_length=1000)] = ()
    details: Pairs = ()


class InstanceEntry(Strict, frozen=True):
    id: Text
    kind: Kind
    values: Leaves
    raw: Facts = {}
    note: Text = ""


class RuleEntry(Strict, frozen=True):
    name: Label
    action: ActionEntry
    upper: Annotated[tuple[Label, ...], Meta(max_length=MAX_TREES)]
    lower: Leaves
    positives: Annotated[tuple[InstanceEntry, ...], Meta(max_length=MAX_INSTANCES)] = ()
    negatives: Annotated[tuple[InstanceEntry, ...], Meta(max_length=MAX_INSTANCES)] = ()
    choices: Annotated[tuple[tuple[Label, tuple[Label, ...]], ...], Meta(max_length=MAX_INSTANCES)] = ()
    quiet: Count = 0
    proposed: bool = False


class WishEntry(Strict, frozen=True):
    better: Label
    worse: Label
    values: Leaves
    instance: Text


class EventEntry(Strict, frozen=True):
    instance: Text
    rule: Label
    tree: Label
    mark: Literal["upper", "lower", "order", "tree", "rule"]
    before: Text
    after: Text
    why: Text


class BookEntry(Strict, frozen=True):
    format: Literal[1]
    trees: Annotated[tuple[TreeEntry, ...], Meta(min_length=1, max_length=MAX_TREES)]
    rules: Annotated[tuple[RuleEntry, ...], Meta(max_length=MAX_RULES)] = ()
    preferences: Annotated[tuple[WishEntry, ...], Meta(max_length=MAX_INSTANCES)] = ()
    events: Annotated[tuple[EventEntry, ...], Meta(max_length=MAX_EVENTS)] = ()
    lessons: Count = 0


def to_plain(rulebook: Rulebook) -> dict[str, Any]:
    """The rulebook as dicts, tuples, numbers and text: what JSON can hold."""
    return msgspec.to_builtins(_entry(rulebook))


def from_plain(plain: Any, source: str = "rulebook") -> Rulebook:
    """The rulebook from what `to_plain` gave. Raises `BadFile` with one sentence, `source` in front."""
    try:
        entry = msgspec.convert(plain, BookEntry)
    except msgspec.ValidationError as error:
        raise BadFile(f"{source}: {error}") from None
    return _checked(entry, source)


def dumps(rulebook: Rulebook) -> bytes:
    """The rulebook as JSON."""
    return msgspec.json.encode(_entry(rulebook))


def loads(content: bytes, source: str = "rulebook") -> Rulebook:
    """The rulebook from JSON. Raises `BadFile` with one sentence, `source` in front."""
    if len(content) > MAX_BYTES:
        raise BadFile(f"{source} is larger than the limit of {MAX_BYTES / 1e6:g} MB")
    try:
        entry = json_of(content, BookEntry, source)
    except msgspec.ValidationError as error:
        raise BadFile(f"{source}: {error}") from None
    return _checked(entry, source)


def _checked(entry: BookEntry, source: str) -> Rulebook:
    """The rulebook of an entry, if it is one that learning could have made."""
    try:
        rulebook = _book(entry)
        faults = audit(rulebook)
    except WrongUse as error:
        raise BadFile(f"{source}: {error}") from None
    if faults:
        raise BadFile(f"{source}: {faults[0]}")
    return rulebook


def _entry(rulebook: Rulebook) -> BookEntry:
    wishes = tuple(
        WishEntry(wish.better, wish.worse, wish.situation.values, wish.instance)
        for wish in rulebook.preferences
    )
    return BookEntry(
        FORMAT,
        tuple(
            TreeEntry(t.name, t.values, t.parents, t.about, t.unit, t.bounds, t.source)
            for t in rulebook.forest.trees
        ),
        tuple(_rule_entry(rule) for rule in rulebook.rules),
        wishes,
        tuple(
            EventEntry(e.instance, e.rule, e.tree, e.mark, e.before, e.after, e.why) for e in rulebook.events
        ),
        rulebook.lessons,
    )


def _rule_entry(rule: Rule) -> RuleEntry:
    a = rule.action
    return RuleEntry(
        rule.name,
        ActionEntry(a.skill, a.slowest, a.fastest, a.until, a.adds, a.deletes, a.details),
        tuple(marks.upper for marks in rule.marks),
        tuple(marks.lower for marks in rule.marks),
        tuple(_instance_entry(instance) for instance in rule.positives),
        tuple(_instance_entry(instance) for instance in rule.negatives),
        tuple((choice.tree, choice.others) for choice in rule.choices),
        rule.quiet,
        rule.proposed,
    )


def _instance_entry(i: Instance) -> InstanceEntry:
    return InstanceEntry(i.id, i.kind, i.situation.values, dict(i.raw), i.note)


def _book(entry: BookEntry) -> Rulebook:
    """Values from an entry. Raises `WrongUse` for whatever does not fit together."""
    forest = Forest(
        tuple(
            FeatureTree(t.name, t.values, t.parents, t.about, t.unit, t.bounds, t.source) for t in entry.trees
        )
    )
    rulebook = Rulebook(
        forest,
        tuple(_rule(forest, rule) for rule in entry.rules),
        tuple(
            Preference(wish.better, wish.worse, _situation(forest, wish.values), wish.instance)
            for wish in entry.preferences
        ),
        tuple(Event(e.instance, e.rule, e.tree, e.mark, e.before, e.after, e.why) for e in entry.events),
        entry.lessons,
    )
    for wish in rulebook.preferences:
        rulebook.place(wish.better)
        rulebook.place(wish.worse)
    return rulebook


def _rule(forest: Forest, entry: RuleEntry) -> Rule:
    """One rule of an entry. Raises `WrongUse` where marks or choices are not of this forest."""
    if not len(entry.upper) == len(entry.lower) == len(forest.names):
        raise WrongUse(f"{entry.name} has marks in {len(entry.upper)} trees of {len(forest.names)}")
    if len(entry.choices) != len(entry.negatives):
        raise WrongUse(f"{entry.name} has {len(entry.choices)} choices for {len(entry.negatives)} negatives")
    for tree, upper, lower in zip(forest.trees, entry.upper, entry.lower, strict=True):
        tree.leaf_set(upper)
        if lower is not None:
            tree.leaf_set(lower)
    for chosen, others in entry.choices:
        for name in ((chosen,) if chosen else ()) + others:
            forest[name]
    a = entry.action
    return Rule(
        entry.name,
        Action(a.skill, a.slowest, a.fastest, a.until, a.adds, a.deletes, a.details),
        tuple(map(Marks, forest.names, entry.upper, entry.lower)),
        _instances(forest, entry.name, entry.positives, True),
        _instances(forest, entry.name, entry.negatives, False),
        tuple(Choice(chosen, others) for chosen, others in entry.choices),
        entry.quiet,
        entry.proposed,
    )


def _instances(
    forest: Forest, rule: str, entries: Sequence[InstanceEntry], speaks_for: bool
) -> tuple[Instance, ...]:
    """Instances of one sign. Raises `WrongUse` for one of the other sign, or of no situation in the
    forest."""
    made = tuple(Instance(i.id, i.kind, _situation(forest, i.values), i.raw, i.note) for i in entries)
    for instance in made:
        if instance.speaks_for != speaks_for:
            raise WrongUse(f"{rule} keeps {instance.id} ({instance.kind}) among the wrong instances")
    return made


def _situation(forest: Forest, values: tuple[str | None, ...]) -> Situation:
    """A situation from its leaves, in the forest's order. Raises `WrongUse` for what is no leaf."""
    if len(values) != len(forest.names):
        raise WrongUse(f"a situation of {len(values)} values, in a forest of {len(forest.names)} trees")
    for tree, value in zip(forest.trees, values, strict=True):
        if value is not None and not tree.is_leaf(value):
            raise WrongUse(f"{value!r} is no leaf of {tree.name}; these are: {', '.join(tree.leaves)}")
    return Situation(forest.names, values)
