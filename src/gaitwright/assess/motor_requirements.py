"""What a gait asks of a robot's motors and legs, before it walks: torques, rates, forces, reach.

The desired cycle of the gait, swaying and bobbing as the coordinator will have it, goes through the numerical
controller as if the motors had no limits; what comes out is held against the limits that they have. The feet
follow the leg cycle that they follow under the coordinator: the gait's own, or another one that is given.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.assess.torque_profiles import torque_profiles
from gaitwright.errors import WrongUse
from gaitwright.gait.desired_cycle import DesiredCycle, Manner, check, desired_cycle
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle
from gaitwright.gait.reference import periodic_reference
from gaitwright.model.kinematics import HINGES
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.signals import Gait
from gaitwright.skills.library import Skill, gait_of

STEPS = 80
"""Samples of a cycle: peaks are within 2 % of those of a fine cycle."""
LIMITLESS = 1e6
"""Times its weight × height: the torque of a motor without limits."""
FREE = 4.0 * math.pi
"""Joint limits that no posture meets [rad]."""
BRIEF = 0.2
"""A torque needed for a smaller share of a stance or a swing is brief: other feet stand in for it."""
STRAINED = math.radians(5.0)
"""Joints may be asked this far beyond their limits [rad]: the foot then stands a little elsewhere."""
PARTS = 9
"""Halvings of the range in which the fastest speed is sought."""
HOPELESS = 2.1
"""Motors that would have to give more than this many times their limit for a gait do not walk it.

In simulation gaits give way between 1.4 and 2.1 times: momentum gets a body over what is missing. The
hexapod climbs at 2.08.
"""
DIGITS = 9
"""Of a joint rate [rad/s]; what is smaller is rounding in J x = b, in a hinge that does not move at all."""


@dataclass(frozen=True)
class MotorRequirements:
    """What a gait needs at one velocity; arrays by leg and joint (hip 1, hip 2, knee)."""

    robot: Robot
    gait: Gait
    command: Float[np.ndarray, "3"]
    """Velocity forward and left [m/s], yaw rate [rad/s]."""
    torque: Float[np.ndarray, "legs 3"]
    """Largest torques over the cycle [N·m]."""
    lasting: Float[np.ndarray, "legs 3"]
    """Torques exceeded for no more than `BRIEF` of a stance or of a swing [N·m], the larger of both."""
    rate: Float[np.ndarray, "legs 3"]
    """Largest joint rates [rad/s]."""
    force: Float[np.ndarray, "legs"]
    """Largest force of each foot [N]."""
    reach: Float[np.ndarray, "legs"]
    """How much longer each leg is than it has to be, in the plane in which the knee bends [m]."""
    room: Float[np.ndarray, "legs 3"]
    """How far each joint stays from its limits [rad]; negative: so far beyond."""

    @property
    def load(self) -> float:
        """Largest share of a motor's limit that is needed lastingly; above 1 the motors cannot follow."""
        return float((self.lasting / self.robot.tau_max).max())

    @property
    def haste(self) -> Float[np.ndarray, "legs 3"]:
        """Largest joint rates as shares of the motors' own; 0 where no limit is known."""
        limits = np.zeros_like(self.rate) if self.robot.rate_max is None else self.robot.rate_max
        return np.divide(self.rate, limits, out=np.zeros_like(self.rate), where=limits > 0.0)

    @property
    def what(self) -> str:
        """The gait and its velocity in words."""
        forward, left, turn = map(float, self.command)
        return words(self.gait, (forward, left, turn))

    def shortage(self, leeway: float = 1.0) -> str | None:
        """What is missing, as a sentence; `None` where motors times `leeway` and joints suffice.

        Joint rates are held against their limits only without leeway: simulated motors turn faster.
        """
        short = self.lasting / self.robot.tau_max
        leg, joint = (int(i) for i in np.unravel_index(np.argmax(short), short.shape))
        if short[leg, joint] > leeway:
            need, limit = self.lasting[leg, joint], self.robot.tau_max[leg, joint]
            where = f"the {HINGES[joint]} of {self.robot.legs[leg]}"
            digits = 3 if need > 1.01 * limit else 5
            return f"{self.what} needs {need:.{digits}g} N·m at {where}; the motor gives {limit:.{digits}g}"
        leg, joint = (int(i) for i in np.unravel_index(np.argmax(self.haste), short.shape))
        if self.robot.rate_max is not None and leeway <= 1.0 < self.haste[leg, joint]:
            turn, limit = self.rate[leg, joint], self.robot.rate_max[leg, joint]
            where = f"the {HINGES[joint]} of {self.robot.legs[leg]}"
            return f"{self.what} turns {where} at {turn:.3g} rad/s; the motor turns {limit:.3g}"
        leg, joint = (int(i) for i in np.unravel_index(np.argmin(self.room), short.shape))
        if self.room[leg, joint] < -STRAINED:
            where = f"the {HINGES[joint]} of {self.robot.legs[leg]}"
            return f"{self.what} turns {where} {math.degrees(-self.room[leg, joint]):.0f}° beyond its limit"
        return None


