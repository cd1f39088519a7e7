"""The desired motion of a cycle is consistent in itself, periodic, reachable, and what the NC can realise."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gaitwright.control.inverse_dynamics import load_of, packed_load
from gaitwright.errors import WrongUse
from gaitwright.gait.command import path
from gaitwright.gait.desired_cycle import DesiredCycle, Manner, desired_cycle, stance_places
from gaitwright.gait.leg_cycles.files import load_cycle
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle, tabulated_legs
from gaitwright.gait.swing import AIM_BELOW, REACH_DOWN, swing_reference
from gaitwright.model.kinematics import feet
from gaitwright.numerics.geometry import GRAVITY, rotation_vector
from gaitwright.signals import Gait
from gaitwright.skills.library import find_skill, gait_of
from oracles import State, mujoco_inverse, robot_called

ROBOTS = ("go2", "thesis", "thesis-table", "hexapod")
STEPS = 1024


def cycle_of(
    name: str, skill: str, pace: float, lateral: float = 0.0, omega: float = 0.0, sways: bool = False
) -> DesiredCycle:
    """A skill on a robot; `pace`, `lateral`: shares of the skill's speed, `omega`: of its w0."""
    robot = robot_called(name)
    chosen = find_skill(skill, robot)
    v = chosen.speed * np.sqrt(robot.height / 0.29)
    velocity = (float(pace * v), float(lateral * v))
    turn = omega * robot.natural_frequency
    return desired_cycle(robot, gait_of(chosen, robot), velocity, turn, Manner(sways=sways), STEPS)


def rate(values: np.ndarray, period: float, order: int) -> np.ndarray:
    """Central difference over the inner samples."""
    dt = period / len(values)
    if order == 1:
        return (values[2:] - values[:-2]) / (2 * dt)
    return (values[2:] - 2 * values[1:-1] + values[:-2]) / dt**2


def inner(stance: np.ndarray) -> np.ndarray:
    """Samples, by leg, whose neighbours are in the same mode: the swing's ends have a jump in the jerk."""
    return (stance[2:] == stance[1:-1]) & (stance[:-2] == stance[1:-1])


MOTIONS = {
    "name": st.sampled_from(ROBOTS),
    "skill": st.sampled_from(["walk", "trot"]),
    "pace": st.floats(-0.6, 0.8),
    "lateral": st.floats(-0.4, 0.4),
    "omega": st.floats(-0.08, 0.08),
    "sways": st.booleans(),
}


@settings(max_examples=25)
@given(**MOTIONS)
def test_velocities_and_accelerations_are_the_rates_of_what_they_belong_to(
    name, skill, pace, lateral, omega, sways
):
    c = cycle_of(name, skill, pace, lateral, omega, sways)
    period, down = c.gait.period, inner(c.stance)
    w0 = c.robot.natural_frequency
    for x, v, a, unit in (
        (c.feet_w, c.feet_velocity_w, c.feet_acceleration_w, c.robot.height),
        (c.q, c.qd, c.qdd, 1.0),
    ):
        # As the feet themselves follow it, a leg cycle is interpolated linearly between its 128 bins.
        assert np.abs(rate(x, period, 1) - v[1:-1])[down].max() < 5e-2 * unit * w0
        assert np.abs(rate(v, period, 1) - a[1:-1])[down].max() < 1.0 * unit * w0**2
    unit = c.robot.height
    assert np.abs(rate(c.position_w, period, 1) - c.velocity_w[1:-1]).max() < 2e-3 * unit * w0
    # The periodic reference is interpolated linearly between its 256 bins.
    assert np.abs(rate(c.velocity_w, period, 1) - c.acceleration_w[1:-1]).max() < 2e-2 * unit * w0**2


