"""A robot does not walk where no foot can stand, says what is there, and walks on where one can."""

import math

import numpy as np
import pytest

from gaitwright.ground.scene import load_scene
from gaitwright.numerics.geometry import yaw_quaternion
from gaitwright.perception.known_ground import map_of
from gaitwright.signals import Route, Sensed
from gaitwright.skills.chooser import fixed_skill
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
