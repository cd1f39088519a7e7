"""The values on the arrows of the data flow, one frozen value per arrow.

    Mission ─► navigation ─► Route ─► skills ─► SkillCall ─► gait ─► MotionTarget
            ─► control ─► Torques ─► plant ─► Sensed

SI units and radians. `_w`: world axes; `_b`: base axes; quaternions `(w, x, y, z)`. Arrays per leg are
`(legs, 3)` in the robot's leg order. Arrays are copies, never views into a simulator.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.numerics.compiled import kernel


@kernel
def are_finite(position, orientation, velocity, spin, q, qd, load):
    """Whether every number of a sensed state is a number."""
    vectors = position.sum() + orientation.sum() + velocity.sum() + spin.sum()
    return math.isfinite(vectors + q.sum() + qd.sum() + load.sum())


@dataclass(frozen=True, slots=True)
class Sensed:
    """What happened: the state of the robot as every controller reads it (row R3)."""

    time: float
    """Time since the start [s]."""
    position_w: Float[np.ndarray, "3"]
    """Origin of the base [m]."""
    orientation_wb: Float[np.ndarray, "4"]
    """Orientation of the base."""
    velocity_w: Float[np.ndarray, "3"]
    """Velocity of the base origin [m/s]."""
    angular_velocity_b: Float[np.ndarray, "3"]
    """Angular velocity of the base, its own axes [rad/s]."""
    q: Float[np.ndarray, "legs 3"]
    """Joint angles [rad]."""
    qd: Float[np.ndarray, "legs 3"]
    """Joint rates [rad/s]."""
    load: Float[np.ndarray, "legs"]
    """Normal force measured at each foot [N]."""

    def is_finite(self) -> bool:
        """Whether every number of the state is a number."""
        return are_finite(
            self.position_w,
            self.orientation_wb,
            self.velocity_w,
            self.angular_velocity_b,
            self.q,
            self.qd,
            self.load,
        )


@dataclass(frozen=True, slots=True)
class Mission:
    """Where to go: way-points in order, the last one is the goal."""

    waypoints: tuple[tuple[float, float], ...]
    """World x, y [m]."""
    speed: float | None = None
    """Wished speed [m/s]; `None` leaves it to the skill."""
    driver: str = "numerical"
    """Who computes the torques."""


@dataclass(frozen=True, slots=True)
class Scan:
    """What is known of the ground ahead, from where the robot is and along its heading (row V3)."""

    slope: float = 0.0
    """Mean slope ahead, uphill positive [rad]."""
    cross: float = 0.0
    """Slope across, rising to the left positive [rad]."""
    roughness: float = 0.0
    """Standard deviation of the ground from that slope [m]; stairs are rough too."""
    step_up: float = 0.0
    """Highest sudden rise from that slope [m]."""
    step_down: float = 0.0
    """Deepest sudden drop from that slope, positive [m]; a gap is none."""
    gap: float = 0.0
    """Widest hole ahead with ground on its other side [m]."""
    obstacle: float = math.inf
    """Distance to the next thing too high to step on [m]."""
    street: float = 0.0
    """World direction of the way ahead [rad]."""
    familiar: bool = False
    """Whether this trip has come along here before."""


@dataclass(frozen=True, slots=True)
class Route:
    """Which way: what is left of the path, and how far."""

    path: tuple[tuple[float, float], ...]
    """Points still to pass, world [m]; empty when there is nowhere to go."""
    remaining: float
    """Length of what is left, from where the robot is [m]."""
    speed: float | None
    """Wished speed [m/s]."""
    driver: str
    arrived: bool = False
    """Whether the robot has come to its goal."""
    no_way: str | None = None
    """Why there is no path to the goal, as a sentence."""
    ahead: Scan | None = None
    """The ground ahead; `None` where nobody looked."""
    travelled: frozenset[tuple[int, int]] = frozenset()
    """Where this trip has been, as cells of a grid."""


@dataclass(frozen=True, slots=True)
class Gait:
    """A cyclic gait (row J1). Leg phase = (φ + offset) mod 1; stance while it is below `duty`."""

    name: str
    period: float
    """τ [s]."""
    duty: float
    """β, the share of the cycle that a foot is down; 1 is standing."""
    offsets: tuple[float, ...]
    """Relative phases, one per leg."""


@dataclass(frozen=True, slots=True)
class SkillCall:
    """Which skill: a gait, a velocity to hold with it, and why."""

    skill: str
    gait: Gait
    velocity: tuple[float, float]
    """Commanded velocity, forward and left, in the robot's heading frame [m/s]."""
    turn: float
    """Commanded yaw rate [rad/s]."""
    driver: str
    because: str
    """Why this skill, as a sentence."""
    halt: str | None = None
    """Why the robot must not go on, as a sentence."""
    memory: Mapping[str, str | float] = field(default_factory=dict, hash=False)
    """Working memory after this choice: what rules added and have not deleted."""


@dataclass(frozen=True, slots=True)
class MotionTarget:
    """Which angles: what the body, the feet and the joints should do now."""

    phase: float
    """Phase φ of the gait, in [0, 1)."""
    stance: Bool[np.ndarray, "legs"]
    """Legs that carry load now."""
    share: Float[np.ndarray, "legs"]
    """How much of the normal-force bound each leg may use, 0 … 1: it ramps at both ends of stance."""
    normal_w: Float[np.ndarray, "3"]
    """Unit normal of the ground under the feet."""
    position_w: Float[np.ndarray, "3"]
    velocity_w: Float[np.ndarray, "3"]
    acceleration_w: Float[np.ndarray, "3"]
    """Reference of the base origin."""
    rotation_wb: Float[np.ndarray, "3 3"]
    angular_velocity_w: Float[np.ndarray, "3"]
    angular_acceleration_w: Float[np.ndarray, "3"]
    """Reference of the base's orientation."""
    feet_w: Float[np.ndarray, "legs 3"]
    feet_velocity_w: Float[np.ndarray, "legs 3"]
    feet_acceleration_w: Float[np.ndarray, "legs 3"]
    """References of the foot centres; of use for legs in swing."""
    q: Float[np.ndarray, "legs 3"]
    """Joint angles that realise them [rad]."""
    command: Float[np.ndarray, "3"]
    """Velocity asked for now, after slewing: forward, left [m/s], yaw rate [rad/s]."""


@dataclass(frozen=True, slots=True)
class Torques:
    """How hard: joint torques, and the foot forces they rest on."""

    tau: Float[np.ndarray, "legs 3"]
    """Joint torques [N·m], within the robot's limits."""
    forces_w: Float[np.ndarray, "legs 3"]
    """Intended ground forces on the feet [N]; zero in swing."""
    residual: float
    """Part of the wanted wrench that the feet cannot give, as a share of the weight."""
    status: str = "solved"
    """`solved`, or why not, as a sentence."""
    prices: Float[np.ndarray, "legs limits"] | None = None
    """What each limit of each foot costs (`control.forces`, in words by `control.certificate`)."""
    basis: Float[np.ndarray, "hints"] | None = None
    """Where a linear program may start at the next tick."""
    follows: MotionTarget | None = None
    """The motion that a driver without mechanics follows; a plant without mechanics puts the robot there."""
