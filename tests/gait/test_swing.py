"""A swinging foot: smooth from lift-off to touch-down, and on its way to where it was aimed."""

import math

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st

from gaitwright.gait.leg_cycles.files import load_cycle
from gaitwright.gait.leg_cycles.leg_cycle import tabulated
from gaitwright.gait.swing import (
    AIM_BELOW,
    REACH,
    REACH_DOWN,
    SEARCH_DEPTH,
    SEARCH_FROUDE,
    hip_over_ground,
    search_reference,
    swing_reference,
    touchdown,
)
from gaitwright.numerics.geometry import GRAVITY, rotation, yaw_quaternion

HEIGHT, DURATION = 0.3, 0.16
TABLE = tabulated(load_cycle("trot"), bins=4096)
"""Fine enough for finite differences."""
DOWN = SEARCH_FROUDE * math.sqrt(GRAVITY * HEIGHT)
share = st.floats(0.0, 1.0)
coordinate = st.floats(-0.5, 0.5)
point = st.tuples(coordinate, coordinate, coordinate).map(np.array)
speed = st.tuples(st.floats(-2.0, 2.0), st.floats(-2.0, 2.0))


def swing(origin, goal, s: float) -> np.ndarray:
    """Position, velocity and acceleration `(3, 3)` at share `s` of the swing to `goal` (x, y, ground)."""
    out = np.empty((3, 3))
    swing_reference(origin, *goal, s, DURATION, HEIGHT, TABLE, 1.0, *out)
    return out


def search(origin, seconds: float) -> np.ndarray:
    out = np.empty((3, 3))
    search_reference(origin, seconds, HEIGHT, *out)
    return out


@given(point, point, st.floats(0.01, 0.99).filter(lambda s: abs(s - REACH_DOWN) > 0.01))
def test_velocity_and_acceleration_are_derivatives(origin, goal, s: float) -> None:
    h = 1e-3
    before, here, after = (swing(origin, goal, s + d) for d in (-h, 0.0, h))
    rates = (after - before)[:2] / (2 * h * DURATION)
    np.testing.assert_allclose(here[1], rates[0], atol=2e-3)
    np.testing.assert_allclose(here[2], rates[1], atol=2.0)


@given(point, point)
def test_a_swing_leaves_the_ground_at_rest_and_comes_down_where_aimed(origin, goal) -> None:
    still = np.zeros((2, 3))
    np.testing.assert_allclose(swing(origin, goal, 0.0), [origin, *still], atol=1e-11)
    p, v, _ = swing(origin, goal, 1.0)
    deeper = 0.5 * DOWN * (1.0 - REACH_DOWN) * DURATION
    np.testing.assert_allclose(p, goal - (0.0, 0.0, AIM_BELOW * HEIGHT + deeper), atol=1e-11)
    np.testing.assert_allclose(v, (0.0, 0.0, -DOWN), atol=1e-9)


@given(point, point, share, st.floats(1.0, 4.0))
def test_a_raised_swing_is_higher_and_no_farther(origin, goal, s: float, lift: float) -> None:
    low, high = np.empty((3, 3)), np.empty((3, 3))
    swing_reference(origin, *goal, s, DURATION, HEIGHT, TABLE, 1.0, *low)
    swing_reference(origin, *goal, s, DURATION, HEIGHT, TABLE, lift, *high)
    np.testing.assert_array_equal(low[0, :2], high[0, :2])
    assert high[0, 2] >= low[0, 2] - 1e-12


@given(point, point)
def test_at_mid_swing_the_foot_is_lifted_over_the_straight_line(origin, goal) -> None:
    aimed = goal - (0.0, 0.0, AIM_BELOW * HEIGHT)
    middle = 0.5 * (origin + aimed) + (0.0, 0.0, TABLE[:, 3].max() * HEIGHT)
    np.testing.assert_allclose(swing(origin, goal, 0.5)[0], middle, atol=1e-3 * HEIGHT)


# --- where to ------------------------------------------------------------------------------------
aims = st.fixed_dictionaries(
    {
        "hip": st.tuples(coordinate, coordinate),
        "arm": st.tuples(coordinate, coordinate),
        "velocity": speed,
        "wanted": speed,
        "turn": st.floats(-2.0, 2.0),
        "remaining": st.floats(0.0, 0.2),
    }
)


