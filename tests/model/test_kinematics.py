"""Legs there and back: closed-form angles bring the foot home on all four branches, or say why not."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from gaitwright.model.catalogue import robot_names
from gaitwright.model.kinematics import (
    BRANCHES,
    REACHED,
    TOO_FAR,
    TOO_NEAR_AXIS,
    TOO_NEAR_HIP,
    angles,
    feet,
    foot_in_leg,
    leg_angles,
    to_base,
    to_leg,
)
from gaitwright.model.leg import foot_and_columns, leg_turns
from gaitwright.model.reach import BEYOND_LIMIT, poses, reach
from gaitwright.numerics.geometry import rotation, wrap
from gaitwright.numerics.matrices import rows
from oracles import branches, robot_called, unlike

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
postures = st.tuples(angle, angle, angle).map(np.array)


def clear_of_singular(q: np.ndarray, offset: np.ndarray, third: float) -> bool:
    """Whether the knee is bent and the foot off the first axis."""
    foot, c1, c2, c3 = (np.array(c) for c in foot_and_columns(leg_turns(q, third), rows(offset), third))
    knee = np.linalg.norm(np.cross(c2, c3)) / (np.linalg.norm(c2) * np.linalg.norm(c3) + 1e-12)
    aside = offset[:, 1].sum()
    down = math.sqrt(max(foot[1] ** 2 + foot[2] ** 2 - aside**2, 0.0))
    return knee > CLEAR and down > CLEAR and np.linalg.norm(c1) > CLEAR


@given(legs, postures, sign)
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


@given(legs, postures, sign)
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


@given(legs, postures, sign)
@example(np.array([(0, 0.1, 0), (0, 0, -0.2), (0, 0, -0.2)]), np.zeros(3), 1.0)
def test_the_jacobian_is_the_derivative(offset: np.ndarray, q: np.ndarray, third: float) -> None:
    foot, *columns = foot_and_columns(leg_turns(q, third), rows(offset), third)
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
    assert np.isfinite(q).all()


@given(abduction_leg(), sign, angle, angle, st.booleans())
def test_the_stretched_and_the_folded_leg_still_reach(offset, third, hip1, hip2, stretched) -> None:
    """A foot at the edge of the reach is reached, whichever way its last digit is rounded."""
    thigh, shank = np.arctan2(offset[1:, 0], offset[1:, 2])
    knee = third * (thigh - shank + (0.0 if stretched else math.pi))
    foot = foot_in_leg(np.array([hip1, hip2, knee]), offset, third)
    assume(abs(lengths(offset)[0] - lengths(offset)[1]) > 0.01)
    solved = [leg_angles(foot, offset, third, *branch) for branch in BRANCHES]
    reached = [foot_in_leg(np.array(q), offset, third) for q, code in solved if code == REACHED]
    assert reached
    for back in reached:
        np.testing.assert_allclose(back, foot, rtol=0, atol=1e-11)


# --- whole robots --------------------------------------------------------------------------------
@pytest.mark.parametrize("name", [*robot_names(), "dog", "insect"])
def test_the_nominal_stance_is_reached(name: str) -> None:
    robot = robot_called(name)
    q, reached = angles(robot, robot.nominal_feet)
    assert reached.all()
    np.testing.assert_allclose(feet(robot, q), robot.nominal_feet, rtol=0, atol=1e-12 * robot.height)


@pytest.mark.parametrize("name", [*robot_names(), "dog", "insect"])
def test_feet_that_cannot_be_reached_are_told_leg_by_leg(name: str) -> None:
    robot = robot_called(name)
    wanted = robot.nominal_feet.copy()
    wanted[1] += (0.0, 0.0, -10.0 * robot.leg_length)
    q, reached = angles(robot, wanted)
    assert reached.tolist() == [leg != 1 for leg in range(robot.n)]
    assert np.isfinite(q).all()


@given(st.sampled_from(["dog", "insect"]), st.integers(0, 2**32 - 1))
def test_all_postures_of_a_robot_nobody_has_seen_bring_its_feet_home(name: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    robot = unlike(robot_called(name), rng)
    q = rng.uniform(-math.pi, math.pi, (robot.n, 3))
    places = feet(robot, q)
    for i, leg in enumerate(robot.legs):
        assume(clear_of_singular(q[i], robot.offset[i], robot.sign[i]))
        found = branches(robot, leg, places[i])
        home = [np.where(np.arange(robot.n)[:, None] == i, posture, q) for posture in found.values()]
        for posture in home:
            np.testing.assert_allclose(feet(robot, posture), places, rtol=0, atol=1e-12)
        wrapped = [np.arctan2(np.sin(p - q), np.cos(p - q)) for p in home]
        assert min(np.abs(w).max() for w in wrapped) < 1e-11, "one of them is where we came from"


def test_all_four_postures_of_a_leg() -> None:
    """The dog's foot below its hip: knee behind or before, foot below or above the axis turned half round."""
    robot = robot_called("dog")
    found = branches(robot, "RR", robot.nominal_feet[3])
    assert set(found) == set(BRANCHES)
    assert len({tuple(q.round(6)) for q in found.values()}) == 4
    own = found[tuple(robot.branch[3])]
    np.testing.assert_allclose(own, angles(robot, robot.nominal_feet)[0][3], atol=1e-14)
    assert branches(robot, "RR", robot.nominal_feet[3] * 9.0) == {}


