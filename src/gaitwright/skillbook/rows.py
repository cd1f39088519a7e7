"""Entries ↔ sealed rows. A row is what it is called, its content as JSON, and a digest of both.

SQLite notices damage to its own structure, not to what the rows say: that is what the seals are for, and
the counts in the book's own row for rows that are gone.
"""

import sqlite3
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from hashlib import blake2b
from itertools import groupby
from typing import Any, TypeVar

import msgspec

from gaitwright.errors import BadFile
from gaitwright.knowledge.json_form import FORMAT, BookEntry, EventEntry, RuleEntry, TreeEntry, WishEntry
from gaitwright.knowledge.rules import Rulebook
from gaitwright.knowledge.trust import Experience
from gaitwright.skillbook.entries import (
    About,
    AncestorEntry,
    File,
    Held,
    RuleHead,
    StepEntry,
    encoded,
    rulebook_entry,
)
from gaitwright.skillbook.map_notes import MapNotes, place_of
from gaitwright.skillbook.operator_notes import OperatorNotes
from gaitwright.skillbook.profile_notes import ProfileNotes, name_of
from gaitwright.skillbook.pupil_notes import PupilNotes

KEYS = {
    "book": ("place",),
    "ancestors": ("place",),
    "trees": ("place",),
    "rules": ("name",),
    "instances": ("rule", "sign", "place"),
    "wishes": ("place",),
    "steps": ("place",),
    "events": ("step", "place"),
    "pupil": ("place",),
    "profiles": ("name",),
    "trust": ("place",),
    "operators": ("place",),
    "maps": ("place",),
}
"""The key columns of each table, in an order in which rows can be written."""

Key = tuple[str, tuple[Any, ...]]
"""A table and the key of a row in it."""
Rows = dict[Key, str]
T = TypeVar("T")


def seal(key: Key, content: str) -> bytes:
    return blake2b(f"{key!r}\n{content}".encode(), digest_size=8).digest()


def put(db: sqlite3.Connection, rows: Mapping[Key, str]) -> None:
    """Writes rows, over those of the same keys; one table after the other."""
    order = list(KEYS)
    for key, content in sorted(rows.items(), key=lambda row: order.index(row[0][0])):
        table, values = key
        names = ", ".join(KEYS[table])
        marks = ", ".join("?" for _ in (*values, content, key))
        db.execute(
            f"INSERT INTO {table} ({names}, content, seal) VALUES ({marks}) "
            f"ON CONFLICT ({names}) DO UPDATE SET (content, seal) = (excluded.content, excluded.seal)",
            (*values, content, seal(key, content)),
        )


def remove(db: sqlite3.Connection, keys: Iterable[Key]) -> None:
    order = list(KEYS)
    for table, values in sorted(keys, key=lambda key: -order.index(key[0])):
        db.execute(f"DELETE FROM {table} WHERE {' AND '.join(f'{name} = ?' for name in KEYS[table])}", values)


# --- what the rulebook is ----------------------------------------------------------------------------
def change(db: sqlite3.Connection, before: Rulebook | None, after: Rulebook) -> None:
    """Writes what differs between two rulebooks, events apart; only rules that changed are looked at."""
    old = {} if before is None else {r.name: (k, r) for k, r in enumerate(before.rules)}
    new = {r.name: (k, r) for k, r in enumerate(after.rules)}
    forest_changed = before is None or before.forest != after.forest
    changed = {name for name in old.keys() | new.keys() if forest_changed or old.get(name) != new.get(name)}
    was = {} if before is None else state_rows(before, changed)
    now = state_rows(after, changed)
    remove(db, was.keys() - now.keys())
    put(db, {key: content for key, content in now.items() if was.get(key) != content})


def state_rows(rulebook: Rulebook, names: set[str]) -> Rows:
    """The rows of a rulebook's trees, wishes, and of the rules named."""
    places = [k for k, rule in enumerate(rulebook.rules) if rule.name in names]
    part = replace(rulebook, rules=tuple(rulebook.rules[k] for k in places), events=())
    return book_rows(rulebook_entry(part), places)


