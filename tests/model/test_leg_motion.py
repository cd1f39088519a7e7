"""Rates and accelerations of joints: there and back, by differences, by the thesis, by two other engines."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from gaitwright.errors import WrongUse
from gaitwright.model.kinematics import angles, feet
from gaitwright.model.leg import SINGULAR, least_volume
from gaitwright.model.leg_motion import (
    BaseMotion,
    acceleration_from_base,
    columns_of,
    feet_acceleration,
    feet_velocity,
    joint_accelerations,
    joint_rates,
    velocity_from_base,
)
from gaitwright.model.reach import KNEE_FOLDED, KNEE_STRAIGHT, UNDER_AXIS, poses
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import from_thesis, rotation
from gaitwright.numerics.matrices import rows
from oracles import any_state, bare_world, branches, mujoco_foot_accelerations, put, robot_called, unlike

fewer = settings(max_examples=50)
seeds = st.integers(0, 2**32 - 1)
builds = st.sampled_from(["dog", "insect"])
NAMES = pytest.mark.parametrize("name", ["go2", "thesis", "hexapod", "dog", "insect"])
CLEAR = 0.1
"""Sine of the knee, and share of the leg's length, by which drawn poses stay clear of singular ones."""


def clear(robot: Robot, q: np.ndarray) -> bool:
    """Whether no leg is near a singular pose."""
    for leg in range(robot.n):
        columns = columns_of(q[leg], rows(robot.offset[leg]), robot.sign[leg])
        if abs(np.linalg.det(columns)) < 3.0 * least_volume(*columns):
            return False
    stretched = np.hypot(robot.offset[:, 1:, 0], robot.offset[:, 1:, 2]).sum(axis=1)
    near = [
        p.knee_sine < CLEAR or p.axis_distance < CLEAR * s
        for p, s in zip(poses(robot, q), stretched, strict=True)
    ]
    return not any(near)


def drawn(name: str, seed: int) -> tuple[Robot, np.ndarray, np.ndarray, np.ndarray]:
    """A robot nobody has seen, in rapid motion: angles, rates and accelerations."""
    rng = np.random.default_rng(seed)
    robot = unlike(robot_called(name), rng)
    s = any_state(robot, rng)
    assume(clear(robot, s.q))
    return robot, s.q, s.qd, s.qdd


# --- there and back --------------------------------------------------------------------------------
@fewer
@given(builds, seeds)
@example("dog", 0)
def test_rates_and_accelerations_are_there_and_back(name: str, seed: int) -> None:
    robot, q, qd, qdd = drawn(name, seed)
    rates, regular = joint_rates(robot, q, feet_velocity(robot, q, qd))
    assert regular.all()
    np.testing.assert_allclose(rates, qd, rtol=0, atol=1e-12 * np.abs(qd).max())
    accelerations, regular = joint_accelerations(robot, q, qd, feet_acceleration(robot, q, qd, qdd))
    assert regular.all()
    scale = np.abs(qdd).max() + (np.abs(qd) ** 2).max()
    np.testing.assert_allclose(accelerations, qdd, rtol=0, atol=1e-12 * scale)


@fewer
@given(builds, seeds)
def test_in_every_branch_the_foot_is_moved_alike(name: str, seed: int) -> None:
    """Four postures, four sets of rates and accelerations, one motion of the foot."""
    robot, q, *_ = drawn(name, seed)
    rng = np.random.default_rng(seed)
    velocity, acceleration = rng.normal(size=(2, robot.n, 3))
    places = feet(robot, q)
    solutions = [branches(robot, leg, place) for leg, place in zip(robot.legs, places, strict=True)]
    checked = 0
    for branch in [(-1, -1), (-1, 1), (1, -1), (1, 1)]:
        posture = np.array([s.get(branch, q[i]) for i, s in enumerate(solutions)])
        np.testing.assert_allclose(feet(robot, posture), places, rtol=0, atol=1e-12)
        if not clear(robot, posture):
            continue
        checked += 1
        rates, _ = joint_rates(robot, posture, velocity)
        np.testing.assert_allclose(feet_velocity(robot, posture, rates), velocity, rtol=0, atol=1e-12)
        qdd, _ = joint_accelerations(robot, posture, rates, acceleration)
        back = feet_acceleration(robot, posture, rates, qdd)
        np.testing.assert_allclose(back, acceleration, rtol=0, atol=1e-12 * (1.0 + (rates**2).max()))
    assume(checked)


