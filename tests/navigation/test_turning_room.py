"""Where there is no room to turn in place: how a robot goes on, and where it goes first."""

import math

import numpy as np
import pytest
import shapely
from plane_world import box_at
from shapely import LineString, Polygon

from gaitwright.description.load import load_robot
from gaitwright.navigation.footprint import footprint_of
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.navigation.paths import begin_of, length
from gaitwright.navigation.room_needed import half_width
from gaitwright.navigation.turning_room import (
    FREE,
    SPARE,
    Turning,
    come_along,
    going,
    room_to_turn,
)
from gaitwright.signals import Sight

GO2 = load_robot("go2")
BODY = footprint_of(GO2)
BOUNDS = (-6.0, -6.0, 6.0, 6.0)
WANTED = (1.0 + SPARE) * BODY.radius


def known(*boxes: list[tuple[float, float]]) -> LearnedMap:
    return LearnedMap.of_polygons(BOUNDS, half_width(GO2), boxes)


def asked(field: LearnedMap, pose, path, trail=()) -> Turning | None:
    return room_to_turn(field, BODY, pose, tuple(path), tuple(trail))


def room(boxes, place) -> float:
    return min(Polygon(box).distance(shapely.Point(place)) for box in boxes)


SIDES = [box_at(0.0, y, 6.0, 0.1) for y in (0.35, -0.35)]
END = box_at(3.05, 0.0, 0.1, 0.8)
"""A corridor of 0.6 m along x, from -3 to 3, and what shuts it ahead."""


# --- nothing to do ----------------------------------------------------------------------------------
def test_in_the_open_it_turns_in_place() -> None:
    for angle in np.linspace(-3.1, 3.1, 9):
        path = [(math.cos(angle), math.sin(angle))]
        assert asked(known(box_at(3.0, 0.0, 0.5, 0.5)), (0.0, 0.0, 0.0), path) == FREE


def test_whoever_looks_along_the_path_need_not_turn() -> None:
    assert asked(known(*SIDES), (0.0, 0.0, 0.0), [(2.0, 0.0)]) == FREE
    assert asked(known(*SIDES), (0.0, 0.0, math.radians(14)), [(2.0, 0.0)]) == FREE


# --- going on ---------------------------------------------------------------------------------------
@pytest.mark.parametrize("angle", [60.0, 90.0, 150.0, 179.0])
def test_beside_a_wall_it_goes_on_and_turns_as_far_as_there_is_room(angle: float) -> None:
    wall = box_at(0.0, -0.25, 6.0, 0.1)
    path = [(2.0 * math.cos(math.radians(angle)), 2.0 * math.sin(math.radians(angle)))]
    turning = asked(known(wall), (0.0, 0.0, 0.0), path)
    assert turning is not None and turning != FREE
    if turning.aside:  # first to where there is room
        assert room([wall], turning.aside[-1]) >= WANTED - 1e-6
        assert length((0.0, 0.0), turning.aside) < 0.35
    else:
        assert turning.facing is not None and 0.0 <= turning.facing < math.radians(angle)


# --- aside ------------------------------------------------------------------------------------------
def test_out_of_a_dead_end_it_goes_back_the_way_it_came() -> None:
    boxes = [*SIDES, END]
    field = known(*boxes)
    trail = [(-4.0 + 0.11 * k, 0.0) for k in range(int(6.0 / 0.11) + 1)]
    here = trail[-1]
    turning = asked(field, (*here, 0.0), field.way(here, (0.0, 3.0)).path, trail)
    assert turning is not None and turning.aside
    assert room(boxes, turning.aside[-1]) >= WANTED - 1e-6 and turning.aside[-1][0] < -3.0
    assert turning.facing == pytest.approx(0.0), "backwards: it looks to where it does not go"
    assert all(abs(y) < 1e-9 for _, y in turning.aside)


