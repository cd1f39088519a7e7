"""Leg cycles: curves through points that never overshoot, at rest at both ends, and what robots can walk."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.interpolate import BPoly, PchipInterpolator, make_interp_spline

from gaitwright.errors import WrongUse
from gaitwright.gait.desired_cycle import Manner, desired_cycle
from gaitwright.gait.leg_cycles.check import JOINT_SPEED, LEAST_CLEARANCE, check_cycle, swing_of
from gaitwright.gait.leg_cycles.files import cycle_of, load_cycle
from gaitwright.gait.leg_cycles.leg_cycle import (
    NEAREST,
    LegCycle,
    Point,
    is_hind,
    sampled,
    seen_from_hip,
    tabulated,
    tabulated_legs,
)
from gaitwright.model.kinematics import feet
from gaitwright.model.robot import Robot
from gaitwright.numerics.shape_preserving import curve, limited, monotone, shape_preserving, spline
from gaitwright.skills.library import find_skill, gait_of, speed_scale
from oracles import robot_called
from robots_by_hand import dog

FINE = np.linspace(0.0, 1.0, 801)
CLEARANCE = 0.2
"""Height of the common swing, in body heights."""
SMOOTH = np.polynomial.Polynomial([0, 0, 0, 10, -15, 6])
"""10s³ − 15s⁴ + 6s⁵: from rest to rest."""
BUMP = np.polynomial.Polynomial([0, 0, 0, 64, -192, 192, -64])
"""64 s³(1 − s)³: one at mid-swing."""


def with_derivatives(polynomial: np.polynomial.Polynomial) -> np.ndarray:
    """Value, first and second derivative at `FINE`."""
    return np.stack([polynomial(FINE), polynomial.deriv(1)(FINE), polynomial.deriv(2)(FINE)], axis=1)


@st.composite
def shares(draw: st.DrawFn, most: int = 10) -> np.ndarray:
    """Ascending shares from 0 to 1, at least as far apart as points of a cycle are."""
    widths = np.array(draw(st.lists(st.floats(0.15, 1.0), min_size=3, max_size=most)))
    s = np.concatenate([[0.0], np.cumsum(widths) / widths.sum()])
    s[-1] = 1.0
    return s


@st.composite
def some_points(draw: st.DrawFn) -> tuple[np.ndarray, np.ndarray]:
    """Shares and values, some of them equal."""
    s = draw(shares())
    value = st.one_of(st.floats(0.0, 1.0).map(lambda x: round(x, 9)), st.sampled_from([0.0, 0.25, 1.0]))
    return s, np.array(draw(st.lists(value, min_size=len(s), max_size=len(s))))


@st.composite
def transfer_parts(draw: st.DrawFn) -> tuple[Point, ...]:
    """Points of a transfer part: forward ascends, heights as they come."""
    s = draw(shares())
    n = len(s) - 2
    forward = sorted(draw(st.lists(st.floats(-0.5, 0.5), min_size=n, max_size=n)))
    height = draw(st.lists(st.floats(0.0, 0.5), min_size=n, max_size=n))
    inner = zip(s[1:-1].tolist(), forward, height, strict=True)
    return ((0.0, -0.5, 0.0), *inner, (1.0, 0.5, 0.0))


def bounds(s: np.ndarray, y: np.ndarray, at: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Lower and higher one of the points beside each of `at`, and which way they go."""
    i = np.clip(np.searchsorted(s, at, side="right") - 1, 0, len(s) - 2)
    return np.minimum(y[i], y[i + 1]), np.maximum(y[i], y[i + 1]), np.sign(y[i + 1] - y[i])


# --- the curve -------------------------------------------------------------------------------------
@given(some_points())
def test_a_curve_passes_its_points_and_stays_between_them(points) -> None:
    s, y = points
    np.testing.assert_allclose(curve(s, y, s)[:, 0], y, atol=1e-12)
    value, slope, _ = curve(s, y, FINE).T
    low, high, way = bounds(s, y, FINE)
    assert (value >= low - 1e-9).all() and (value <= high + 1e-9).all()
    assert (way * slope >= -1e-7 * max(1.0, np.abs(slope).max())).all()


