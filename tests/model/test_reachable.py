"""Which ground a foot reaches, against places that joint angles drawn within their limits bring it to."""

from typing import NamedTuple

import numpy as np
import pytest
from scipy.spatial import cKDTree

from gaitwright.model.centre_of_mass import centres_of_mass, on_link
from gaitwright.model.kinematics import angles, feet, feet_over_time
from gaitwright.model.reach import reach
from gaitwright.model.reachable import reachable
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import rotation
from oracles import robot_called

ROBOTS = ("go2", "thesis", "hexapod", "dog")
DRAWN = 200_000
SPACING = 1.0 / 20.0
"""Of the nodes, in leg lengths."""


class Case(NamedTuple):
    robot: Robot
    position_w: np.ndarray
    R_wb: np.ndarray
    x: np.ndarray
    y: np.ndarray


def posed(name: str) -> Case:
    """A robot at its height over ground around z = 0, turned a little about every axis."""
    robot, tilt = robot_called(name), np.array([1.0, 0.06, -0.08, 0.3])
    far = 1.6 * robot.leg_length + robot.body_length
    x = np.arange(-far, far, SPACING * robot.leg_length)
    return Case(robot, np.array([0.3, -0.2, robot.height]), rotation(tilt), x + 0.3, x - 0.2)


def drawn_places(case: Case, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Joint angles drawn within their limits `(n, legs, 3)`, and soles `(legs, n, 3)`, world."""
    robot = case.robot
    low, high = np.maximum(robot.q_min, -np.pi), np.minimum(robot.q_max, np.pi)
    q = rng.uniform(low, high, (DRAWN, robot.n, 3))
    a = robot.arrays
    feet_w = case.position_w + feet_over_time(a.hip, a.leg_frame, a.offset, a.sign, q) @ case.R_wb.T
    return q, feet_w.transpose(1, 0, 2) - robot.foot_radius[:, None, None] * (0.0, 0.0, 1.0)


def ground(case: Case) -> np.ndarray:
    """A hillside with a step in it."""
    h = case.robot.height
    hillside = 0.15 * (case.x[None, :] - 0.3) + 0.0 * case.y[:, None]
    return hillside + np.where(case.y[:, None] > 0.1 * h, 0.2 * h, 0.0)


@pytest.mark.parametrize("name", ROBOTS)
def test_what_is_reached_is_what_angles_within_their_limits_come_to(name: str, rng):
    case = posed(name)
    robot, heights = case.robot, ground(case)
    found = reachable(robot, case.position_w, case.R_wb, (case.x, case.y), heights)
    node = SPACING * robot.leg_length
    _, places = drawn_places(case, rng)
    for leg in range(robot.n):
        mine = np.argwhere(found[leg])
        nodes = np.column_stack([case.x[mine[:, 1]], case.y[mine[:, 0]], heights[found[leg]]])
        assert len(nodes) > 30
        apart, _ = cKDTree(places[leg]).query(nodes)
        assert np.quantile(apart, 0.99) < node and apart.max() < 2.0 * node, robot.legs[leg]


@pytest.mark.parametrize("name", ROBOTS)
def test_places_on_the_ground_that_angles_come_to_are_reached(name: str, rng):
    """Where the leg is then in its own branch, which its answer to the place is to tell."""
    case = posed(name)
    robot, flat = case.robot, np.zeros((len(case.y), len(case.x)))
    found = reachable(robot, case.position_w, case.R_wb, (case.x, case.y), flat)
    q, places = drawn_places(case, rng)
    node = SPACING * robot.leg_length
    for leg in range(robot.n):
        level = np.flatnonzero(np.abs(places[leg][:, 2]) < 0.01 * robot.leg_length)
        answers = (angles(robot, feet(robot, q[k]))[0][leg] for k in level)
        own = [np.allclose(answer, q[k, leg], atol=1e-6) for k, answer in zip(level, answers, strict=True)]
        on = places[leg][level[own]]
        cells = np.round((on[:, :2] - (case.x[0], case.y[0])) / node).astype(int)
        hit = np.zeros(found[leg].shape, dtype=int)
        np.add.at(hit, (cells[:, 1], cells[:, 0]), 1)
        often = hit > 0.3 * np.median(hit[hit > 0])  # at the rim a cell is hit by places beside its node
        grown = found[leg].copy()
        for axis in (0, 1):
            grown |= np.roll(found[leg], 1, axis) | np.roll(found[leg], -1, axis)
        assert often.sum() > 50 and (often & ~grown).sum() <= 0.01 * often.sum(), robot.legs[leg]


@pytest.mark.parametrize("name", ROBOTS)
def test_it_is_what_the_reach_of_each_leg_says(name: str, rng):
    case = posed(name)
    robot, heights = case.robot, ground(case)
    heights[rng.random(heights.shape) < 0.1] = np.nan
    found = reachable(robot, case.position_w, case.R_wb, (case.x, case.y), heights)
    assert not found[:, np.isnan(heights)].any()
    for i, j in rng.integers((0, 0), heights.shape, (400, 2)):
        if np.isnan(heights[i, j]):
            continue
        centres = np.column_stack(
            [np.tile((case.x[j], case.y[i]), (robot.n, 1)), heights[i, j] + robot.foot_radius]
        )
        told = reach(robot, (centres - case.position_w) @ case.R_wb)
        assert [one.code == 0 for one in told] == found[:, i, j].tolist()


# --- centre of mass --------------------------------------------------------------------------------
def test_a_link_of_no_length_is_its_hinge_and_the_last_one_ends_in_the_foot(rng):
    robot = robot_called("dog")
    q = rng.uniform(-1.0, 1.0, (3, robot.n, 3))
    np.testing.assert_allclose(on_link(robot, q, robot.offset[:, 2], 2)[1], feet(robot, q[1]), atol=1e-12)
    np.testing.assert_allclose(on_link(robot, q, np.zeros((robot.n, 3)), 0)[2], robot.hip, atol=1e-12)


def test_the_centre_of_mass_weighs_every_link(rng):
    robot = robot_called("dog")
    q = rng.uniform(-1.0, 1.0, (2, robot.n, 3))
    whole = centres_of_mass(robot, q) * robot.total_mass
    links = sum(
        robot.mass[leg, k] * on_link(robot, q, robot.com[:, k], k)[:, leg]
        for leg in range(4)
        for k in range(3)
    )
    np.testing.assert_allclose(whole, links + robot.base_mass * robot.base_com, atol=1e-12)
