"""What is made to fail fails, from its time on, and nothing else does; the truth stays true."""

from itertools import pairwise

import numpy as np
import pytest

from gaitwright.errors import WrongUse
from gaitwright.ground.scene import load_scene
from gaitwright.numerics.geometry import rotation
from gaitwright.perception.fault_words import JOINTS as NAMED_JOINTS
from gaitwright.perception.fault_words import KINDS
from gaitwright.plant.faults import (
    LATE,
    OFFSET,
    Breakdown,
    FaultyPlant,
    breakdown,
    changed,
)
from gaitwright.plant.imperfections import LEGGED_GYM, NOISE, Imperfections
from gaitwright.plant.names import FAULTS, JOINTS
from gaitwright.plant.registry import make_plant
from gaitwright.signals import Measured, MotorCommand
from gaitwright.stages import SimulatedPlant
from oracles import robot_called

GO2, FLAT = robot_called("go2"), load_scene("flat")
FIELDS = ("position_w", "orientation_wb", "velocity_w", "angular_velocity_b", "q", "qd", "load")


def broken(*breakdowns: Breakdown, imperfections: Imperfections | None = None, plant: str = "mujoco"):
    return FaultyPlant(make_plant(plant, GO2, FLAT), GO2, breakdowns, imperfections)


def pushed(size: float = 2.0) -> MotorCommand:
    return MotorCommand(np.full((4, 3), size), np.zeros((4, 3)))


def read(plant: SimulatedPlant, ticks: int, command: MotorCommand | None = None) -> list[Measured]:
    plant.reset(3)
    return [plant.step(command or pushed()) for _ in range(ticks)]


def differing(one: Measured, other: Measured) -> set[str]:
    return {name for name in FIELDS if not np.array_equal(getattr(one, name), getattr(other, name))}


def test_without_faults_it_is_the_plant_itself() -> None:
    plain, wrapped = read(make_plant("mujoco", GO2, FLAT), 20), read(broken(), 20)
    assert all(np.array_equal(a.row, b.row) for a, b in zip(plain, wrapped, strict=True))
    assert isinstance(broken(), SimulatedPlant)


def test_what_can_be_injected_is_what_can_be_named() -> None:
    assert KINDS[1:] == tuple(FAULTS) and NAMED_JOINTS == JOINTS


@pytest.mark.parametrize(
    ("kind", "fields"),
    [
        ("encoder-frozen", {"q", "qd"}),
        ("encoder-offset", {"q"}),
        ("foot-off", {"load"}),
        ("foot-on", {"load"}),
        ("imu-frozen", {"orientation_wb", "angular_velocity_b"}),
        ("imu-tilted", {"orientation_wb"}),
        ("frozen", set(FIELDS)),
    ],
)
def test_a_sensor_lies_from_its_time_on_and_alone(kind: str, fields: set[str]) -> None:
    names = (GO2.legs[1], "knee")
    leg, joint = names if kind.startswith("encoder") else (names[0], "") if "foot" in kind else ("", "")
    plant = broken(breakdown(GO2, kind, leg, joint, 0.02))
    plant.reset(3)
    seen: set[str] = set()
    for tick in range(40):
        told = plant.step(pushed(0.0))
        assert told.time == plant.truth.time
        if tick < 8:
            assert differing(told, plant.truth) == set()
        seen |= differing(told, plant.truth)
    assert seen == fields
    if len(fields) < len(FIELDS) and "q" in fields:
        assert np.count_nonzero(told.q != plant.truth.q) == 1


def test_an_offset_is_as_large_as_it_says() -> None:
    plant = broken(Breakdown("encoder-offset", 2, 1), Breakdown("imu-tilted"))
    plant.reset(3)
    told = plant.step(pushed())
    assert told.q[2, 1] - plant.truth.q[2, 1] == pytest.approx(OFFSET)
    turn = rotation(plant.truth.orientation_wb).T @ rotation(told.orientation_wb)
    assert np.arccos((np.trace(turn) - 1.0) / 2.0) == pytest.approx(OFFSET)


@pytest.mark.parametrize("plant", ["mujoco", "armstrong"])
def test_a_dead_motor_gives_nothing(plant: str) -> None:
    for kind, joint in (("motor-dead", 2), ("leg-dead", None)):
        dead = read(broken(Breakdown(kind, 0, joint), plant=plant), 5)
        without = pushed()
        without.tau[0, 2 if joint else slice(None)] = 0.0
        told = read(make_plant(plant, GO2, FLAT), 5, without)
        np.testing.assert_array_equal(dead[-1].q, told[-1].q)