@settings(max_examples=10)
@given(**MOTIONS)
def test_the_attitude_turns_as_its_angular_velocity_says(name, skill, pace, lateral, omega, sways):
    c = cycle_of(name, skill, pace, lateral, omega, sways)
    dt, w0 = c.gait.period / c.steps, c.robot.natural_frequency
    turned = np.array(
        [
            rotation_vector(np.ascontiguousarray(b @ a.T))
            for a, b in zip(c.rotation_wb, c.rotation_wb[2:], strict=False)
        ]
    )
    assert np.abs(turned / (2 * dt) - c.angular_velocity_w[1:-1]).max() < 2e-3 * w0
    spins = rate(c.angular_velocity_w, c.gait.period, 1)
    assert np.abs(spins - c.angular_acceleration_w[1:-1]).max() < 2e-2 * w0**2


@settings(max_examples=25)
@given(**MOTIONS)
def test_the_joints_put_the_feet_where_they_should_be(name, skill, pace, lateral, omega, sways):
    c = cycle_of(name, skill, pace, lateral, omega, sways)
    for i in range(0, c.steps, 97):
        at = c.position_w[i] + feet(c.robot, c.q[i]) @ c.rotation_wb[i].T
        assert np.abs(at - c.feet_w[i]).max() < 1e-12 * (1.0 + c.robot.leg_length)


@settings(max_examples=15)
@given(**MOTIONS)
def test_feet_that_are_down_stay_and_the_others_are_above_the_ground(
    name, skill, pace, lateral, omega, sways
):
    c = cycle_of(name, skill, pace, lateral, omega, sways)
    height = c.feet_w[..., 2] - c.robot.foot_radius
    assert not c.feet_velocity_w[c.stance].any() and not c.feet_acceleration_w[c.stance].any()
    assert not height[c.stance].any()
    assert (height[~c.stance] >= -1e-12).all()
    assert height.max() == pytest.approx(0.2 * c.robot.height, rel=1e-3)
    share = c.stance.mean(axis=0)
    assert np.abs(share - c.gait.duty).max() <= 1.5 / c.steps


@settings(max_examples=15)
@given(**MOTIONS)
def test_the_cycle_closes_one_stride_on(name, skill, pace, lateral, omega, sways):
    """What comes after the last sample, by its velocity, is the first one moved on and turned."""
    c = cycle_of(name, skill, pace, lateral, omega, sways)
    yaw = c.command[2] * c.gait.period
    turn = np.array([[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, 1.0]])
    dt = c.gait.period / c.steps
    for now, v in ((c.position_w, c.velocity_w), (c.feet_w, c.feet_velocity_w)):
        following = c.stride_w + now[0] @ turn.T
        middle = 0.5 * (v[-1] + v[0] @ turn.T)
        step = 1e-3 * c.robot.height
        assert np.abs(following - now[-1] - middle * dt).max() < step
    joints = c.q[0] - c.q[-1] - 0.5 * (c.qd[0] + c.qd[-1]) * dt
    assert np.abs(joints).max() < 1e-3


@given(st.floats(-2.0, 2.0), st.floats(-2.0, 2.0), st.floats(-3.0, 3.0), st.floats(-9.0, 9.0))
def test_the_path_is_the_arc_that_the_command_integrates_to(forward, left, turn, seconds):
    t = np.linspace(0.0, seconds, 20001)
    c, s = np.cos(turn * t), np.sin(turn * t)
    v = np.stack([c * forward - s * left, s * forward + c * left], axis=1)
    integral = ((v[1:] + v[:-1]) / 2).sum(axis=0) * (t[1] - t[0])
    place, yaw = path(np.array([forward, left, turn]), t[-1:])
    assert np.abs(place[0] - integral).max() < 1e-4
    assert yaw[0] == turn * t[-1]


# --- the swing -------------------------------------------------------------------------------------
LOW: LegCycle = LegCycle("low", ((0.0, -0.5, 0.0), (0.3, -0.3, 0.1), (0.7, 0.3, 0.1), (1.0, 0.5, 0.0)))
HIND = replace(LOW, name="uneven", hind=load_cycle("climb").points)


