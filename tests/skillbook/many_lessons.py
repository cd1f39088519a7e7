"""How long a lesson takes to be stored in a book that holds many: run as a script with their number."""

import sys
import tempfile
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np
from schooling import begun, settle, tell_in, truthful_lesson

from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.skillbook import Skillbook, open_for_learning

HEARD = 100
"""So many lessons are heard by a pupil, so that the book has rules; the others are only stored."""


def times(lessons: int) -> list[float]:
    rng, pupil = np.random.default_rng(1), SkillPupil()
    took = []
    with tempfile.TemporaryDirectory() as folder:
        path = begun().save(Path(folder) / "a.skills")
        with open_for_learning(path) as ledger:
            for k in range(HEARD):
                tell_in(ledger, pupil, truthful_lesson(rng, f"trip {k}"))
            settle(ledger, pupil)
            for k in range(HEARD, lessons):
                told = truthful_lesson(rng, f"trip {k}")
                began = perf_counter()
                ledger.tell(told)
                took.append(perf_counter() - began)
            assert Skillbook.load(path) == ledger.book
            return took


if __name__ == "__main__":
    took = times(int(sys.argv[1]))
    print(median(took[-100:]), max(took), len(took) + HEARD)