@given(some_points())
def test_a_curve_begins_and_ends_at_rest_and_has_two_derivatives_everywhere(points) -> None:
    s, y = points
    np.testing.assert_array_equal(curve(s, y, np.array([0.0]))[0, 1:], 0.0)
    np.testing.assert_allclose(curve(s, y, np.array([1.0]))[0, 1:], 0.0, atol=1e-9 / np.diff(s).min() ** 2)
    before, after = curve(s, y, s[1:-1] - 1e-9), curve(s, y, s[1:-1])
    jump = np.abs(after - before).max(axis=0)
    rate = 1.0 / np.diff(s).min()
    assert jump[0] < 1e-6 * rate and jump[1] < 1e-5 * rate / np.diff(s).min()
    assert jump[2] < 1e-4 * rate / np.diff(s).min() ** 2


@given(some_points(), st.floats(0.02, 0.98))
def test_a_curve_carries_its_own_derivatives(points, at: float) -> None:
    s, y = points
    step = 1e-4 * np.diff(s).min()
    before, here, after = curve(s, y, np.array([at - step, at, at + step]))
    scale = 1.0 / np.diff(s).min()
    assert abs((after[0] - before[0]) / (2 * step) - here[1]) < 1e-4 * scale
    assert abs((after[1] - before[1]) / (2 * step) - here[2]) < 1e-2 * scale**2


@given(some_points())
def test_the_parts_are_those_of_scipy_for_the_same_slopes_and_curvatures(points) -> None:
    s, y = points
    slope, curvature = shape_preserving(s, y)
    oracle = BPoly.from_derivatives(s, np.stack([y, slope, curvature], axis=1))
    scale = 1.0 / np.diff(s).min()
    ours = curve(s, y, FINE)
    for order in range(3):
        np.testing.assert_allclose(ours[:, order], oracle(FINE, order), atol=1e-9 * scale**order)


@given(shares(), st.lists(st.floats(0.3, 1.0), min_size=10, max_size=10))
def test_between_turning_points_the_spline_is_that_of_scipy(s: np.ndarray, steps: list[float]) -> None:
    y = np.concatenate([[0.0], np.cumsum(steps[: len(s) - 1])])
    rest = [(1, 0.0), (2, 0.0)]
    oracle = make_interp_spline(s, y, k=5, bc_type=(rest, rest))
    slope, curvature = spline(s, y)
    scale = y[-1] / np.diff(s).min()
    np.testing.assert_allclose(slope, oracle(s, 1), atol=1e-7 * scale)
    np.testing.assert_allclose(curvature, oracle(s, 2), atol=1e-6 * scale / np.diff(s).min())
    if monotone(s, y, slope, curvature).all():
        np.testing.assert_array_equal(shape_preserving(s, y), (slope, curvature))


@given(some_points(), st.integers(0, 2**32 - 1))
def test_limited_slopes_and_curvatures_are_always_monotone_and_level_where_pchip_is(points, seed) -> None:
    s, y = points
    wild = np.random.default_rng(seed).normal(0.0, 50.0, (2, len(s)))
    slope, curvature = limited(s, y, *wild)
    assert monotone(s, y, slope, curvature).all()
    level = PchipInterpolator(s, y)(s, 1)[1:-1] == 0.0
    assert (slope[1:-1][level] == 0.0).all()


def test_two_points_give_the_polynomial_of_rest_to_rest() -> None:
    ends = np.array([0.0, 1.0])
    np.testing.assert_allclose(curve(ends, ends, FINE), with_derivatives(SMOOTH), atol=1e-12)