@pytest.mark.parametrize(("skill", "lift"), [("walk", 0.2), ("climb", 0.28), ("descend", 0.2), ("trot", 0.2)])
def test_a_foot_is_swung_as_high_as_the_leg_cycle_of_its_gait(skill: str, lift: float):
    c = cycle_of("go2", skill, 0.5)
    height = c.feet_w[..., 2] - c.robot.foot_radius
    assert height.max(axis=0) == pytest.approx(lift * c.robot.height, rel=1e-2)


@pytest.mark.parametrize("cycle", [LOW, HIND, load_cycle("climb")])
def test_the_swing_is_the_one_that_the_coordinator_asks_for(cycle: LegCycle):
    """Until it reaches down, and but for the aim, which it takes below the ground to be sure to meet it."""
    robot = robot_called("go2")
    gait = gait_of(find_skill("trot", robot), robot)
    c = desired_cycle(robot, gait, (0.4, 0.1), 0.3, Manner(cycle=cycle), 500)
    duration, tables = (1.0 - gait.duty) * gait.period, tabulated_legs(cycle, robot.n)
    for leg in range(robot.n):
        along = c.phase + gait.offsets[leg]
        share = (along % 1.0 - gait.duty) / (1.0 - gait.duty)
        for i in np.flatnonzero((share >= 0.0) & (share < REACH_DOWN)):
            before, after = (
                stance_places(robot, gait, c.command, np.full((1, 4), np.floor(along[i]) + k))[0, leg]
                for k in (0, 1)
            )
            after[2] += AIM_BELOW * robot.height
            p, v, a = np.empty((3, 3))
            swing_reference(before, *after, share[i], duration, robot.height, tables[leg], 1.0, p, v, a)
            np.testing.assert_allclose(c.feet_w[i, leg], p, atol=1e-12)
            np.testing.assert_allclose(c.feet_velocity_w[i, leg], v, atol=1e-11)
            np.testing.assert_allclose(c.feet_acceleration_w[i, leg], a, atol=1e-9)


# --- as the controllers read it --------------------------------------------------------------------
def test_the_demand_without_error_is_the_motion_itself(rng):
    """Free torques and wrench are those of the inverse dynamics of q, q̇, q̈: no feedback term is left."""
    for name in ROBOTS:
        c = cycle_of(name, "walk", 0.7, 0.1, 0.02, True)
        i = int(rng.integers(c.steps))
        sensed = c.sensed(i)
        R = c.rotation_wb[i]
        state = State(
            sensed.position_w, sensed.orientation_wb, sensed.velocity_w, sensed.angular_velocity_b,
            sensed.q, sensed.qd, c.acceleration_w[i], R.T @ c.angular_acceleration_w[i], c.qdd[i],
        )  # fmt: skip
        wrench, tau = mujoco_inverse(c.robot, state)
        load = load_of(packed_load(c.robot, c.target(i), sensed))
        weight = c.robot.total_mass * GRAVITY
        assert np.abs(R @ wrench[:3] - load.wrench[:3]).max() < 1e-9 * weight
        assert np.abs(R @ wrench[3:] - load.wrench[3:]).max() < 1e-9 * weight * c.robot.height
        assert np.abs(tau - load.free).max() < 1e-9 * weight * c.robot.height


# --- what cannot be --------------------------------------------------------------------------------
def test_a_foot_out_of_reach_is_named_with_phase_and_distance():
    robot = robot_called("thesis")
    with pytest.raises(
        WrongUse,
        match=r"thesis cannot walk 'walk' this way: at phase 0\.\d+, leg (FL|FR|RL|RR): "
        r"the foot is 7\.3\d* m from hip 2, the stretched leg is 5 m",
    ):
        desired_cycle(robot, Gait("walk", 18.0, 0.8, (0.75, 0.25, 0.0, 0.5)), (0.9, 0.0))