@fewer
@given(builds, seeds)
def test_velocity_and_acceleration_are_derivatives_of_the_path(name: str, seed: int) -> None:
    robot, q, qd, qdd = drawn(name, seed)
    step, scale = 1e-5, np.abs(qd).max() ** 2 + np.abs(qdd).max()

    def path(t: float) -> np.ndarray:
        return feet(robot, q + t * qd + 0.5 * t * t * qdd)

    def speed(t: float) -> np.ndarray:
        return feet_velocity(robot, q + t * qd + 0.5 * t * t * qdd, qd + t * qdd)

    by_steps = (path(step) - path(-step)) / (2 * step)
    np.testing.assert_allclose(by_steps, feet_velocity(robot, q, qd), atol=1e-8 * scale * np.sqrt(scale))
    by_steps = (speed(step) - speed(-step)) / (2 * step)
    np.testing.assert_allclose(by_steps, feet_acceleration(robot, q, qd, qdd), atol=1e-8 * scale**2)


# --- the thesis's own formulas, in its own axes ------------------------------------------------------
def thesis_leg(l1: float, l2: float) -> Robot:
    """The insect with legs as in the thesis: yaw about its z, then two turns about its y (z points down)."""
    robot = robot_called("insect")
    x, y, z = from_thesis(np.eye(3))
    frame = np.column_stack([z, y, -x])
    offset = np.zeros((4, 3, 3))
    offset[:, 1, 2], offset[:, 2, 0] = -l1, l2
    return replace(robot, leg_frame=np.tile(frame, (4, 1, 1)), offset=offset, sign=np.ones(4))


def thesis_place(l1, l2, q) -> np.ndarray:
    """Foot from the hip, thesis axes (eq. 3-8, corrected)."""
    ps, th, tk = q.T
    R = l1 * np.cos(th) + l2 * np.sin(th + tk)
    return np.column_stack([R * np.cos(ps), R * np.sin(ps), -l1 * np.sin(th) + l2 * np.cos(th + tk)])


def thesis_rates(l1, l2, q, v) -> np.ndarray:
    """Joint rates from the foot's velocity, thesis axes (eq. 3-15 … 3-18, corrected)."""
    ps, th, tk = q.T
    X, Y, Z = thesis_place(l1, l2, q).T
    R = np.cos(ps) * X + np.sin(ps) * Y
    Rd = np.cos(ps) * v[:, 0] + np.sin(ps) * v[:, 1]
    psd = (-np.sin(ps) * v[:, 0] + np.cos(ps) * v[:, 1]) / R
    thd = -(np.sin(th + tk) * Rd + np.cos(th + tk) * v[:, 2]) / (l1 * np.cos(tk))
    return np.column_stack([psd, thd, (R * Rd + Z * v[:, 2]) / (l1 * l2 * np.cos(tk))])


def thesis_accelerations(l1, l2, q, v, a) -> np.ndarray:
    """Joint accelerations from the foot's velocity and acceleration, thesis axes (equations.md §1)."""
    ps, th, tk = q.T
    psd, thd, tkd = thesis_rates(l1, l2, q, v).T
    X, Y, Z = thesis_place(l1, l2, q).T
    R, Rd = np.cos(ps) * X + np.sin(ps) * Y, np.cos(ps) * v[:, 0] + np.sin(ps) * v[:, 1]
    Zd, Za = v[:, 2], a[:, 2]
    s12, c12 = np.sin(th + tk), np.cos(th + tk)
    Ra = np.cos(ps) * a[:, 0] + np.sin(ps) * a[:, 1] + R * psd**2
    psdd = (-np.sin(ps) * a[:, 0] + np.cos(ps) * a[:, 1] - 2 * Rd * psd) / R
    turning = (c12 * Rd - s12 * Zd) * (thd + tkd) - l1 * np.sin(tk) * tkd * thd
    thdd = -(s12 * Ra + c12 * Za + turning) / (l1 * np.cos(tk))
    tkdd = (Rd**2 + R * Ra + Zd**2 + Z * Za + l1 * l2 * np.sin(tk) * tkd**2) / (l1 * l2 * np.cos(tk))
    return np.column_stack([psdd, thdd, tkdd])


