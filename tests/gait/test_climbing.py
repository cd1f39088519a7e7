"""The thesis's stairway: its robot climbs 45° with its body tilted, and not without; every check checked."""

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from gaitwright.errors import WrongUse
from gaitwright.gait.climb.checks import balance_room, checked, links
from gaitwright.gait.climb.climber import Climber, climb_call
from gaitwright.gait.climb.motion import motion
from gaitwright.gait.climb.plan import Ascent, climb, foothold, order_of
from gaitwright.ground.layouts import flight, stairway
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.locomotion import Brain
from gaitwright.model.kinematics import feet
from gaitwright.numerics.geometry import quaternion_of
from gaitwright.numerics.polygon import hull, leaned, margins
from gaitwright.plant.closure import Closure
from gaitwright.plant.kinematic import KinematicPlant
from gaitwright.session import walk
from gaitwright.signals import Mission, Sensed
from gaitwright.skills.chooser import HeldSkill
from oracles import robot_called

seeds = st.integers(0, 2**32 - 1)
TREAD = 0.99
"""As deep as a step of the thesis's stairway is high [m]."""


def stairs(degrees: float, start: float = 0.0) -> Scene:
    """A stairway for the thesis's robot that begins at 13.5 m."""
    layout = flight(TREAD * np.tan(np.radians(degrees)), TREAD, 9.0)
    return Scene("stairway", *layout[:3], start=(start, 0.0, 0.0))


@cache
def ascent() -> Ascent:
    """The thesis's robot up and down its stairway."""
    return climb(robot_called("thesis"), stairs(45.0, 9.0))


# --- the climb -----------------------------------------------------------------------------------
def test_the_thesis_robot_climbs_its_stairway_and_comes_down_again() -> None:
    climbed = ascent()
    assert climbed.faults == ()
    assert min(climbed.margins[i] for i in (0, 2, 3, 4)) > 0.0
    assert climbed.margins.foot == pytest.approx(0.0, abs=1e-9)
    height = climbed.motion.feet_w[:, :, 2]
    assert (height.max(axis=0) > 6 * TREAD).all(), "every foot has been on the platform"
    np.testing.assert_allclose(height[[0, -1]], 0.05, atol=1e-9)
    pitch = np.degrees(np.arcsin(-climbed.motion.rotation_wb[:, 2, 0]))
    assert pitch.min() == pytest.approx(-45.0, abs=0.5) and pitch.max() == pytest.approx(45.0, abs=0.5)


def test_without_tilting_its_body_it_cannot() -> None:
    """The thesis: it "could not climb them without tilting its body"."""
    level = climb(robot_called("thesis"), stairs(45.0, 9.0), distance=8.0, tilts=False)
    assert any("beyond its limit" in fault or "stretched leg" in fault for fault in level.faults)


def test_what_is_too_steep_is_told_with_leg_and_time() -> None:
    steep = climb(robot_called("thesis"), stairs(60.0, 9.0), distance=8.0)
    told = " ".join(steep.faults)
    assert re.search(r"leg (FL|FR|RL|RR): (the foot is|hip 2 would|knee would) .* at \d+\.\d\d s", told), told
    assert steep.margins.joint < 0.0 or "the stretched leg is 5 m" in told


def test_the_scene_as_it_will_be_called_rises_at_45_degrees() -> None:
    scene = Scene("stairway", *stairway(0.11, 9.0, np.random.default_rng(0))[:3])
    tops = sorted(scene.top(box) for box in scene.boxes)
    np.testing.assert_allclose(np.diff(tops), 0.99)
    edges = sorted(box.x - box.lx / 2 for box in scene.boxes)
    np.testing.assert_allclose(np.diff(edges), 0.99)
    assert len(tops) >= 5 and scene.bounds[2] > max(box.x + box.lx / 2 for box in scene.boxes) + 20.0


@pytest.mark.parametrize("name", ["go2", "hexapod"])
def test_other_robots_climb_what_fits_them(name: str) -> None:
    robot = robot_called(name)
    tread = 0.38 * robot.height
    scene = Scene("stairs", *flight(0.4 * tread, tread, 0.3, steps=2)[:3])
    climbed = climb(robot, scene, distance=0.3 * 1.5 + 2 * tread)
    assert climbed.faults == ()
    assert {step.leg for step in climbed.steps} == set(range(robot.n))


