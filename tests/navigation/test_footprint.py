"""The body from above: how near things are, and how far it turns and goes before they are too near."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString, affinity

from gaitwright.description.load import load_robot
from gaitwright.model.kinematics import angles, feet, knees
from gaitwright.navigation.footprint import (
    GONE,
    TURNED,
    Footprint,
    backs,
    drives,
    follows,
    footprint_of,
    goes,
    near,
    room_around,
    turns,
)
from oracles import robot_called

BODY = Footprint(0.33, 0.38, 0.165, 0.02)
spots = st.floats(-1.2, 1.2)
pieces = st.lists(st.tuples(spots, spots, spots, spots), min_size=1, max_size=5).map(
    lambda rows: np.array(rows, dtype=float).reshape(-1, 4)
)
poses = st.tuples(spots, spots, st.floats(-7.0, 7.0))


def outline(pose: tuple[float, float, float], body: Footprint = BODY) -> shapely.Polygon:
    box = shapely.box(-body.back, -body.side, body.front, body.side)
    turned = affinity.rotate(box, pose[2], origin=(0.0, 0.0), use_radians=True)
    return affinity.translate(turned, pose[0], pose[1])


def apart(what: np.ndarray, pose: tuple[float, float, float]) -> float:
    """By shapely."""
    return min(float(outline(pose).distance(LineString(piece.reshape(2, 2)))) for piece in what)


@given(pieces, poses)
def test_the_room_around_it_is_its_distance_from_the_nearest_piece(what: np.ndarray, pose) -> None:
    assert room_around(what, *pose, BODY, 0.5) == pytest.approx(min(apart(what, pose), 0.5), abs=1e-9)


@given(pieces, poses, st.floats(0.1, 2.0))
def test_what_is_left_out_as_far_away_is_far_away(what: np.ndarray, pose, far: float) -> None:
    kept = near(what, pose[:2], far)
    left = [piece for piece in what if not (kept == piece).all(axis=1).any()]
    place = shapely.Point(pose[:2])
    assert all(LineString(piece.reshape(2, 2)).distance(place) >= far - 1e-9 for piece in left)


@given(pieces, poses, st.floats(-3.0, 3.0))
def test_a_turn_ends_before_anything_is_too_near(what: np.ndarray, pose, by: float) -> None:
    x, y, yaw = pose
    before = apart(what, pose)
    done = turns(what, pose, by, BODY)
    least = min(before, BODY.sway) - 0.002
    for part in np.linspace(0.0, 1.0, 20):
        # Between the poses that are looked at, a corner may come nearer by the arc that it makes.
        slack = BODY.radius * TURNED
        assert before == 0.0 or apart(what, (x, y, yaw + part * done)) >= least - slack
    if done != by and before > 0.0:
        beyond = yaw + done + math.copysign(TURNED, by)
        assert apart(what, (x, y, beyond)) < BODY.sway + BODY.radius * TURNED


@given(pieces, poses, st.floats(-3.2, 3.2), st.floats(0.05, 1.5))
def test_a_move_ends_before_anything_is_too_near(what: np.ndarray, pose, towards: float, far: float) -> None:
    x, y, yaw = pose
    before, done = apart(what, pose), goes(what, pose, towards, far, BODY)
    assert 0.0 <= done <= far
    for part in np.linspace(0.0, 1.0, 20):
        there = (x + part * done * math.cos(towards), y + part * done * math.sin(towards), yaw)
        assert before == 0.0 or apart(what, there) >= min(before, BODY.sway) - 0.002 - GONE


def test_a_wall_ahead_ends_a_drive_when_it_is_reached() -> None:
    wall = np.array([[1.0, -2.0, 1.0, 2.0]])
    room = 1.0 - BODY.front - BODY.sway
    for speed in (0.2, 0.5, 1.0):
        lasts = drives(wall, (0.0, 0.0, 0.0), (speed, 0.0, 0.0), 60.0, BODY)
        assert room - GONE - 0.002 <= lasts * speed <= room + 0.002
    assert drives(wall, (0.0, 0.0, 0.0), (-0.5, 0.0, 0.0), 5.0, BODY) == 5.0
    assert drives(wall, (0.0, 0.0, math.pi), (-0.5, 0.0, 0.0), 60.0, BODY) * 0.5 < 1.0 - BODY.back
    assert drives(wall, (0.0, 0.0, math.pi / 2), (0.0, -0.5, 0.0), 60.0, BODY) * 0.5 < 1.0 - BODY.side


def test_an_arc_leads_round_what_stands_straight_ahead() -> None:
    pole = np.array([[1.2, -0.02, 1.2, 0.02]])
    assert drives(pole, (0.0, 0.0, 0.0), (0.4, 0.0, 0.0), 4.0, BODY) < 4.0
    assert drives(pole, (0.0, 0.0, 0.0), (0.4, 0.0, 0.8), 4.0, BODY) == 4.0


def test_in_a_corridor_it_follows_its_path_and_backs_out_but_does_not_turn_round() -> None:
    walls = np.array([[-3.0, 0.25, 2.0, 0.25], [-3.0, -0.25, 2.0, -0.25], [2.0, -0.25, 2.0, 0.25]])
    inside = (1.0, 0.0, 0.0)
    assert abs(turns(walls, inside, math.pi, BODY)) < math.radians(30.0)
    assert not follows(walls, inside, [(-5.0, 0.0)], 3.0, BODY)
    assert follows(walls, (1.0, 0.0, 0.1), [(1.6, 0.0)], 3.0, BODY)
    out = backs(walls, inside, [(-5.0, 0.0)], BODY.radius, BODY)
    assert out == pytest.approx(4.0 + math.sqrt(BODY.radius**2 - 0.25**2), abs=2 * GONE)
    assert backs(walls, inside, [(-2.0, 0.0)], BODY.radius, BODY) == pytest.approx(3.0), "all of a short path"
    shut = np.vstack([walls, [[-3.0, -0.25, -3.0, 0.25]]])
    assert backs(shut, inside, [(-5.0, 0.0)], BODY.radius, BODY) == -1.0


def test_beside_a_wall_it_turns_away_as_it_goes_on() -> None:
    """Turned in place, its tail would meet the wall; going on, it has turned soon."""
    wall = np.array([[-3.0, -0.2, 3.0, -0.2]])
    pose = (0.0, 0.0, 0.0)
    assert turns(wall, pose, math.radians(90.0), BODY) < math.radians(15.0)
    assert follows(wall, pose, [(0.0, 3.0)], 1.5, BODY)


@pytest.mark.parametrize("name", ["go2", "dog", "hexapod"])
def test_trunk_hips_knees_and_feet_are_within_it(name: str) -> None:
    robot = robot_called(name)
    body, (centre, half) = footprint_of(robot), robot.trunk
    q, _ = angles(robot, robot.nominal_feet)
    limbs = np.vstack([robot.hip, knees(robot, q), feet(robot, q), centre - half, centre + half])
    assert (limbs[:, 0] <= body.front + 1e-9).all() and (limbs[:, 0] >= -body.back - 1e-9).all()
    assert (np.abs(limbs[:, 1]) <= body.side + 1e-9).all()
    assert body.radius >= np.hypot(limbs[:, 0], limbs[:, 1]).max()


def test_a_go2_takes_its_length_to_turn() -> None:
    body = footprint_of(load_robot("go2"))
    assert 0.4 < body.radius < 0.45 and body.side + body.sway < 0.2, (
        "its path has room for it, a turn has not"
    )
