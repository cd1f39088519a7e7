"""Profile and operator notes with short tables, as skillbooks may hold them."""

import numpy as np

from gaitwright.skillbook.operator_notes import OperatorNotes
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


def some_operators() -> tuple[OperatorNotes, ...]:
    """Two terrain operators, in the order in which they are tried."""
    line = tuple(round(0.1 * k, 3) for k in range(5))
    raised = ((0.0,) * 5, line)
    force = (line, (0.0,) * 5, tuple(-100.0 * x for x in line))
    return (
        OperatorNotes("over a »hole«", ("hole",), 0.2, raised, force, 0.2, 0.3, "on FL in trot at 0.100 m"),
        OperatorNotes("over a block", ("block", "step up"), 0.1, raised, force, 0.2),
    )
