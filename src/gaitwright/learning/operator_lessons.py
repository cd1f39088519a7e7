"""Terrain operators from one edit on one leg in one skill (row L4; thesis 5.4.1, 6.2).

A teacher shows how a leg gets over an obstacle of a size: a person by a leg cycle of hers, the numerical
controller by how it raises a foot. The edited path less the usual one, per metre, is the operator's path; the
torque that the leg takes beyond its usual one, as a force on the foot, is measured in physics.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float

from gaitwright.control.learned.law import columns_in_ground, note
from gaitwright.control.learned.profile import ROW
from gaitwright.errors import WrongUse, unknown
from gaitwright.gait.contacts import swing_time
from gaitwright.gait.coordinator import Coordinator
from gaitwright.gait.kinds import KINDS
from gaitwright.gait.leg_cycles.files import cycle_of
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle, is_hind, sampled
from gaitwright.gait.operators import SHARES, Operator
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain, Lap
from gaitwright.model.robot import Robot
from gaitwright.plant.registry import make_plant
from gaitwright.session import DT, Session
from gaitwright.signals import Gait, Mission
from gaitwright.skills.chooser import fixed_skill

SETTLING, SHOWN, STARTS = 2.0, 4.0, 2
"""Time until a gait is steady, time that is noted [s], and how many starts."""
SHOWN_ON, SHOWN_SIZE, SHOWN_HOLE = "trot", 0.6, 0.5
"""What the numerical controller shows unasked: in which skill, an obstacle of which share of the highest
step, and a hole of which share of the body's height."""
ROOM = 1.65
"""An operator serves obstacles of up to so many times the size that it was taught for."""
RAISED = ("block", "step up", "step down")
"""Obstacles that a foot is raised over by their own height."""
OVER_HOLES = 0.3
"""Over a hole it is raised by this share of the width: a foot that goes low hits the far edge."""
FEWEST = 8
"""A share of the swing that was seen so often is known."""
TRUSTED = 0.02
"""Along directions that move a foot by less than this per radian, over the leg's length, torques say little
of a force, and little of one is taken."""


@dataclass(frozen=True)
class Edit:
    """What a teacher showed. Raises `WrongUse` for a leg or an obstacle that there is not."""

    robot: Robot
    size: float
    """Of the obstacle [m]."""
    skill: str = SHOWN_ON
    leg: str = ""
    """Empty: the first one."""
    kinds: tuple[str, ...] = RAISED
    cycle: LegCycle | None = None
    """How the foot goes over it; `None`: as the numerical controller raises it, where she does."""
    landing: float = 0.0
    """How much farther it lands [m]."""

    def __post_init__(self) -> None:
        if self.leg and self.leg not in self.robot.legs:
            raise unknown(f"leg of {self.robot.name}", self.leg, self.robot.legs)
        for kind in self.kinds:
            if kind not in KINDS:
                raise unknown("kind of obstacle", kind, KINDS)
        if not 0.0 < self.size <= self.robot.height:
            raise WrongUse(
                f"an obstacle of {self.size:g} m: it is more than 0 and at most {self.robot.height:.2f} m, "
                "as high as the body"
            )

    @property
    def number(self) -> int:
        """Which leg it is."""
        return self.robot.legs.index(self.leg) if self.leg else 0


def learned_from(edit: Edit, name: str = "", seed: int = 0) -> Operator:
    """The operator that an edit teaches. Raises `WrongUse` where the robot falls with it."""
    robot, gait = (
        edit.robot,
        fixed_skill(edit.robot, edit.skill, None, 0.0, None, "numerical").skill_call.gait,
    )
    leg = robot.legs[edit.number]
    who = "by the numerical controller" if edit.cycle is None else f"by the leg cycle {edit.cycle.name}"
    drawn = Operator(
        name or f"over a {edit.kinds[0]}",
        edit.kinds,
        round(ROOM * edit.size, 4),
        path_of(edit, gait).round(5),
        np.zeros((SHARES, 3)),
        round(swing_time(gait.period, gait.duty), 6),
        round(edit.landing / edit.size, 5),
        f"on {leg} in {gait.name} at {edit.size:.3f} m, {who}",
    )
    plain, raised = (swings(edit, drawn, size, seed) for size in (0.0, edit.size))
    force = force_between(robot, edit.number, plain, raised) / edit.size
    return replace(drawn, force=force.round(3))


def shown(robot: Robot, seed: int = 0) -> tuple[Operator, ...]:
    """What the numerical controller shows unasked: how a foot gets over obstacles, and over holes."""
    obstacle = Edit(robot, SHOWN_SIZE * robot.step_limit)
    hole = Edit(robot, SHOWN_HOLE * robot.height, kinds=("hole",))
    return learned_from(obstacle, "over an obstacle", seed), learned_from(hole, "over a hole", seed)


def path_of(edit: Edit, gait: Gait) -> Float[np.ndarray, "shares 2"]:
    """The edited path less the usual one, per metre: shift in shares of the way, height."""
    at = np.linspace(0.0, 1.0, SHARES)
    hind = is_hind(edit.number, edit.robot.n)
    usual = sampled(cycle_of(gait.name), at, hind)[:, [0, 3]]
    if edit.cycle is None:
        much = 1.0 if set(edit.kinds) & set(RAISED) else OVER_HOLES if "hole" in edit.kinds else 0.0
        shift, height = np.zeros(SHARES), much * usual[:, 1] / usual[:, 1].max()
    else:
        off = sampled(edit.cycle, at, hind)[:, [0, 3]] - usual
        shift, height = off[:, 0] / edit.size, off[:, 1] * edit.robot.height / edit.size
    path = np.stack([shift, height], axis=1)
    path[[0, -1]] = 0.0
    return path