def test_a_joint_beyond_its_limit_is_told_with_the_phase():
    robot = robot_called("go2")
    tight = replace(robot, q_max=robot.q_max - [0.0, 0.0, 1.5])
    with pytest.raises(
        WrongUse,
        match=r"go2 cannot walk 'trot' this way: at phase \d\.\d+, leg (FL|FR|RL|RR): "
        r"knee would stand at -\d\.\d+ rad, beyond its limit of -2\.34 rad",
    ):
        desired_cycle(tight, Gait("trot", 0.5, 0.5, (0.0, 0.5, 0.5, 0.0)), (0.3, 0.0))


def test_a_gait_must_fit_the_robot_and_lift_its_feet():
    robot = robot_called("hexapod")
    with pytest.raises(WrongUse, match=r"gait 'walk' is for 4 legs; hexapod has 6: FL, FR, ML, MR, RL, RR"):
        desired_cycle(robot, Gait("walk", 1.0, 0.8, (0.75, 0.25, 0.0, 0.5)), (0.1, 0.0))
    stand = Gait("stand", 1.0, 1.0, (0.0,) * 6)
    with pytest.raises(WrongUse, match=r"gait 'stand' lifts no foot \(duty factor 1\): it cannot move"):
        desired_cycle(robot, stand, (0.1, 0.0))
    for period, duty, told in (
        (0.0, 0.8, "a period of 0 s; it must be above 0"),
        (np.nan, 0.8, "a period of nan s"),
        (1.0, 0.0, "a duty factor of 0; it must be above 0, at most 1"),
        (1.0, 1.5, r"a duty factor of 1\.5"),
    ):
        with pytest.raises(WrongUse, match=told):
            desired_cycle(robot, Gait("odd", float(period), duty, (0.0,) * 6), (0.0, 0.0))
    with pytest.raises(WrongUse, match="velocity nan, 0 m/s and yaw rate 0 rad/s: every number must be"):
        desired_cycle(robot, Gait("walk", 1.0, 0.8, (0.0,) * 6), (np.nan, 0.0))
    with pytest.raises(WrongUse, match="a lift of nan m was asked for"):
        desired_cycle(robot, stand, (0.0, 0.0), manner=Manner(lift=np.nan))
    with pytest.raises(WrongUse, match="a cycle of 0 samples is none"):
        desired_cycle(robot, stand, (0.0, 0.0), steps=0)
    still = desired_cycle(robot, stand, (0.0, 0.0), steps=4)
    assert still.stance.all() and not still.qd.any() and np.ptp(still.q, axis=0).max() == 0.0


def test_height_and_lift_are_as_asked():
    robot = robot_called("thesis")
    gait = Gait("walk", 18.0, 0.8, (0.75, 0.25, 0.0, 0.5))
    c = desired_cycle(robot, gait, (1 / 6, 0.0), manner=Manner(height=2.3, lift=0.5), steps=180)
    assert c.position_w[:, 2] - 0.05 == pytest.approx(2.3)
    assert c.feet_w[..., 2].max() - 0.05 == pytest.approx(0.5, rel=1e-2)
    assert c.stride_w == pytest.approx([3.0, 0.0, 0.0])


def test_a_lift_is_that_of_every_foot_and_a_cycle_that_lifts_none_cannot_have_one():
    robot = robot_called("go2")
    gait = gait_of(find_skill("trot", robot), robot)
    c = desired_cycle(robot, gait, (0.3, 0.0), manner=Manner(lift=0.04, cycle=HIND), steps=400)
    height = c.feet_w[..., 2] - robot.foot_radius
    assert height.max(axis=0) == pytest.approx(0.04, rel=1e-2)
    flat = LegCycle("flat", tuple((s, forward, 0.0) for s, forward, _ in LOW.points))
    with pytest.raises(WrongUse, match=r"leg cycle 'flat' lifts no foot: it cannot be swung 0\.04 m high"):
        desired_cycle(robot, gait, (0.3, 0.0), manner=Manner(lift=0.04, cycle=flat))
    assert not desired_cycle(robot, gait, (0.0, 0.0), manner=Manner(cycle=flat), steps=8).qd.any()
