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
    playing: list[tuple[float, Message]] = field(default_factory=list)
    """What is still to be played, and when in the run's time."""

    def begin(self, now: float) -> None:
        """Another motion; the one before is forgotten."""
        self.begun, self.words, self.playing = now, [], []

    def hear(self, now: float, message: Message) -> None:
        """Notes what moves the robot, where somebody composes; a person who moves it ends what is played."""
        if not isinstance(message, MOVES):
            return
        self.playing = []
        if self.begun is None or (self.words and same(self.words[-1][1], message)):
            return
        if len(self.words) >= MOST:
            raise WrongUse(f"a motion has at most {MOST} words: end it, and begin another")
        self.words.append((now - self.begun, message))

    def end(self) -> int:
        """The motion is whole; of how many words."""
        self.begun = None
        return len(self.words)

    def play(self, now: float) -> float:
        """From now on; how long it takes [s]. Raises `WrongUse` where nothing was composed."""
        if not self.words:
            raise WrongUse("nothing was composed yet: compose, then drive the robot, then play it back")
        self.begun = None
        self.playing = [(now + after, message) for after, message in self.words]
        return self.words[-1][0]

    def due(self, now: float) -> list[Message]:
        """What is to be done now."""
        count = sum(at <= now + 1e-9 for at, _ in self.playing)
        done, self.playing = self.playing[:count], self.playing[count:]
        return [message for _, message in done]


def same(one: Message, other: Message) -> bool:
    """Whether two messages ask for the same, whoever waits for an answer."""
    names = [name for name in one.__struct_fields__ if name != "id"]
    return type(one) is type(other) and all(getattr(one, name) == getattr(other, name) for name in names)
