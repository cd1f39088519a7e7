"""Armstrong's recursion obeys Newton: two engines, the closed form and the laws of momentum agree."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from ball_trees import (
    Motion,
    any_motion,
    any_tree,
    joint_wrenches,
    mujoco_accelerations,
    pinocchio_accelerations,
)
from gaitwright.dynamics.armstrong import (
    accelerations,
    fast_accelerations,
    packed_accelerations,
    slow_coefficients,
)
from gaitwright.dynamics.newton_euler import inverse_dynamics, links_motion
from gaitwright.dynamics.tree import (
    Tree,
    ball_rotations,
    ball_tree,
    checked_tree,
    packed,
    unpacked_tree,
)
from gaitwright.dynamics.tree_laws import (
    closed_form_accelerations,
    energy,
    hinge_motions,
    momentum,
)
from gaitwright.errors import WrongUse
from gaitwright.model.kinematics import feet
from gaitwright.model.leg import leg_at, leg_turns
from gaitwright.model.robot import Robot
from oracles import NEEDS_PINOCCHIO, any_state, robot_called

SEEDS = st.integers(0, 2**32 - 1)
WEIGHT = np.array([0.0, 0.0, -9.81])


def drawn(seed: int) -> tuple[Tree, Motion]:
    """Any tree in any motion."""
    rng = np.random.default_rng(seed)
    tree = any_tree(rng)
    return tree, any_motion(tree, rng)


def assert_same(mine, theirs, tolerance: float = 1e-10) -> None:
    """Equal to `tolerance` of the largest number."""
    np.testing.assert_allclose(mine, theirs, rtol=0, atol=tolerance * np.abs(theirs).max())


# --- other ways to the same accelerations --------------------------------------------------------
@NEEDS_PINOCCHIO
@settings(max_examples=200)
@given(SEEDS)
def test_accelerations_are_those_of_pinocchio(seed: int) -> None:
    tree, s = drawn(seed)
    assert_same(accelerations(tree, *s.arguments), pinocchio_accelerations(tree, s))


@settings(max_examples=200)
@given(SEEDS)
def test_accelerations_are_those_of_mujoco(seed: int) -> None:
    tree, s = drawn(seed)
    assert_same(accelerations(tree, *s.arguments), mujoco_accelerations(tree, s))


@given(SEEDS)
def test_accelerations_solve_the_closed_form(seed: int) -> None:
    tree, s = drawn(seed)
    assert_same(accelerations(tree, *s.arguments), closed_form_accelerations(tree, *s.arguments))


@given(SEEDS)
def test_inverse_dynamics_gives_the_torques_back_and_nothing_holds_the_root(seed: int) -> None:
    tree, s = drawn(seed)
    a0, *wd = accelerations(tree, *s.arguments)
    found = joint_wrenches(tree, s.R, s.w, a0, np.array(wd), s.force, s.moment, s.gravity)
    nothing = 1e-10 * max(np.abs(found).max(), np.abs(s.force).max())
    np.testing.assert_allclose(found[0], 0.0, atol=nothing)
    np.testing.assert_allclose(found[1:, 3:], s.torque[1:], rtol=0, atol=nothing)


@given(SEEDS)
def test_a_torque_on_the_root_counts_for_nothing(seed: int) -> None:
    tree, s = drawn(seed)
    torque = s.torque.copy()
    torque[0] = 7.0
    other = replace(s, torque=torque)
    assert (accelerations(tree, *other.arguments) == accelerations(tree, *s.arguments)).all()
    assert (
        closed_form_accelerations(tree, *other.arguments) == closed_form_accelerations(tree, *s.arguments)
    ).all()


# --- slow and fast, packed and not ---------------------------------------------------------------
@given(SEEDS)
def test_what_a_hinge_pulls_is_a_negative_definite_mass(seed: int) -> None:
    tree, s = drawn(seed)
    slow = slow_coefficients(tree, s.R)
    for M, A_inverse in zip(slow.M, slow.A_inverse, strict=True):
        assert_same(M, M.T, 1e-13)
        assert np.linalg.eigvalsh(M).max() < 0.0
        assert np.linalg.eigvalsh(A_inverse).min() > 0.0


@given(SEEDS)
def test_old_orientations_cost_an_error_that_shrinks_with_their_age(seed: int) -> None:
    tree, s = drawn(seed)
    exact = accelerations(tree, *s.arguments)

    def error(age: float) -> np.ndarray:
        old = s.R @ Rotation.from_rotvec(-age * s.w).as_matrix()
        return fast_accelerations(tree, slow_coefficients(tree, old), *s.arguments) - exact

    assert (error(0.0) == 0.0).all()
    assert_same(error(1e-5), 2.0 * error(5e-6), 1e-2)


@given(SEEDS)
def test_packed_arrays_give_the_same_bits(seed: int) -> None:
    tree, s = drawn(seed)
    numbers = packed(tree)
    for mine, field in zip(unpacked_tree(numbers), tree, strict=True):
        assert (mine == field).all()
        assert mine.dtype == field.dtype
    motion = np.concatenate([s.R.ravel(), s.w.ravel()])
    load = np.concatenate([s.torque.ravel(), s.force.ravel(), s.moment.ravel(), s.gravity])
    assert (packed_accelerations(numbers, motion, load) == accelerations(tree, *s.arguments)).all()


# --- laws ----------------------------------------------------------------------------------------
def later(s: Motion, acceleration: np.ndarray, t: float) -> tuple[np.ndarray, ...]:
    """R, x, v, w after a short time: what `momentum` and `energy` read."""
    a, wd = acceleration[0], acceleration[1:]
    R = s.R @ Rotation.from_rotvec(t * s.w + 0.5 * t * t * wd).as_matrix()
    return R, s.x + t * s.v + 0.5 * t * t * a, s.v + t * a, s.w + t * wd


def rate(quantity, step: float = 1e-5) -> np.ndarray:
    """Derivative of a function of time at 0."""
    return (np.array(quantity(step)) - np.array(quantity(-step))) / (2.0 * step)


@given(SEEDS)
def test_momentum_changes_by_what_acts_from_outside(seed: int) -> None:
    tree, s = drawn(seed)
    acceleration = accelerations(tree, *s.arguments)
    linear, angular = rate(lambda t: momentum(tree, *later(s, acceleration, t)))
    hinges, _ = hinge_motions(tree, s.R, s.x, s.v, s.w)
    weights = tree.mass[:, None] * s.gravity
    centres = hinges + np.einsum("kij,kj->ki", s.R, tree.com)
    moment = np.cross(hinges, s.force) + s.moment + np.cross(centres, weights)
    assert_same(linear, (s.force + weights).sum(axis=0), 1e-5)
    assert_same(angular, moment.sum(axis=0), 1e-5)


@given(SEEDS)
def test_energy_changes_by_the_power_of_torques_and_of_what_acts_from_outside(seed: int) -> None:
    tree, s = drawn(seed)
    acceleration = accelerations(tree, *s.arguments)
    found = rate(lambda t: sum(energy(tree, *later(s, acceleration, t), s.gravity)))
    _, velocities = hinge_motions(tree, s.R, s.x, s.v, s.w)
    spin = np.einsum("kij,kj->ki", s.R, s.w)
    torque = np.einsum("kij,kj->ki", s.R, s.torque)[1:]
    terms = [s.force * velocities, s.moment * spin, torque * (spin[1:] - spin[tree.parent[1:]])]
    assert found == pytest.approx(
        sum(term.sum() for term in terms), abs=1e-5 * sum(np.abs(term).sum() for term in terms)
    )


# --- a robot with ball joints --------------------------------------------------------------------
def test_the_thesis_robot_has_nine_links() -> None:
    robot = robot_called("thesis")
    tree, names = ball_tree(robot)
    assert names == ("base", *(f"{leg} {link}" for leg in robot.legs for link in ("thigh", "shank")))
    assert tree.parent.tolist() == [-1, 0, 1, 0, 3, 0, 5, 0, 7]
    assert tree.mass.sum() == pytest.approx(robot.total_mass)


@pytest.mark.parametrize("name", ["thesis", "go2", "hexapod", "insect"])
def test_its_feet_are_where_the_hinges_put_them(name: str, rng: np.random.Generator) -> None:
    robot = robot_called(name)
    tree, names = ball_tree(robot)
    s = any_state(robot, rng)
    R = ball_rotations(robot, np.eye(3), s.q)
    hinges, _ = hinge_motions(tree, R, np.zeros(3), np.zeros(3), np.zeros_like(tree.com))
    shanks = [k for k, link in enumerate(names) if link.endswith("shank")]
    found = [hinges[k] + R[k] @ robot.offset[leg, 2] for leg, k in enumerate(shanks)]
    np.testing.assert_allclose(found, feet(robot, s.q), atol=1e-12)


@pytest.mark.parametrize("name", ["thesis", "go2", "hexapod", "insect"])
def test_moved_like_a_hinge_robot_its_joints_carry_the_motors_torques(
    name: str, rng: np.random.Generator
) -> None:
    robot = replace(robot_called(name), armature=np.zeros((robot_called(name).n, 3)))
    tree, _ = ball_tree(robot)
    s = any_state(robot, rng)
    w, wd, a = (tuple(x) for x in (s.angular_velocity_b, s.angular_acceleration_b, s.acceleration_w))
    weightless = np.zeros((3, tree.mass.size, 3))
    R = ball_rotations(robot, np.eye(3), s.q)
    rates = np.array([(w, wd), *hinge_rates(robot, s, w, wd, a)])
    found = joint_wrenches(tree, R, rates[:, 0], np.array(a), rates[:, 1], *weightless[:2], np.zeros(3))
    force, moment, tau = inverse_dynamics(robot.arrays, w, wd, a, s.q, s.qd, s.qdd)
    assert_same(found[0], np.array([*force, *moment]))
    links = (tree.mass.size - 1) // robot.n
    torque = np.einsum("kij,kj->ki", R, found[:, 3:])[1:].reshape(robot.n, links, 3)
    assert_same(motor_torques(robot, s.q, torque), tau)


def hinge_rates(robot: Robot, s, w, wd, a) -> list:
    """Angular velocity and acceleration of every link with mass, link axes, as the hinges move them."""
    out = []
    for k in range(robot.n):
        leg, q = leg_at(robot.packed, k), tuple(s.q[k])
        links = links_motion(leg, leg_turns(q, leg.sign), w, wd, a, tuple(s.qd[k]), tuple(s.qdd[k]))
        out += [link[:2] for link, m in zip(links, robot.mass[k], strict=True) if m > 0.0]
    return out


def motor_torques(robot: Robot, q: np.ndarray, torque: np.ndarray) -> np.ndarray:
    """Parts along the three hinge axes of the first, second and last joint's torques, base axes."""
    out = np.empty((robot.n, 3))
    for k in range(robot.n):
        hip = robot.leg_frame[k] @ Rotation.from_euler("x", q[k, 0]).as_matrix()
        axes = [hip[:, 0], hip[:, 1], robot.sign[k] * hip[:, 1]]
        out[k] = [axes[0] @ torque[k, 0], axes[1] @ torque[k, -2], axes[2] @ torque[k, -1]]
    return out


