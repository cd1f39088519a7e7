"""What is told in words beside the laps of a run: why it does what it does, and what a person did."""

from typing import NamedTuple

WHY = "why"
"""The reason for a skill, noted when it, its driver or its rule changes."""
DONE = ("mode", "lesson", "edit", "world")
"""What a person did: who drives and what for, what was taught, curves edited, boxes moved."""
MOST_NOTES, MOST_LETTERS = 10_000, 1000


class Note(NamedTuple):
    """A sentence of a moment."""

    time: float
    """[s]"""
    kind: str
    """`WHY`, or one of `DONE`."""
    sentence: str
