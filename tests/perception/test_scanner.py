"""The scanner: slopes, steps, gaps and walls as they are, from wherever the robot stands."""

import math
import time
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Flat, HeightField, Slope
from gaitwright.navigation.navigator import Navigator
from gaitwright.numerics.geometry import yaw_quaternion
from gaitwright.perception.known_ground import KnownGround, map_of
from gaitwright.perception.scanner import SPACING, Scanner, widest_gap
from gaitwright.signals import Mission, Scan, Sensed
from oracles import robot_called

DOG = robot_called("dog")
H = DOG.height


def sensed(place, yaw: float = 0.0) -> Sensed:
    still, joints = np.zeros(3), np.zeros((4, 3))
    return Sensed(1.0, np.array([*place, H]), yaw_quaternion(yaw), still, still, joints, joints, np.ones(4))


def scanner(scene: Scene) -> Callable[[tuple[float, float], float], Scan]:
    """The dog's look at a scene that it knows, from a place in a direction."""
    eyes, ground = Scanner.of(DOG), map_of(scene, DOG)

    def look(place: tuple[float, float], yaw: float) -> Scan:
        scan = eyes.look(ground, place, yaw)
        assert scan is not None
        return scan

    return look


def wide(surface=None, *boxes: Box) -> Scene:
    return Scene("test", surface or Flat(), boxes, (-20.0, -20.0, 20.0, 20.0))


@given(st.floats(-0.6, 0.6), st.floats(-0.4, 0.4), st.floats(-math.pi, math.pi), st.floats(-3.0, 3.0))
def test_on_a_plane_there_is_its_slope_in_the_direction_looked_at_and_nothing_else(pitch, cross, yaw, x):
    scan = scanner(wide(Slope(pitch, cross)))((x, 1.0), yaw)
    along = math.cos(yaw) * math.tan(pitch) + math.sin(yaw) * math.tan(cross)
    aside = -math.sin(yaw) * math.tan(pitch) + math.cos(yaw) * math.tan(cross)
    assert scan.slope == pytest.approx(math.atan(along), abs=1e-9)
    assert scan.cross == pytest.approx(math.atan(aside), abs=1e-9)
    assert max(scan.roughness, scan.step_up, scan.step_down, scan.gap) < 1e-9
    assert scan.obstacle == math.inf and scan.course == yaw


@given(st.floats(0.05, 0.3), st.floats(1.2, 3.0))
def test_a_low_step_is_a_step_and_from_above_a_drop(rise, away):
    step = wide(None, Box(away * H + 2.0, 0.0, 0.0, 4.0, 8.0, rise * H))
    up = scanner(step)((0.0, 0.0), 0.0)
    assert up.obstacle == math.inf and up.slope > 0.0
    # What of it is not sudden is in the slope.
    assert up.step_up + math.tan(up.slope) * SPACING * H == pytest.approx(rise * H, abs=1e-9)
    down = scanner(step)((2.0 * away * H, 0.0), math.pi)
    assert down.step_down + math.tan(-down.slope) * SPACING * H == pytest.approx(rise * H, abs=1e-9)
    assert down.step_down > down.step_up


@given(st.floats(0.54, 5.0), st.floats(0.5, 3.0), st.floats(-math.pi, math.pi))
def test_a_wall_is_an_obstacle_where_it_stands_and_no_road(high, away, yaw):
    c, s = math.cos(yaw), math.sin(yaw)
    far = away * H + 0.3
    wall = Box(far * c, far * s, yaw, 0.6, 0.4, high * H)
    scan = scanner(wide(None, wall))((0.0, 0.0), yaw)
    assert away * H - 1e-9 <= scan.obstacle <= (away + 2 * SPACING) * H + 1e-9
    assert max(scan.step_up, scan.roughness, abs(scan.slope)) < 1e-9, "it hides what is behind it"
    assert scanner(wide(None, wall))((0.0, 0.0), yaw + 1.6).obstacle == math.inf


@pytest.mark.parametrize("width", [0.1, 0.2, 0.3])
def test_a_gap_is_as_wide_as_it_is_and_no_step(width):
    scan = scanner(load_scene(f"gap:{width}"))((0.7, 0.0), 0.0)
    assert scan.gap == pytest.approx(width, abs=1.01 * SPACING * H)
    assert max(scan.step_up, scan.step_down, scan.roughness) < 1e-9 and scan.obstacle == math.inf


@given(st.lists(st.floats(-1.0, 1.0), min_size=3, max_size=20))
def test_a_gap_has_higher_ground_on_both_sides(heights):
    along = 0.1 * np.arange(len(heights))
    falling, rising = np.sort(heights)[::-1].copy(), np.sort(heights)
    assert widest_gap(along, falling, 0.05) == widest_gap(along, rising, 0.05) == 0.0
    assert widest_gap(along, np.array(heights), 0.05) <= 0.1 * (len(heights) - 2) + 1e-9


def test_rougher_ground_is_rougher_and_sizes_do_not_matter(rng):
    field = rng.uniform(-0.02, 0.02, (80, 80))
    rough = [wide(HeightField(-4.0, -4.0, 0.1, k * field)) for k in (1.0, 2.0)]
    one, two = (scanner(scene)((0.0, 0.0), 0.3) for scene in rough)
    assert two.roughness == pytest.approx(2.0 * one.roughness) and one.roughness > 0.0


def test_a_trip_remembers_where_it_has_been():
    scene = load_scene("flat")
    navigator, perception = Navigator(DOG), KnownGround.of(scene, DOG)
    ground = perception.ground
    here = sensed((0.0, 0.0))
    route, memory = navigator.set_out(Mission(((9.0, 0.0),)), here, ground, perception.look(ground, here))
    for x in np.arange(0.0, 2.0, 0.05):
        here = sensed((float(x), 0.0))
        route, memory = navigator.plan(route, here, ground, perception.look(ground, here), memory)
        assert route.ahead is not None and not route.ahead.familiar
    here = sensed((1.8, 0.0), math.pi)
    back, _ = navigator.plan(route, here, ground, perception.look(ground, here), memory)
    assert back.ahead is not None and back.ahead.familiar
    blind = KnownGround.of(scene, DOG, sees=False)
    assert blind.look(blind.ground, here) is None
    assert navigator.plan(route, sensed((2.0, 0.0)), blind.ground, None, memory)[0].ahead == route.ahead


def test_a_look_is_quick():
    looks = scanner(load_scene("blocks", 3))
    times = []
    for _ in range(100):
        began = time.perf_counter()
        looks((1.0, 0.2), 0.1)
        times.append(time.perf_counter() - began)
    assert min(times) < 1e-3