def test_a_first_link_with_length_needs_mass() -> None:
    robot = robot_called("thesis")
    offset = robot.offset.copy()
    offset[2, 0] = [0.0, 0.3, 0.4]
    with pytest.raises(WrongUse, match=r"leg RL of thesis has no mass and a length of 0\.5 m"):
        ball_tree(replace(robot, offset=offset))


# --- trees that cannot be ------------------------------------------------------------------------
def sound() -> Tree:
    """Two unit balls on a stick."""
    return Tree(
        np.array([-1, 0]),
        np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]),
        np.array([1.0, 2.0]),
        np.zeros((2, 3)),
        np.tile(np.eye(3), (2, 1, 1)),
    )


def changed(field: str, value) -> Tree:
    """`sound` with other numbers for link 1."""
    array = getattr(sound(), field).copy()
    array[1] = value
    return sound()._replace(**{field: array})


@pytest.mark.parametrize(
    ("tree", "sentence"),
    [
        (changed("mass", 0.0), "shank has a mass of 0 kg"),
        (changed("mass", -1.0), "shank has a mass of -1 kg"),
        (changed("mass", np.nan), "mass of shank is nan"),
        (changed("hinge", np.inf), r"hinge of shank is \[inf, inf, inf\]"),
        (changed("parent", 1), r"shank is link 1 and has link 1 as its parent"),
        (changed("parent", -1), r"shank is link 1 and has link -1 as its parent"),
        (changed("inertia", np.diag([1.0, 1.0, 0.0])), "shank about its hinge is not positive .*0, 1, 1"),
        (changed("inertia", np.diag([1.0, 1.0, 2.5])), "shank is that of no body.*1, 1, 2.5"),
        (changed("com", 1.0), "shank is that of no body.*-5, -5, 1"),
        (changed("inertia", np.eye(3) + np.triu(np.ones((3, 3)), 1)), "shank is not symmetric"),
        (sound()._replace(hinge=np.ones((2, 3))), "base is the root"),
        (sound()._replace(parent=np.array([0, 0])), "base is the root: its parent must be -1, not 0"),
        (sound()._replace(com=np.zeros((3, 3))), r"com of a tree of 2 links .* \(3, 3\), not \(2, 3\)"),
        (sound()._replace(parent=np.array([-1])), "a tree of 1 links with 2 names"),
    ],
)  # fmt: skip
def test_what_cannot_move_is_told_by_name_and_number(tree: Tree, sentence: str) -> None:
    with pytest.raises(WrongUse, match=sentence):
        checked_tree(tree, ("base", "shank"))


def test_a_sound_tree_passes_and_weighs_what_it_did() -> None:
    tree = checked_tree(sound())
    still = np.zeros((2, 3))
    found = accelerations(tree, np.tile(np.eye(3), (2, 1, 1)), still, still, still, still, WEIGHT)
    np.testing.assert_allclose(found, [WEIGHT, *still], atol=1e-14)
