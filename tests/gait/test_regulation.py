"""Roll, pitch and height from the feet: the body lies in the plane, at its distance, whatever its yaw."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.errors import WrongUse
from gaitwright.gait.contact_plane import Plane
from gaitwright.gait.regulation import LEVEL, Regulation, regulate
from gaitwright.model.kinematics import angles, feet
from gaitwright.numerics.geometry import from_thesis, roll_pitch_yaw
from oracles import robot_called

seeds = st.integers(0, 2**32 - 1)
slope = st.floats(-0.6, 0.6)
yaws = st.floats(-3.1, 3.1)
CORNERS = np.array([[0.2, 0.15], [0.2, -0.15], [-0.2, 0.15], [-0.2, -0.15]])


def attitude(roll: float, pitch: float, yaw: float) -> np.ndarray:
    """R_wb of turns about z, then y, then x (eq. 3-1)."""
    (cr, cp, cy), (sr, sp, sy) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    Rx = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    Ry = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    Rz = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return Rz @ Ry @ Rx


@given(slope, slope, yaws, seeds)
def test_the_body_lies_in_the_plane_at_its_yaw_and_distance(a: float, b: float, yaw: float, seed) -> None:
    x, y, *_ = np.random.default_rng(seed).normal(size=3)
    points = np.column_stack([CORNERS, 0.1 + CORNERS @ [a, b]])
    pose = regulate(points, np.array([x, y, yaw]), 0.3)
    R = attitude(pose.roll, pose.pitch, yaw)
    normal = np.array([-a, -b, 1.0]) / np.sqrt(1.0 + a * a + b * b)
    np.testing.assert_allclose(R[:, 2], normal, atol=1e-12)
    np.testing.assert_allclose(roll_pitch_yaw(R)[2], yaw, atol=1e-12)
    away = (np.array([x, y, pose.height]) - points) @ normal
    np.testing.assert_allclose(away, 0.3, atol=1e-12)


@given(slope, slope, yaws)
def test_it_is_what_the_thesis_says_in_its_own_axes(a: float, b: float, yaw: float) -> None:
    """N = (P, Q, R) downwards, φ = asin(P sψ − Q cψ), θ = atan2(P cψ + Q sψ, R), all with z down."""
    points = np.column_stack([CORNERS, 0.1 + CORNERS @ [a, b]])
    down = from_thesis(points)
    a0, a1, a2 = np.linalg.lstsq(np.column_stack([np.ones(4), down[:, :2]]), down[:, 2], rcond=None)[0]
    P, Q, N = np.array([-a1, -a2, 1.0]) / np.sqrt(1.0 + a1 * a1 + a2 * a2)
    turn = -yaw  # about an axis that points down
    roll = np.arcsin(P * np.sin(turn) - Q * np.cos(turn))
    pitch = np.arctan2(P * np.cos(turn) + Q * np.sin(turn), N)
    pose = regulate(points, np.array([0.05, 0.02, yaw]), 0.3)
    assert pose.roll == pytest.approx(roll, abs=1e-12)
    assert -pose.pitch == pytest.approx(pitch, abs=1e-12)
    x, y, _ = from_thesis(np.array([0.05, 0.02, 0.0]))
    assert -pose.height == pytest.approx(a0 + a1 * x + a2 * y - 0.3 / N, abs=1e-12)


@pytest.mark.parametrize("name", ["go2", "thesis", "hexapod"])
@pytest.mark.parametrize("tilt", [(0.0, 0.0), (0.2, -0.15)])
def test_a_robot_that_stands_on_a_slope_is_told_its_own_pose(name: str, tilt) -> None:
    """A body in the pose it is told, with its legs in their nominal stance, has its feet where they were."""
    robot = robot_called(name)
    R = attitude(*tilt, 0.7)
    at = np.array([1.0, -2.0, 0.4])
    q, reached = angles(robot, robot.nominal_feet)
    assert reached.all()
    feet_w = at + feet(robot, q) @ R.T
    pose = regulate(feet_w, np.array([at[0], at[1], 0.7]), robot.stand)
    assert (pose.roll, pose.pitch) == pytest.approx(tilt, abs=1e-9)
    assert pose.height == pytest.approx(at[2], abs=1e-9)


def standing_on(count: int) -> Regulation:
    """The pose over the first few of four feet on a slope ahead, after a slope to the left."""
    points = np.column_stack([CORNERS, 0.1 * CORNERS[:, 0]])
    return regulate(points[:count], np.zeros(3), 0.3, Plane(0.0, 0.2, 0.0, 0.0, 0.05))


def test_each_number_of_feet_has_its_policy() -> None:
    four, three, two, one, none = (standing_on(count) for count in (4, 3, 2, 1, 0))
    for pose in (four, three):
        assert pose.plane[:2] == pytest.approx((0.1, 0.0), abs=1e-12)
        assert (pose.determined, pose.roll) == (1.0, pytest.approx(0.0, abs=1e-12))
        assert pose.pitch == pytest.approx(-np.arctan(0.1), abs=1e-12)
    assert two.plane[:2] == pytest.approx((0.0, 0.0), abs=1e-12), "two front feet at one height: level across"
    assert one.plane == pytest.approx((0.0, 0.2, 0.2, 0.15, 0.02))
    assert none.plane == (0.0, 0.2, 0.0, 0.0, 0.05)
    assert none.roll == pytest.approx(np.arctan(0.2))
    assert none.height == pytest.approx(0.05 + 0.3 * np.hypot(1.0, 0.2))


def test_it_says_what_the_plane_is_made_of() -> None:
    said = [standing_on(count).sentence for count in (4, 3, 2, 1, 0)]
    assert said == [
        "the plane is the least-squares fit of 4 feet",
        "the plane is the least-squares fit of 3 feet",
        "2 feet stand on a line: the plane goes through it, nearest to the one before",
        "one foot stands: the slope is kept, the plane goes through the foot",
        "no foot stands: the plane is kept",
    ]
    narrow = np.column_stack([CORNERS * [1.0, 0.06 * 4 / 3], np.zeros(4)])
    pose = regulate(narrow, np.zeros(3), 0.3)
    assert pose.sentence == "4 feet stand almost on a line: across it the past counts for 50%"


def test_feet_above_each_other_are_no_line() -> None:
    before = Plane(0.1, 0.2, 0.0, 0.0, 0.0)
    pose = regulate(np.array([[1.0, 2.0, z] for z in (0.0, 0.3, 0.6)]), np.zeros(3), 0.3, before)
    assert pose.plane == pytest.approx((0.1, 0.2, 1.0, 2.0, 0.3))
    said = "3 feet stand in one place: the slope is kept, the plane goes through their mean"
    assert (pose.sentence, pose.determined) == (said, 0.0)


def test_without_feet_and_past_it_is_level() -> None:
    pose = regulate(np.empty((0, 3)), np.array([3.0, 4.0, 1.0]), 0.3)
    assert (pose.roll, pose.pitch, pose.height, pose.plane) == (0.0, 0.0, 0.3, LEVEL)


@pytest.mark.parametrize(
    ("feet_w", "place", "stand", "told"),
    [
        (np.array([[0.0, np.nan, 0.0]]), np.zeros(3), 0.3, "foot"),
        (np.zeros((4, 3)), np.array([0.0, 0.0, np.inf]), 0.3, "place"),
        (np.zeros((4, 3)), np.zeros(3), np.nan, "stand nan"),
    ],
)
def test_numbers_that_are_none_are_refused(feet_w, place, stand, told) -> None:
    with pytest.raises(WrongUse, match=f"{told}.*not finite"):
        regulate(feet_w, place, stand)