def book_rows(entry: BookEntry, places: Sequence[int]) -> Rows:
    """The rows of a rulebook's entry, its rules at these places; without its events."""
    rows: Rows = {("trees", (k,)): encoded(tree) for k, tree in enumerate(entry.trees)}
    rows |= {("wishes", (k,)): encoded(wish) for k, wish in enumerate(entry.preferences)}
    for place, rule in zip(places, entry.rules, strict=True):
        rows |= rule_rows(place, rule)
    return rows


def rule_rows(place: int, rule: RuleEntry) -> Rows:
    head = RuleHead(
        place,
        rule.action,
        rule.upper,
        rule.lower,
        rule.quiet,
        rule.proposed,
        len(rule.positives),
        len(rule.negatives),
    )
    rows: Rows = {("rules", (rule.name,)): encoded(head)}
    rows |= {("instances", (rule.name, 1, k)): encoded(Held(right)) for k, right in enumerate(rule.positives)}
    rows |= {
        ("instances", (rule.name, -1, k)): encoded(Held(wrong, choice))
        for k, (wrong, choice) in enumerate(zip(rule.negatives, rule.choices, strict=True))
    }
    return rows


def profile_rows(profiles: Iterable[ProfileNotes]) -> Rows:
    """The rows of torque profiles."""
    return {("profiles", (name_of(profile),)): encoded(profile) for profile in profiles}


def map_rows(maps: Iterable[MapNotes]) -> Rows:
    """The rows of learned maps."""
    return {("maps", (place_of(notes),)): encoded(notes) for notes in maps}


def change_profiles(
    db: sqlite3.Connection, before: Sequence[ProfileNotes], after: Sequence[ProfileNotes]
) -> None:
    """Writes what differs between the profiles of two books."""
    if before is after:
        return
    was, now = ({name_of(profile): profile for profile in some} for some in (before, after))
    remove(db, [("profiles", (name,)) for name in was.keys() - now.keys()])
    put(db, profile_rows(profile for name, profile in now.items() if was.get(name) != profile))


def change_maps(db: sqlite3.Connection, before: Sequence[MapNotes], after: Sequence[MapNotes]) -> None:
    """Writes what differs between the maps of two books."""
    if before is after:
        return
    was, now = ({place_of(notes): notes for notes in some} for some in (before, after))
    remove(db, [("maps", (place,)) for place in was.keys() - now.keys()])
    put(db, map_rows(notes for place, notes in now.items() if was.get(place) != notes))


def trust_rows(history: Iterable[Experience], first: int = 0) -> Rows:
    """The rows of entries of trust, the first of them at a place."""
    return {("trust", (k,)): encoded(entry) for k, entry in enumerate(history, first)}


def operator_rows(operators: Iterable[OperatorNotes]) -> Rows:
    """The rows of terrain operators, in their order."""
    return {("operators", (place,)): encoded(operator) for place, operator in enumerate(operators)}


def change_operators(
    db: sqlite3.Connection, before: Sequence[OperatorNotes], after: Sequence[OperatorNotes]
) -> None:
    """Writes what differs between the terrain operators of two books."""
    if before is after:
        return
    was, now = operator_rows(before), operator_rows(after)
    remove(db, was.keys() - now.keys())
    put(db, {key: content for key, content in now.items() if was.get(key) != content})


def step_rows(place: int, step: StepEntry, events: Iterable[EventEntry]) -> Rows:
    """The rows of one step and what it moved."""
    rows: Rows = {("steps", (place,)): encoded(step)}
    return rows | {("events", (place, k)): encoded(event) for k, event in enumerate(events)}


# --- back ------------------------------------------------------------------------------------------
def read(db: sqlite3.Connection, source: str) -> File:
    """All of a book's rows as entries. Raises `BadFile` where one is missing, altered or of no sense."""
    about = _read(db, "book", About, source).get((0,))
    if about is None:
        raise BadFile(f"{source} is damaged: it does not say what it is")
    trees = _row_of(_read(db, "trees", TreeEntry, source), about.trees, "trees", source)
    wishes = _row_of(_read(db, "wishes", WishEntry, source), about.wishes, "wishes", source)
    steps = _row_of(_read(db, "steps", StepEntry, source), about.steps, "steps", source)
    ancestors = _row_of(_read(db, "ancestors", AncestorEntry, source), about.ancestors, "ancestors", source)
    events = _events(_read(db, "events", EventEntry, source), steps, source)
    rules = _rules(db, about, source)
    notes = _row_of(_read(db, "pupil", PupilNotes, source), about.pupil, "pupils", source)
    rulebook = BookEntry(FORMAT, trees, rules, wishes, events, about.lessons)
    profiles = _named(
        _read(db, "profiles", ProfileNotes, source), name_of, about.profiles, "profiles", source
    )
    maps = _named(_read(db, "maps", MapNotes, source), place_of, about.maps, "maps", source)
    trust = _row_of(_read(db, "trust", Experience, source), about.trust, "entries of trust", source)
    operators = _row_of(_read(db, "operators", OperatorNotes, source), about.operators, "operators", source)
    pupil = notes[0] if notes else None
    return File(about, rulebook, steps, ancestors, pupil, profiles, trust, operators, maps)


