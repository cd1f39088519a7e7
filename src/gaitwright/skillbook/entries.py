"""Everything in a book as strict plain entries: what a file holds, whatever its form, is checked here."""

from collections.abc import Iterable
from typing import Annotated, Any, Literal, TypeVar

import msgspec
from msgspec import Meta

from gaitwright.errors import BadFile, WrongUse
from gaitwright.knowledge.forest import MAX_TREES, Situation
from gaitwright.knowledge.json_form import (
    MAX_EVENTS,
    ActionEntry,
    BookEntry,
    Count,
    EventEntry,
    Facts,
    InstanceEntry,
    Label,
    Leaves,
    Strict,
    Text,
    from_plain,
    to_plain,
)
from gaitwright.knowledge.lessons import Lesson
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.rules import Event, Rulebook
from gaitwright.knowledge.told import Given, Told
from gaitwright.knowledge.trust import Experience, History, fault_in_history
from gaitwright.skillbook.history import Ancestor, How, Step
from gaitwright.skillbook.map_notes import MapNotes, place_of
from gaitwright.skillbook.map_notes import fault_in as fault_in_maps
from gaitwright.skillbook.operator_notes import OperatorNotes
from gaitwright.skillbook.operator_notes import fault_in as fault_in_operators
from gaitwright.skillbook.profile_notes import ProfileNotes, fault_in, name_of
from gaitwright.skillbook.pupil_notes import PupilNotes

T = TypeVar("T")
Place = Annotated[int, Meta(ge=0, le=MAX_EVENTS)]
Whole = Annotated[int, Meta(ge=-(1 << 62), le=1 << 62)]


class About(Strict, frozen=True):
    """The book itself; the counts tell when rows are missing."""

    name: Label
    robot: Label
    made_by: Label
    seed: Whole
    lessons: Count
    steps: Place = 0
    rules: Place = 0
    wishes: Place = 0
    trees: Place = 0
    ancestors: Place = 0
    pupil: Annotated[int, Meta(ge=0, le=1)] = 0
    profiles: Place = 0
    trust: Place = 0
    operators: Place = 0
    maps: Place = 0


class AncestorEntry(Strict, frozen=True):
    how: Literal["forked", "merged"]
    name: Label
    digest: Annotated[str, Meta(pattern="^[0-9a-f]{64}$")]


class LessonEntry(Strict, frozen=True):
    kind: Literal["positive", "omission", "commission"]
    rule: Label
    situation: Annotated[tuple[tuple[Label, Label | None], ...], Meta(min_length=1, max_length=MAX_TREES)]
    id: Text
    note: Text = ""
    raw: Facts = msgspec.field(default_factory=dict)
    blame: Label = ""
    action: ActionEntry | None = None


class ToldEntry(Strict, frozen=True, omit_defaults=True):
    id: Text
    rule: Label
    action: ActionEntry
    facts: Facts
    because: Text = ""
    about: Label = ""
    scene: Text = ""
    given: Given = "corrected"


class StepEntry(Strict, frozen=True, omit_defaults=True):
    how: How
    lesson: LessonEntry | None = None
    rulebook: BookEntry | None = None
    note: Text = ""
    events: Place = 0
    told: ToldEntry | None = None


class RuleHead(Strict, frozen=True):
    """A rule without its instances, and how many of these there are."""

    place: Place
    action: ActionEntry
    upper: Annotated[tuple[Label, ...], Meta(max_length=MAX_TREES)]
    lower: Leaves
    quiet: Place
    proposed: bool
    rights: Place
    wrongs: Place


class Held(Strict, frozen=True):
    """An instance as a rule holds it, and for a wrong one the choice that keeps it out."""

    instance: InstanceEntry
    choice: tuple[Label, tuple[Label, ...]] | None = None


class File(Strict, frozen=True):
    """All of a book."""

    about: About
    rulebook: BookEntry
    steps: tuple[StepEntry, ...]
    ancestors: tuple[AncestorEntry, ...] = ()
    pupil: PupilNotes | None = None
    profiles: tuple[ProfileNotes, ...] = ()
    """In the order of their names."""
    trust: History = ()
    operators: tuple[OperatorNotes, ...] = ()
    """In the order in which they are tried."""
    maps: tuple[MapNotes, ...] = ()
    """In the order of their places."""


ENCODER = msgspec.json.Encoder(order="deterministic")


def encoded(entry: Any) -> str:
    """JSON on one line, the same for the same entry. Raises `WrongUse` for text that no file can hold."""
    try:
        return ENCODER.encode(entry).decode()
    except UnicodeEncodeError as error:
        raise WrongUse(f"a skillbook holds text only: {error}") from None


def checked(entry: Any, kind: type[T]) -> T:
    """An entry as it will be when it is read again. Raises `WrongUse` where it could not be."""
    try:
        return msgspec.convert(msgspec.to_builtins(entry), kind)
    except msgspec.ValidationError as error:
        raise WrongUse(f"a skillbook cannot hold this: {error}") from None


def rulebook_entry(rulebook: Rulebook) -> BookEntry:
    """A rulebook, checked against the limits of a file."""
    return checked(to_plain(rulebook), BookEntry)


def event_entries(events: tuple[Event, ...]) -> tuple[EventEntry, ...]:
    return tuple(checked(event, EventEntry) for event in events)


def step_entry(step: Step) -> StepEntry:
    """A step, checked against the limits of a file; of its events only how many."""
    lesson = None if step.lesson is None else _lesson_entry(step.lesson)
    rulebook = None if step.rulebook is None else rulebook_entry(step.rulebook)
    told = None if step.told is None else _told_entry(step.told)
    return checked(StepEntry(step.how, lesson, rulebook, step.note, len(step.events), told), StepEntry)