def test_a_steep_step_is_limited_and_stays_smooth() -> None:
    s, y = np.array([0.0, 0.4, 0.45, 0.5, 1.0]), np.array([0.0, 0.01, 0.9, 0.99, 1.0])
    assert not monotone(s, y, *spline(s, y)).all()
    value = curve(s, y, FINE)[:, 0]
    assert (np.diff(value) >= -1e-12).all()


# --- cycles ----------------------------------------------------------------------------------------
@pytest.mark.parametrize("name", ["walk", "trot"])
def test_the_common_swing_is_what_its_file_says(name: str) -> None:
    table = sampled(load_cycle(name), FINE)
    way, lift = with_derivatives(SMOOTH), CLEARANCE * with_derivatives(BUMP)
    assert np.abs(table[:, 0] - way[:, 0]).max() < 1e-3
    assert np.abs(table[:, 3] - lift[:, 0]).max() < 1e-3 * CLEARANCE
    for columns, analytic in ((table[:, :3], way), (table[:, 3:], lift)):
        off = np.abs(columns - analytic).max(axis=0) / np.abs(analytic).max(axis=0)
        assert off[1] < 0.01 and off[2] < 0.05


def test_climbing_goes_up_before_it_goes_forward() -> None:
    common, climb = (sampled(load_cycle(name), FINE) for name in ("trot", "climb"))
    assert climb[:, 3].max() > 1.3 * common[:, 3].max()
    assert np.interp(0.25, climb[:, 0][:401], climb[:401, 3]) > 1.5 * np.interp(
        0.25, common[:, 0][:401], common[:401, 3]
    )


def test_a_skill_without_a_cycle_of_its_own_has_that_of_trot() -> None:
    assert cycle_of("walk").name == "walk"
    assert cycle_of("rotary-gallop") is cycle_of("trot") is load_cycle("trot")


@settings(max_examples=30)
@given(transfer_parts(), transfer_parts())
def test_tables_are_of_the_path_of_their_leg(front, hind) -> None:
    cycle = LegCycle("two", front, hind)
    own = LegCycle("one", hind)
    tables = tabulated_legs(cycle, 6)
    assert tables.shape == (6, 129, 6)
    np.testing.assert_array_equal(tables[3], tabulated(cycle))
    np.testing.assert_array_equal(tables[4], tabulated(own))
    np.testing.assert_array_equal(tabulated_legs(own, 4)[0], tabulated_legs(own, 4)[3])
    s = np.array([point[0] for point in front])
    np.testing.assert_allclose(sampled(cycle, s)[:, [0, 3]] - [0.5, 0.0], np.array(front)[:, 1:], atol=1e-9)
    assert (tables[..., 3] >= -1e-9).all() and (np.diff(tables[..., 0], axis=1) >= -1e-9).all()


@given(transfer_parts(), st.floats(0.1, 0.9))
def test_seen_from_the_hip_the_path_is_closed_and_without_a_corner(points, duty: float) -> None:
    ends = np.array([0.0, 1.0])
    left, landed = seen_from_hip(sampled(LegCycle("c", points), ends), ends, duty)
    np.testing.assert_allclose(left[[0, 3]], [-0.5 * duty, 0.0], atol=1e-9)
    np.testing.assert_allclose(landed[[0, 3]], [0.5 * duty, 0.0], atol=1e-9)
    # In its support the foot goes back β strides in β periods; a swing takes 1 − β periods.
    for end in (left, landed):
        np.testing.assert_allclose(end[[1, 4]], [-(1.0 - duty), 0.0], atol=1e-6)


def test_hind_legs_are_the_rear_half() -> None:
    assert [is_hind(leg, 4) for leg in range(4)] == [False, False, True, True]
    assert [is_hind(leg, 6) for leg in range(6)] == [False] * 4 + [True] * 2
    assert [is_hind(leg, 8) for leg in range(8)] == [False] * 4 + [True] * 4


MIDDLE: tuple[Point, ...] = ((0.3, -0.3, 0.1), (0.7, 0.3, 0.1))
START, END = (0.0, -0.5, 0.0), (1.0, 0.5, 0.0)


