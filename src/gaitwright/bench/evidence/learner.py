"""A learner to be killed, and the lessons it takes: in a module of its own, which starts fast."""

import os
import random
import sys
import time
from dataclasses import replace
from pathlib import Path

from gaitwright.knowledge.correction import teach
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Lesson
from gaitwright.knowledge.trees import interval_tree, tree
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.history import Step, number_lesson
from gaitwright.skillbook.writer import open_for_learning

LESSONS = 150
"""So many lessons a book takes."""
SKILLS = ("walk", "trot", "climb", "stop")


def learn_on() -> None:
    """The child: learns on from where the book ends, and says after every lesson how many are stored."""
    path, seed = Path(sys.argv[1]), int(sys.argv[2])
    print("ready", flush=True)
    sys.stdin.readline()
    with open_for_learning(path) as ledger:
        for place in range(len(ledger.book.steps) - 1, LESSONS):
            lesson = lesson_of(seed, place)
            learned = teach(ledger.book.rulebook, lesson)
            began = time.perf_counter()
            ledger.record(lesson, learned)
            os.write(1, f"{place + 1} {1e3 * (time.perf_counter() - began):.3f}\n".encode())


def begun() -> Skillbook:
    forest = Forest(
        (
            tree("ground", {"even": ("flat", "slippery"), "uneven": ("stairs", "rocks", "grass")}),
            interval_tree("slope", "rad", (-0.2, -0.05, 0.05, 0.2)),
            interval_tree("speed", "m/s", (0.2, 0.6, 1.2)),
            tree("legs", ("whole", "one hurt")),
        )
    )
    return Skillbook.new(forest, "go2", "kills")


def lesson_of(seed: int, place: int) -> Lesson:
    """One lesson of a school: the same for the same numbers, now and then against an earlier one."""
    chance = random.Random(f"lesson {seed} {place}")
    forest = begun().rulebook.forest
    situation = forest.at(tuple(chance.randrange(len(grown.leaves)) for grown in forest.trees))
    skill = SKILLS[forest.leaf_places(situation)[0] % len(SKILLS)]
    skill = chance.choice(SKILLS) if chance.random() < 0.1 else skill
    raw = {"friction": chance.random()}
    return Lesson("omission", skill, situation, raw=raw, action=Action(skill, 0.0, 0.5 + len(skill) / 10))


def taught(book: Skillbook, lesson: Lesson) -> Skillbook:
    """The book after a lesson, without any file."""
    before = book.rulebook
    stated = number_lesson(lesson, before.lessons)
    learned = teach(before, stated)
    note = learned.trouble.sentence if learned.trouble else ""
    step = Step("taught", stated, None, note, learned.rulebook.events[len(before.events) :])
    return replace(book, rulebook=learned.rulebook, steps=(*book.steps, step))


if __name__ == "__main__":
    learn_on()
