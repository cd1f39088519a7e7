"""What a person did while a robot moved, noted beside its laps."""

from typing import NamedTuple

NOTED = ("mode", "lesson", "edit", "world")
"""Kinds of notes: who drives and what for, what was taught, curves edited, boxes moved."""
MOST_NOTES = 10_000


class Note(NamedTuple):
    """Something that a person did."""

    time: float
    """[s]"""
    kind: str
    """One of `NOTED`."""
    sentence: str
