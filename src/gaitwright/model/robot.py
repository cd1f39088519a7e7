"""A robot as plain numbers: a floating body and legs of three hinges (rows R1, R2).

Each leg has a *leg frame* at its first hinge: x along the first axis, y along the second. The third
axis is parallel to the second, so every leg is the chain (turn about x, turn about y, turn about y),
whether its first hinge is an abduction (x forward) or a yaw (x up). All that tells one leg type from
the other is where the leg frame points.
"""

from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from jaxtyping import Float, Int

from gaitwright.errors import printable
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.numerics.packing import Layout


class RobotArrays(NamedTuple):
    """The numbers that kernels read, for `legs` legs; the fields are those of `Robot`."""

    base_mass: Float[np.ndarray, "1"]
    base_com: Float[np.ndarray, "3"]
    base_inertia: Float[np.ndarray, "3 3"]
    hip: Float[np.ndarray, "legs 3"]
    leg_frame: Float[np.ndarray, "legs 3 3"]
    offset: Float[np.ndarray, "legs 3 3"]
    sign: Float[np.ndarray, "legs"]
    mass: Float[np.ndarray, "legs 3"]
    com: Float[np.ndarray, "legs 3 3"]
    inertia: Float[np.ndarray, "legs 3 3 3"]
    armature: Float[np.ndarray, "legs 3"]
    branch: Float[np.ndarray, "legs 2"]
    tau_max: Float[np.ndarray, "legs 3"]
    damping: Float[np.ndarray, "legs 3"]
    friction: Float[np.ndarray, "legs 3"]
    q_min: Float[np.ndarray, "legs 3"]
    q_max: Float[np.ndarray, "legs 3"]
    foot_radius: Float[np.ndarray, "legs"]
    nominal_feet: Float[np.ndarray, "legs 3"]
    measures: Float[np.ndarray, "3"]


LAYOUT = Layout.of(RobotArrays)
unpacked = LAYOUT.views(RobotArrays)
"""The `RobotArrays` in a `Robot.packed`, as views; for kernels too."""
legs_of = LAYOUT.legs()
tau_max_of, measures_of = LAYOUT.field("tau_max"), LAYOUT.field("measures")
damping_of, friction_of = LAYOUT.field("damping"), LAYOUT.field("friction")
q_min_of, q_max_of = LAYOUT.field("q_min"), LAYOUT.field("q_max")


