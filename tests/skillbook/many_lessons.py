"""How long a lesson takes to be stored in a book that holds many: run as a script with their number."""

import sys
import tempfile
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np
from schooling import truthful_lesson

from gaitwright.knowledge.correction import teach
from gaitwright.skillbook import Skillbook, open_for_learning
from knowledge.random_books import random_book, random_forest


def times(lessons: int) -> tuple[list[float], Skillbook]:
    rng = np.random.default_rng(1)
    truth = random_book(rng, random_forest(rng, 6, 8), 12, 0.5)
    took = []
    with tempfile.TemporaryDirectory() as folder:
        path = Skillbook.new(truth.forest, "go2").save(Path(folder) / "a.skills")
        with open_for_learning(path) as ledger:
            while len(ledger.book.steps) <= lessons:
                lesson = truthful_lesson(rng, truth)
                learned = teach(ledger.book.rulebook, lesson)
                began = perf_counter()
                ledger.record(lesson, learned)
                took.append(perf_counter() - began)
            assert Skillbook.load(path) == ledger.book
            return took, ledger.book


if __name__ == "__main__":
    took, book = times(int(sys.argv[1]))
    print(median(took[-100:]), max(took), len(took))