@pytest.mark.parametrize(
    ("points", "sentence"),
    [
        ((START, END), "mine has 2 points; a leg cycle has 4 to 64"),
        ((START, (0.3, -0.3, -0.03), *MIDDLE[1:], END), "point 2 of mine lies 0.03 below the ground"),
        ((START, (0.3, -0.7, 0.1), *MIDDLE[1:], END), "point 2 of mine lies 0.2 strides behind the lift-off"),
        ((START, *MIDDLE[:1], (0.7, 0.9, 0.1), END), "point 3 of mine lies 0.4 strides beyond the touch"),
        ((START, *MIDDLE[:1], (0.7, 0.3, 1.5), END), "point 3 of mine is 1.5 body heights over the ground"),
        ((START, *MIDDLE[::-1], END), "point 3 of mine is at share 0.3 of the swing, the point before it"),
        ((START, (0.3, math.nan, 0.1), *MIDDLE[1:], END), "point 2 of mine is .0.3, nan, 0.1.; every number"),
        ((START, *MIDDLE, (1.2, 0.5, 0.0)), "point 4 of mine is at share 1.2 of the swing"),
        ((START, *MIDDLE, (1.0, 0.4, 0.0)), "point 4 of mine is .1, 0.4, 0.; touch-down is always .1, 0.5"),
        (((0.0, -0.5, 0.1), *MIDDLE, END), "point 1 of mine is .0, -0.5, 0.1.; lift-off is always"),
    ],
)  # fmt: skip
def test_what_is_no_cycle_names_its_point(points, sentence: str) -> None:
    with pytest.raises(WrongUse, match=sentence):
        LegCycle("mine", points)
    with pytest.raises(WrongUse, match=sentence.replace("mine", "the hind legs of mine")):
        LegCycle("mine", (START, *MIDDLE, END), points)


def test_points_may_be_as_near_as_they_may_be() -> None:
    near = tuple((0.3 + NEAREST * i, -0.3, 0.1) for i in range(3))
    assert np.isfinite(tabulated(LegCycle("near", (START, *near, *MIDDLE[1:], END)))).all()


# --- what a robot can walk -------------------------------------------------------------------------
def faults(cycle: LegCycle, robot: Robot, skill: str = "trot", pace: float = 1.0) -> dict:
    """What `check_cycle` finds at a share of the speed a skill is meant for, by kind."""
    row = find_skill(skill, robot)
    speed = pace * row.speed * speed_scale(robot)
    return {fault.kind: fault for fault in check_cycle(cycle, robot, gait_of(row, robot), speed)}


def with_point(number: int, point: Point, hind: bool = False) -> LegCycle:
    """The common swing with another point; counted from 1."""
    points = cycle_of("trot").points
    other = (*points[: number - 1], point, *points[number:])
    return LegCycle("mine", points, other) if hind else LegCycle("mine", other)


@pytest.mark.parametrize("name", ["go2", "thesis", "thesis-table"])
@pytest.mark.parametrize("skill", ["walk", "trot", "run"])
def test_robots_can_walk_their_own_cycles(name: str, skill: str) -> None:
    assert faults(cycle_of(skill), robot_called(name), skill) == {}


@pytest.mark.parametrize("skill", ["walk", "trot"])
def test_go2_can_climb(skill: str) -> None:
    assert faults(load_cycle("climb"), robot_called("go2"), skill) == {}


def test_the_checked_swing_is_that_of_the_desired_cycle() -> None:
    robot = robot_called("go2")
    gait = gait_of(find_skill("trot", robot), robot)
    swing = swing_of(cycle_of("trot"), robot, gait, 0.4)
    np.testing.assert_allclose([feet(robot, q) for q in swing.q], swing.feet_b, atol=1e-9)
    wanted = desired_cycle(robot, gait, (0.4, 0.0), 0.0, Manner(height=robot.stand), 1024)
    for leg in range(robot.n):
        air = ~wanted.stance[:, leg]
        s = ((wanted.phase[air] + gait.offsets[leg]) % 1.0 - gait.duty) / (1.0 - gait.duty)
        for ours, theirs, unit in ((swing.q, wanted.q, 1e-3), (swing.qd, wanted.qd, 0.1)):
            for joint in range(3):
                expected = np.interp(s, swing.s, ours[:, leg, joint])
                np.testing.assert_allclose(theirs[air, leg, joint], expected, atol=unit)