def aim(hip, arm, velocity, wanted, turn, remaining) -> np.ndarray:
    return np.array(touchdown(*hip, *arm, velocity, wanted, turn, remaining, 0.24, 0.17, HEIGHT))


def turned(angle: float, v) -> tuple[float, float]:
    c, s = math.cos(angle), math.sin(angle)
    return c * v[0] - s * v[1], s * v[0] + c * v[1]


@given(aims, st.floats(-3.0, 3.0), st.tuples(coordinate, coordinate))
def test_touch_down_does_not_depend_on_where_north_is(aims: dict, angle: float, shift) -> None:
    elsewhere = {k: turned(angle, v) if isinstance(v, tuple) else v for k, v in aims.items()}
    elsewhere["hip"] = tuple(np.add(elsewhere["hip"], shift))
    np.testing.assert_allclose(aim(**elsewhere), np.add(turned(angle, aim(**aims)), shift), atol=1e-6)


@given(aims)
def test_a_step_keeps_within_reach_of_the_hip_to_be(aims: dict) -> None:
    (vx, vy), (ax, ay), turn, t = aims["velocity"], aims["arm"], aims["turn"], aims["remaining"]
    hip_then = np.add(aims["hip"], (t * (vx - turn * ay), t * (vy + turn * ax)))
    assert np.linalg.norm(aim(**aims) - hip_then) <= REACH * HEIGHT * (1 + 1e-12)


@given(st.tuples(coordinate, coordinate), st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5)))
def test_in_steady_motion_the_foot_lands_half_a_stance_ahead(hip, v) -> None:
    landed = aim(hip, (0.0, 0.0), v, v, 0.0, 0.0)
    np.testing.assert_allclose(landed, np.add(hip, np.multiply(v, 0.12)), atol=1e-15)


def test_a_push_is_caught_on_its_own_side() -> None:
    pushed = aim((0.0, 0.0), (0.0, 0.0), (0.0, 0.3), (0.0, 0.0), 0.0, 0.0)
    assert pushed[1] > 0.0 and pushed[0] == 0.0


def test_where_the_reach_ends_the_stride_gives_way_to_balance() -> None:
    fast = aim((0.0, 0.0), (0.0, 0.0), (3.0, 0.5), (3.0, 0.0), 0.0, 0.0)
    assert fast[1] == 0.17 * 0.5, "the capture step is whole"
    assert math.isclose(math.hypot(*fast), REACH * HEIGHT)


def test_turning_left_front_feet_step_left_and_rear_feet_right() -> None:
    front, rear = (aim((0.0, 0.0), (x, 0.0), (0.0, 0.0), (0.0, 0.0), 1.0, 0.0) for x in (0.2, -0.2))
    assert front[1] > 0.0 > rear[1]


@given(st.floats(-3.0, 3.0), point, point)
def test_on_level_ground_hips_are_carried_along_with_the_body(yaw: float, position, stance) -> None:
    R = rotation(yaw_quaternion(yaw))
    *place, arm_x, arm_y = hip_over_ground(R, position, stance)
    np.testing.assert_allclose(place, (position + R @ stance)[:2], atol=1e-14)
    np.testing.assert_allclose((arm_x, arm_y), (R @ stance)[:2], atol=1e-14)


# --- a late foot ---------------------------------------------------------------------------------
@given(point, st.floats(0.0, 3.0))
def test_a_late_foot_goes_straight_down_and_not_for_ever(origin, seconds: float) -> None:
    p, v, a = search(origin, seconds)
    np.testing.assert_array_equal(p[:2], origin[:2])
    assert origin[2] - SEARCH_DEPTH * HEIGHT - 1e-12 <= p[2] <= origin[2]
    assert v[0] == v[1] == 0.0 and v[2] <= 0.0 and not a.any()


@given(point, st.floats(0.001, 3.0))
def test_a_late_foot_moves_at_the_speed_it_claims(origin, seconds: float) -> None:
    h = 1e-6
    (before, v0, _), (after, v1, _) = search(origin, seconds - h), search(origin, seconds + h)
    assume(v0[2] == v1[2])  # not where it has come to its depth
    np.testing.assert_allclose(v0[2], (after - before)[2] / (2 * h), atol=1e-8)
    assert search(origin, 0.01)[1, 2] == -DOWN and search(origin, 100.0)[1, 2] == 0.0
