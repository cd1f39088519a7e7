"""Legs there and back: closed-form angles bring the foot home on all four branches, or say why not."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from gaitwright.geometry import rotation, wrap
from gaitwright.model.catalogue import robot_names
from gaitwright.model.kinematics import (
    REACH_SENTENCES,
    REACHED,
    TOO_FAR,
    TOO_NEAR_AXIS,
    TOO_NEAR_HIP,
    angles,
    feet,
    foot_in_leg,
    leg_angles,
    leg_points_and_jacobian,
    to_base,
    to_leg,
)
from oracles import robot_called

BRANCHES = list(itertools.product((1, -1), repeat=2))
CLEAR = 0.05
"""Sine of the angle by which the drawn legs stay clear of poses where branches meet."""

small = st.floats(-0.3, 0.3)
link = st.floats(0.2, 2.0)
angle = st.floats(-math.pi, math.pi)
sign = st.sampled_from([1.0, -1.0])


@st.composite
def abduction_leg(draw) -> np.ndarray:
    """Offsets of a leg whose foot stays beside the first axis."""
    aside = draw(st.floats(0.02, 0.5)) * draw(sign)
    thigh, shank = (draw(small), draw(small), -draw(link)), (draw(small), draw(small), -draw(link))
    return np.array([(draw(small), aside, draw(small)), thigh, shank])


@st.composite
def yaw_leg(draw) -> np.ndarray:
    """Offsets of a leg whose first axis stands in the plane in which the others bend."""
    return np.array([(draw(small), 0.0, draw(small)), (0.0, 0.0, -draw(link)), (0.0, 0.0, -draw(link))])


legs = st.one_of(abduction_leg(), yaw_leg())
poses = st.tuples(angle, angle, angle).map(np.array)


def clear_of_singular(q: np.ndarray, offset: np.ndarray, third: float) -> bool:
    """Whether the knee is bent and the foot off the first axis."""
    foot, c1, c2, c3 = (np.array(c) for c in leg_points_and_jacobian(q, offset, third))
    knee = np.linalg.norm(np.cross(c2, c3)) / (np.linalg.norm(c2) * np.linalg.norm(c3) + 1e-12)
    aside = offset[:, 1].sum()
    down = math.sqrt(max(foot[1] ** 2 + foot[2] ** 2 - aside**2, 0.0))
    return knee > CLEAR and down > CLEAR and np.linalg.norm(c1) > CLEAR


@given(legs, poses, sign)
def test_every_branch_brings_the_foot_back(offset: np.ndarray, q: np.ndarray, third: float) -> None:
    foot = foot_in_leg(q, offset, third)
    assume(clear_of_singular(q, offset, third))
    solutions = []
    for side, bend in BRANCHES:
        solution, code = leg_angles(foot, offset, third, side, bend)
        if code == REACHED:
            solutions.append(solution)
            np.testing.assert_allclose(
                foot_in_leg(np.array(solution), offset, third), foot, rtol=0, atol=1e-12
            )
    errors = [max(abs(wrap(a - b)) for a, b in zip(s, q, strict=True)) for s in solutions]
    assert min(errors) < 1e-12, "one branch is the pose that the foot came from"


@given(legs, poses, sign)
def test_branches_are_told_apart_by_side_and_bend(offset: np.ndarray, q: np.ndarray, third: float) -> None:
    foot = foot_in_leg(q, offset, third)
    assume(clear_of_singular(q, offset, third))
    solved = {b: leg_angles(foot, offset, third, *b) for b in BRANCHES}
    reached = {b: np.array(s) for b, (s, code) in solved.items() if code == REACHED}
    for (one, a), (two, b) in itertools.combinations(reached.items(), 2):
        assert np.abs(np.exp(1j * a) - np.exp(1j * b)).max() > 1e-6, f"{one} and {two} are the same pose"
    for (side, _), s in reached.items():
        below = (
            np.array([0.0, math.cos(s[0]), math.sin(s[0])]),
            np.array([0.0, -math.sin(s[0]), math.cos(s[0])]),
        )
        assert below[0] @ foot == pytest.approx(offset[:, 1].sum(), abs=1e-12)
        assert side * (below[1] @ foot) > 0.0, "side is the sign of the foot's place along the plane's z axis"


@given(legs, poses, sign)
@example(np.array([(0, 0.1, 0), (0, 0, -0.2), (0, 0, -0.2)]), np.zeros(3), 1.0)
def test_the_jacobian_is_the_derivative(offset: np.ndarray, q: np.ndarray, third: float) -> None:
    foot, *columns = leg_points_and_jacobian(q, offset, third)
    np.testing.assert_allclose(foot, foot_in_leg(q, offset, third), rtol=0, atol=1e-14)
    step = 1e-6
    for j, column in enumerate(columns):
        e = step * np.eye(3)[j]
        there, back = foot_in_leg(q + e, offset, third), foot_in_leg(q - e, offset, third)
        np.testing.assert_allclose(column, np.subtract(there, back) / (2 * step), atol=1e-8)


# --- out of reach --------------------------------------------------------------------------------
def in_plane(point, q1: float, offset: np.ndarray) -> np.ndarray:
    """Place of a point in the plane in which hinges 2 and 3 bend, seen from hinge 2: x and z."""
    z = -math.sin(q1) * point[1] + math.cos(q1) * point[2]
    return np.array([point[0] - offset[0, 0], z - offset[0, 2]])


def lengths(offset: np.ndarray) -> tuple[float, float]:
    """Thigh and shank in that plane [m]."""
    return math.hypot(offset[1, 0], offset[1, 2]), math.hypot(offset[2, 0], offset[2, 2])


@given(legs, sign, st.sampled_from(BRANCHES), angle, st.floats(1.01, 5.0), st.booleans())
def test_too_far_or_too_near_points_the_leg_there(offset, third, branch, way, beyond, far) -> None:
    thigh, shank = lengths(offset)
    limit = thigh + shank if far else abs(thigh - shank)
    assume(limit > 0.05)
    distance = limit * beyond if far else limit / beyond
    x, down = distance * math.sin(way) + offset[0, 0], distance * math.cos(way) + offset[0, 2]
    assume(branch[0] * down > 0.01)
    wanted = (x, offset[:, 1].sum(), down)
    q, code = leg_angles(wanted, offset, third, *branch)
    assert code == (TOO_FAR if far else TOO_NEAR_HIP)
    reached = in_plane(foot_in_leg(np.array(q), offset, third), q[0], offset)
    direction = in_plane(wanted, q[0], offset) / distance
    np.testing.assert_allclose(reached, limit * direction, atol=1e-7)


@given(abduction_leg(), sign, st.sampled_from(BRANCHES), angle, st.floats(0.0, 0.99), st.floats(-0.5, 0.5))
def test_a_foot_nearer_to_the_axis_than_the_offset_is_not_reached(
    offset, third, branch, around, share, x
) -> None:
    aside = offset[:, 1].sum()
    assume(abs(aside) > 0.01)
    r = share * abs(aside)
    q, code = leg_angles((x, r * math.cos(around), r * math.sin(around)), offset, third, *branch)
    assert code in (TOO_NEAR_AXIS, TOO_FAR, TOO_NEAR_HIP)
    assert np.isfinite(q).all()


def test_a_foot_on_the_axis_says_which_limit_it_breaks() -> None:
    offset = np.array([(0, 0.1, 0), (0, 0, -0.2), (0, 0, -0.2)])
    q, code = leg_angles((0.2, 0.0, 0.05), offset, 1.0, -1, -1)
    assert code == TOO_NEAR_AXIS
    assert "lateral offset" in REACH_SENTENCES[code]
    assert np.isfinite(q).all()


def test_every_code_has_its_own_sentence() -> None:
    assert sorted(REACH_SENTENCES) == sorted({REACHED, TOO_NEAR_AXIS, TOO_FAR, TOO_NEAR_HIP})
    assert len(set(REACH_SENTENCES.values())) == 4


# --- whole robots --------------------------------------------------------------------------------
@pytest.mark.parametrize("name", [*robot_names(), "dog", "insect"])
def test_the_nominal_stance_is_reached(name: str) -> None:
    robot = robot_called(name)
    q, reached = angles(robot, robot.stance)
    assert reached.all()
    np.testing.assert_allclose(feet(robot, q), robot.stance, rtol=0, atol=1e-12 * robot.height)


@pytest.mark.parametrize("name", [*robot_names(), "dog", "insect"])
def test_feet_that_cannot_be_reached_are_told_leg_by_leg(name: str) -> None:
    robot = robot_called(name)
    wanted = robot.stance.copy()
    wanted[1] += (0.0, 0.0, -10.0 * robot.leg_length)
    q, reached = angles(robot, wanted)
    assert reached.tolist() == [leg != 1 for leg in range(robot.n)]
    assert np.isfinite(q).all()


@given(st.integers(0, 2**32 - 1))
def test_leg_and_base_frames_are_there_and_back(seed: int) -> None:
    rng = np.random.default_rng(seed)
    frame, hip, point = rotation(rng.normal(size=4)), rng.normal(size=3), tuple(rng.normal(size=3))
    np.testing.assert_allclose(to_base(frame, hip, point), hip + frame @ point, atol=1e-14)
    np.testing.assert_allclose(to_leg(frame, hip, to_base(frame, hip, point)), point, atol=1e-14)