def _told_entry(told: Told) -> ToldEntry:
    action = checked(told.action, ActionEntry)
    own = (told.because, told.about, told.scene, told.given)
    return ToldEntry(told.id, told.rule, action, dict(told.facts), *own)


def _lesson_entry(lesson: Lesson) -> LessonEntry:
    action = None if lesson.action is None else checked(lesson.action, ActionEntry)
    pairs = tuple(lesson.situation.items())
    return LessonEntry(
        lesson.kind, lesson.rule, pairs, lesson.id, lesson.note, dict(lesson.raw), lesson.blame, action
    )


def ancestor_entry(ancestor: Ancestor) -> AncestorEntry:
    return checked(ancestor, AncestorEntry)


def profile_entries(profiles: Iterable[ProfileNotes]) -> tuple[ProfileNotes, ...]:
    """Torque profiles in the order of their names, checked against the limits of a file."""
    ordered = tuple(sorted((checked(profile, ProfileNotes) for profile in profiles), key=name_of))
    fault = fault_in(ordered)
    if fault:
        raise WrongUse(f"a skillbook cannot hold this: {fault}")
    return ordered


def operator_entries(operators: Iterable[OperatorNotes]) -> tuple[OperatorNotes, ...]:
    """Terrain operators, checked against the limits of a file."""
    entries = tuple(checked(operator, OperatorNotes) for operator in operators)
    fault = fault_in_operators(entries)
    if fault:
        raise WrongUse(f"a skillbook cannot hold this: {fault}")
    return entries


def map_entries(maps: Iterable[MapNotes]) -> tuple[MapNotes, ...]:
    """Learned maps in the order of their places, checked against the limits of a file."""
    entries = tuple(sorted((checked(notes, MapNotes) for notes in maps), key=place_of))
    fault = fault_in_maps(entries)
    if fault:
        raise WrongUse(f"a skillbook cannot hold this: {fault}")
    return entries


def trust_entries(history: Iterable[Experience]) -> History:
    """A history of trust, checked against the limits of a file."""
    entries = tuple(checked(entry, Experience) for entry in history)
    fault = fault_in_history(entries)
    if fault or len(entries) > MAX_EVENTS:
        raise WrongUse(f"a skillbook cannot hold this: {fault or f'more than {MAX_EVENTS} entries of trust'}")
    return entries


# --- back ------------------------------------------------------------------------------------------
def rulebook_of(entry: BookEntry, source: str) -> Rulebook:
    """The rulebook of an entry. Raises `BadFile`."""
    return from_plain(msgspec.to_builtins(entry), source)


def steps_of(entries: tuple[StepEntry, ...], events: tuple[Event, ...], source: str) -> tuple[Step, ...]:
    """The steps, each with its share of the events. Raises `BadFile` where they do not fit together."""
    if not entries or entries[0].how != "begun":
        raise BadFile(f"{source}: its history does not begin with a rulebook")
    if sum(entry.events for entry in entries) != len(events):
        raise BadFile(f"{source}: its steps moved other things than its rules remember")
    steps, start = [], 0
    for place, entry in enumerate(entries):
        steps.append(_step(entry, events[start : start + entry.events], f"{source}, step {place}"))
        start += entry.events
    return tuple(steps)


HOLDS = {"begun": "a rulebook", "edited": "a rulebook", "told": "what was told", "forgotten": ""}
"""What a step holds, where it is not a lesson of an older book."""


def _step(entry: StepEntry, events: tuple[Event, ...], source: str) -> Step:
    held = {"a rulebook": entry.rulebook, "a lesson": entry.lesson, "what was told": entry.told}
    wanted = HOLDS.get(entry.how, "a lesson")
    if [name for name, value in held.items() if value is not None] != ([wanted] if wanted else []):
        raise BadFile(f"{source}: a step {entry.how!r} has {wanted or 'a name'} and nothing else")
    rulebook = None if entry.rulebook is None else rulebook_of(entry.rulebook, source)
    told = None if entry.told is None else _told(entry.told, source)
    return Step(entry.how, _lesson(entry.lesson, source), rulebook, entry.note, events, told)


def _told(entry: ToldEntry, source: str) -> Told:
    """What was told. Raises `BadFile` for what makes no sense."""
    try:
        action = _action(entry.action)
        own = (entry.because, entry.about, entry.scene, entry.given)
        return Told(entry.id, entry.facts, entry.rule, action, *own)
    except WrongUse as error:
        raise BadFile(f"{source}: {error}") from None


def _action(a: ActionEntry) -> Action:
    return Action(a.skill, a.slowest, a.fastest, a.until, a.adds, a.deletes, a.details)


def _lesson(entry: LessonEntry | None, source: str) -> Lesson | None:
    """The lesson of an entry. Raises `BadFile` for one of no sense."""
    if entry is None:
        return None
    trees = tuple(tree for tree, _ in entry.situation)
    if len(set(trees)) < len(trees):
        raise BadFile(f"{source}: {entry.id} names a tree twice")
    try:
        action = entry.action and _action(entry.action)
    except WrongUse as error:
        raise BadFile(f"{source}: {error}") from None
    situation = Situation(trees, tuple(value for _, value in entry.situation))
    return Lesson(entry.kind, entry.rule, situation, entry.id, entry.note, entry.raw, entry.blame, action)


def ancestors_of(entries: tuple[AncestorEntry, ...]) -> tuple[Ancestor, ...]:
    return tuple(Ancestor(entry.how, entry.name, entry.digest) for entry in entries)
