"""Whether a robot can walk a leg cycle at a speed: reach, ground, joint speeds, torques (row J3).

The body stays level at its nominal height and goes straight ahead, each foot passes under its nominal
place in the middle of its support. What is wrong is a value with a sentence that names point and leg.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.dynamics.newton_euler import inverse_dynamics
from gaitwright.errors import WrongUse
from gaitwright.gait.desired_cycle import check_numbers
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle, is_hind, sampled, seen_from_hip
from gaitwright.model.kinematics import HINGES, REACHED
from gaitwright.model.leg_motion import joints_of
from gaitwright.model.reach import LIMIT_TOLERANCE, reach
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.signals import Gait

SAMPLES = 128
"""Moments of a swing that are looked at, besides the points themselves."""
LEAST_CLEARANCE = 0.02
"""A foot is this much over the ground, in body heights, …"""
WAY = 0.1
"""… while it is further than this, in strides, from where it left and from where it will land."""
JOINT_SPEED = 5.0
"""Greatest rate of a joint over √(g/h): 30 rad/s at 0.27 m, the hip motors of dogs of that size; robot
files name no rates."""

Array = np.ndarray


class Fault(NamedTuple):
    """One thing that a robot cannot do of a leg cycle, where it is worst."""

    kind: str
    """`reach`, `ground`, `speed` or `torque`."""
    point: int
    """The nearest point of the cycle, counted from 1."""
    hind: bool
    """Whether that is a point of the hind legs' own path."""
    leg: str
    measure: float
    """What was measured [m, rad/s or N·m; a joint limit: rad]."""
    limit: float
    """What it would have to keep to, same unit."""
    sentence: str
    """All of it in words."""


class Swing(NamedTuple):
    """All legs over one swing, each in its own time, at `moments` shares `s`."""

    s: Float[np.ndarray, "moments"]
    height: Float[np.ndarray, "moments legs"]
    """Of the feet over the ground [m]."""
    way: Float[np.ndarray, "moments legs"]
    """Way share."""
    feet_b: Float[np.ndarray, "moments legs 3"]
    q: Float[np.ndarray, "moments legs 3"]
    qd: Float[np.ndarray, "moments legs 3"]
    qdd: Float[np.ndarray, "moments legs 3"]
    reached: Float[np.ndarray, "moments legs"]
    """1.0 where the foot is within reach and no joint beyond its limit, else 0.0."""


def check_cycle(cycle: LegCycle, robot: Robot, gait: Gait, speed: float) -> tuple[Fault, ...]:
    """What keeps a robot from walking a cycle with a gait straight ahead at `speed` [m/s]; empty: nothing.

    Each kind of fault once, where it is worst. Raises `WrongUse` where the gait is none of this robot or
    lifts no foot, and for a speed that is no number.
    """
    if len(gait.offsets) != robot.n:
        raise WrongUse(f"gait {gait.name!r} is for {len(gait.offsets)} legs; {robot.name} has {robot.n}")
    check_numbers(gait, np.array([speed, 0.0, 0.0]))
    if gait.duty >= 1.0:
        raise WrongUse(f"gait {gait.name!r} lifts no foot (duty factor {gait.duty:g}): it has no leg cycle")
    swing = swing_of(cycle, robot, gait, float(speed))
    found = [out_of_reach(cycle, robot, swing), dragging(cycle, robot, swing)]
    if not found[0]:  # rates and torques mean something only where the foot gets there
        found += [too_fast(cycle, robot, swing), too_hard(cycle, robot, swing)]
    return tuple(fault for fault in found if fault)


def swing_of(cycle: LegCycle, robot: Robot, gait: Gait, speed: float) -> Swing:
    """The motion of all legs over their swings."""
    paths = [cycle.points_of(is_hind(leg, robot.n)) for leg in range(robot.n)]
    nodes = [point[0] for path in set(paths) for point in path]
    s = np.unique(np.concatenate([np.linspace(0.0, 1.0, SAMPLES + 1), nodes]))
    tables = np.stack([sampled(cycle, s, is_hind(leg, robot.n)) for leg in range(robot.n)], axis=1)
    seen = np.stack([seen_from_hip(tables[:, leg], s, gait.duty) for leg in range(robot.n)], axis=1)
    duration = (1.0 - gait.duty) * gait.period
    motion = np.zeros((3, len(s), robot.n, 3))  # place, velocity, acceleration from the nominal place
    for order in range(3):
        motion[order, ..., 0] = speed * gait.period * seen[..., order] / duration**order
        motion[order, ..., 2] = robot.height * seen[..., 3 + order] / duration**order
    feet = motion[0] + robot.stance
    q, qd, qdd, codes = joints_of(robot.packed, feet, motion[1], motion[2])
    beyond = np.maximum(robot.q_min - q, q - robot.q_max).max(axis=2)
    reached = (codes == REACHED) & (beyond <= LIMIT_TOLERANCE)
    return Swing(s, motion[0, ..., 2], tables[..., 0], feet, q, qd, qdd, reached.astype(float))


