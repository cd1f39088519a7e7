"""The skillbook as one frozen value, with its doors: a file, and text."""

from dataclasses import dataclass, replace
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from gaitwright.errors import BadFile
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.rules import Rulebook
from gaitwright.knowledge.trust import History, fault_in_history
from gaitwright.skillbook import store, text
from gaitwright.skillbook.entries import (
    About,
    File,
    ancestor_entry,
    ancestors_of,
    checked,
    map_entries,
    operator_entries,
    profile_entries,
    rulebook_entry,
    rulebook_of,
    step_entry,
    steps_of,
    trust_entries,
)
from gaitwright.skillbook.history import Ancestor, Step, all_told, forgotten
from gaitwright.skillbook.map_notes import MapNotes
from gaitwright.skillbook.map_notes import fault_in as fault_in_maps
from gaitwright.skillbook.operator_notes import OperatorNotes
from gaitwright.skillbook.operator_notes import fault_in as fault_in_operators
from gaitwright.skillbook.profile_notes import ProfileNotes, fault_in
from gaitwright.skillbook.pupil_notes import PupilNotes, actions_in, is_sound


@dataclass(frozen=True)
class Skillbook:
    """What a robot was taught (`steps`), what came of it (`rulebook`), and the books it came from.

    `robot` names the one it was taught on, `made_by` the version of Gaitwright that began it; `pupil` is how
    far she has come who learns from it.
    """

    name: str
    robot: str
    rulebook: Rulebook
    steps: tuple[Step, ...]
    made_by: str
    seed: int = 0
    ancestors: tuple[Ancestor, ...] = ()
    pupil: PupilNotes | None = None
    profiles: tuple[ProfileNotes, ...] = ()
    """Torque profiles, in the order of their names."""
    trust: History = ()
    """What the learned controller went through with each skill, in order."""
    operators: tuple[OperatorNotes, ...] = ()
    """Terrain operators, in the order in which they are tried."""
    maps: tuple[MapNotes, ...] = ()
    """What was learned of places, in the order of their names."""

    @staticmethod
    def new(start: Forest | Rulebook, robot: str = "", name: str = "", seed: int = 0) -> "Skillbook":
        """A book that begins with a rulebook, or with none but the features to come."""
        rulebook = start if isinstance(start, Rulebook) else Rulebook(start)
        return Skillbook(name, robot, rulebook, (_begun(rulebook, "as it began"),), _this_version(), seed)

    @staticmethod
    def load(path: str | Path) -> "Skillbook":
        """The book in a file. Raises `BadFile` with one sentence where it is not one, or a damaged one."""
        return book_of(store.read(path), str(path))

    def save(self, path: str | Path) -> Path:
        """Writes the book to a file, whole or not at all. Raises `BadFile` while that one is being taught,
        and `WrongUse` for a book that no file can hold."""
        return store.write(entry_of(self), path)

    def forked(self, name: str) -> "Skillbook":
        """A book of another name that goes on from here and remembers this one."""
        ancestor = Ancestor("forked", self.name, content_hash(self))
        return replace(self, name=name, ancestors=(*self.ancestors, ancestor))


def content_hash(book: Skillbook) -> str:
    """SHA-256 of everything in the book, as text."""
    return sha256(export_text(book).encode()).hexdigest()


def export_text(book: Skillbook) -> str:
    """The book as lines of text: the same book, the same text; one thing a line, in the book's own order."""
    return text.write(entry_of(book))


def import_text(content: str, source: str = "skillbook text") -> Skillbook:
    """The book from what `export_text` gave. Raises `BadFile` with one sentence, `source` in front."""
    return book_of(text.read(content, source), source)


def entry_of(book: Skillbook) -> File:
    """The book, checked against the limits of a file. Raises `WrongUse`."""
    rulebook = rulebook_entry(book.rulebook)
    steps = tuple(step_entry(step) for step in book.steps)
    ancestors = tuple(ancestor_entry(a) for a in book.ancestors)
    profiles, trust = profile_entries(book.profiles), trust_entries(book.trust)
    operators, maps = operator_entries(book.operators), map_entries(book.maps)
    return File(about_of(book), rulebook, steps, ancestors, book.pupil, profiles, trust, operators, maps)


def about_of(book: Skillbook) -> About:
    """What the book is called, and how much there is of everything."""
    rules = book.rulebook
    counts = (len(book.steps), len(rules.rules), len(rules.preferences), len(rules.forest.trees))
    own = (book.name, book.robot, book.made_by, book.seed, rules.lessons)
    others = len(book.ancestors), int(book.pupil is not None), len(book.profiles), len(book.trust)
    return checked(About(*own, *counts, *others, len(book.operators), len(book.maps)), About)


def book_of(entry: File, source: str) -> Skillbook:
    """The book of an entry. Raises `BadFile`."""
    rulebook = rulebook_of(entry.rulebook, source)
    steps = steps_of(entry.steps, rulebook.events, source)
    about, ancestors = entry.about, ancestors_of(entry.ancestors)
    check_notes(entry.pupil, steps, source)
    check_profiles(entry, source)
    own = (about.made_by, about.seed, ancestors, entry.pupil)
    learned = (entry.profiles, entry.trust, entry.operators, entry.maps)
    return Skillbook(about.name, about.robot, rulebook, steps, *own, *learned)


def check_notes(notes: PupilNotes | None, steps: tuple[Step, ...], source: str) -> None:
    """Raises `BadFile` where a pupil's notes are not about what was told."""
    told = all_told(steps)
    names = {one.id for one in told}
    if len(names) < len(told) or not forgotten(steps) <= names:
        raise BadFile(f"{source}: two lessons have one name, or one is forgotten that it does not hold")
    if notes is None:
        return
    actions = len({one.action for one in told})
    if notes.heard > len(told) or not is_sound(notes) or (told and actions_in(notes) > actions):
        raise BadFile(f"{source}: its pupil has learned from other lessons than it holds")


def check_profiles(entry: File, source: str) -> None:
    """Raises `BadFile` where one of a book's profiles, operators or maps is damaged or stands in it twice, or
    the history of trust makes no sense."""
    fault = fault_in(entry.profiles) or fault_in_history(entry.trust)
    fault = fault or fault_in_operators(entry.operators) or fault_in_maps(entry.maps)
    if fault:
        raise BadFile(f"{source}: {fault}")


def _begun(rulebook: Rulebook, note: str) -> Step:
    return Step("begun", None, replace(rulebook, events=()), note, rulebook.events)


def _this_version() -> str:
    try:
        return version("gaitwright")
    except PackageNotFoundError:  # run from a folder that was never installed
        return ""
