"""The shapes behind the curves: periodic, never overshooting, the same in every leg's mirror."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.gait.leg_cycles.files import cycle_of
from gaitwright.signals import Gait
from gaitwright.studio.curve_angle import AngleCurve
from gaitwright.studio.curve_cycle import CycleCurve
from gaitwright.studio.curve_history import LONGEST, History, Snapshot
from gaitwright.studio.curve_periodic import through
from gaitwright.studio.curve_torque import turns
from gaitwright.studio.curve_walk import Walk
from oracles import robot_called

GO2 = robot_called("go2")


@given(st.lists(st.floats(-50.0, 50.0), min_size=4, max_size=16), st.floats(0.0, 0.05))
def test_a_periodic_curve_passes_its_points_closes_and_never_overshoots(
    values: list[float], first: float
) -> None:
    phases = first + np.arange(len(values)) / len(values)
    y = np.array(values)[:, None]
    np.testing.assert_allclose(through(phases, y, phases), y, atol=1e-9)
    at = np.linspace(0.0, 1.0, 501)
    line = through(phases, y, at)[:, 0]
    assert line[0] == pytest.approx(line[-1], abs=1e-9)
    between = np.searchsorted(phases, at, side="right") - 1
    low = np.minimum(y[between, 0], y[(between + 1) % len(y), 0])
    high = np.maximum(y[between, 0], y[(between + 1) % len(y), 0])
    assert (line >= low - 1e-9).all() and (line <= high + 1e-9).all()


def test_a_point_moves_the_curve_near_it_alone() -> None:
    phases, y = np.arange(12) / 12, np.zeros((12, 1))
    y[6] = 1.0
    line = through(phases, y, np.arange(120) / 120)[:, 0]
    assert (line[:50] == 0.0).all() and (line[70:] == 0.0).all() and line[60] == 1.0
    ends = through(phases, np.roll(y, 6, axis=0), np.array([0.0, 0.95, 0.05]))[:, 0]
    assert ends[0] == 1.0 and ends[1] == pytest.approx(ends[2]) and 0.0 < ends[1] < 1.0


@pytest.mark.parametrize("name", ["go2", "hexapod", "thesis"])
def test_a_mirror_of_a_mirror_is_the_leg_itself(name: str) -> None:
    robot = robot_called(name)
    for leg in range(robot.n):
        for other in range(robot.n):
            assert (turns(robot, leg, other) * turns(robot, other, leg) == 1.0).all()
        assert (turns(robot, leg, leg) == 1.0).all()
    assert turns(GO2, 0, 1).tolist() == [-1.0, 1.0, 1.0]
    assert turns(GO2, 0, 2).tolist() == [1.0, 1.0, 1.0]


@pytest.mark.parametrize("skill", ["trot", "climb", "gallop"])
def test_angles_and_path_are_one_motion(skill: str) -> None:
    walk = Walk.of(GO2, skill)
    cycle = cycle_of(skill)
    own = np.linspace(0.0, 1.0, 33)
    for leg in (0, 3):
        path = walk.path(cycle, leg, own)
        back = walk.feet(leg, walk.angles(leg, path))
        np.testing.assert_allclose(back[:, :2] @ walk.way / walk.stride, path[:, 0], atol=1e-9)
        np.testing.assert_allclose(back[:, 2] / GO2.height, path[:, 1], atol=1e-9)
        assert path[0, 0] == pytest.approx(path[-1, 0]) and path[-1, 1] == pytest.approx(0.0, abs=1e-12), (
            "it is closed"
        )


def test_an_angle_is_what_the_foot_has_afterwards() -> None:
    walk = Walk.of(GO2, "trot")
    curve = AngleCurve(walk, cycle_of("trot"), 2)
    points = curve.points
    points[2][3] -= 0.03
    points.insert(4, [*np.mean([points[3], points[4]], axis=0)])
    new = curve.edited(points, mirror=False)
    assert new.hind is not None and new.points == cycle_of("trot").points, "RL is a hind leg"
    found = np.array(AngleCurve(walk, new, 2).points)
    np.testing.assert_allclose(found[2], points[2], atol=1e-6)
    kept = [0, 1, 3, 5, 6, 7]
    np.testing.assert_array_equal(found[kept], np.array(points)[kept])


def test_on_the_spot_an_angle_says_only_how_high_the_foot_is() -> None:
    walk = Walk.of(GO2, "turn-in-place")
    curve = AngleCurve(walk, cycle_of("trot"), 0)
    points = curve.points
    points[3][3] -= 0.02
    new = curve.edited(points, mirror=True)
    (_, forward, height), (_, x, z) = new.points[3], cycle_of("trot").points[3]
    assert forward == pytest.approx(x, abs=1e-12) and height > z + 0.01


def test_a_fault_that_was_there_before_is_not_held_against_an_edit() -> None:
    hasty = Walk(GO2, Gait("trot", 0.16, 0.6, (0.0, 0.5, 0.5, 0.0)), (0.4, 0.0), 0.0)
    points = [list(point) for point in cycle_of("trot").points]
    for point in points:
        point[2] *= 0.95
    assert not hasattr(CycleCurve(hasty, cycle_of("trot"), 0).edited(points, True), "because")
    points[3][2] += 0.1
    assert "knee would turn at" in CycleCurve(hasty, cycle_of("trot"), 0).edited(points, True).because


def test_the_oldest_steps_are_forgotten() -> None:
    history, steps = History(), [Snapshot() for _ in range(LONGEST + 5)]
    for step in steps:
        history.add(step)
    for step in reversed(steps[4:-1]):
        assert history.undo() is step
    assert not history.before and len(history.behind) == LONGEST
    history.add(Snapshot())
    assert not history.behind, "a new edit ends what could be done again"