@dataclass(frozen=True)
class Robot:
    """A legged robot. SI units; legs in the order of `legs`; joints hip 1, hip 2, knee.

    Frames: *base* is the floating body's own (x forward, y left, z up, origin where the model has it);
    *leg* is at the first hinge, axes as above; *link i* turns with hinge i and equals the leg frame
    at zero angles.
    """

    name: str
    legs: tuple[str, ...]
    """Names of the legs, e.g. `("FL", "FR", "RL", "RR")`."""
    base_mass: float
    """Mass of the floating body with all that is fixed to it [kg]."""
    base_com: Float[np.ndarray, "3"]
    """Its centre of mass, base frame [m]."""
    base_inertia: Float[np.ndarray, "3 3"]
    """Its inertia about the centre of mass, base axes [kg·m²]."""
    hip: Float[np.ndarray, "legs 3"]
    """First hinge of each leg, base frame [m]."""
    leg_frame: Float[np.ndarray, "legs 3 3"]
    """Rotation that takes leg components to base components, at zero angles."""
    offset: Float[np.ndarray, "legs 3 3"]
    """Rows: hinge 1 → hinge 2, hinge 2 → hinge 3, hinge 3 → centre of the foot, in link axes [m]."""
    sign: Float[np.ndarray, "legs"]
    """+1 where the third axis points along the second one, -1 where against it."""
    mass: Float[np.ndarray, "legs 3"]
    """Link masses [kg]; a first link may be massless where hinges 1 and 2 meet in a point."""
    com: Float[np.ndarray, "legs 3 3"]
    """Link centres of mass from the link's hinge, link axes [m]."""
    inertia: Float[np.ndarray, "legs 3 3 3"]
    """Link inertias about their centres of mass, link axes [kg·m²]."""
    armature: Float[np.ndarray, "legs 3"]
    """Rotor inertia seen at the joint [kg·m²]."""
    damping: Float[np.ndarray, "legs 3"]
    """Viscous joint friction [N·m·s/rad]; the plant has it, and the numerical controller feeds it forward."""
    friction: Float[np.ndarray, "legs 3"]
    """Dry joint friction [N·m]; as `damping`."""
    q_min: Float[np.ndarray, "legs 3"]
    q_max: Float[np.ndarray, "legs 3"]
    """Joint limits [rad]."""
    tau_max: Float[np.ndarray, "legs 3"]
    """Torque limits, both signs [N·m]."""
    foot_radius: Float[np.ndarray, "legs"]
    """Radius of the spherical feet [m]."""
    branch: Int[np.ndarray, "legs 2"]
    """Branch of the inverse kinematics: side of the foot (sg) and bend of the knee (kn), each ±1."""
    nominal_feet: Float[np.ndarray, "legs 3"]
    """Centres of the feet in the nominal stance, base frame [m]."""
    trunk: Float[np.ndarray, "2 3"]
    """Collision box of the floating body: centre and half sizes, base frame [m]."""
    rate_max: Float[np.ndarray, "legs 3"] | None = None
    """Velocity limits of the joints [rad/s], 0 where there is none; `None`: no limit is known."""

    @property
    def stance(self) -> Float[np.ndarray, "legs 3"]:
        """`nominal_feet` by its name in the first versions."""
        return self.nominal_feet

    @property
    def n(self) -> int:
        """Number of legs."""
        return len(self.legs)

    @cached_property
    def total_mass(self) -> float:
        """Mass of the whole robot [kg]."""
        return float(self.base_mass + self.mass.sum())

    @cached_property
    def height(self) -> float:
        """Nominal height of the base origin above flat ground [m]."""
        return float(np.mean(self.foot_radius - self.nominal_feet[:, 2]))

    @cached_property
    def stand(self) -> float:
        """Height of the base origin above the centres of the feet in the nominal stance [m]."""
        return -float(self.nominal_feet[:, 2].mean())

    @cached_property
    def body_length(self) -> float:
        """Distance between the foremost and the rearmost hip [m]: the unit in which goals are reached."""
        return float(np.ptp(self.hip[:, 0]))

    @cached_property
    def leg_length(self) -> float:
        """Length of a stretched leg from hinge 2 to the foot [m], mean over the legs."""
        return float(np.linalg.norm(self.offset[:, 1:], axis=2).sum(axis=1).mean())

    @cached_property
    def step_limit(self) -> float:
        """Highest sudden rise or drop that the feet step over where they know the ground ahead [m].

        0.36 of the height that the legs hold the base at. Measured on stairs of which more and more were too
        high: Go2, the thesis's robot and the hexapod all still climb steps of this share and fall on higher
        ones, though their stretched legs are 1.4 to 2 times that height.
        """
        return 0.36 * self.height

    @cached_property
    def natural_frequency(self) -> float:
        """√(g/h) [1/s]: the robot's clock; all gains and periods scale with it (control.md)."""
        return float(np.sqrt(GRAVITY / self.height))

    @cached_property
    def measures(self) -> Float[np.ndarray, "3"]:
        """Weight [N], nominal height [m] and natural frequency [1/s]: the units of the controllers."""
        return np.array([self.total_mass * GRAVITY, self.height, self.natural_frequency])

    @cached_property
    def arrays(self) -> RobotArrays:
        """The same numbers for the kernels: contiguous float64, scalars as arrays of one."""

        def flat(x: np.ndarray) -> np.ndarray:
            return np.ascontiguousarray(x, dtype=np.float64)

        own = {field: flat(getattr(self, field)) for field in RobotArrays._fields if field != "base_mass"}
        return RobotArrays(base_mass=np.array([self.base_mass]), **own)

    @cached_property
    def packed(self) -> Float[np.ndarray, "numbers"]:
        """All of `arrays` in one row."""
        return LAYOUT.pack(self.arrays)


def lists_of(robot: Robot) -> dict[str, Any]:
    """The fields of a robot as plain JSON values."""
    values = {field.name: getattr(robot, field.name) for field in fields(Robot)}
    known = {name: value for name, value in values.items() if value is not None}
    return {name: v.tolist() if isinstance(v, np.ndarray) else v for name, v in known.items()}


def robot_of(values: dict[str, Any]) -> Robot:
    """The robot of what `lists_of` gave, in older recordings too."""
    values = {"nominal_feet" if name == "stance" else name: value for name, value in values.items()}
    arrays: dict[str, Any] = {name: np.array(v) for name, v in values.items() if isinstance(v, list)}
    own = {"name": printable(str(values["name"])), "legs": tuple(values["legs"])}
    return Robot(**{**values, **arrays, **own})


@kernel
def scales(packed):
    """Torque limits `(legs, 3)`, weight [N] and nominal height [m] of a `Robot.packed`."""
    measures = measures_of(packed)
    return tau_max_of(packed), measures[0], measures[1]
