"""The end of a merge: whatever a book decides as it was taught, the joined one decides too, or says so."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.correction import same_action
from gaitwright.knowledge.forest import Situation
from gaitwright.knowledge.modifier import Lesson, values_text
from gaitwright.knowledge.rules import Rulebook
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.history import Step
from gaitwright.skillbook.merging.state import Conflict, Joining, apart
from gaitwright.skillbook.merging.translate import lesson_over

ROUNDS = 4
"""So often the lessons that others undid are taught again."""

Side = Literal["ours", "theirs", "both"]


@dataclass(frozen=True)
class FootholdRequest:
    """What was taught last in a situation, and by whom."""

    lesson: Lesson
    side: Side


def settle(joining: Joining) -> None:
    """Teaches again what others undid; what cannot be kept is a conflict."""
    wanted = wishes(joining)
    for _ in range(ROUNDS):
        undone = [wish for wish in wanted if not holds(joining.rulebook, wish.lesson)]
        for wish in undone:
            if not holds(joining.rulebook, wish.lesson):
                joining.teach(wish.lesson, "taught", again=True)
        if not undone:
            return
    for wish in wanted:
        if not holds(joining.rulebook, wish.lesson):
            joining.report(lost(joining, wish))


def wishes(joining: Joining) -> list[FootholdRequest]:
    """The last lesson in each situation that its own book follows, and that no conflict reports yet; ours
    where both teach there."""
    ours, theirs, shared = joining.ours, joining.theirs, joining.shared
    found: dict[Situation, FootholdRequest] = {}
    sides: list[tuple[Side, Sequence[Step], Sequence[Skillbook]]] = [
        ("both", ours.steps[:shared], (ours, theirs)),
        ("theirs", theirs.steps[shared:], (theirs,)),
        ("ours", ours.steps[shared:], (ours,)),
    ]
    for side, steps, books in sides:
        for step in steps:
            if step.lesson is None or step.how != "taught":
                continue
            stated = joining.restated(step.lesson, side == "theirs")
            if isinstance(stated, str) or stated.id in joining.given_up:
                continue
            if all(follows(book.rulebook, step.lesson) for book in books):
                found[stated.situation] = FootholdRequest(stated, side)
    return list(found.values())


def holds(rulebook: Rulebook, lesson: Lesson) -> bool:
    """Whether what fires there does what the lesson wants."""
    fires = consult(rulebook, lesson.situation).rule
    return fires is not None and rulebook[fires].action == lesson.action


def follows(rulebook: Rulebook, lesson: Lesson) -> bool:
    """Whether a book decides as it was taught."""
    stated = lesson_over(rulebook.forest, lesson)
    if isinstance(stated, str):
        return False
    return consult(rulebook, stated.situation).rule in same_action(rulebook, lesson.rule)


def lost(joining: Joining, wish: FootholdRequest) -> Conflict:
    """What fires in place of what was taught, and the nearest situation in which that was right."""
    book, lesson = joining.rulebook, wish.lesson
    fires = consult(book, lesson.situation).rule
    rights = book[fires].positives if fires else ()
    near = min(rights, key=lambda right: len(apart(lesson.situation, [right.situation])), default=None)
    where = values_text(book.forest, lesson.situation)
    sentence = f"where {where}, {lesson.id} teaches {lesson.rule}, but {fires or 'no rule'} fires"
    if near is None:
        return Conflict(lesson.rule, (), *joining.sides([lesson.id]), sentence)
    trees = apart(lesson.situation, [near.situation])
    sides = joining.sides([lesson.id, near.id])
    return Conflict(lesson.rule, trees, *sides, f"{sentence}, which was right at {near.id}")
