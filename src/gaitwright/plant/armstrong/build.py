"""Robot → `System`: the tree of ball joints, the springs of its hinges, its feet (rows N6, N7).

Every spring follows from the robot's own numbers: as stiff as its load asks, but no faster than `FASTEST`.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.dynamics.tree import Tree, ball_rotations, ball_tree, first_link
from gaitwright.model.kinematics import angles
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, quaternion_of
from gaitwright.plant.armstrong.contact import Feet
from gaitwright.plant.armstrong.joints import ABOUT_X, ABOUT_Y, BOTH, Joints
from gaitwright.plant.armstrong.stiffness import row_mobility
from gaitwright.plant.armstrong.system import System, parts, rates_begin

SAG = 0.01
"""How far a guide gives way under the weight on one leg at the leg's length [rad]."""
SINK = 0.001
"""How deep a foot stands in the ground, per height of the robot [-]."""
FASTEST = 1500.0
"""Springs alone on their joint are no faster than this [rad/s]: faster ones would cost steps."""
FIRMEST = 200.0
"""Feet on the ground are no faster than this [rad/s]: from firmer ground they bounce between two ticks."""
DAMPED = 1.0
"""Damping ratio of a spring alone on its joint or foot [-]."""
THICK = 0.02
"""A link's least moment of inertia about its hinge, per its largest [-].

Twists of a slender link are the stiff mode of ball joints (equations.md §3). Thickened, they are slower;
what the leg's own swing takes changes by a few hundredths."""
POSES = 8
"""Poses in which the stiffest mode is looked for: the stance, and others within the joint limits."""


class Ball(NamedTuple):
    """A ball joint of a leg, and the hinges it stands for."""

    leg: int
    link: int
    first: int
    last: int
    """Its first and last hinge, 0 … 2."""

    @property
    def kind(self) -> int:
        """What the joint may do."""
        if self.first < self.last:
            return BOTH
        return ABOUT_X if self.first == 0 else ABOUT_Y

    @property
    def name(self) -> str:
        """What a person calls it."""
        return "hip" if self.kind == BOTH else ("hip 1", "hip 2", "knee")[self.first]


def balls(robot: Robot) -> list[Ball]:
    """The ball joints of a robot, leg by leg, in the order of the links of `ball_tree`."""
    out: list[Ball] = []
    for leg in range(robot.n):
        top = first_link(robot, leg)
        out += [Ball(leg, 1 + len(out) + i - top, 0 if i == top else i, i) for i in range(top, 3)]
    return out


# --- links ---------------------------------------------------------------------------------------
def links_of(robot: Robot) -> Tree:
    """The robot's tree as this plant moves it: slender links thickened."""
    tree, _ = ball_tree(robot)
    legs = [thickened(inertia) for inertia in tree.inertia[1:]]
    return tree._replace(inertia=np.array([tree.inertia[0], *legs]))


def thickened(inertia: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "3 3"]:
    """The same inertia with no principal moment below `THICK` times the largest."""
    moments, axes = np.linalg.eigh(inertia)
    return axes * np.maximum(moments, THICK * moments[2]) @ axes.T


# --- springs -------------------------------------------------------------------------------------
def system_of(robot: Robot, friction: float) -> System:
    """The robot with its springs, on ground of a coefficient of friction."""
    bare = unsprung(robot, friction)
    ease = np.diag(row_mobility(bare, state_of(robot, bare, *stance_pose(robot))))
    in_joints, at_feet = ease[: -3 * robot.n].reshape(-1, 4), ease[-3 * robot.n :].reshape(-1, 3).min(axis=1)
    weight = robot.total_mass * GRAVITY / robot.n
    moment = weight * robot.leg_length
    guide, guide_damping = spring(moment / SAG, in_joints[:, :2], FASTEST)
    of_hinges = [
        in_joints[j, 2 + i] for j, ball in enumerate(balls(robot)) for i in range(1 + ball.last - ball.first)
    ]
    stop, stop_damping = spring(moment / SAG, np.array(of_hinges), FASTEST)
    stiffness, damping = spring(weight / (SINK * robot.height), at_feet, FIRMEST)
    joints = bare.joints._replace(
        guide=guide, guide_damping=guide_damping, stop=stop, stop_damping=stop_damping
    )
    return bare._replace(joints=joints, feet=bare.feet._replace(stiffness=stiffness, damping=damping))


