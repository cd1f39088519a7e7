"""A motion that a person composes, and that is played back: what she asked for, and when (mode "guide").

What counts is what moves the robot: skills that are held, velocities, standing, goals. They are played in the
run's own time, so that a pause or another pace changes nothing.
"""

from dataclasses import dataclass, field

from gaitwright.errors import WrongUse
from gaitwright.studio.messages import Go, Message, Skill, Stand, Steer

MOVES = (Go, Skill, Stand, Steer)
MOST = 20_000
"""Longest motion, in words."""


@dataclass
class Score:
    """What was asked for, and how long after the beginning [s]."""

    begun: float | None = None
    """When composing began; `None`: nobody composes."""
    words: list[tuple[float, Message]] = field(default_factory=list)
    length: float = 0.0
    """Of a motion that is whole [s]."""
    left: list[tuple[float, Message]] = field(default_factory=list)
    """What is still to be played, and when in the run's time."""
    until: float | None = None
    """When what is played ends; `None`: nothing is played."""

    @property
    def is_playing(self) -> bool:
        return self.until is not None

    def seconds(self, now: float) -> float:
        """How long the motion takes, or what there is of it."""
        return self.length if self.begun is None else now - self.begun

    def played(self, now: float) -> float:
        """How much of it was played [s]; 0 where nothing is."""
        return 0.0 if self.until is None else min(self.length, now - self.until + self.length)

    def begin(self, now: float) -> None:
        """Another motion; the one before is forgotten."""
        self.begun, self.words, self.length = now, [], 0.0
        self.stop()

    def stop(self) -> None:
        """No more of it is played."""
        self.left, self.until = [], None

    def check(self, message: Message) -> None:
        """Raises `WrongUse` for a word that there is no more room for."""
        if self.begun is not None and isinstance(message, MOVES) and len(self.words) >= MOST:
            raise WrongUse(f"a motion has at most {MOST} words: end it, and begin another")

    def hear(self, now: float, message: Message) -> None:
        """Notes what moves the robot, where somebody composes; a person who moves it ends what is played."""
        if not isinstance(message, MOVES):
            return
        self.stop()
        if self.begun is None or (self.words and same(self.words[-1][1], message)):
            return
        self.words.append((now - self.begun, message))

    def end(self, now: float) -> int:
        """The motion is whole; of how many words."""
        self.length, self.begun = self.seconds(now), None
        return len(self.words)

    def play(self, now: float) -> float:
        """From now on; how long it takes [s]. Raises `WrongUse` where nothing was composed."""
        if not self.words:
            raise WrongUse("nothing was composed yet: compose, then drive the robot, then play it back")
        self.end(now)
        self.left = [(now + after, message) for after, message in self.words]
        self.until = now + self.length
        return self.length

    def due(self, now: float) -> list[Message]:
        """What is to be done now."""
        count = sum(at <= now + 1e-9 for at, _ in self.left)
        done, self.left = self.left[:count], self.left[count:]
        return [message for _, message in done]

    def is_played(self, now: float) -> bool:
        """Whether all of it was played, with the time after its last word."""
        return self.until is not None and not self.left and now >= self.until - 1e-9


def same(one: Message, other: Message) -> bool:
    """Whether two messages ask for the same, whoever waits for an answer."""
    names = [name for name in one.__struct_fields__ if name != "id"]
    return type(one) is type(other) and all(getattr(one, name) == getattr(other, name) for name in names)
