"""A robot does not walk where no foot can stand, says what is there, and walks on where one can."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gaitwright.ground.holes import Hole, dug
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Flat
from gaitwright.numerics.geometry import yaw_quaternion
from gaitwright.perception.known_ground import map_of
from gaitwright.signals import GroundMap, Route, Sensed, SkillCall
from gaitwright.skills.chooser import DefaultChooser, fixed_skill
from gaitwright.skills.foothold_guard import FootholdGuard
from oracles import robot_called

DOG = robot_called("dog")
NOWHERE = Route((), 0.0, None)


def at(scene, x: float, yaw: float = 0.0) -> Sensed:
    """The robot standing at a place of a scene."""
    still, joints = np.zeros(3), np.zeros((4, 3))
    place = np.array([x, 0.0, float(scene.height(x, 0.0)) + DOG.height])
    return Sensed(0.0, place, np.array(yaw_quaternion(yaw)), still, still, joints, joints, np.zeros(4))


def asked(name: str, x: float, speed: float = 0.4, yaw: float = 0.0, route: Route = NOWHERE):
    scene = load_scene(name)
    cautious = FootholdGuard(fixed_skill(DOG, "trot", speed, 0.0, 0.0, "numerical"), DOG)
    return cautious.choose(route, at(scene, x, yaw), ground=map_of(scene, DOG))


@pytest.mark.parametrize(
    "name, x, what", [("gap:0.6", 0.8, "a drop of 0.50 m"), ("stairs:0.3", 1.0, "a wall of 0.30 m")]
)
def test_it_stops_before_what_it_cannot_step_over_or_onto(name: str, x: float, what: str) -> None:
    call = asked(name, x)
    assert call.skill == "stop" and call.velocity == (0.0, 0.0)
    assert call.halt is not None and what in call.halt and call.because == call.halt


@pytest.mark.parametrize(
    "name, x", [("gap:0.15", 0.8), ("stairs:0.10", 1.0), ("rough:0.05", 0.0), ("flat", 0.0)]
)
def test_it_goes_on_where_feet_find_a_place(name: str, x: float) -> None:
    call = asked(name, x)
    assert call.skill == "trot" and call.halt is None


def test_it_may_turn_away_and_walk_back() -> None:
    assert asked("gap:0.6", 0.8, yaw=math.pi).halt is None
    assert asked("gap:0.6", 0.8, speed=0.0).halt is None


def test_it_looks_no_farther_than_the_next_corner_of_its_path() -> None:
    near = Route(((0.85, 0.0), (0.85, 3.0)), 3.0, 0.4)
    assert asked("gap:0.6", 0.8, route=near).halt is None


def test_over_a_gap_the_other_bank_is_no_wall() -> None:
    scene = load_scene("gap:0.2")
    level = at(scene, 1.0).position_w[2]
    over = at(scene, 1.3)
    over.position_w[2] = level
    cautious = FootholdGuard(fixed_skill(DOG, "walk", 0.25, 0.0, 0.0, "numerical"), DOG)
    assert cautious.choose(NOWHERE, over, ground=map_of(scene, DOG)).halt is None


# --- what it tells of what stopped it ------------------------------------------------------------------
def pit(x: float, y: float, lx: float, ly: float) -> Scene:
    outline = ((x, y), (x + lx, y), (x + lx, y + ly), (x, y + ly))
    holes = [Hole(outline, 0.5)]
    return Scene("pit", dug(Flat(), holes), holes=tuple(holes))


def before(scene: Scene, ground: GroundMap | None = None, now: SkillCall | None = None, **route) -> SkillCall:
    cautious = FootholdGuard(DefaultChooser(DOG), DOG)
    path = route.pop("path", ((6.0, 0.0),))
    sensed = replace(
        at(scene, 0.0, route.pop("yaw", 0.0)), velocity_w=np.array([route.pop("speed", 0.0), 0.0, 0.0])
    )
    return cautious.choose(Route(path, 6.0, 0.5), sensed, now, ground or map_of(scene, DOG))


def test_its_rim_is_told_as_far_as_it_goes_on() -> None:
    near = pit(0.5, -0.4, 1.0, 1.2)
    call = before(near)
    assert call.halt is not None and call.blocked is not None and call.blocked.is_seen
    rim = np.array(call.blocked.rim)
    assert np.all((rim[:, 0] > 0.35) & (rim[:, 0] < 0.5)), "its near side, less what feet keep from an edge"
    assert rim[0, 1] == pytest.approx(-0.4, abs=0.1) and rim[-1, 1] == pytest.approx(0.8, abs=0.1)
    assert call.blocked.direction == pytest.approx(0.0)


def test_of_what_was_not_seen_it_is_not_sure() -> None:
    scene = pit(0.5, -0.4, 1.0, 1.2)
    known = map_of(scene, DOG)

    class Hidden:
        """Eyes that have seen nothing beyond 0.3 m."""

        def height(self, x, y):
            return np.where(np.asarray(x) < 0.3, 0.0, np.nan)

    call = before(scene, replace(known, elevation=Hidden()))
    assert call.blocked is not None and not call.blocked.is_seen and len(call.blocked.rim) == 1


def test_it_comes_to_a_stand_before_it_goes_another_way() -> None:
    scene = pit(0.5, -0.4, 1.0, 1.2)
    stopped = before(scene)
    elsewhere = ((0.0, 3.0),)
    assert before(scene, now=stopped, path=elsewhere, speed=0.4) is stopped
    assert before(scene, now=stopped, path=elsewhere).skill == "turn-in-place"


def test_whose_nose_looks_elsewhere_turns_to_its_path_first() -> None:
    scene = pit(0.5, -0.4, 1.0, 0.6)
    aside = before(scene, path=((1.5, 1.0),))
    assert aside.skill == "turn-in-place" and aside.turn > 0.0 and aside.halt is None


def test_a_corner_of_the_path_over_a_hole_is_no_excuse() -> None:
    scene = pit(0.3, -2.0, 1.0, 4.0)
    assert before(scene, path=((0.35, 0.0), (0.35, 3.0))).halt is not None