def motor_requirements(
    robot: Robot,
    gait: Gait,
    velocity: tuple[float, float],
    turn: float = 0.0,
    cycle: LegCycle | None = None,
) -> MotorRequirements:
    """What a gait needs at a velocity (forward and left, m/s) and a yaw rate (rad/s) on level ground.

    `cycle`: the leg cycle of the feet; `None`: the gait's own. Raises `WrongUse` where the gait does not fit
    the robot, and where a foot cannot be reached.
    """
    weight = robot.total_mass * GRAVITY
    free = replace(
        robot,
        tau_max=np.full_like(robot.tau_max, LIMITLESS * weight * robot.height),
        q_min=np.full_like(robot.q_min, -FREE),
        q_max=np.full_like(robot.q_max, FREE),
    )
    motion = desired_cycle(free, gait, velocity, turn, Manner(sways=True, cycle=cycle), STEPS)
    efforts = torque_profiles([motion], cores=1)[0]
    tau = np.abs(efforts.tau)
    return MotorRequirements(
        robot=robot,
        gait=gait,
        command=motion.command,
        torque=tau.max(axis=0),
        lasting=np.maximum(lasting(tau, motion.stance), lasting(tau, ~motion.stance)),
        rate=np.abs(motion.qd).max(axis=0).round(DIGITS),
        force=np.linalg.norm(efforts.forces_w, axis=2).max(axis=0),
        reach=spare_length(motion).min(axis=0),
        room=np.minimum(motion.q - robot.q_min, robot.q_max - motion.q).min(axis=0),
    )


def lasting(
    tau: Float[np.ndarray, "steps legs 3"], when: Bool[np.ndarray, "steps legs"]
) -> Float[np.ndarray, "legs 3"]:
    """The torque of each joint that is exceeded in no more than `BRIEF` of the samples `when`; else 0."""
    ranked = np.sort(np.where(when[..., None], tau, -1.0), axis=0)[::-1]
    at = np.floor(BRIEF * when.sum(axis=0)).astype(int)
    chosen = np.take_along_axis(ranked, np.repeat(at[:, None], 3, axis=1)[None], axis=0)[0]
    return np.maximum(chosen, 0.0)


def spare_length(cycle: DesiredCycle) -> Float[np.ndarray, "steps legs"]:
    """Length of the stretched leg less the distance from hip 2 to the foot, in the plane of the knee [m]."""
    robot = cycle.robot
    thigh, shank = robot.offset[:, 1][:, [0, 2]], robot.offset[:, 2][:, [0, 2]]
    bend = robot.sign * cycle.q[..., 2]
    c, s = np.cos(bend), np.sin(bend)
    turned = np.stack([c * shank[:, 0] + s * shank[:, 1], c * shank[:, 1] - s * shank[:, 0]], axis=-1)
    longest = np.linalg.norm(thigh, axis=1) + np.linalg.norm(shank, axis=1)
    return longest - np.linalg.norm(thigh + turned, axis=-1)


def shortage(
    robot: Robot,
    gait: Gait,
    velocity: tuple[float, float],
    turn: float = 0.0,
    leeway: float = 1.0,
    cycle: LegCycle | None = None,
) -> str | None:
    """What a robot lacks for a gait at a velocity, as a sentence; `None` where it has all.

    `leeway`: how many times their limits the motors are taken to give; `cycle`: the leg cycle of the feet;
    `None`: the gait's own. Raises `WrongUse` only where the gait is none of this robot's.
    """
    command = np.array([*velocity, turn], dtype=float)
    check(robot, gait, command, Manner(), STEPS)
    try:
        found = motor_requirements(robot, gait, velocity, turn, cycle)
    except WrongUse as error:  # all else was checked: a foot cannot be reached
        return f"{words(gait, (*velocity, turn))} is beyond the legs: {str(error).partition(', ')[2]}"
    return found.shortage(leeway)


MOST_SWAY = 0.075
"""A gait that sways the body by more than this, in body heights, throws it over its feet.

Measured on robots carried by one side in turn: the thesis's falls at 0.085 and more, others go at 0.07.
"""


def too_wide(robot: Robot, gait: Gait) -> str | None:
    """Why a robot stands too wide for a gait, as a sentence; `None` where it does not."""
    sway = float(np.abs(periodic_reference(robot, gait)[:, 0]).max())
    if sway <= MOST_SWAY * robot.height:
        return None
    wide = float(np.abs(robot.nominal_feet[:, 1]).max())
    return (
        f"{gait.name} would sway {robot.name} by {sway:.2f} m: its feet stand {wide:.2f} m from its middle "
        f"line at a height of {robot.height:.2f} m, too wide to be carried by one side in turn"
    )


def words(gait: Gait, command: tuple[float, float, float]) -> str:
    """A gait and its velocity."""
    forward, left, turn = command
    parts = [f"{forward:.3g} m/s"] if forward or not (left or turn) else []
    parts += [f"{left:.3g} m/s to the left"] if left else []
    parts += [f"{turn:.3g} rad/s"] if turn else []
    return gait.name if gait.duty >= 1.0 else f"{gait.name} at {', '.join(parts)}"


@dataclass(frozen=True, slots=True)
class Fastest:
    """How fast a robot can go with a skill, and what keeps it from going faster."""

    speed: float
    """[m/s]; not a number where it cannot even step on the spot."""
    limit: str
    """What is missing just beyond, as a sentence."""


def fastest_supported(robot: Robot, skill: Skill, leeway: float = 1.0) -> Fastest:
    """The largest forward speed of a skill that motors (times `leeway`) and legs allow, by bisection."""
    gait = gait_of(skill, robot)
    limit = shortage(robot, gait, (0.0, 0.0), leeway=leeway)
    if limit is not None:
        return Fastest(math.nan, limit)
    if gait.duty >= 1.0:
        return Fastest(0.0, f"{gait.name} lifts no foot")
    # A step as long as both stretched legs is beyond any reach.
    slow, fast = 0.0, 2.0 * robot.leg_length / (gait.period * gait.duty)
    limit = shortage(robot, gait, (fast, 0.0), leeway=leeway)
    for _ in range(PARTS):
        middle = 0.5 * (slow + fast)
        missing = shortage(robot, gait, (middle, 0.0), leeway=leeway)
        if missing is None:
            slow = middle
        else:
            fast, limit = middle, missing
    return Fastest(slow, limit or "nothing was found missing")