# --- its parts, against others -------------------------------------------------------------------
def test_feet_stand_still_and_the_joints_put_them_there() -> None:
    climbed, robot = ascent(), robot_called("thesis")
    made = climbed.motion
    for i in np.linspace(0, len(made.time) - 1, 60).astype(int):
        by_joints = made.position_w[i] + feet(robot, made.q[i]) @ made.rotation_wb[i].T
        np.testing.assert_allclose(by_joints, made.feet_w[i], atol=1e-9)
    stay = made.stance[1:] & made.stance[:-1]
    assert np.abs(np.diff(made.feet_w, axis=0)[stay]).max() < 1e-12
    assert (made.stance.sum(axis=1) >= 3).all()


def test_feet_that_stand_are_in_the_middle_of_their_treads() -> None:
    scene, made = stairs(45.0), ascent().motion
    x = made.feet_w[..., 0][made.stance]
    first, last = 13.5, 13.5 + 5 * TREAD
    on_stairs = x[(x > first) & (x < last)]
    assert len(np.unique(np.floor((on_stairs - first) / TREAD))) == 5
    np.testing.assert_allclose((on_stairs - first) / TREAD % 1.0, 0.5, atol=0.01)
    standing = made.feet_w[made.stance]
    np.testing.assert_allclose(standing[:, 2], scene.height(standing[:, 0], standing[:, 1]) + 0.05)


def test_body_and_feet_never_jump() -> None:
    climbed, robot = ascent(), robot_called("thesis")
    fine = motion(robot, climbed.steps, climbed.seconds, 60.0 + 1e-3 * np.arange(8000))
    speed = 2.0 * np.sqrt(9.81 * robot.height)
    assert np.abs(np.diff(fine.feet_w, axis=0)).max() < 1e-3 * speed
    assert np.abs(np.diff(fine.position_w, axis=0)).max() < 1e-3 * speed
    assert np.abs(np.diff(fine.q, axis=0)).max() < 1e-3 * 10.0


@given(seeds)
@settings(max_examples=20)
def test_the_centre_of_mass_is_that_of_the_tree(seed: int) -> None:
    rng = np.random.default_rng(seed)
    for name in ("dog", "insect", "thesis", "hexapod"):
        robot = robot_called(name)
        q = rng.uniform(-1.5, 1.5, (1, robot.n, 3))
        zero = np.zeros((robot.n, 3))
        at_rest = Sensed(
            0.0, np.zeros(3), quaternion_of(np.eye(3)), np.zeros(3), np.zeros(3), q[0], zero, zero[:, 0]
        )
        of = links(robot, q)
        np.testing.assert_allclose(of.centre[0], Closure(robot, 0.01).centre_of_mass(at_rest), atol=1e-12)
        np.testing.assert_allclose(of.foot[0], feet(robot, q[0]), atol=1e-12)


@given(seeds, st.integers(3, 12))
def test_the_support_polygon_is_qhulls(seed: int, count: int) -> None:
    points = np.random.default_rng(seed).normal(size=(count, 2))
    oracle = ConvexHull(points)
    corners = hull(points)
    assert {tuple(p) for p in corners} == {tuple(points[i]) for i in oracle.vertices}
    places = np.random.default_rng(seed + 1).normal(size=(20, 2))
    away = (oracle.equations[:, :2] @ places.T + oracle.equations[:, 2:]).max(axis=0)
    np.testing.assert_allclose(margins(corners, places), -away, atol=1e-9)


@given(seeds, st.floats(0.0, 0.5))
def test_a_point_is_leaned_no_farther_than_it_must(seed: int, margin: float) -> None:
    rng = np.random.default_rng(seed)
    corners, point = hull(rng.normal(size=(5, 2))), 2.0 * rng.normal(size=2)
    moved = leaned(corners, point, margin)
    inside, most = margins(corners, moved[None])[0], margins(corners, corners.mean(axis=0)[None])[0]
    assert inside >= min(margin, most) - 1e-9
    if margins(corners, point[None])[0] >= margin:
        np.testing.assert_array_equal(moved, point)
    elif most > margin:
        assert inside == pytest.approx(margin, abs=1e-6)


def test_feet_on_a_line_or_in_a_point_support_nothing() -> None:
    line = hull(np.array([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]))
    found = margins(line, np.array([[1.0, 1.0], [1.0, 2.0], [3.0, 3.0]]))
    np.testing.assert_allclose(found, [0.0, -np.sqrt(0.5), -np.sqrt(2.0)], atol=1e-12)
    np.testing.assert_allclose(margins(line[:1], np.array([[3.0, 4.0]])), [-5.0])
    assert margins(np.empty((0, 2)), np.zeros((1, 2)))[0] == -np.inf


