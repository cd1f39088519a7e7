"""The values on the arrows of the data flow, one frozen value per arrow.

    Mission ─► navigation ─► Route ─► skills ─► SkillCall ─► gait ─► MotionTarget
            ─► control ─► MotorCommand ─► plant ─► Measured

SI units and radians. `_w`: world axes; `_b`: base axes; quaternions `(w, x, y, z)`. Arrays per leg are
`(legs, 3)` in the robot's leg order. Arrays are copies, never views into a simulator.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.ground_map import (  # noqa: F401 - on an arrow as a whole: found here by all
    GRIP,
    Blocked,
    Elevation,
    ElevationGrid,
    GroundMap,
    Moving,
    Scan,
    Sight,
)
from gaitwright.missions import Mission, Velocity  # noqa: F401 - a mission is on an arrow: found here by all
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.packing import Packed, packed

SHARP = math.radians(40)
"""A turn by more than this is made on the spot [rad]."""


@kernel
def are_finite(row):
    """Whether every number of a row is one."""
    return math.isfinite(row.sum())


@packed
@dataclass(frozen=True, slots=True)
class Sensed(Packed):
    """What is: the state of the robot as every controller reads it (row R3)."""

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
        """Whether every number of the state is one."""
        return are_finite(self.row)


@dataclass(frozen=True, eq=False)
class DepthFrame:
    """What a depth camera saw, whatever camera it was (`model.camera` has its rays)."""

    ranges: Float[np.ndarray, "rows columns"]
    """Distance along each pixel's ray [m], from above and from the left; NaN where nothing came back."""
    time: float
    """When, since the start [s]."""


@dataclass(frozen=True)
class Measured(Sensed):
    """What happened: the state as a plant has it, and what an inertial unit on the base feels.

    Its row is that of a `Sensed`: what further sensors tell stays beside it.

    A simulated plant tells the truth, so its `Measured` may be taken for a `Sensed` as it is; an estimator
    makes a `Sensed` of joints, load, gyroscope and accelerometer alone.
    """

    specific_force_b: tuple[float, float, float]
    """Acceleration of the base origin less gravity, base axes, mean over the last control period [m/s²]."""
    frame: DepthFrame | None = None
    """What a depth camera saw in this tick; `None` where there is none, or nothing new."""


@dataclass(frozen=True, slots=True)
class Route:
    """Which way: what is left of the path, and how far."""

    path: tuple[tuple[float, float], ...]
    """Points still to pass, world [m]; empty when there is nowhere to go."""
    remaining: float
    """Length of what is left until the robot is to stand, from where it is [m]."""
    speed: float | None
    """Wished speed [m/s]."""
    arrived: bool = False
    """Whether the robot has come to its goal."""
    no_way: str | None = None
    """Why there is no path to the goal, as a sentence."""
    ahead: Scan | None = None
    """The ground ahead; `None` where nobody looked."""
    begins: float | None = None
    """World direction in which the way sets out [rad]; `None` where there is none, or nobody noted it."""
    ends: float | None = None
    """World direction in which it comes to its last point [rad]."""
    facing: float | None = None
    """World direction in which the robot looks on its way, where there is no room to turn to it [rad]."""
    velocity: Velocity | None = None
    """What a person asks for now; `None`: the path is followed."""
    pause: str | None = None
    """Why the robot stands for now, as a sentence."""
    halt: str | None = None
    """Why it must not go on, as a sentence."""
    blocked: Blocked | None = None
    """Over what the robot could not go on, as it was found since the way was planned."""
    attended: bool = False
    """Whether a person steers who can give another velocity: a robot that must not go on waits for it."""

    def is_other_than(self, before: "Route") -> bool:
        """Whether the skill is to be chosen anew, and not only at the end of its cycle."""
        return (
            self.arrived != before.arrived
            or len(self.path) != len(before.path)
            or self.facing is not None
            or before.facing is not None
            or self.velocity != before.velocity
            or (self.pause is None) != (before.pause is None)
            or (self.halt is None) != (before.halt is None)
        )


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

    def __hash__(self) -> int:
        """Of the name alone, which Python keeps: what is known of a gait is looked up at every tick."""
        return hash(self.name)


