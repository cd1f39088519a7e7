"""From gait to gait: the new one begins where its legs are nearest, once the robot is slow enough."""

from dataclasses import replace

import numpy as np
import pytest

from gaitwright.gait.coordinator import Coordinator
from gaitwright.gait.desired_cycle import desired_cycle
from gaitwright.gait.transition import may_start
from gaitwright.signals import Gait, SkillCall
from gaitwright.skills.library import LIBRARY, gait_of, skill_names
from oracles import robot_called

DOG = robot_called("dog")
DT = 0.002
MOVING = [name for name in skill_names(4) if LIBRARY[name].duty < 1.0]


def call_of(gait: Gait, velocity: tuple[float, float] = (0.4, 0.0)) -> SkillCall:
    return SkillCall(gait.name, gait, velocity, 0.0, "numerical", "a test asks")


@pytest.mark.parametrize("name", ["trot", "walk", "pace", "rack"])
@pytest.mark.parametrize("shift", [0.2, 0.55, 0.8])
def test_the_same_gait_with_other_phases_goes_on_where_it_was(name: str, shift: float) -> None:
    gait = gait_of(LIBRARY[name], DOG)
    cycle = desired_cycle(DOG, gait, (0.4, 0.0), steps=round(gait.period / DT))
    coordinator = Coordinator(DOG, DT)
    memory = coordinator.begin(cycle.sensed(0), 0.0)
    for i in range(cycle.steps):
        _, memory = coordinator.move(memory, call_of(gait), cycle.sensed(i))
    other = replace(gait, name="other", offsets=tuple((o + shift) % 1.0 for o in gait.offsets))
    before = memory.row[0]
    _, memory = coordinator.move(memory, call_of(other), cycle.sensed(cycle.steps - 1))
    off = (memory.row[0] + shift - before + 0.5) % 1.0 - 0.5
    assert abs(off) < 0.12, "its legs are where they were"


@pytest.mark.parametrize("name", MOVING)
def test_a_gait_begins_with_the_phase_it_is_given(name: str) -> None:
    gait = gait_of(LIBRARY[name], DOG)
    sensed = desired_cycle(DOG, gait_of(LIBRARY["stand"], DOG), (0.0, 0.0)).sensed(0)
    coordinator = Coordinator(DOG, DT)
    _, memory = coordinator.move(coordinator.begin(sensed, 0.37), call_of(gait), sensed)
    assert memory.gait == gait
    assert 0.37 <= memory.row[0] <= 0.37 + 2.0 * DT / gait.period


def test_a_robot_that_is_too_fast_keeps_its_gait_until_it_is_not() -> None:
    run, walk = (gait_of(LIBRARY[name], DOG) for name in ("run", "walk"))
    cycle = desired_cycle(DOG, run, (1.5, 0.0))
    coordinator = Coordinator(DOG, DT)
    memory = coordinator.begin(cycle.sensed(0), 0.0)
    _, memory = coordinator.move(memory, call_of(run, (1.5, 0.0)), cycle.sensed(0))
    _, memory = coordinator.move(memory, call_of(walk), cycle.sensed(1))
    assert memory.gait == run
    slow = replace(cycle.sensed(1), velocity_w=np.array([0.3, 0.0, 0.0]))
    _, memory = coordinator.move(memory, call_of(walk), slow)
    assert memory.gait == walk


def test_standing_waits_for_a_robot_that_moves() -> None:
    stand = gait_of(LIBRARY["stop"], DOG)
    assert may_start(stand, 0.0, DOG.height) and not may_start(stand, 0.5, DOG.height)
