"""Skillbooks of a pupil who is told lessons by chance."""

import sqlite3
from contextlib import closing
from pathlib import Path

import numpy as np

from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.told import Told
from gaitwright.learning.notes import forget as forget_in  # noqa: F401 - found here with the others
from gaitwright.learning.notes import notes_of, settle, with_steps  # noqa: F401
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.skillbook import Ledger, Skillbook
from gaitwright.skillbook.history import Step, all_told
from gaitwright.skills.situation import FOREST

SKILLS = ("walk", "trot", "climb", "stop")
DOING = ("standing", "walking", "trotting")


def moment(rng: np.random.Generator) -> dict[str, str | float]:
    """What was measured somewhere."""
    return {
        "slope": round(float(rng.uniform(-20.0, 20.0)), 2),
        "possible": round(float(rng.uniform(0.0, 2.0)), 3),
        "sway": round(float(rng.uniform(0.0, 0.4)), 3),
        "doing": str(rng.choice(DOING)),
    }


def random_lesson(rng: np.random.Generator, name: str) -> Told:
    """A lesson that may well contradict others, with everything that a book can hold of one."""
    return lesson(name, moment(rng), str(rng.choice(SKILLS)), "possible")


def truthful_lesson(rng: np.random.Generator, name: str) -> Told:
    """A lesson from one who knows what is right."""
    facts = moment(rng)
    up = float(facts["slope"]) > 8.0
    skill = "climb" if up else "trot" if float(facts["possible"]) > 0.7 else "walk"
    return lesson(name, facts, skill, "slope" if up else "possible")


def lesson(name: str, facts: dict[str, str | float], skill: str, about: str = "") -> Told:
    action = Action(skill, 0.1, 1.0, "", (("at", "B"), ("height", 0.3)), ("at",), (("size", 2.0),))
    return Told(name, facts, skill, action, "it\nslipped – «twice»", about, name.split(",", maxsplit=1)[0])


def begun(seed: int = 0) -> Skillbook:
    return Skillbook.new(FOREST, "go2", f"book {seed}", seed)


def tell(book: Skillbook, pupil: SkillPupil, *told: Told) -> Skillbook:
    """The book after its pupil heard some more, without any file."""
    return with_steps(book, pupil, [Step("told", told=one, events=pupil.hear(one).events) for one in told])


def forget(book: Skillbook, pupil: SkillPupil, name: str) -> Skillbook:
    """The book after its pupil forgot a lesson, without any file."""
    return with_steps(book, pupil, [Step("forgotten", note=name, events=pupil.forget(name))])


def taught_skillbook(seed: int, lessons: int = 10) -> Skillbook:
    """A book of some lessons; of many, the third one is forgotten."""
    rng = np.random.default_rng(seed)
    book, pupil = begun(seed), SkillPupil(seed)
    for k in range(lessons):
        book = tell(book, pupil, random_lesson(rng, f"trip {k // 4}, moment {k}"))
    return forget(book, pupil, "trip 0, moment 2") if lessons > 6 else book


def tell_in(ledger: Ledger, pupil: SkillPupil, told: Told) -> None:
    """A lesson heard and stored."""
    ledger.tell(told, pupil.hear(told).events)


def noted(ledger: Ledger, pupil: SkillPupil):
    return notes_of(pupil, len(all_told(ledger.book.steps)))


def written_by(version: int, path: Path, which: str = "") -> Path:
    """A book as a version wrote it."""
    with closing(sqlite3.connect(path)) as db:
        db.executescript(
            (Path(__file__).parent / f"version_{version}{which}.sql").read_text(encoding="utf-8")
        )
        db.execute(f"PRAGMA application_id={0x47614954}")
        db.execute(f"PRAGMA user_version={version}")
    return path