@dataclass(frozen=True, slots=True)
class SkillCall:
    """Which skill: a gait, a velocity to hold with it, and why."""

    skill: str
    gait: Gait
    velocity: tuple[float, float]
    """Commanded velocity, forward and left, in the robot's heading frame [m/s]."""
    turn: float
    """Commanded yaw rate [rad/s]."""
    driver: str = ""
    """Who computes the torques; empty: as the mission says."""
    because: str = ""
    """Why this skill, as a sentence."""
    halt: str | None = None
    """Why the robot must not go on, as a sentence."""
    blocked: Blocked | None = None
    """What it must not go on over."""
    memory: Mapping[str, str | float] = field(default_factory=dict, hash=False)
    """Working memory after this choice: what rules added and have not deleted."""
    firm: bool = False
    """Whether a rule that stands firm asks for it."""
    ruled: bool = False
    """Whether a rule asks for it at all."""
    yields: bool = False
    """Whether it gives way to something that moves: what was wished comes later."""


@packed
@dataclass(frozen=True, slots=True)
class MotionTarget(Packed):
    """Which angles: what the body, the feet and the joints should do now."""

    phase: float
    """Phase φ of the gait, in [0, 1)."""
    stance: Bool[np.ndarray, "legs"]
    """Legs that carry load now."""
    load_scale: Float[np.ndarray, "legs"]
    """How much of the normal-force bound each leg may use, 0 … 1: it ramps at both ends of stance."""
    friction: Float[np.ndarray, "legs"]
    """Coefficient of friction that each foot may count on [-]."""
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
    operator: Float[np.ndarray, "legs"]
    """Number of the terrain operator that each leg is under, from 1 on; 0: none; −1: none is for what
    is ahead."""
    reach: Float[np.ndarray, "legs"]
    """Metres of obstacle that it answers."""
    extra_force_w: Float[np.ndarray, "legs 3"]
    """Forces that it takes to move the feet so [N]."""

    @property
    def share(self) -> Float[np.ndarray, "legs"]:
        """`load_scale` by its name in the first versions."""
        return self.load_scale


@dataclass(frozen=True, slots=True)
class Posture:
    """Where a plant without mechanics puts the robot: all that there is to move it by."""

    position_w: Float[np.ndarray, "3"]
    rotation_wb: Float[np.ndarray, "3 3"]
    """Base origin and orientation."""
    q: Float[np.ndarray, "legs 3"]
    """Joint angles [rad]."""
    stance: Bool[np.ndarray, "legs"]
    """Legs whose feet are on the ground."""


@packed
@dataclass(frozen=True)
class MotorCommand(Packed):
    """How hard: what every motor is told, as drives of legged robots want it, and what it rests on.

    A motor gives τ + k_p (q − q_now) + k_d (q̇ − q̇_now), within its limit; where no gains are set, τ.
    """

    tau: Float[np.ndarray, "legs 3"]
    """Joint torques [N·m], within the robot's limits."""
    forces_w: Float[np.ndarray, "legs 3"]
    """Intended ground forces on the feet [N]; zero in swing."""
    residual: float = 0.0
    """Part of the wanted wrench that the feet cannot give, as a share of the weight."""
    status: str = "solved"
    """`solved`, or why not, as a sentence."""
    q: Float[np.ndarray, "legs 3"] | None = None
    """Joint angles to hold [rad]; with `kp`."""
    qd: Float[np.ndarray, "legs 3"] | None = None
    """Joint rates to hold [rad/s]; with `kd`."""
    kp: Float[np.ndarray, "legs 3"] | None = None
    """Stiffness [N·m/rad]."""
    kd: Float[np.ndarray, "legs 3"] | None = None
    """Damping [N·m·s/rad]."""
    multipliers: Float[np.ndarray, "legs limits"] | None = None
    """What each limit of each foot costs (`control.forces`, in words by `control.certificate`)."""
    posture: Posture | None = None
    """For a plant without mechanics; drivers that solve a robot's dynamics leave it out."""

    @property
    def prices(self) -> Float[np.ndarray, "legs limits"] | None:
        """`multipliers` by their name in the first versions."""
        return self.multipliers

    def torques(
        self, q: Float[np.ndarray, "legs 3"], qd: Float[np.ndarray, "legs 3"]
    ) -> Float[np.ndarray, "legs 3"]:
        """What the motors give where the joints are [N·m], before their limits."""
        tau = self.tau
        if self.kp is not None and self.q is not None:
            tau = tau + self.kp * (self.q - q)
        if self.kd is not None:
            tau = tau + self.kd * ((0.0 if self.qd is None else self.qd) - qd)
        return tau

    def given(
        self,
        q: Float[np.ndarray, "legs 3"],
        qd: Float[np.ndarray, "legs 3"],
        tau_max: Float[np.ndarray, "legs 3"],
    ) -> Float[np.ndarray, "legs 3"]:
        """What the motors give where the joints are [N·m], within their limits."""
        return np.clip(self.torques(q, qd), -tau_max, tau_max)


Torques = MotorCommand
"""The name of a motor command before motors could be told more than a torque."""