def test_a_point_above_the_hip_is_out_of_reach_and_named() -> None:
    fault = faults(with_point(4, (0.5, 0.0, 0.95)), robot_called("go2"))["reach"]
    assert fault.point == 4 and fault.measure != fault.limit
    assert f" point 4 of mine, leg {fault.leg}: " in fault.sentence


def test_a_stride_beyond_the_legs_is_out_of_reach() -> None:
    robot = robot_called("go2")
    free = replace(robot, q_min=robot.q_min - 9.0, q_max=robot.q_max + 9.0)
    fault = faults(cycle_of("trot"), free, pace=8.0)["reach"]
    assert fault.measure > fault.limit
    assert "the stretched leg is" in fault.sentence


def test_a_joint_limit_is_in_the_way() -> None:
    robot = robot_called("go2")
    stiff = replace(robot, q_min=robot.q_min.copy())
    stiff.q_min[2, 2] = -1.7
    fault = faults(cycle_of("trot"), stiff)["reach"]
    assert (fault.leg, fault.limit, fault.point) == ("RL", -1.7, 4)
    assert "knee would stand at" in fault.sentence


def test_a_foot_that_drags_is_named_with_its_hind_path() -> None:
    low = LegCycle(
        "mine", cycle_of("trot").points, (START, (0.3, -0.2, 0.1), (0.5, 0.0, 0.004), (0.7, 0.2, 0.1), END)
    )
    fault = faults(low, dog())["ground"]
    assert (fault.point, fault.hind, fault.leg) == (3, True, "RL")
    assert fault.measure < fault.limit == LEAST_CLEARANCE * dog().height
    assert fault.sentence.startswith("at point 3 of the hind legs of mine, leg RL: the foot is 0.0012 m over")


def test_a_hasty_point_asks_too_much_of_joints() -> None:
    robot = robot_called("go2")
    found = faults(with_point(2, (0.05, 0.3, 0.1)), robot)
    assert found["speed"].measure > found["speed"].limit == JOINT_SPEED * robot.natural_frequency
    assert found["torque"].measure > found["torque"].limit in robot.tau_max
    assert found["speed"].point in {1, 2, 3} and "would turn at" in found["speed"].sentence


@settings(max_examples=20)
@given(transfer_parts(), st.floats(0.1, 1.0))
def test_what_is_found_is_really_there(points, pace: float) -> None:
    robot = dog()
    cycle = LegCycle("any", points)
    found = faults(cycle, robot, "trot", pace)
    assume(found)
    for kind, fault in found.items():
        assert 1 <= fault.point <= len(points) and fault.leg in robot.legs
        assert fault.measure < fault.limit if kind == "ground" else fault.measure != fault.limit
        assert fault.measure > fault.limit or kind in {"ground", "reach"}


def test_a_gait_without_swing_or_for_other_legs_is_wrong_use() -> None:
    robot = dog()
    with pytest.raises(WrongUse, match="'stand' lifts no foot"):
        check_cycle(cycle_of("trot"), robot, gait_of(find_skill("stand", robot), robot), 0.0)
    gait = gait_of(find_skill("trot", robot), robot)
    with pytest.raises(WrongUse, match="is for 6 legs; dog has 4"):
        check_cycle(cycle_of("trot"), robot, replace(gait, offsets=(0.0,) * 6), 0.1)
    with pytest.raises(WrongUse, match="must be finite"):
        check_cycle(cycle_of("trot"), robot, gait, math.inf)
