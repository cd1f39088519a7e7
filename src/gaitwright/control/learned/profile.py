"""A torque profile: one cycle of a skill as the numerical controller drove it, as a table over the phase.

Rows of type II (thesis 5.4.1, 5.4.2.2) with one thing split: the torque is kept as what the leg takes by
itself and as the forces of its foot, τ = τ_free − J_cᵀ f. A foot that is late, early or on a slope then only
changes f. The errors that the teacher had at each phase are kept too: only what differs from them is
regulated, so that in the taught cycle nothing is.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.errors import WrongUse
from gaitwright.numerics.packing import Layout
from gaitwright.signals import Gait

BINS = 128
"""Rows of a table; row k is at phase k / 128."""


class ProfileRow(NamedTuple):
    """One phase. G: the ground frame, z along the normal of the ground, x along the robot's heading."""

    free: Float[np.ndarray, "legs 3"]
    """Joint torques without foot forces, τ + J_cᵀ f [N·m]."""
    force: Float[np.ndarray, "legs 3"]
    """Ground forces on the feet, G [N]."""
    tip: Float[np.ndarray, "legs 3"]
    """Foot centres from the base origin, G [m]."""
    lag: Float[np.ndarray, "legs 3"]
    """How far the joints were from where they should be [rad]."""
    lag_rate: Float[np.ndarray, "legs 3"]
    """And their rates [rad/s]."""
    feedback: Float[np.ndarray, "6"]
    """The teacher's feedback acceleration of the base, linear and angular, G [m/s², rad/s²]."""
    tau: Float[np.ndarray, "legs 3"]
    """Joint torques as they were [N·m]."""
    q: Float[np.ndarray, "legs 3"]
    """Joint angles as they were [rad]."""
    qd: Float[np.ndarray, "legs 3"]
    """Joint rates as they were [rad/s]."""
    stance: Float[np.ndarray, "legs"]
    """Share of the cycles in which the leg was down."""
    pose: Float[np.ndarray, "3"]
    """Height of the base over the plane of the foot centres [m], roll and pitch in G [rad]."""
    velocity: Float[np.ndarray, "3"]
    """Of the base origin, G [m/s]."""
    omega: Float[np.ndarray, "3"]
    """Angular velocity of the base, G [rad/s]."""


ROW = Layout.of(ProfileRow)
row_of = ROW.views(ProfileRow)
"""The `ProfileRow` in a row, as views; for kernels too."""
Table = Float[np.ndarray, "bins width"]


@dataclass(frozen=True, eq=False)
class Profile:
    """A cell: a skill at one velocity, on level ground."""

    gait: Gait
    command: tuple[float, float, float]
    """Forward, left [m/s] and yaw rate [rad/s] at which it was taught."""
    table: Table
    repeat: float = 0.0
    """`torque_error` between what the teacher did from one start and from another."""
    answers: Float[np.ndarray, "probes torques"] = field(default_factory=lambda: np.zeros((0, 0)))
    """Torques of the teacher in a few states [N·m]: whoever answers otherwise teaches other profiles."""
    edited: str = ""
    """What a person changed in it; empty: nothing."""

    def __post_init__(self) -> None:
        """Raises `WrongUse` for a table of another shape, or one with gaps."""
        legs = len(self.gait.offsets)
        if self.table.shape != (BINS, ROW.size(legs)):
            raise WrongUse(
                f"a profile of {self.gait.name} has {BINS} rows of {ROW.size(legs)} numbers for {legs} legs, "
                f"not {' × '.join(map(str, self.table.shape))}"
            )
        if not np.isfinite(self.table).all():
            raise WrongUse(f"a profile of {self.gait.name} has a number that is not finite")

    @property
    def skill(self) -> str:
        return self.gait.name


def mean_cycle(
    phases: Float[np.ndarray, " ticks"], rows: Float[np.ndarray, "ticks width"]
) -> Float[np.ndarray, "bins width"]:
    """The mean row of each phase: what was seen is shared out between the two nearest rows of the table.

    Phases that nobody saw are filled straight between their neighbours. Raises `WrongUse` where less than
    half of the cycle was seen.
    """
    total, weight = np.zeros((BINS, rows.shape[1])), np.zeros(BINS)
    place = (phases % 1.0) * BINS
    low, share = place.astype(int) % BINS, place - np.floor(place)
    for at, part in ((low, 1.0 - share), ((low + 1) % BINS, share)):
        np.add.at(total, at, part[:, None] * rows)
        np.add.at(weight, at, part)
    seen = np.flatnonzero(weight > 1e-6)
    if len(seen) < BINS // 2:
        raise WrongUse(f"only {len(seen)} of {BINS} phases of the cycle were seen")
    mean = total[seen] / weight[seen, None]
    around = np.concatenate([seen - BINS, seen, seen + BINS])
    thrice = np.tile(mean, (3, 1))
    return np.stack([np.interp(np.arange(BINS), around, column) for column in thrice.T], axis=1)


def as_kept(numbers: np.ndarray) -> np.ndarray:
    """Numbers as a skillbook keeps them, which has 32 bits for each."""
    return numbers.astype(np.float32).astype(np.float64)


def torque_error(one: Table, other: Table, legs: int) -> float:
    """RMS of the difference of the torques of two tables over the RMS of the other's."""
    where = ROW.slices(legs)["tau"]
    off, whole = one[:, where] - other[:, where], other[:, where]
    return float(np.sqrt(np.mean(off**2) / np.mean(whole**2)))
