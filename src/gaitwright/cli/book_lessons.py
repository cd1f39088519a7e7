"""`gaitwright books confirm|undo|forget`: lessons that a book takes in, or takes back."""

import json
from argparse import Namespace
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

from gaitwright.cli import profiles
from gaitwright.cli.book_files import facts_of, skillbook_of
from gaitwright.cli.console import show_pairs, working
from gaitwright.cli.output import write_json
from gaitwright.errors import BadFile, WrongUse
from gaitwright.knowledge.explain import move_text
from gaitwright.knowledge.rules import Event
from gaitwright.knowledge.sentences import counted
from gaitwright.knowledge.told import Told
from gaitwright.learning.analogies import proposal_of
from gaitwright.learning.merging import decided
from gaitwright.learning.notes import forget as forget_in
from gaitwright.learning.notes import pupil_of, settle
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.history import all_told, free_name, names_told
from gaitwright.skillbook.writer import Ledger, open_for_learning

Rows = list[tuple[str, str]]
SHOWN = 3
"""So many lessons are named on the screen; the figures have all."""


def confirm(args: Namespace) -> None:
    """Takes in what is proposed by analogy for a skill."""
    path, skill = args.files
    book, pupil = read(path)
    taken = names_told(book.steps)
    new = [replace(told, id=free_name(told.id, taken)) for told in proposal_of(pupil, skill).told]
    events = []
    with opened(path, book) as ledger, working(f"{path} takes in {skill}", worth_a_line=None):
        for told in new:
            moved = pupil.hear(told).events
            ledger.tell(told, moved)
            events += moved
        settle(ledger, pupil)
        done = Counter(action.skill for action in decided(pupil, new) if action is not None)
    decisions = ", ".join(f"{name} {number}" for name, number in done.most_common())
    rows = [
        ("told", f"{counted(len(new), 'lesson')}, by analogy"),
        ("decided there now", decisions),
        *changes(events),
        ("take it back", f"gaitwright books undo {path}"),
    ]
    tell(args, ledger.book, f"{path} takes in {skill}", rows, told=new, events=events)


def undo(args: Namespace) -> None:
    """Forgets the last lesson that counts; all of one confirmation are one."""
    (path,) = args.files
    book, pupil = read(path)
    if not pupil.told:
        raise WrongUse(f"no lesson in {path} counts any more: there is nothing to undo")
    forget_all(args, book, pupil, last_of(pupil.told))


def forget(args: Namespace) -> None:
    """Forgets one lesson, or what a person edited in a profile."""
    path, name = args.files
    if profiles.forget(path, name):
        return
    book, pupil = read(path)
    gone = [told for told in pupil.told if told.id == name]
    if not gone:
        pupil.forget(name)  # which says what is wrong
    forget_all(args, book, pupil, gone)


def read(path: str) -> tuple[Skillbook, SkillPupil]:
    """A book and its pupil: what cannot be done is said before the file is opened to be changed. Raises
    `WrongUse` for a book without lessons that a pupil heard."""
    book = skillbook_of(path)
    if not all_told(book.steps):
        raise WrongUse(
            f"{path} holds no lessons that can be told or taken back: those of an older book are told again "
            f"by `gaitwright teach --out {path}`"
        )
    return book, pupil_of(book)


def opened(path: str, book: Skillbook) -> Ledger:
    """The book in a file, to be changed. Raises `BadFile` where it was changed since it was read."""
    ledger = open_for_learning(path)
    if ledger.book.steps != book.steps:
        ledger.close()
        raise BadFile(f"{path} was changed by another process meanwhile: try again")
    return ledger


def last_of(told: Sequence[Told]) -> list[Told]:
    """The last lesson, the latest first; where it came by analogy, all that came with it."""
    last = told[-1]
    if last.given != "by analogy":
        return [last]
    kin = []
    for one in reversed(told):
        if (one.given, one.action.skill) != (last.given, last.action.skill):
            break
        kin.append(one)
    return kin


def forget_all(args: Namespace, book: Skillbook, pupil: SkillPupil, lessons: Sequence[Told]) -> None:
    """Forgets some lessons one by one, and tells what that moved."""
    path, events = args.files[0], []
    what = lessons[0].id if len(lessons) == 1 else f"{len(lessons)} lessons that came together"
    with opened(path, book) as ledger, working(f"{path} forgets {what}", worth_a_line=None):
        for told in lessons:
            events += forget_in(ledger, pupil, told.id)
    names = ", ".join(told.id for told in lessons[:SHOWN]) + (", …" if len(lessons) > SHOWN else "")
    rows = [("forgotten", names), *changes(events)]
    tell(args, ledger.book, f"{path} forgets {what}", rows, forgotten=lessons, events=events)


def changes(events: Sequence[Event]) -> Rows:
    """What is different, a line for each sentence."""
    said = list(dict.fromkeys(move_text(event) for event in events))
    return [("what changed", sentence) for sentence in said] or [("what changed", "no rule")]


def tell(  # noqa: PLR0913 - one report of three commands
    args: Namespace,
    book: Skillbook,
    title: str,
    rows: Rows,
    told: Sequence[Told] = (),
    forgotten: Sequence[Told] = (),
    events: Sequence[Event] = (),
) -> None:
    """What came of it, on the screen and as figures."""
    figures = facts_of(book, args.files[0]) | {
        "told": [one.id for one in told],
        "forgotten": [one.id for one in forgotten],
        "changed": list(dict.fromkeys(move_text(event) for event in events)),
    }
    write_json(args.json, json.dumps(figures, indent=2, ensure_ascii=False))
    rules = ", ".join(rule.name for rule in book.rulebook.rules) or "none"
    rows = [*rows, ("rules", rules), ("lessons", str(book.rulebook.lessons))]
    show_pairs(title, rows, to_stderr=args.json == "-")