def _read(db: sqlite3.Connection, table: str, kind: type[T], source: str) -> dict[tuple, T]:
    """The rows of a table by their keys, in the order of these."""
    names, found = ", ".join(KEYS[table]), {}
    for *key, content, sealed in db.execute(f"SELECT {names}, content, seal FROM {table} ORDER BY {names}"):
        where = f"row {', '.join(map(str, key))} of its {table}"
        if seal((table, tuple(key)), content) != sealed:
            raise BadFile(f"{source} is damaged: {where} is not as it was written")
        try:
            found[tuple(key)] = msgspec.json.decode(content, type=kind)
        except (msgspec.DecodeError, RecursionError) as error:
            raise BadFile(f"{source}: {where}: {error}") from None
    return found


def _row_of(found: Mapping[tuple, T], count: int, what: str, source: str) -> tuple[T, ...]:
    """Rows that stand in a row, none missing."""
    if len(found) != count or [key[-1] for key in found] != list(range(count)):
        raise BadFile(f"{source} is damaged: of {count} {what} it has {len(found)}, or in no order")
    return tuple(found.values())


def _named(
    found: Mapping[tuple, T], name: Callable[[T], str], count: int, what: str, source: str
) -> tuple[T, ...]:
    """Entries under their own names, none missing."""
    if len(found) != count or any(key != (name(entry),) for key, entry in found.items()):
        raise BadFile(f"{source} is damaged: of {count} {what} it has {len(found)}, or under other names")
    return tuple(found.values())


def _events(
    found: Mapping[tuple, EventEntry], steps: tuple[StepEntry, ...], source: str
) -> tuple[EventEntry, ...]:
    together = sum(step.events for step in steps) == len(found)  # only then so many are counted out
    if not together or list(found) != [(k, e) for k, step in enumerate(steps) for e in range(step.events)]:
        raise BadFile(f"{source} is damaged: its steps and what they moved do not belong together")
    return tuple(found.values())


def _rules(db: sqlite3.Connection, about: About, source: str) -> tuple[RuleEntry, ...]:
    heads = sorted(_read(db, "rules", RuleHead, source).items(), key=lambda row: row[1].place)
    if len(heads) != about.rules or [head.place for _, head in heads] != list(range(about.rules)):
        raise BadFile(f"{source} is damaged: of {about.rules} rules it has {len(heads)}, or in no order")
    found = _read(db, "instances", Held, source).items()
    held = {
        owner: {key: row for key, row in rows} for owner, rows in groupby(found, key=lambda row: row[0][:2])
    }
    rules = []
    for (name,), head in heads:
        rights, wrongs = (
            _row_of(held.get((name, sign), {}), count, f"instances of {name}", source)
            for sign, count in ((1, head.rights), (-1, head.wrongs))
        )
        rules.append(_rule(name, head, rights, wrongs, source))
    return tuple(rules)


def _rule(
    name: str, head: RuleHead, rights: tuple[Held, ...], wrongs: tuple[Held, ...], source: str
) -> RuleEntry:
    choices = tuple(wrong.choice for wrong in wrongs if wrong.choice is not None)
    if len(choices) < len(wrongs) or any(right.choice for right in rights):
        raise BadFile(f"{source}: {name} has wrong instances without a choice, or right ones with one")
    return RuleEntry(
        name,
        head.action,
        head.upper,
        head.lower,
        tuple(right.instance for right in rights),
        tuple(wrong.instance for wrong in wrongs),
        choices,
        head.quiet,
        head.proposed,
    )
