"""A torque profile as a skillbook holds it: which skill, at which velocity, and its table as numbers."""

from collections.abc import Sequence
from typing import Annotated

import numpy as np
from msgspec import Meta

from gaitwright.knowledge.json_form import Label, Strict, Text

MOST = 4096
"""Profiles in a book."""
LARGEST = 1e6
"""No torque, force or length of a profile is beyond this."""
Number = Annotated[float, Meta(ge=-1e4, le=1e4)]
Numbers = Annotated[bytes, Meta(max_length=4_000_000)]
"""32-bit floats, the lowest byte first."""


class ProfileNotes(Strict, frozen=True, omit_defaults=True):
    """The rows of `table` follow each other, each as `control.learned.profile.ProfileRow` has it."""

    skill: Label
    command: tuple[Number, Number, Number]
    """Forward, left [m/s], yaw rate [rad/s]."""
    period: Annotated[float, Meta(gt=0.0, le=100.0)]
    duty: Annotated[float, Meta(gt=0.0, le=1.0)]
    offsets: Annotated[tuple[Number, ...], Meta(min_length=1, max_length=16)]
    table: Numbers
    answers: Numbers
    """What the teacher answered in a few states."""
    repeat: Annotated[float, Meta(ge=0.0, le=1e4)] = 0.0
    edited: Text = ""
    """What a person changed in it; empty: it is as it was taught."""


def name_of(profile: ProfileNotes) -> str:
    """What a profile is called in a book: an edited one stands beside what it was."""
    forward, left, turn = (part + 0.0 for part in profile.command)
    return f"{profile.skill} {forward:.3f} {left:.3f} {turn:.3f}{' edited' if profile.edited else ''}"


def fault_in(profiles: Sequence[ProfileNotes]) -> str:
    """Why a book cannot hold these, as a sentence; empty: it can."""
    if len(profiles) > MOST:
        return f"it holds {len(profiles)} profiles; {MOST} is the most"
    for profile in profiles:
        if not is_sound(profile):
            return f"its profile {name_of(profile)} holds what is no number"
    if len({name_of(profile) for profile in profiles}) < len(profiles):
        return "it holds two profiles of one skill at one velocity"
    return ""


def is_sound(profile: ProfileNotes) -> bool:
    """Whether its tables are whole numbers of finite 32-bit floats of a possible size."""
    tables = profile.table, profile.answers
    if any(len(numbers) % 4 for numbers in tables):
        return False
    return all((np.abs(np.frombuffer(numbers, "<f4")) < LARGEST).all() for numbers in tables)
