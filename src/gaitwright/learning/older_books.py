"""What books of the first version taught, told again: their lessons have the numbers that were measured."""

import re

from gaitwright.knowledge.lessons import Lesson
from gaitwright.knowledge.told import Told
from gaitwright.skillbook.book import Skillbook


def told_by(book: Skillbook) -> list[Told]:
    """What a pupil can be told of an older book's lessons: at which moments which action was right.

    A lesson without measurements, or one that only says what was wrong, tells her nothing.
    """
    actions = {rule.name: rule.action for rule in book.rulebook.rules}
    found: dict[str, Told] = {}
    corrections = {step.lesson.id for step in book.steps if step.lesson and step.lesson.kind == "omission"}
    for lesson in (step.lesson for step in book.steps if step.lesson is not None):
        action = lesson.action or actions.get(lesson.rule)
        if lesson.raw and lesson.kind != "commission" and action is not None:
            given = "corrected" if lesson.id in corrections else "confirmed"
            own = (lesson.rule, action, lesson.note, lesson.blame, scene_of(lesson), given)
            found[lesson.id] = Told(lesson.id, facts_of(lesson), *own)
    return list(found.values())


def facts_of(lesson: Lesson) -> dict[str, str | float]:
    """The numbers of a lesson and what the robot had been doing."""
    doing = dict(lesson.situation.items()).get("doing")
    return dict(lesson.raw) if doing is None else {**lesson.raw, "doing": doing}


def scene_of(lesson: Lesson) -> str:
    """Where a lesson was taught, by its name."""
    return re.sub(r", moment \d+$", "", lesson.id)
