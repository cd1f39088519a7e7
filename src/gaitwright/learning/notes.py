"""A pupil ↔ the notes on her in a skillbook: she goes on as if she had never stopped."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from gaitwright.errors import BadFile
from gaitwright.induction.cases import no_cases, table_of
from gaitwright.induction.columns import Vocabulary
from gaitwright.induction.decision_list import Bound, Lines, RuleLine
from gaitwright.induction.standing import standing_of
from gaitwright.knowledge.rules import Event, Rulebook
from gaitwright.knowledge.told import Told
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.history import Step, all_told, forgotten
from gaitwright.skillbook.pupil_notes import ColumnBound, ListedRule, PupilNotes, RuleList
from gaitwright.skillbook.writer import Ledger


def notes_of(taught: SkillPupil, heard: int) -> PupilNotes:
    """What a pupil has made of `heard` lessons, those forgotten included."""
    pupil = taught.pupil
    weights = pupil.cases.weight
    return PupilNotes(
        heard,
        pupil.seed,
        listed(pupil.lines, taught.vocabulary),
        tuple(listed(rival, taught.vocabulary) for rival in pupil.rivals),
        None if pupil.draft is None else listed(pupil.draft, taught.vocabulary),
        pupil.age,
        pupil.drafts,
        pupil.since,
        tuple((k, float(weights[k])) for k in np.flatnonzero(weights != 1.0).tolist()),
        yes_or_no(pupil.surprises),
        yes_or_no(pupil.drift.mistakes),
    )


def settle(ledger: Ledger, taught: SkillPupil) -> None:
    """Puts the rules that a pupil has made of all that the book holds into it, and the notes on her."""
    ledger.settle(taught.rulebook(), notes_of(taught, len(all_told(ledger.book.steps))))


def forget(ledger: Ledger, taught: SkillPupil, name: str) -> tuple[Event, ...]:
    """Takes back what was told under a name, from a pupil and in her book; what that moved. Raises `WrongUse`
    where nothing was."""
    events = taught.forget(name)
    ledger.forget(name, taught.rulebook(), notes_of(taught, len(all_told(ledger.book.steps))), events)
    return events


def pupil_of(book: Skillbook) -> SkillPupil:
    """The pupil of a book, who has heard everything that it holds. Raises `BadFile` for a book over numbers
    that nobody measures."""
    taught, rest = pupil_as_noted(book)
    for told in rest:
        taught.hear(told)
    return taught


def pupil_as_noted(book: Skillbook) -> tuple[SkillPupil, list[Told]]:
    """The pupil as her notes have her, and what she was told since then."""
    told, notes = all_told(book.steps), book.pupil
    if notes is None:
        return SkillPupil(book.seed), told
    gone, taught, heard = forgotten(book.steps), SkillPupil(notes.seed), told[: notes.heard]
    for one in heard:
        taught.note(one)
    taught.told = [one for one in heard if one.id not in gone]
    taught.instances = [taught.instance_of(one) for one in taught.told]
    restore(taught, notes, book.name)
    return taught, told[notes.heard :]


def restore(taught: SkillPupil, notes: PupilNotes, source: str) -> None:
    """Puts what the notes say into a pupil who knows what she was told."""
    pupil, n = taught.pupil, len(taught.told)
    if len(notes.surprises) != n or notes.since > n or any(case >= n for case, _ in notes.weights):
        raise BadFile(f"{source}: the notes on its pupil are about other lessons than it holds")
    lessons = [taught.lesson_of(told) for told in taught.told]
    empty = no_cases(taught.vocabulary.reads, taught.vocabulary.price)
    rows = np.array([lesson.row for lesson in lessons]).reshape(n, len(taught.vocabulary.columns))
    numbers = np.array([(lesson.action, lesson.reason, lesson.scene) for lesson in lessons], np.int64)
    actions, reasons, scenes = np.ascontiguousarray(numbers.reshape(n, 3).T)
    pupil.cases = table_of(rows, actions, reasons, len(taught.kinds), empty)
    pupil.scene = scenes
    pupil.lines = lines_of(notes.own, taught.vocabulary, source)
    pupil.rivals = [lines_of(rival, taught.vocabulary, source) for rival in notes.rivals]
    pupil.draft = None if notes.draft is None else lines_of(notes.draft, taught.vocabulary, source)
    pupil.age, pupil.drafts, pupil.since = notes.age, notes.drafts, notes.since
    pupil.surprises = [mark == "1" for mark in notes.surprises]
    pupil.drift.mistakes = [mark == "1" for mark in notes.mistakes]
    taught.said = np.zeros(n, np.bool_)
    taught.learn_ends("")
    pupil.cases.weight[:] = 1.0
    for case, weight in notes.weights:
        pupil.cases.weight[case] = weight
    pupil.standing = standing_of(pupil.lines, pupil.cases, pupil.scene, pupil.since)


def listed(lines: Lines, vocabulary: Vocabulary) -> RuleList:
    """A list with its columns by their names."""

    def named(bound: Bound) -> ColumnBound:
        low, high = (float(end) if np.isfinite(end) else None for end in (bound.low, bound.high))
        return ColumnBound(vocabulary.columns[bound.column].name, low, high)

    rules = (ListedRule(rule.action, tuple(map(named, rule.bounds))) for rule in lines.rules)
    return RuleList(tuple(rules), lines.otherwise)


def lines_of(rules: RuleList, vocabulary: Vocabulary, source: str) -> Lines:
    """A list with its columns by their places. Raises `BadFile` for one that is not known here."""
    return Lines(tuple(line_of(rule, vocabulary, source) for rule in rules.rules), rules.otherwise)


def line_of(rule: ListedRule, vocabulary: Vocabulary, source: str) -> RuleLine:
    bounds = []
    for bound in rule.bounds:
        if bound.column not in vocabulary.places:
            raise BadFile(
                f"{source}: its rules ask for {bound.column!r}, which nobody measures here: it was taught by "
                "another version"
            )
        low = -np.inf if bound.low is None else bound.low
        high = np.inf if bound.high is None else bound.high
        bounds.append(Bound(vocabulary.places[bound.column], float(low), float(high)))
    return RuleLine(rule.action, tuple(bounds))


def yes_or_no(marks: Sequence[bool]) -> str:
    return "".join("1" if mark else "0" for mark in marks)


def relearned(book: Skillbook) -> Rulebook:
    """The rules that a new pupil makes of what a book's pupil has heard, lesson by lesson: those of the book,
    unless its text was changed or this code learns otherwise. What was told after her notes is left out."""
    notes = book.pupil
    taught = SkillPupil(book.seed if notes is None else notes.seed)
    left = 0 if notes is None else notes.heard
    for step in book.steps:
        if step.told is not None and left == 0:
            break
        if step.told is not None:
            taught.hear(step.told)
            left -= 1
        elif step.how == "forgotten":
            taught.forget(step.note)
    return taught.rulebook()


def with_steps(book: Skillbook, taught: SkillPupil, steps: Sequence[Step]) -> Skillbook:
    """A book with more steps, which its pupil has been through: as a ledger stores them and settles it."""
    every = (*book.steps, *steps)
    events = (*book.rulebook.events, *(event for step in steps for event in step.events))
    rulebook = replace(taught.rulebook(), events=events)
    return replace(book, rulebook=rulebook, steps=every, pupil=notes_of(taught, len(all_told(every))))
