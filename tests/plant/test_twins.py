"""A twin goes the way of its original to the bit, and neither feels the other."""

import numpy as np
import pytest

from gaitwright.errors import WrongUse
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain
from gaitwright.plant.faults import FaultyPlant, breakdown
from gaitwright.plant.imperfections import Imperfections
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.plant.registry import make_plant
from gaitwright.plant.twins import twin
from gaitwright.session import Session
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill
from oracles import robot_called

GO2 = robot_called("go2")


def walked(plant, scene, ticks: int, driver: str = "numerical") -> Session:
    brain = Brain.of(GO2, scene, fixed_skill(GO2, "trot", 0.4, 0.0, 0.0, driver))
    session = Session(brain, plant, Mission(()), 9.0, 3)
    for _ in range(ticks):
        session.step()
    return session


@pytest.mark.parametrize("name", ["flat", "slippery"])
def test_under_equal_commands_both_go_the_same_way(name: str) -> None:
    scene = load_scene(name)
    session = walked(MujocoPlant(GO2, scene), scene, 150)
    plant, other = session.plant, twin(session.plant, GO2, session.measured)
    command = session.lap.command
    here = [plant.step(command).row for _ in range(60)]
    there = [other.step(command).row for _ in range(60)]
    np.testing.assert_array_equal(here, there)


def test_what_a_twin_does_is_not_felt() -> None:
    scene = load_scene("flat")
    alone, watched = (walked(MujocoPlant(GO2, scene), scene, 100) for _ in range(2))
    other = twin(watched.plant, GO2, watched.measured)
    other.push((300.0, 0.0, 0.0))
    for _ in range(50):
        other.step(watched.lap.command)
    for _ in range(50):
        alone.step()
        watched.step()
    np.testing.assert_array_equal(alone.measured.row, watched.measured.row)
    assert np.abs(other.sense().position_w - alone.measured.position_w).max() > 0.01


def test_a_broken_robot_has_a_broken_twin_with_the_same_noise() -> None:
    scene = load_scene("flat")
    dead = breakdown(GO2, "motor-dead", "FL", "knee", at=0.1)
    plant = FaultyPlant(MujocoPlant(GO2, scene), GO2, (dead,), Imperfections(angle=0.01))
    session = walked(plant, scene, 100)
    other, command = twin(plant, GO2, session.measured), session.lap.command
    here, there = plant.step(command), other.step(command)
    np.testing.assert_array_equal(here.row, there.row)
    assert np.abs(here.q - plant.truth.q).max() > 1e-4, "its sensors are not exact"


def test_a_robot_of_another_plant_stands_in_physics_as_it_was_measured() -> None:
    scene = load_scene("flat")
    session = walked(make_plant("kinematic", GO2, scene), scene, 100, "kinematic")
    other = twin(session.plant, GO2, session.measured)
    found, wanted = other.sense(), session.measured
    np.testing.assert_allclose(found.q, wanted.q)
    np.testing.assert_allclose(found.position_w, wanted.position_w)
    assert found.time == wanted.time


def test_a_plant_that_says_nothing_of_its_world_has_none() -> None:
    class Telephone:
        dt = 0.002

        def reset(self, seed: int = 0, vary: bool = True):
            return MujocoPlant(GO2, scene).reset(seed, vary)

        def step(self, command):
            return self.reset()

    scene = load_scene("flat")
    with pytest.raises(WrongUse, match="a Telephone tells nobody"):
        twin(Telephone(), GO2, MujocoPlant(GO2, scene).sense())
