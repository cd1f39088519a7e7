"""Profile notes with short tables, as skillbooks may hold them."""

import numpy as np

from gaitwright.skillbook.profile_notes import ProfileNotes


def profile_notes(
    skill: str = "trot",
    command: tuple[float, float, float] = (0.4, 0.0, 0.0),
    edited: str = "",
    first: float = -2.75,
) -> ProfileNotes:
    """A profile of four legs; `first`: the number that its table begins with."""
    table, answers = (np.asarray(first + 0.7 * np.arange(n), "<f4").tobytes() for n in (12, 6))
    return ProfileNotes(skill, command, 0.4, 0.6, (0.0, 0.5, 0.5, 0.0), table, answers, 0.0123, edited)


def some_profiles() -> tuple[ProfileNotes, ...]:
    """Three, in the order of their names, one of them edited."""
    return (
        profile_notes("trot"),
        profile_notes("trot", edited="the hips by -1 N·m – »softer«", first=-3.75),
        profile_notes("walk-backward", (-0.2, -0.0, 0.15)),
    )
