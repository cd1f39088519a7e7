"""Edits to where they last: leg cycles as JSON files, profiles and operators in a skillbook."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import msgspec

from gaitwright.errors import BadFile, WrongUse
from gaitwright.files import fitting, whole
from gaitwright.gait.leg_cycles.files import CycleEntry, cycle_of, load_cycle
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle
from gaitwright.learning import operator_books, profile_books
from gaitwright.model.robot import Robot
from gaitwright.skillbook.operator_notes import OperatorNotes
from gaitwright.skillbook.profile_notes import ProfileNotes, name_of
from gaitwright.skillbook.writer import Ledger
from gaitwright.skills.library import skill_names
from gaitwright.studio.curve_checks import cannot_walk
from gaitwright.studio.curve_history import Snapshot
from gaitwright.studio.curve_walk import Walk


class Keeper:
    """Writes snapshots, and takes out again what it wrote and was undone since."""

    def __init__(self, ledger: Ledger | None, folder: Path | None) -> None:
        self.ledger, self.folder = ledger, folder
        self.kept = Snapshot()
        self.profiles: dict[str, ProfileNotes | None] = {}
        """What stood in the book under the names of edited profiles before; `None`: nothing."""
        self.operators: tuple[OperatorNotes, ...] | None = None
        """Those of the book before the first was added; `None`: none was."""

    def found(self, robot: Robot) -> tuple[Snapshot, list[str]]:
        """Leg cycles that were kept before, and what is wrong with those that a robot cannot walk."""
        cycles, faults = {}, []
        if self.folder is None:
            return self.kept, faults
        for skill in skill_names(robot.n):
            path, usual = self.folder / f"{skill}.json", cycle_of(skill)
            try:
                cycle = load_cycle(path) if path.is_file() else usual
            except BadFile as error:
                faults.append(f"not used: {error}")
                continue
            if cycle == replace(usual, name=cycle.name):  # it was undone
                continue
            wrong = cannot_walk(Walk.of(robot, skill), cycle, usual)
            if wrong:
                faults.append(f"not used: leg cycle of {skill} in {path}: {wrong.because}")
            else:
                cycles[skill] = cycle
        self.kept = Snapshot(cycles)
        return self.kept, faults

    def keep(self, snapshot: Snapshot, usual: Mapping[str, LegCycle]) -> list[str]:
        """Writes a snapshot; a sentence for each thing. `usual`: leg cycles by skill before all edits.

        Raises `WrongUse` where there is no place for it, or nothing to be kept.
        """
        said = [
            *self.keep_cycles(snapshot, usual),
            *self.keep_profiles(snapshot),
            *self.keep_operators(snapshot),
        ]
        if not said:
            raise WrongUse("there is no edit to keep")
        self.kept = snapshot
        return said

    def keep_cycles(self, snapshot: Snapshot, usual: Mapping[str, LegCycle]) -> list[str]:
        """A file for each leg cycle that was edited since the last time."""
        said = []
        for skill in {**self.kept.cycles, **snapshot.cycles}:
            cycle = snapshot.cycles.get(skill) or usual.get(skill) or cycle_of(skill)
            if self.kept.cycles.get(skill) == cycle:
                continue
            if self.folder is None:
                raise WrongUse("no folder was named for edited leg cycles")
            path = self.folder / f"{skill}.json"
            with fitting(path), whole(path) as draft:
                draft.write_bytes(as_json(cycle))
            said.append(f"leg cycle of {skill}: {path}")
        return said

    def keep_profiles(self, snapshot: Snapshot) -> list[str]:
        """Edited profiles stand in a book beside what they were."""
        if snapshot.torques == self.kept.torques:
            return []
        book = self.teachable("profiles").book
        known = {name_of(notes): notes for notes in book.profiles}
        new = {name_of(n): n for n in (profile_books.notes_of(e.profile) for e in snapshot.torques.values())}
        for name in new:
            self.profiles.setdefault(name, known.get(name))
        before = {name: notes for name, notes in self.profiles.items() if notes is not None}
        others = {name: notes for name, notes in known.items() if name not in self.profiles}
        self.teachable("profiles").keep_profiles({**others, **before, **new}.values())
        gone = [name for name in self.profiles if name not in new]
        said = [f"profile {name}: {notes.edited}" for name, notes in new.items()]
        return said + [f"profile {name}: as it was" for name in gone]

    def keep_operators(self, snapshot: Snapshot) -> list[str]:
        """Operators of this hand are tried before those that were in the book."""
        if snapshot.operators == self.kept.operators:
            return []
        ledger = self.teachable("operators")
        if self.operators is None:
            self.operators = ledger.book.operators
        names = {one.name for one in snapshot.operators}
        others = (notes for notes in self.operators if notes.name not in names)
        ledger.keep_operators([*map(operator_books.notes_of, snapshot.operators), *others])
        said = [f"{one.name}: {operator_books.sentence(one)}" for one in snapshot.operators]
        return said or ["terrain operators: as they were"]

    def teachable(self, what: str) -> Ledger:
        """The book. Raises `WrongUse` where there is none."""
        if self.ledger is None:
            raise WrongUse(f"edited {what} are kept in a skillbook, and none is open")
        return self.ledger


def as_json(cycle: LegCycle) -> bytes:
    """A leg cycle as `gait.leg_cycles.files` reads it, a point a line."""
    hind = None if cycle.hind is None else list(cycle.hind)
    plain = msgspec.to_builtins(CycleEntry(list(cycle.points), cycle.about[:200], hind))
    parts = [f'"about": {msgspec.json.encode(plain["about"]).decode()}']
    for name in ("points", "hind"):
        if plain[name] is not None:
            rows = ",\n  ".join(msgspec.json.encode(point).decode() for point in plain[name])
            parts.append(f'"{name}": [\n  {rows}]')
    return ("{" + ",\n ".join(parts) + "}\n").encode()
