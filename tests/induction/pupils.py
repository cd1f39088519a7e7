"""Teachers and lessons for pupils."""

from collections.abc import Callable
from functools import cache

import numpy as np

from gaitwright.induction.cases import NOBODY
from gaitwright.induction.columns import Quantity, Vocabulary
from gaitwright.induction.pupil import Heard, Lesson, Pupil

Concept = Callable[[np.ndarray], np.ndarray]


def plain_columns(n: int) -> Vocabulary:
    return Vocabulary(tuple(Quantity("abcdefghijkl"[k]) for k in range(n)))


def three_thresholds(x: np.ndarray) -> np.ndarray:
    """An ordered list over the first three columns."""
    return np.where(x[0] > 0.6, 0, np.where(x[1] > 0.7, 1, np.where(x[2] <= 0.3, 2, 0)))


def nested(x: np.ndarray) -> np.ndarray:
    """An exception to an exception."""
    return np.where((x[0] > 0.5) & (x[1] > 0.4) & (x[2] <= 0.6), 1, np.where(x[0] > 0.5, 0, 2))


class School:
    """A pupil, and the names of actions in the order in which they were first heard of."""

    def __init__(self, columns: int, seed: int = 0):
        self.pupil = Pupil(plain_columns(columns), seed)
        self.names: dict[int, int] = {}
        self.heard: list[Heard] = []

    def teach(self, x: np.ndarray, actions: np.ndarray, scene: np.ndarray | None = None) -> "School":
        """Lessons one by one, each in a scene of its own where none is said."""
        first = self.pupil.cases.n
        for k, action in enumerate(actions.tolist()):
            place = self.names.setdefault(action, len(self.names))
            where = first + k if scene is None else int(scene[k])
            self.heard.append(self.pupil.hear(Lesson(x[:, k].copy(), place, NOBODY, where)))
        return self

    def score(self, x: np.ndarray, actions: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
        """The share that the pupil decides rightly, which these are, and at which it is sure."""
        decided, _, sure = self.pupil.decide_all(x)
        right = decided == np.array([self.names.get(action, NOBODY) for action in actions.tolist()])
        return float(right.mean()), right, sure


@cache
def taught(concept: Concept, n: int, columns: int, seed: int, slips: float = 0.0) -> School:
    """A school after so many lessons, the same for all who ask; the share of slips is said by chance."""
    rng = np.random.default_rng(seed)
    x = rng.random((columns, n))
    actions = concept(x)
    wrong = rng.random(n) < slips
    actions = np.where(wrong, rng.integers(0, 3, n), actions)
    return School(columns, seed).teach(x, actions)


def held_out(columns: int, n: int = 2000) -> np.ndarray:
    """Cases that were not taught."""
    return np.random.default_rng(987654).random((columns, n))
