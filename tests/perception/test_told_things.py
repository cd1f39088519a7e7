"""Who knows a scene is told at every look what moves in it, and plans anew where something else stands."""

from dataclasses import replace

import numpy as np
import pytest

from gaitwright.ground.moving import Mover
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.solids import Cylinder
from gaitwright.ground.terrain import Box, Flat
from gaitwright.locomotion import Brain
from gaitwright.perception.estimated_state import EstimatedState
from gaitwright.perception.known_ground import KnownGround
from gaitwright.perception.told_things import EVERY, STANDS, ToldThings, with_things
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import Session
from gaitwright.signals import Measured, Mission
from oracles import robot_called
from sights import posed

GO2 = robot_called("go2")
POST = Cylinder(3.0, 1.0, 0.2, 0.6)
GOES = Mover(POST, ((3.0, -1.0),), 0.5, begins=2.0)
"""Stands until 2 s, moves until 6 s, then stands at (3, -1)."""
COMES = Mover(Box(5.0, 0.0, 0.0, 0.5, 0.5, 0.5), appears=3.0, vanishes=5.0)
YARD = Scene("yard", Flat(), (Box(1.5, 2.0, 0.0, 0.4, 0.4, 0.5),), movers=(GOES, COMES))


def measured(time: float) -> Measured:
    sensed = posed(GO2, YARD, (0.0, 0.0), time=time)
    return Measured.of_row(sensed.row, time=time, specific_force_b=(0.0, 0.0, 9.81))


def told(times, perception) -> list:
    memory, grounds = None, []
    for time in times:
        _, ground, memory = perception.perceive(measured(time), memory)
        grounds.append(ground)
    return grounds


def known(scene: Scene = YARD) -> ToldThings:
    perception = with_things(KnownGround.of(scene, GO2), scene, GO2)
    assert isinstance(perception, ToldThings)
    return perception


def test_a_scene_in_which_nothing_moves_is_known_as_before() -> None:
    plain = KnownGround.of(load_scene("blocks", 1), GO2)
    assert with_things(plain, load_scene("blocks", 1), GO2) is plain


def test_what_stands_is_an_obstacle_and_what_moves_is_not() -> None:
    before, goes, both, after, last = told((0.0, 2.5, 4.0, 5.5, 7.0), known())
    assert [len(one.obstacles) for one in (before, goes, both, after, last)] == [2, 1, 2, 1, 2]
    assert [len(one.moving) for one in (before, goes, both, after, last)] == [0, 1, 1, 1, 0]
    (moving,) = both.moving
    np.testing.assert_allclose(moving.edge.mean(axis=0), (3.0, 0.0), atol=1e-9)
    assert moving.velocity == (0.0, -0.5) and moving.time == 4.0
    np.testing.assert_allclose(last.obstacles[-1].mean(axis=0), (3.0, -1.0), atol=1e-9)


def test_feet_and_scanner_know_what_stands_at_that_time() -> None:
    before, last = told((0.0, 7.0), known())
    heights = [[float(one.elevation.height(3.0, y)) for y in (1.0, -1.0)] for one in (before, last)]
    assert heights == [[0.6, 0.0], [0.0, 0.6]]
    x, y, spacing = before.footholds.place
    node = round((2.0 - y) / spacing), round((1.5 - x) / spacing)
    assert before.footholds.heights[node] == 0.5


def test_the_map_is_another_one_only_where_something_else_stands() -> None:
    times = [EVERY * k for k in range(80)]
    grounds = told(times, known())
    other = [k for k in range(1, len(grounds)) if grounds[k].obstacles is not grounds[k - 1].obstacles]
    assert [times[k] for k in other] == pytest.approx([2.0, 3.0, 5.0, 6.0])
    assert all(one.footholds is grounds[0].footholds for one in grounds[: other[0]])


def test_between_looks_the_same_is_known() -> None:
    first, same, other = told((4.0, 4.0 + 0.9 * EVERY, 4.0 + EVERY), known())
    assert same is first and other is not first


def test_who_is_told_nothing_of_motion_knows_all_as_standing() -> None:
    (ground,) = told((4.0,), replace(known(), apart=False))
    assert ground.moving == () and len(ground.obstacles) == 3


def test_what_creeps_stands() -> None:
    slow = replace(YARD, movers=(Mover(POST, ((3.0, -1.0),), 0.9 * STANDS),))
    (ground,) = told((4.0,), known(slow))
    assert ground.moving == () and len(ground.obstacles) == 2


def test_who_estimates_its_state_is_told_too() -> None:
    estimating = EstimatedState(KnownGround.of(YARD, GO2), GO2, 0.002)
    perception = with_things(estimating, YARD, GO2)
    first, other = told((0.0, 2.5), perception)
    assert not first.moving and len(other.moving) == 1


def test_told_of_another_arrangement_it_knows_that_one() -> None:
    calm = replace(YARD, movers=())
    assert isinstance(known().told(calm, GO2), KnownGround)
    assert isinstance(with_things(KnownGround.of(calm, GO2).told(YARD, GO2), YARD, GO2), ToldThings)


# --- the way -----------------------------------------------------------------------------------------
def test_what_appears_is_walked_around_and_way_points_behind_are_left_behind() -> None:
    appears = Mover(Box(2.4, 0.0, 0.0, 0.4, 0.8, 0.5), appears=2.0)
    scene = Scene("yard", Flat(), (), (-2.0, -4.0, 6.0, 4.0), movers=(appears,))
    mission = Mission(((0.4, 0.0), (4.0, 0.0)))
    session = Session(Brain.of(GO2, scene), MujocoPlant(GO2, scene), mission, 30.0, 1)
    anew, places = None, []
    for lap in session:
        if anew is None and len(lap.route.path) > 1 and lap.sensed.time > 1.99:
            anew = lap.sensed.time, lap.route.path
        places.append(lap.sensed.position_w[:2])
    assert session.lap is not None and session.lap.arrived, session.lap
    assert anew is not None and anew[0] == pytest.approx(2.0, abs=0.11) and (0.4, 0.0) not in anew[1]
    away = np.maximum(np.abs(np.array(places) - (2.4, 0.0)) - (0.2, 0.4), 0.0)
    assert np.hypot(*away.T)[1000:].min() > 0.15