# --- what it takes -------------------------------------------------------------------------------
@dataclass(frozen=True)
class Swing:
    """The mean swing of a leg, row by row over its shares."""

    free: Float[np.ndarray, "shares 3"]
    """Torques without foot forces [N·m]."""
    columns: Float[np.ndarray, "shares 3 3"]
    """Columns of the Jacobian of the contact point, ground frame [m]."""


def swings(edit: Edit, operator: Operator, size: float, seed: int) -> Swing:
    """The mean swing of the leg, where it takes an obstacle of that size for seen; without one for 0."""
    robot, leg = edit.robot, edit.number
    offset, found = 0.0, []
    for lap in driven(edit, operator, size, seed):
        offset, gait = lap.call.gait.offsets[leg], lap.call.gait
        own = (lap.target.phase + offset) % 1.0
        if own > gait.duty and not lap.target.stance[leg]:
            share = (own - gait.duty) / (1.0 - gait.duty)
            found.append((share, *taken(robot, lap, leg)))
    return mean_swing(np.array([one[0] for one in found]), np.array([one[1:] for one in found]), edit)


def driven(edit: Edit, operator: Operator, size: float, seed: int) -> Iterator[Lap]:
    """The laps of the numerical controller, once steady. Raises `WrongUse` where the robot falls."""
    robot = edit.robot
    chooser = fixed_skill(robot, edit.skill, None, 0.0, None, "numerical")
    for start in range(seed, seed + STARTS):
        scene = load_scene("flat", start)
        brain = imagining(Brain.of(robot, scene, chooser, DT, watches=False), (operator,), edit.number, size)
        session = Session(brain, make_plant("mujoco", robot, scene, DT), Mission(()), SETTLING + SHOWN, start)
        for lap in session:
            if lap.fell:
                raise WrongUse(f"{robot.name} falls in {edit.skill} with this edit: {lap.stopped_because}")
            if lap.sensed.time >= SETTLING:
                yield lap


def imagining(brain: Brain, operators: tuple[Operator, ...], leg: int, size: float) -> Brain:
    """The same brain with operators, one leg of which takes an obstacle of a size [m] for seen."""
    assert isinstance(brain.coordinator, Coordinator)
    sizes = tuple(size if k == leg else 0.0 for k in range(brain.robot.n))
    return replace(brain, coordinator=replace(brain.coordinator, operators=operators, imagined=sizes))


def taken(robot: Robot, lap: Lap, leg: int) -> Float[np.ndarray, "numbers"]:
    """Free torques of a leg and the columns of its Jacobian, in a tick."""
    row, where = np.empty(ROW.size(robot.n)), ROW.slices(robot.n)
    note(robot.packed, lap.sensed.row, lap.target.row, lap.command.tau, lap.command.forces_w, row)
    columns = columns_in_ground(robot.packed, lap.sensed.row, lap.target.row, leg)
    three = slice(3 * leg, 3 * leg + 3)
    return np.concatenate([row[where["free"]][three], columns.ravel()])


def mean_swing(shares: np.ndarray, numbers: np.ndarray, edit: Edit) -> Swing:
    """The mean of what was seen at each share, straight between those that nobody saw."""
    at = np.linspace(0.0, 1.0, SHARES)
    place = np.round(np.clip(shares, 0.0, 1.0) * (SHARES - 1)).astype(int)
    count = np.bincount(place, minlength=SHARES)
    known = np.flatnonzero(count >= FEWEST)
    if len(known) < SHARES // 2:
        raise WrongUse(f"{edit.robot.name} swings {edit.leg or 'its leg'} too rarely in {edit.skill}")
    total = np.zeros((SHARES, numbers.shape[1]))
    np.add.at(total, place, numbers)
    mean = total[known] / count[known, None]
    full = np.stack([np.interp(at, at[known], column) for column in mean.T], axis=1)
    return Swing(full[:, :3], full[:, 3:].reshape(-1, 3, 3))


def force_between(robot: Robot, leg: int, plain: Swing, raised: Swing) -> Float[np.ndarray, "shares 3"]:
    """The force on a foot that a raised swing takes beyond a plain one [N]: of a left leg, heading frame."""
    side = 1.0 if robot.nominal_feet[leg, 1] >= 0.0 else -1.0
    size = float(np.linalg.norm(robot.offset[leg, 1:], axis=1).sum())
    force = np.array(
        [
            damped(columns, more, TRUSTED * size)
            for columns, more in zip(raised.columns, raised.free - plain.free, strict=True)
        ]
    )
    return force * np.array([1.0, side, 1.0])


def force_as_torque(
    robot: Robot, leg: int, operator: Operator, swing: Swing
) -> Float[np.ndarray, "shares 3"]:
    """Torques per metre that an operator's force comes to in a leg that swings so [N]."""
    side = 1.0 if robot.nominal_feet[leg, 1] >= 0.0 else -1.0
    return np.einsum("sja,sa->sj", swing.columns, operator.force * np.array([1.0, side, 1.0]))


def damped(
    columns: Float[np.ndarray, "3 3"], torques: Float[np.ndarray, "3"], least: float
) -> Float[np.ndarray, "3"]:
    """The smallest force F with columnsⱼ · F = torques, little of it where the columns hardly tell."""
    u, s, vt = np.linalg.svd(columns)
    return vt.T @ (s / (s * s + least * least) * (u.T @ torques))