# --- reach in words ------------------------------------------------------------------------------
def test_a_foot_too_far_is_told_with_leg_distance_and_length() -> None:
    robot = robot_called("dog")
    wanted = robot.nominal_feet.copy()
    wanted[1] += (0.0, 0.0, -0.252)
    far = reach(robot, wanted)[1]
    assert (far.leg, far.code) == ("FR", TOO_FAR)
    assert far.measure == pytest.approx(0.52)
    assert far.sentence == "leg FR: the foot is 0.52 m from hip 2, the stretched leg is 0.43 m"


def test_a_foot_too_near_is_told_with_leg_distance_and_length() -> None:
    robot = robot_called("dog")
    folded = robot.hip + [[0.0, y, 0.005] for y in robot.offset[:, 0, 1]]
    near = reach(robot, folded)[2]
    assert (near.code, near.measure, near.limit) == (TOO_NEAR_HIP, pytest.approx(0.005), pytest.approx(0.01))
    assert near.sentence == "leg RL: the foot is 0.005 m from hip 2, the folded leg is 0.01 m"
    inside = reach(robot, robot.hip + np.array([0.1, 0.03, 0.04]))[0]
    assert inside.code == TOO_NEAR_AXIS
    assert (
        inside.sentence
        == "leg FL: the foot is 0.05 m from the first axis, the leg's lateral offset is 0.09 m"
    )


def test_a_limit_in_the_way_is_told_with_joint_and_angle() -> None:
    robot = robot_called("dog")
    q = np.tile([0.0, 0.4, -0.3], (4, 1))
    stuck = reach(robot, feet(robot, q))[0]
    assert (stuck.code, stuck.limit) == (BEYOND_LIMIT, -0.5)
    assert stuck.sentence == "leg FL: knee would stand at -0.3 rad, beyond its limit of -0.5 rad"
    at_limit = reach(robot, feet(robot, np.tile([1.0, 0.9, -0.5], (4, 1))))
    assert [r.code for r in at_limit] == [REACHED] * 4


@given(st.sampled_from(["dog", "insect"]), st.integers(0, 2**32 - 1))
def test_reach_agrees_with_the_angles_and_its_numbers_say_why(name: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    robot = unlike(robot_called(name), rng)
    wanted = robot.hip + rng.normal(0.0, 0.25, (robot.n, 3))
    _, reached = angles(robot, wanted)
    for told, there in zip(reach(robot, wanted), reached, strict=True):
        assert there == (told.code in (REACHED, BEYOND_LIMIT))
        assert told.sentence.startswith(f"leg {told.leg}: ")
        assert f"{told.measure:.3g}" in told.sentence and f"{told.limit:.3g}" in told.sentence
        if told.code in (REACHED, TOO_NEAR_AXIS, TOO_NEAR_HIP):
            assert told.measure <= told.limit * (1.0 + 1e-9)
        if told.code == TOO_FAR:
            assert told.measure > told.limit


@pytest.mark.parametrize(
    ("q", "sentence"),
    [
        ([0.1, 0.5, 0.0], "leg FL: the knee is straight, its sine is 0"),
        ([0.1, 0.5, -0.004], "leg FL: the knee is straight, its sine is 0.004"),
        ([0.0, 0.6, -1.2], "leg FL: regular: the foot is 0.35 m from under the first axis, "
         "the knee's sine is 0.93"),
        ([0.0, math.pi / 2, 0.0], "leg FL: the foot is under the first axis, 0 m from it in the plane of "
         "the knee and the knee is straight, its sine is 0"),
    ],
)  # fmt: skip
def test_singular_poses_are_told_with_their_numbers(q, sentence) -> None:
    robot = robot_called("dog")
    assert poses(robot, np.tile(q, (4, 1)))[0].sentence == sentence


@given(st.integers(0, 2**32 - 1))
def test_leg_and_base_frames_are_there_and_back(seed: int) -> None:
    rng = np.random.default_rng(seed)
    frame, hip, point = rotation(rng.normal(size=4)), rng.normal(size=3), tuple(rng.normal(size=3))
    np.testing.assert_allclose(to_base(frame, hip, point), hip + frame @ point, atol=1e-14)
    np.testing.assert_allclose(to_leg(frame, hip, to_base(frame, hip, point)), point, atol=1e-14)
