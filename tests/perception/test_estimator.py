"""What a robot makes of its own sensors: near the truth, from nothing but what sensors say."""

from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain
from gaitwright.numerics.geometry import rotation, rotation_vector
from gaitwright.perception.estimated_state import EstimatedState
from gaitwright.perception.estimator import estimate_in, turned_by
from gaitwright.perception.known_ground import KnownGround
from gaitwright.plant.faults import FaultyPlant, breakdown
from gaitwright.plant.imperfections import NOISE, Imperfections
from gaitwright.plant.registry import make_plant
from gaitwright.session import DT, Push, Session
from gaitwright.signals import Measured, Mission, Sensed
from gaitwright.skills.chooser import fixed_skill
from oracles import robot_called

GO2, FLAT = robot_called("go2"), load_scene("flat")


def estimating(
    skill: str,
    sensors: Imperfections,
    seconds: float,
    seed: int = 3,
    faults: tuple[tuple[str, ...], ...] = (),
) -> Session:
    chooser = fixed_skill(GO2, skill, None, 0.0, None, "numerical")
    brain = Brain.of(GO2, FLAT, chooser, DT, sensing="estimated")
    broken = [breakdown(GO2, *names, at=1.5) for names in faults]
    plant = FaultyPlant(make_plant("mujoco", GO2, FLAT, DT), GO2, broken, sensors)
    return Session(brain, plant, Mission(()), seconds, 3)


def both(session: Session) -> Iterator[tuple[Sensed, Measured]]:
    """What it believes and what is true, at each tick."""
    true = session.plant.truth
    for lap in session:
        yield lap.sensed, true
        true = session.plant.truth


def errors(session: Session) -> tuple[np.ndarray, float, float]:
    """RMS error of the velocity [m/s], mean tilt error [°], and how far off the place is per way gone."""
    velocity, tilt, last = [], [], None
    for believed, true in both(session):
        last = believed, true
        if believed.time > 1.0:
            velocity.append(believed.velocity_w - true.velocity_w)
            up, felt = (rotation(state.orientation_wb)[2] for state in (true, believed))
            tilt.append(np.degrees(np.arccos(np.clip(up @ felt, -1.0, 1.0))))
    assert last is not None and session.lap is not None and not session.lap.fell and not session.lap.faults
    off, way = last[0].position_w - last[1].position_w, np.linalg.norm(last[1].position_w[:2])
    return (
        np.sqrt(np.mean(np.square(velocity), axis=0)),
        float(np.mean(tilt)),
        float(np.linalg.norm(off) / way),
    )


@pytest.mark.parametrize(
    ("skill", "sensors", "velocity", "tilt", "place"),
    [
        ("trot", "exact", 0.03, 0.6, 0.06),
        ("walk", "go2", 0.03, 1.2, 0.10),
        ("trot", "legged-gym", 0.07, 2.6, 0.15),
        ("gallop", "go2", 0.08, 2.6, 0.10),
    ],
)
def test_what_it_believes_is_near_the_truth(skill, sensors, velocity, tilt, place):
    off, leans, lost = errors(estimating(skill, NOISE[sensors], 5.0))
    assert off.max() < velocity and leans < tilt and lost < place


def test_it_goes_by_its_sensors_alone():
    """What no sensor tells may be anything: place, velocity and attitude of the base."""
    perception = EstimatedState(KnownGround.of(FLAT, GO2), GO2, DT)
    plant, rng = make_plant("mujoco", GO2, FLAT, DT), np.random.default_rng(0)
    session = Session(
        Brain.of(GO2, FLAT, fixed_skill(GO2, "trot", 0.4, 0.0, 0.0, "numerical")), plant, Mission(()), 0.4
    )
    memory = other = None
    for _ in session:
        measured = session.measured
        otherwise = measured if other is None else lying(measured, rng)
        told, _, memory = perception.perceive(measured, memory)
        lied, _, other = perception.perceive(otherwise, other)
        np.testing.assert_array_equal(told.row, lied.row)
    assert session.measured.time > 0.3


def lying(measured: Measured, rng: np.random.Generator) -> Measured:
    row, where = measured.row.copy(), Sensed.layout.slices(GO2.n)
    for name in ("position_w", "orientation_wb", "velocity_w"):
        row[where[name]] = rng.normal(size=row[where[name]].shape)
    return Measured.of_row(row, time=measured.time, specific_force_b=measured.specific_force_b)


def test_the_bias_of_a_gyroscope_is_found_out():
    session = estimating("stand", Imperfections(spin_bias=0.02), 20.0)
    for _ in session:
        pass
    found = np.array(estimate_in(session.mind.memories.perception).bias)
    assert isinstance(session.plant, FaultyPlant)
    np.testing.assert_allclose(found[:2], session.plant.spin_bias[:2], atol=0.006)


def test_a_push_is_stood_without_being_told_the_state():
    session = estimating("trot", NOISE["legged-gym"], 4.0)
    session.push(Push(0.9, 90.0, at=2.0))
    for _ in session:
        pass
    assert session.lap is not None and session.lap.stopped_because == "the 4 s asked for are over"


@pytest.mark.parametrize(
    "kind", [("imu-frozen",), ("motor-dead", "FR", "knee"), ("encoder-frozen", "FR", "knee")]
)
def test_what_breaks_is_noticed_all_the_same(kind):
    session = estimating("trot", NOISE["go2"], 2.5, faults=(kind,))
    for _ in session:
        pass
    assert session.lap is not None and [fault.kind for fault in session.lap.faults] == [kind[0]]


@given(st.tuples(*[st.floats(-0.02, 0.02)] * 3), st.tuples(*[st.floats(-1.0, 1.0)] * 4), st.booleans())
def test_a_small_turn_is_a_rotation(angle, numbers, is_in_base):
    start = np.array(numbers) + np.array([2.0, 0.0, 0.0, 0.0])
    start /= np.linalg.norm(start)
    end = start.copy()
    turned_by(end, angle, is_in_base)
    R, S = rotation(start), rotation(end)
    np.testing.assert_allclose(rotation_vector(R.T @ S if is_in_base else S @ R.T), angle, atol=1e-5)