# --- the checks see what is wrong ------------------------------------------------------------------
@pytest.mark.parametrize(
    ("spoil", "told"),
    [
        (lambda m: replace(m, feet_w=m.feet_w - [0.0, 0.0, 0.01]), "its foot is 0.01 m inside the ground"),
        (lambda m: replace(m, position_w=m.position_w - [0.0, 0.0, 3.0]), "the trunk is "),
        (lambda m: replace(m, position_w=m.position_w - [0.0, 0.0, 3.0]), "its thigh or shank is "),
        (
            lambda m: replace(m, position_w=m.position_w + np.array([4.0, 0.0, 0.0])),
            "outside the support of ",
        ),
        (lambda m: replace(m, q=m.q + 1.0), "beyond its limit of "),
    ],
)
def test_a_spoilt_motion_is_found_out(spoil, told: str) -> None:
    climbed = ascent()
    _, faults = checked(robot_called("thesis"), stairs(45.0), spoil(climbed.at(climbed.motion.time[::40])))
    assert any(told in fault and fault.endswith(("s", "rad")) for fault in faults), faults


def test_balance_is_judged_by_the_feet_that_stand() -> None:
    climbed, robot = ascent(), robot_called("thesis")
    made = climbed.at(np.array([0.0]))
    all_four = balance_room(made, links(robot, made.q))[0]
    made.stance[0, 0] = False
    assert balance_room(made, links(robot, made.q))[0] < all_four


def test_a_foot_keeps_from_edges_and_takes_the_middle_of_a_narrow_tread() -> None:
    robot, scene = robot_called("thesis"), stairs(45.0)
    assert foothold(robot, scene, 0, 13.5 + 0.2 * TREAD, 3.0)[0] == pytest.approx(
        13.5 + 0.5 * TREAD, abs=0.01
    )
    assert foothold(robot, scene, 0, 13.45, 3.0)[0] == pytest.approx(13.5 - 0.2 * 2.55, abs=0.01)
    np.testing.assert_allclose(foothold(robot, scene, 0, 2.0, 3.0), [2.0, 3.0, 0.05])


def test_legs_are_lifted_as_a_walk_lifts_them() -> None:
    assert order_of(4) == (2, 0, 3, 1)
    assert order_of(6) == (4, 2, 0, 5, 3, 1)


@pytest.mark.parametrize("asked", [{"distance": 0.0}, {"distance": np.inf}, {"stride": -1.0}, {"dt": np.nan}])
def test_numbers_that_are_none_are_refused(asked) -> None:
    with pytest.raises(WrongUse, match="expected a finite number above 0"):
        climb(robot_called("thesis"), load_scene("flat"), **{"distance": 1.0} | asked)


def test_a_start_that_looks_elsewhere_is_refused() -> None:
    turned = replace(load_scene("flat"), start=(0.0, 0.0, 0.5))
    with pytest.raises(WrongUse, match=r"looks 0.5 rad off"):
        climb(robot_called("thesis"), turned, 1.0)


# --- as a trip -----------------------------------------------------------------------------------
def test_the_kinematic_driver_goes_through_a_climb_with_a_report() -> None:
    """The same way, feet and joints as planned, tick by tick, and the same report as any skill's."""
    robot, scene, dt = robot_called("thesis"), stairs(45.0, 9.0), 0.1
    short = climb(robot, scene, distance=6.0)
    chooser = HeldSkill(climb_call(short, "kinematic"))
    brain = replace(Brain.of(robot, scene, chooser, dt), chooser=chooser, coordinator=Climber(short, dt))
    seconds = len(short.steps) * short.seconds
    plant = KinematicPlant(robot, scene, dt)
    record = walk(brain, plant, Mission((), None, "kinematic"), seconds, vary=False, scene=scene.name)
    report = record.report()
    assert report.stopped_because.endswith("asked for are over") and report.falls == 0
    assert report.driver_share == {"kinematic": 1.0} and report.skills == ["climb"]
    planned = short.at(record["time"])
    np.testing.assert_allclose(record["position_w"][1:], planned.position_w[1:], atol=1e-9)
    np.testing.assert_allclose(record["q"].reshape(-1, 4, 3)[1:], planned.q[1:], atol=1e-9)
    assert record["position_w"][-1, 2] > 2.55 + 1.0, "it is well up the stairs"