def test_without_a_trail_it_goes_straight_back_where_that_was_seen() -> None:
    boxes, here = [*SIDES, END], (-0.5, 0.0)
    field = known(*boxes)
    turning = asked(field, (*here, 0.0), field.way(here, (0.0, 3.0)).path)
    assert turning is not None and len(turning.aside) == 1
    assert room(boxes, turning.aside[0]) >= WANTED - 1e-6


def test_it_does_not_go_where_it_has_never_looked() -> None:
    """The same corridor, of which nothing but the walls was seen: nowhere to go to."""
    boxes, here = [*SIDES, END], (-0.5, 0.0)
    edges = np.concatenate([np.hstack([np.array(b), np.roll(np.array(b), -1, axis=0)]) for b in boxes])
    empty = LearnedMap.of(BOUNDS, half_width(GO2))
    seen = empty.seen(Sight(here, edges, np.ones((len(edges), 2), bool), np.empty((0, 2))))
    assert asked(seen, (*here, 0.0), seen.way(here, (0.0, 3.0)).path) is None


def test_round_a_corner_it_goes_backwards_along_its_path() -> None:
    """Straight back is a wall: the corridor turns."""
    boxes = [
        box_at(0.0, 0.35, 3.4, 0.1),
        box_at(0.35, -0.35, 2.7, 0.1),
        box_at(1.75, 0.0, 0.1, 0.8),
        box_at(-1.65, -1.3, 0.1, 3.4),
        box_at(-0.95, -1.7, 0.1, 2.6),
    ]
    field = known(*boxes)
    start = (0.9, 0.0)
    path = field.way(start, (-1.3, -5.0)).path
    turning = asked(field, (*start, 0.0), path)
    assert turning is not None and len(turning.aside) > 2
    assert room(boxes, turning.aside[-1]) >= WANTED - 0.02
    assert LineString([start, *turning.aside]).distance(LineString([(-1.3, -2.5), (-1.3, -3.0)])) < 0.5


def test_in_a_pen_there_is_no_room_and_nowhere_to_go() -> None:
    pen = [*SIDES, END, box_at(2.0, 0.0, 0.1, 0.8)]
    assert asked(known(*pen), (2.5, 0.0, 0.0), [(0.0, 0.0)], [(2.5, 0.0)]) is None


def test_whoever_is_on_the_way_aside_looks_where_it_came_from_or_as_it_stood() -> None:
    field = known(*SIDES, END)
    assert going(field, BODY, (1.0, 0.0, 0.05), ((0.0, 0.0),)).facing == pytest.approx(0.0, abs=1e-6)
    side = going(field, BODY, (1.0, 0.0, 0.05), ((1.0, 0.1),))
    assert side.facing == 0.05 and side.aside == ((1.0, 0.1),)


# --- the trail --------------------------------------------------------------------------------------
def test_a_trail_has_no_loops_and_shortens_where_the_robot_goes_back() -> None:
    there = [(x, 0.0) for x in np.arange(0.0, 2.0, 0.02).tolist()]
    trail = come_along((), there[0], BODY)
    for here in there:
        trail = come_along(trail, here, BODY)
    assert 15 < len(trail) < 25 and trail[0] == (0.0, 0.0)
    whole = trail
    for here in there[::-1][:50]:
        trail = come_along(trail, here, BODY)
    assert trail == whole[: len(trail)] and trail[-1][0] == pytest.approx(1.0, abs=0.15)
    turns = np.linspace(0.0, 2.0 * math.pi, 100)
    for here in zip((1.0 + np.sin(turns)).tolist(), (1.0 - np.cos(turns)).tolist(), strict=True):
        trail = come_along(trail, here, BODY)
    assert len(trail) < 15, "a loop leads to where it began"


def test_the_beginning_of_a_path_is_so_long() -> None:
    path = ((1.0, 0.0), (1.0, 2.0))
    assert begin_of((0.0, 0.0), path, 0.5) == ((0.5, 0.0),)
    assert begin_of((0.0, 0.0), path, 1.5) == ((1.0, 0.0), (1.0, 0.5))
    assert begin_of((0.0, 0.0), path, 9.0) == path
