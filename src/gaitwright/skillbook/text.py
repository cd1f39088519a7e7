"""Books ↔ lines of text that diff well: a word and JSON, one thing a line, rules with what they hold below.

Order is kept where it means something (rules, instances, steps); there is no other.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import msgspec

from gaitwright.errors import BadFile
from gaitwright.knowledge.json_form import (
    FORMAT,
    MAX_BYTES,
    ActionEntry,
    BookEntry,
    Count,
    EventEntry,
    Facts,
    InstanceEntry,
    Kind,
    Label,
    RuleEntry,
    Strict,
    Text,
    TreeEntry,
    WishEntry,
)
from gaitwright.knowledge.trust import Experience
from gaitwright.skillbook.entries import (
    About,
    AncestorEntry,
    File,
    LessonEntry,
    Place,
    StepEntry,
    ToldEntry,
    Whole,
    encoded,
)
from gaitwright.skillbook.history import How
from gaitwright.skillbook.map_notes import MapNotes, place_of
from gaitwright.skillbook.operator_notes import OperatorNotes
from gaitwright.skillbook.profile_notes import ProfileNotes, name_of
from gaitwright.skillbook.pupil_notes import PupilNotes

HEAD = "gaitwright skillbook text 1"
END = "end"


class BookLine(Strict, frozen=True):
    name: Label
    robot: Label
    made_by: Label
    seed: Whole
    lessons: Count


class RuleLine(Strict, frozen=True):
    name: Label
    action: ActionEntry
    quiet: Place
    proposed: bool


class MarkLine(Strict, frozen=True):
    rule: Label
    tree: Label
    upper: Label
    lower: Label | None


class InstanceLine(Strict, frozen=True, omit_defaults=True):
    """An instance of the rule above; the values stand as the trees do."""

    rule: Label
    id: Text
    kind: Kind
    values: tuple[Label | None, ...]
    raw: Facts = msgspec.field(default_factory=dict)
    note: Text = ""
    choice: tuple[Label, tuple[Label, ...]] | None = None


class StepLine(Strict, frozen=True, omit_defaults=True):
    how: How
    lesson: LessonEntry | None = None
    rulebook: BookEntry | None = None
    note: Text = ""
    told: ToldEntry | None = None


KINDS: dict[str, type] = {
    "book": BookLine,
    "ancestor": AncestorEntry,
    "tree": TreeEntry,
    "rule": RuleLine,
    "mark": MarkLine,
    "right": InstanceLine,
    "wrong": InstanceLine,
    "wish": WishEntry,
    "step": StepLine,
    "event": EventEntry,
    "pupil": PupilNotes,
    "profile": ProfileNotes,
    "trust": Experience,
    "operator": OperatorNotes,
    "map": MapNotes,
}


# --- writing ----------------------------------------------------------------------------------------
def write(entry: File) -> str:
    """The book as text that ends in a line end."""
    lines = (f"{word} {encoded(line)}" for word, line in _lines(entry))
    return "\n".join([HEAD, *lines, END, ""])


def _lines(entry: File) -> Iterator[tuple[str, Any]]:
    a, book = entry.about, entry.rulebook
    yield "book", BookLine(a.name, a.robot, a.made_by, a.seed, a.lessons)
    for ancestor in entry.ancestors:
        yield "ancestor", ancestor
    for tree in book.trees:
        yield "tree", tree
    for rule in book.rules:
        yield from _rule_lines(rule, [tree.name for tree in book.trees])
    for wish in book.preferences:
        yield "wish", wish
    start = 0
    for step in entry.steps:
        yield "step", StepLine(step.how, step.lesson, step.rulebook, step.note, step.told)
        for event in book.events[start : start + step.events]:
            yield "event", event
        start += step.events
    if entry.pupil is not None:
        yield "pupil", entry.pupil
    for profile in entry.profiles:
        yield "profile", profile
    for experience in entry.trust:
        yield "trust", experience
    for operator in entry.operators:
        yield "operator", operator
    for notes in entry.maps:
        yield "map", notes


def _rule_lines(rule: RuleEntry, trees: list[str]) -> Iterator[tuple[str, Any]]:
    yield "rule", RuleLine(rule.name, rule.action, rule.quiet, rule.proposed)
    for tree, upper, lower in zip(trees, rule.upper, rule.lower, strict=True):
        yield "mark", MarkLine(rule.name, tree, upper, lower)
    for i in rule.positives:
        yield "right", InstanceLine(rule.name, i.id, i.kind, i.values, i.raw, i.note)
    for i, choice in zip(rule.negatives, rule.choices, strict=True):
        yield "wrong", InstanceLine(rule.name, i.id, i.kind, i.values, i.raw, i.note, choice)


# --- reading ----------------------------------------------------------------------------------------
@dataclass
class DraftRule:
    """A rule and the lines below it."""

    head: RuleLine
    marks: list[MarkLine] = field(default_factory=list)
    rights: list[InstanceLine] = field(default_factory=list)
    wrongs: list[InstanceLine] = field(default_factory=list)


@dataclass
class Draft:
    """What was read so far."""

    book: BookLine | None = None
    ancestors: list[AncestorEntry] = field(default_factory=list)
    trees: list[TreeEntry] = field(default_factory=list)
    rules: dict[str, "DraftRule"] = field(default_factory=dict)
    wishes: list[WishEntry] = field(default_factory=list)
    steps: list[tuple[StepLine, list[EventEntry]]] = field(default_factory=list)
    pupils: list[PupilNotes] = field(default_factory=list)
    profiles: list[ProfileNotes] = field(default_factory=list)
    trust: list[Experience] = field(default_factory=list)
    operators: list[OperatorNotes] = field(default_factory=list)
    maps: list[MapNotes] = field(default_factory=list)


def read(content: str, source: str) -> File:
    """The book in a text. Raises `BadFile` naming the line that is none of a book."""
    if len(content) > MAX_BYTES:
        raise BadFile(f"{source} is larger than the limit of {MAX_BYTES / 1e6:g} MB")
    lines = content.rstrip().split("\n")
    if lines[0].strip() != HEAD:
        raise BadFile(f"{source} does not begin with {HEAD!r}: it is no skillbook text of this version")
    if len(lines) < 2 or lines[-1] != END:
        raise BadFile(f"{source} does not end with {END!r}: a part of it is missing")
    draft = Draft()
    for count, line in enumerate(lines[1:-1], start=2):
        if not line.strip():
            continue
        try:
            _take(draft, line)
        except (msgspec.DecodeError, RecursionError, UnicodeEncodeError, _Misplaced) as error:
            raise BadFile(f"{source}, line {count}: {error}") from None
    return _file(draft, source)


class _Misplaced(Exception):
    """A line that says what cannot be said there."""


def _take(draft: Draft, line: str) -> None:
    word, _, rest = line.partition(" ")
    if word not in KINDS:
        raise _Misplaced(f"no line begins with {word[:40]!r}; these do: {', '.join(KINDS)}")
    value = msgspec.json.decode(rest.encode(), type=KINDS[word])
    if word == "book":
        if draft.book is not None:
            raise _Misplaced("a second book in one text")
        draft.book = value
    elif word == "rule":
        if value.name in draft.rules:
            raise _Misplaced(f"the rule {value.name!r} a second time")
        draft.rules[value.name] = DraftRule(value)
    elif word in ("mark", "right", "wrong"):
        if value.rule not in draft.rules:
            raise _Misplaced(f"no rule {value.rule!r} above")
        rule = draft.rules[value.rule]
        {"mark": rule.marks, "right": rule.rights, "wrong": rule.wrongs}[word].append(value)
    elif word == "step":
        draft.steps.append((value, []))
    elif word == "event":
        if not draft.steps:
            raise _Misplaced("an event before any step")
        draft.steps[-1][1].append(value)
    else:
        if word == "pupil" and draft.pupils:
            raise _Misplaced("a second pupil in one text")
        lists = {
            "ancestor": draft.ancestors,
            "tree": draft.trees,
            "wish": draft.wishes,
            "pupil": draft.pupils,
            "profile": draft.profiles,
            "trust": draft.trust,
            "operator": draft.operators,
            "map": draft.maps,
        }
        lists[word].append(value)


def _file(draft: Draft, source: str) -> File:
    """The entries of a book whose lines were all read."""
    b = draft.book
    if b is None:
        raise BadFile(f"{source} does not say what book it is: a line 'book' is missing")
    trees, wishes, ancestors = tuple(draft.trees), tuple(draft.wishes), tuple(draft.ancestors)
    profiles, maps = tuple(sorted(draft.profiles, key=name_of)), tuple(sorted(draft.maps, key=place_of))
    names = [tree.name for tree in trees]
    rules = tuple(_rule(rule, names, source) for rule in draft.rules.values())
    steps = tuple(
        StepEntry(step.how, step.lesson, step.rulebook, step.note, len(events), step.told)
        for step, events in draft.steps
    )
    events = tuple(event for _, moved in draft.steps for event in moved)
    pupil, more = (
        draft.pupils[0] if draft.pupils else None,
        (tuple(draft.trust), tuple(draft.operators), maps),
    )
    counted = (steps, rules, wishes, trees, ancestors, draft.pupils, profiles, *more)
    about = About(b.name, b.robot, b.made_by, b.seed, b.lessons, *map(len, counted))
    rulebook = BookEntry(FORMAT, trees, rules, wishes, events, b.lessons)
    return File(about, rulebook, steps, ancestors, pupil, profiles, *more)


def _rule(rule: DraftRule, trees: list[str], source: str) -> RuleEntry:
    head = rule.head
    if [mark.tree for mark in rule.marks] != trees:
        raise BadFile(f"{source}: {head.name} needs one mark in each of {', '.join(trees)}, in this order")
    choices = tuple(wrong.choice for wrong in rule.wrongs if wrong.choice is not None)
    if any(right.choice for right in rule.rights) or len(choices) < len(rule.wrongs):
        raise BadFile(f"{source}: {head.name} has wrong instances without a choice, or right ones with one")
    return RuleEntry(
        head.name,
        head.action,
        tuple(mark.upper for mark in rule.marks),
        tuple(mark.lower for mark in rule.marks),
        tuple(_instance(right) for right in rule.rights),
        tuple(_instance(wrong) for wrong in rule.wrongs),
        choices,
        head.quiet,
        head.proposed,
    )


def _instance(line: InstanceLine) -> InstanceEntry:
    return InstanceEntry(line.id, line.kind, line.values, line.raw, line.note)