def spring(
    wanted: float, ease: Float[np.ndarray, "*rows"], fastest: float
) -> tuple[Float[np.ndarray, "*rows"], Float[np.ndarray, "*rows"]]:
    """Stiffness and damping of springs on rows of mobility `ease`, no faster than `fastest` [rad/s].

    Nothing on rows that are none.
    """
    there = np.maximum(ease, 1e-12)
    stiffness = np.where(ease > 1e-12, np.minimum(wanted, fastest**2 / there), 0.0)
    return stiffness, 2.0 * DAMPED * np.sqrt(stiffness / there)


def unsprung(robot: Robot, friction: float) -> System:
    """The robot's links, joints and feet, all springs at nothing."""
    of, n = balls(robot), robot.n
    none, hinges = np.zeros((len(of), 2)), np.zeros(3 * n)
    joints = Joints(
        link=np.array([ball.link for ball in of]),
        kind=np.array([ball.kind for ball in of]),
        hinge=np.array([3 * ball.leg + ball.first for ball in of]),
        frame=np.array([robot.leg_frame[ball.leg] if ball.first == 0 else np.eye(3) for ball in of]),
        sign=np.array([robot.sign[ball.leg] if ball.last == 2 else 1.0 for ball in of]),
        guide=none,
        guide_damping=none,
        lower=robot.q_min.ravel().astype(float),
        upper=robot.q_max.ravel().astype(float),
        stop=hinges,
        stop_damping=hinges,
        viscous=robot.damping.ravel().astype(float),
        dry=robot.friction.ravel().astype(float),
        rotor=robot.armature.ravel().astype(float),
    )
    feet = Feet(
        link=np.array([ball.link for ball in of if ball.last == 2]),
        at=np.ascontiguousarray(robot.offset[:, 2], dtype=float),
        radius=robot.foot_radius.astype(float),
        stiffness=np.zeros(n),
        damping=np.zeros(n),
        friction=np.full(n, friction),
    )
    return System(links_of(robot), joints, feet, np.array([0.0, 0.0, -GRAVITY]))


# --- states --------------------------------------------------------------------------------------
def state_of(
    robot: Robot,
    system: System,
    position_w: Float[np.ndarray, "3"],
    rotation_wb: Float[np.ndarray, "3 3"],
    q: Float[np.ndarray, "legs 3"],
) -> Float[np.ndarray, "numbers"]:
    """The robot at rest in a pose."""
    y = np.zeros(rates_begin(system) + 3 + 3 * system.tree.mass.size)
    p = parts(system, y)
    p.x[:] = position_w
    p.quaternion[:] = [quaternion_of(R) for R in ball_rotations(robot, rotation_wb, q)]
    return y


def stance_pose(
    robot: Robot,
) -> tuple[Float[np.ndarray, "3"], Float[np.ndarray, "3 3"], Float[np.ndarray, "legs 3"]]:
    """Level, over the origin, the feet where they stand."""
    return np.array([0.0, 0.0, robot.height]), np.eye(3), angles(robot, robot.nominal_feet)[0]


def any_poses(robot: Robot, system: System) -> list[Float[np.ndarray, "numbers"]]:
    """The stance and other poses within the joint limits, the same ones every time."""
    position, level, stance = stance_pose(robot)
    random = np.random.default_rng(0)
    others = [random.uniform(robot.q_min, robot.q_max) for _ in range(POSES - 1)]
    return [state_of(robot, system, position, level, q) for q in (stance, *others)]


def row_name(robot: Robot, row: int) -> tuple[str, str, str]:
    """Leg, joint or foot, and spring of a row that `stiffness.mobility` counts."""
    of = balls(robot)
    if row >= 4 * len(of):
        return robot.legs[(row - 4 * len(of)) // 3], "foot", "the spring of its contact"
    ball = of[row // 4]
    spring_of = "its restorative spring" if row % 4 < 2 else "the spring at its limits"
    return robot.legs[ball.leg], ball.name, spring_of