# --- the faults ------------------------------------------------------------------------------------
def out_of_reach(cycle: LegCycle, robot: Robot, swing: Swing) -> Fault | None:
    """The foot that is furthest beyond its reach, or the joint beyond its limit."""
    told = {
        (i, leg): reach(robot, swing.feet_b[i])[leg] for i, leg in np.argwhere(swing.reached < 1.0).tolist()
    }
    if not told:
        return None
    (i, leg), worst = max(told.items(), key=lambda item: abs(item[1].measure - item[1].limit))
    words = worst.sentence.partition(": ")[2]
    return fault("reach", (cycle, robot, swing), (i, leg), (worst.measure, worst.limit), words)


def dragging(cycle: LegCycle, robot: Robot, swing: Swing) -> Fault | None:
    """The foot that is nearest to the ground while it is on its way."""
    least = LEAST_CLEARANCE * robot.height
    on_its_way = np.abs(swing.way - 0.5) < 0.5 - WAY
    i, leg = lowest = worst_of(np.where(on_its_way, least - swing.height, -np.inf))
    height = float(swing.height[i, leg])
    if not on_its_way[i, leg] or height >= least:
        return None
    words = f"the foot is {height:.2g} m over the ground on its way; at least {least:.2g} m are needed"
    return fault("ground", (cycle, robot, swing), lowest, (height, least), words)


def too_fast(cycle: LegCycle, robot: Robot, swing: Swing) -> Fault | None:
    """The joint that turns fastest, where that is too fast."""
    most = JOINT_SPEED * robot.natural_frequency
    i, leg = worst = worst_of(np.abs(swing.qd).max(axis=2))
    joint = int(np.argmax(np.abs(swing.qd[worst])))
    rate = abs(float(swing.qd[i, leg, joint]))
    if rate <= most:
        return None
    words = f"{HINGES[joint]} would turn at {rate:.3g} rad/s; motors of its size reach {most:.3g} rad/s"
    return fault("speed", (cycle, robot, swing), worst, (rate, most), words)


def too_hard(cycle: LegCycle, robot: Robot, swing: Swing) -> Fault | None:
    """The joint whose torque is furthest beyond its limit."""
    still, up = (0.0, 0.0, 0.0), (0.0, 0.0, GRAVITY)
    moments = zip(swing.q, swing.qd, swing.qdd, strict=True)
    tau = np.abs([inverse_dynamics(robot.arrays, still, still, up, *moment)[2] for moment in moments])
    i, leg = worst = worst_of((tau / robot.tau_max).max(axis=2))
    joint = int(np.argmax(tau[worst] / robot.tau_max[leg]))
    torque, most = float(tau[i, leg, joint]), float(robot.tau_max[leg, joint])
    if torque <= most:
        return None
    words = f"{HINGES[joint]} would need {torque:.3g} N·m; its limit is {most:.3g} N·m"
    return fault("torque", (cycle, robot, swing), worst, (torque, most), words)


def worst_of(badness: Float[np.ndarray, "moments legs"]) -> tuple[int, int]:
    """Moment and leg at which something is largest."""
    i, leg = np.unravel_index(np.argmax(badness), badness.shape)
    return int(i), int(leg)


def fault(
    kind: str,
    about: tuple[LegCycle, Robot, Swing],
    where: tuple[int, int],
    figures: tuple[float, float],
    words: str,
) -> Fault:
    """A `Fault` at a moment of a leg, with its sentence."""
    (cycle, robot, swing), (i, leg) = about, where
    hind = cycle.hind is not None and is_hind(leg, robot.n)
    nodes = np.array(cycle.points_of(hind))[:, 0]
    nearest = int(np.argmin(np.abs(nodes - swing.s[i])))
    at = "at" if nodes[nearest] == swing.s[i] else "near"
    whose = f"the hind legs of {cycle.name}" if hind else cycle.name
    sentence = f"{at} point {nearest + 1} of {whose}, leg {robot.legs[leg]}: {words}"
    return Fault(kind, nearest + 1, hind, robot.legs[leg], *figures, sentence)