@given(st.floats(0.5, 3.0), st.floats(0.5, 3.0), seeds)
@example(2.0, 3.0, 1)
def test_the_thesis_says_the_same_of_the_yaw_leg(l1: float, l2: float, seed: int) -> None:
    robot, rng = thesis_leg(l1, l2), np.random.default_rng(seed)
    q = rng.uniform(-np.pi, np.pi, (4, 3))
    assume(clear(robot, q))
    np.testing.assert_allclose(
        from_thesis(feet(robot, q) - robot.hip), thesis_place(l1, l2, q), rtol=0, atol=1e-12
    )
    v, a = rng.normal(size=(2, 4, 3))
    ours, _ = joint_rates(robot, q, from_thesis(v))
    np.testing.assert_allclose(ours, thesis_rates(l1, l2, q, v), rtol=1e-12, atol=1e-11)
    ours, _ = joint_accelerations(robot, q, ours, from_thesis(a))
    scale = 1.0 + np.abs(ours).max()
    np.testing.assert_allclose(ours, thesis_accelerations(l1, l2, q, v, a), rtol=0, atol=1e-11 * scale)


# --- over a base that moves --------------------------------------------------------------------------
def base_of(s) -> BaseMotion:
    """The motion of the base in a drawn state."""
    return BaseMotion(
        rotation(s.orientation_wb),
        s.velocity_w,
        s.angular_velocity_b,
        s.acceleration_w,
        s.angular_acceleration_b,
    )


