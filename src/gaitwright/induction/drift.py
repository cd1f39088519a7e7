"""Has the teacher changed her mind? The share of lessons that come as a surprise tells (drift detection).

After Gama and others (2004): the rate of mistakes of a good while is what slips and the rest of the pupil's
ignorance explain; a rate far above it in the lessons since is a change.
"""

import math
from dataclasses import dataclass, field

WINDOW, WHILE, LEAST_WHILE = 30, 100, 60
"""Lessons over which the rate is taken now, those before them that it is compared with, and how few of these
are enough."""
FAR, FEWEST = 3.5, 6
"""A change is so many standard deviations above the usual rate, and at least so many mistakes in a window."""


@dataclass
class Drift:
    """The mistakes so far, but for those that were a change of mind."""

    mistakes: list[bool] = field(default_factory=list)

    def notes(self, is_mistake: bool) -> bool:
        """Whether one more lesson makes it a change of mind; then half a window is begun anew."""
        self.mistakes.append(is_mistake)
        now, before = self.mistakes[-WINDOW:], self.mistakes[-WINDOW - WHILE : -WINDOW]
        if len(before) < LEAST_WHILE:
            return False
        rate = (sum(before) + 1.0) / (len(before) + 2.0)
        usual = WINDOW * rate + FAR * math.sqrt(WINDOW * rate * (1.0 - rate))
        if sum(now) < max(FEWEST, usual):
            return False
        del self.mistakes[-WINDOW // 2 :]
        return True
