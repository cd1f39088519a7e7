"""Terrain operators: what is added to a leg's profile where an obstacle is ahead of it (row L4).

A rule of type III (thesis 5.4.1): IF an obstacle of a kind, up to a size, is ahead of a leg THEN its foot
takes another path, its step another length, and the leg another torque, each so much per metre of it. It is
learned from one edit on one leg in one skill, and serves every leg and skill: the path goes with the
share of the swing, and the torque is told as the force that moves the foot: any posture makes its own of it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.errors import WrongUse
from gaitwright.gait.kinds import KINDS
from gaitwright.gait.leg_cycles.leg_cycle import BINS
from gaitwright.numerics.shape_preserving import curve

SHARES = 33
"""Rows of an operator: shares 0, 1/32, …, 1 of the swing."""
MOST_LARGEST = 1.0
"""No operator is for obstacles larger than this, in body heights."""
MOST_PATH, MOST_LANDING, MOST_FORCE = 3.0, 2.0, 1e4
"""Limits per metre of obstacle: of the path [-], of the landing [-], of the force [N/m]."""


@dataclass(frozen=True, eq=False)
class Operator:
    """An additive edit of a swing, per metre of the obstacle. Raises `WrongUse` for one that leaps."""

    name: str
    kinds: tuple[str, ...]
    """Obstacles that it is for, of `KINDS`."""
    largest: float
    """How large an obstacle it was taught for [m]; of a slope, the tangent of its angle."""
    path: Float[np.ndarray, "shares 2"]
    """Per metre: shift along the way in shares of it [1/m], and height [-]; nothing at both ends."""
    force: Float[np.ndarray, "shares 3"]
    """Per metre: force that moves the foot along, of a left leg, heading frame [N/m]."""
    duration: float
    """Of the swing that it was taught in [s]."""
    landing: float = 0.0
    """Per metre: how much farther along its way the foot lands [-]."""
    taught: str = ""
    """On which leg, in which skill, at which size, and by whom."""

    def __post_init__(self) -> None:
        fault = fault_in(self)
        if fault:
            raise WrongUse(f"operator {self.name!r} {fault}")

    @property
    def strategy(self) -> str:
        """What the foot does about an obstacle: it lands beyond it, or goes along with the ground."""
        return "steps over" if self.landing > 0.0 else "follows the ground"

    def table(self) -> Float[np.ndarray, "samples 9"]:
        """What a kernel looks up at even shares of the swing: shift with its first two derivatives, height
        with its own, force."""
        s, at = np.linspace(0.0, 1.0, SHARES), np.arange(BINS + 1) / BINS
        ways = [curve(s, column.copy(), at) for column in self.path.T]
        force = np.stack([np.interp(at, s, column) for column in self.force.T], axis=1)
        return np.concatenate([*ways, force], axis=1)


def fault_in(operator: Operator) -> str:
    """Why an operator is none, as the rest of a sentence; empty: it is one."""
    path, force = operator.path, operator.force
    if not operator.kinds or not set(operator.kinds) <= set(KINDS):
        return f"is for {', '.join(operator.kinds) or 'nothing'}; there are: {', '.join(KINDS)}"
    if path.shape != (SHARES, 2) or force.shape != (SHARES, 3):
        return f"has not the {SHARES} rows of a swing"
    if not (np.isfinite(path).all() and np.isfinite(force).all()):
        return "has a number that is not finite"
    if not (0.0 < operator.largest < np.inf and 0.0 < operator.duration < np.inf):
        return "was taught at no size, or in no time"
    if np.abs(path[[0, -1]]).max() > 1e-9:
        return "moves the foot where it leaves or meets the ground"
    if (
        np.abs(path).max() > MOST_PATH / min(1.0, operator.largest)
        or not abs(operator.landing) <= MOST_LANDING
    ):
        return f"moves the foot by more than {MOST_PATH:g} times the obstacle"
    return f"asks for more than {MOST_FORCE:g} N per metre" if np.abs(force).max() > MOST_FORCE else ""


class Packed(NamedTuple):
    """Operators as kernels read them, in the order in which they are tried."""

    terms: Float[np.ndarray, "operators 8"]
    """One of `KINDS` each: 1 where it is for it; then largest [m], landing, duration [s]."""
    tables: Float[np.ndarray, "operators samples 9"]


NONE = Packed(np.empty((0, 8)), np.empty((0, BINS + 1, 9)))


def packed(operators: Sequence[Operator]) -> Packed:
    """Operators as kernels read them."""
    if not operators:
        return NONE
    terms = [
        (*(float(kind in one.kinds) for kind in KINDS), one.largest, one.landing, one.duration)
        for one in operators
    ]
    return Packed(np.array(terms), np.stack([one.table() for one in operators]))