def standing(robot: Robot, q: np.ndarray, base: BaseMotion) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Joint rates and accelerations with which feet stay while the base moves, and the flags."""
    places = feet(robot, q)
    still = np.zeros_like(places)
    relative = velocity_from_base(base, places, still)
    qd, regular = joint_rates(robot, q, relative)
    qdd, also = joint_accelerations(robot, q, qd, acceleration_from_base(base, places, relative, still))
    return qd, qdd, regular & also


@NAMES
def test_feet_stand_still_in_mujoco_when_the_joints_move_so(name: str, rng: np.random.Generator) -> None:
    """Whatever base and robot do, MuJoCo sees the feet at rest: no velocity and no acceleration."""
    robot = robot_called(name)
    for one in [robot, *(unlike(robot, rng) for _ in range(3))]:
        s = any_state(one, rng)
        while not clear(one, s.q):
            s = any_state(one, rng)
        base = base_of(s)
        qd, qdd, regular = standing(one, s.q, base)
        assert regular.all()
        model, data = bare_world(one)
        put(data, s.position_w, s.orientation_wb, s.velocity_w, s.angular_velocity_b, s.q, qd)
        mujoco.mj_forward(model, data)
        data.qacc[:] = np.concatenate([s.acceleration_w, s.angular_acceleration_b, qdd.ravel()])
        six = np.empty(6)
        for leg in range(one.n):
            mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_SITE, leg, six, 0)
            np.testing.assert_allclose(six[3:], 0.0, atol=1e-11 * (1.0 + np.abs(qd).max()))
        scale = 1.0 + np.abs(qdd).max() + (qd**2).max()
        np.testing.assert_allclose(mujoco_foot_accelerations(one, model, data), 0.0, atol=1e-11 * scale)


@given(seeds)
def test_motion_seen_from_the_base_is_the_derivative_of_the_place_seen_from_it(seed: int) -> None:
    """A point on a parabola, a base on a parabola that turns faster and faster about one axis."""
    rng = np.random.default_rng(seed)
    (p0, pv, pa), (b0, bv, ba), axis = rng.normal(size=(3, 3)), rng.normal(size=(3, 3)), rng.normal(size=3)
    axis /= np.linalg.norm(axis)
    rate, faster = rng.normal(size=2)

    def turned(t: float) -> np.ndarray:
        half = 0.5 * (rate * t + 0.5 * faster * t * t)
        return rotation(np.array([np.cos(half), *(np.sin(half) * axis)]))

    def place(t: float) -> np.ndarray:
        return (p0 + pv * t + 0.5 * pa * t * t - b0 - bv * t - 0.5 * ba * t * t) @ turned(t)

    t, h = 0.3, 1e-4
    base = BaseMotion(turned(t), bv + ba * t, (rate + faster * t) * axis, ba, faster * axis)
    here = place(t)[None]
    velocity = velocity_from_base(base, here, (pv + pa * t)[None])
    acceleration = acceleration_from_base(base, here, velocity, pa[None])
    np.testing.assert_allclose(velocity[0], (place(t + h) - place(t - h)) / (2 * h), atol=1e-5)
    by_steps = (place(t + h) - 2 * place(t) + place(t - h)) / h**2
    np.testing.assert_allclose(acceleration[0], by_steps, atol=1e-4)


# --- singular poses ----------------------------------------------------------------------------------
SINGULAR_POSES = {
    KNEE_STRAIGHT: (0.25, 0.2, np.array([0.2, 0.3, 0.0])),
    KNEE_FOLDED: (0.25, 0.2, np.array([0.2, 0.3, np.pi])),
    UNDER_AXIS: (0.2, 0.2, np.array([0.2, np.pi / 2 - 0.4, 0.8])),
}
"""Lengths of thigh and shank, and a pose that is singular for them."""


def leg_like(l1: float, l2: float) -> Robot:
    """The dog with these lengths of thigh and shank, straight below each other at zero angles."""
    robot = robot_called("dog")
    offset = robot.offset.copy()
    offset[:, 1:] = [(0.0, 0.0, -l1), (0.0, 0.0, -l2)]
    return replace(robot, offset=offset)


@pytest.mark.parametrize("which", SINGULAR_POSES)
def test_near_singular_poses_answers_are_bounded_and_flagged(which: int, rng) -> None:
    """The pose says which it is, the flag says that the rates are not exact, and no rate runs away."""
    long, short, pose = SINGULAR_POSES[which]
    robot = leg_like(long, short)
    for off in (0.0, 1e-12, -1e-6, 1e-3):
        q = np.tile(pose + np.array([0.0, off, -off]), (4, 1))
        assert all(pose.singular == (which,) for pose in poses(robot, q))
        v = rng.normal(size=(4, 3))
        rates, regular = joint_rates(robot, q, v)
        assert not regular.any()
        speed = np.linalg.norm(v, axis=1)
        assert (np.abs(rates) <= speed[:, None] / (SINGULAR * short) * (1.0 + 1e-9)).all()


def test_a_foot_on_the_axis_of_a_yaw_leg_is_singular_and_its_rates_are_bounded(rng) -> None:
    """There the first column of the Jacobian is nothing at all: the length of the leg is the measure."""
    robot = thesis_leg(0.25, 0.2)
    # R = l1 cos θ + l2 sin(θ + θk) = 0: tan θ = −(l1 + l2 sin θk) / (l2 cos θk)
    elevation = np.arctan2(-(0.25 + 0.2 * np.sin(0.5)), 0.2 * np.cos(0.5))
    q = np.tile([0.3, elevation, 0.5], (4, 1))
    assert np.abs(thesis_place(0.25, 0.2, q)[:, :2]).max() < 1e-12
    v = rng.normal(size=(4, 3))
    rates, regular = joint_rates(robot, q, v)
    assert not regular.any() and all(p.singular == (UNDER_AXIS,) for p in poses(robot, q))
    assert (np.abs(rates) <= np.linalg.norm(v, axis=1)[:, None] / (SINGULAR * 0.2)).all()


@fewer
@given(builds, seeds)
def test_the_flag_and_the_pose_agree(name: str, seed: int) -> None:
    """Exactly where no singular pose is named the answer is exact."""
    rng = np.random.default_rng(seed)
    robot = unlike(robot_called(name), rng)
    q = rng.uniform(-np.pi, np.pi, (robot.n, 3))
    thigh, shank = np.arctan2(robot.offset[:, 1:, 0], robot.offset[:, 1:, 2]).T
    straight = robot.sign * (thigh - shank)
    q[:2, 2] = (straight + 10.0 ** rng.uniform(-6.0, 0.0, robot.n))[:2]
    v = rng.normal(size=(robot.n, 3))
    rates, regular = joint_rates(robot, q, v)
    assert regular.tolist() == [not pose.singular for pose in poses(robot, q)]
    back = feet_velocity(robot, q, rates)
    np.testing.assert_allclose(back[regular], v[regular], rtol=0, atol=1e-12 * (1.0 + np.abs(rates).max()))


# --- wrong use ---------------------------------------------------------------------------------------
def test_numbers_that_are_none_are_told_by_leg_and_joint() -> None:
    robot = robot_called("dog")
    q, _ = angles(robot, robot.nominal_feet)
    q[2, 1] = np.nan
    with pytest.raises(WrongUse, match="leg RL: the angle of hip 2 is nan"):
        joint_rates(robot, q, np.zeros((4, 3)))
    q[2, 1] = 0.0
    v = np.zeros((4, 3))
    v[3, 2] = np.inf
    with pytest.raises(WrongUse, match="leg RR: the foot's velocity z is inf"):
        joint_rates(robot, q, v)
    with pytest.raises(WrongUse, match=r"dog has 4 legs \(FL, FR, RL, RR\), expected \(4, 3\)"):
        feet(robot, q[:3])
