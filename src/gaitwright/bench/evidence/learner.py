"""A pupil to be killed, and the lessons that she is told: in a module of its own, which starts fast."""

import os
import random
import sys
import time
from pathlib import Path

from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.rules import Rule
from gaitwright.knowledge.told import Told
from gaitwright.learning.notes import pupil_of, settle, with_steps
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.history import Step, all_told
from gaitwright.skillbook.writer import open_for_learning
from gaitwright.skills.situation import FOREST

LESSONS = 60
"""So many lessons a book takes."""
SETTLES = 5
"""After so many lessons the rules are stored."""
SLIPS = 0.1
"""Share of the lessons that go against the others."""
SKILLS = ("walk", "trot", "climb", "stop")


def learn_on() -> None:
    """The child: learns on from where the book ends, and says after every lesson how many are stored."""
    path, seed = Path(sys.argv[1]), int(sys.argv[2])
    unkilled(seed, 2 * SETTLES)  # what is compiled is loaded before the clock counts
    print("ready", flush=True)
    sys.stdin.readline()
    with open_for_learning(path) as ledger:
        pupil = pupil_of(ledger.book)
        for place in range(len(all_told(ledger.book.steps)), LESSONS):
            told = lesson_of(seed, place)
            events = pupil.hear(told).events
            began = time.perf_counter()
            ledger.tell(told, events)
            os.write(1, f"{place + 1} {1e3 * (time.perf_counter() - began):.3f}\n".encode())
            if (place + 1) % SETTLES == 0:
                settle(ledger, pupil)
        settle(ledger, pupil)


def begun() -> Skillbook:
    return Skillbook.new(FOREST, "go2", "kills")


def lesson_of(seed: int, place: int) -> Told:
    """One lesson of a school: the same for the same numbers, now and then against the others."""
    chance = random.Random(f"lesson {seed} {place}")
    facts: dict[str, str | float] = {
        "slope": round(chance.uniform(-20.0, 20.0), 2),
        "possible": round(chance.uniform(0.0, 2.0), 3),
        "roughness": round(chance.uniform(0.0, 0.1), 4),
        "sway": round(chance.uniform(0.0, 0.4), 3),
        "arrived": float(chance.random() < 0.1),
        "doing": chance.choice(("standing", "walking", "trotting")),
    }
    skill, about = right_at(facts)
    if chance.random() < SLIPS:
        skill, about = chance.choice(SKILLS), ""
    action = Action(skill, 0.0, 0.5 + len(skill) / 10)
    return Told(f"lesson {place + 1}", facts, skill, action, "", about, f"trip {place // 10}")


def right_at(facts: dict[str, str | float]) -> tuple[str, str]:
    """Which skill is right, and which fact decides that."""
    if facts["arrived"] != 0.0:
        return "stop", "arrived"
    if float(facts["slope"]) > 8.0:
        return "climb", "slope"
    return ("trot" if float(facts["possible"]) > 0.7 else "walk"), "possible"


def unkilled(seed: int, lessons: int) -> Skillbook:
    """The book after so many lessons, without any file."""
    book, pupil = begun(), SkillPupil()
    steps = []
    for place in range(lessons):
        told = lesson_of(seed, place)
        steps.append(Step("told", told=told, events=pupil.hear(told).events))
    return with_steps(book, pupil, steps)


def rules_of(seed: int) -> tuple[Rule, ...]:
    """The rules at the end of a school that nobody killed."""
    return unkilled(seed, LESSONS).rulebook.rules


if __name__ == "__main__":
    learn_on()