def test_a_stuck_joint_hardly_turns() -> None:
    free, stuck = (
        read(broken(), 40, pushed(8.0)),
        read(broken(Breakdown("motor-stuck", 0, 2)), 40, pushed(8.0)),
    )
    start = broken().reset(3).q[0, 2]
    assert abs(free[-1].q[0, 2] - start) > 0.03 > 5.0 * abs(stuck[-1].q[0, 2] - start)


def test_late_readings_are_those_of_before() -> None:
    plant, states = broken(imperfections=Imperfections(late=3)), []
    plant.reset(3)
    for tick in range(12):
        told = plant.step(pushed())
        states.append(plant.truth)
        if tick >= 3:
            np.testing.assert_array_equal(told.q, states[tick - 3].q)
        assert told.time == plant.truth.time


def test_a_stream_that_comes_late_stalls_first_and_goes_on() -> None:
    plant = broken(Breakdown("late", at=0.02))
    plant.reset(3)
    told, states = [], []
    for _ in range(60):
        told.append(plant.step(pushed()))
        states.append(plant.truth)
    stalled = [np.array_equal(a.q, b.q) for a, b in pairwise(told)]
    assert sum(stalled) == LATE and not stalled[5] and not stalled[-1]
    np.testing.assert_array_equal(told[-1].q, states[-1 - LATE].q)


def test_noise_and_bias_stay_within_their_bounds_and_differ_by_seed() -> None:
    plant = broken(imperfections=LEGGED_GYM)
    plant.reset(1)
    off = []
    for _ in range(200):
        told = plant.step(pushed(0.5))
        off.append((np.abs(told.q - plant.truth.q).max(), np.abs(told.qd - plant.truth.qd).max()))
    assert 0.009 < np.max(off, axis=0)[0] <= 0.01 and 1.4 < np.max(off, axis=0)[1] <= 1.5
    assert not np.array_equal(plant.reset(1).q, plant.reset(2).q)
    biased = broken(imperfections=Imperfections(angle_bias=0.02))
    told = biased.reset(1)
    np.testing.assert_allclose(np.abs(told.q - biased.truth.q), 0.02)


def test_a_reading_is_changed_without_touching_the_one_it_comes_from() -> None:
    true = make_plant("mujoco", GO2, FLAT).reset(1)
    before = true.row.copy()
    told = changed(true, load=np.ones(4), time=7.0)
    assert told.time == 7.0 and (told.load == 1.0).all()
    np.testing.assert_array_equal(true.row, before)


@pytest.mark.parametrize(
    ("asked", "sentence"),
    [
        (("motor-deed", "FL", "knee"), "did you mean 'motor-dead'"),
        (("motor-dead", "XX", "knee"), "no leg of go2 'XX'; there is: FL, FR, RL, RR"),
        (("motor-dead", "FL", "toe"), "there is: hip1, hip2, knee"),
        (("motor-dead", "FL", ""), "is written motor-dead:LEG:JOINT@T, e.g. motor-dead:FL:knee@2"),
        (("frozen", "FL", ""), "is written frozen@T"),
    ],
)
def test_what_there_is_not_is_told(asked: tuple[str, str, str], sentence: str) -> None:
    with pytest.raises(WrongUse, match=sentence):
        breakdown(GO2, *asked)


def test_an_inertial_unit_and_feet_are_as_noisy_as_they_are_named():
    plant = FaultyPlant(make_plant("mujoco", GO2, FLAT), GO2, (), NOISE["legged-gym"])
    told = plant.reset(5, vary=False)
    off = np.array(
        [np.array(plant.read().specific_force_b) - plant.truth.specific_force_b for _ in range(400)]
    )
    assert (np.abs(off - plant.force_bias) <= 0.5 + 1e-9).all()
    np.testing.assert_allclose(off.mean(axis=0), plant.force_bias, atol=0.06)
    np.testing.assert_allclose(np.abs(plant.force_bias), 0.1)
    spin = np.array([plant.read().angular_velocity_b - plant.truth.angular_velocity_b for _ in range(400)])
    np.testing.assert_allclose(spin.mean(axis=0), plant.spin_bias, atol=0.03)
    assert (told.load[plant.truth.load == 0.0] == 0.0).all() and (told.load >= 0.0).all()
