"""What breaks is noticed soon and named rightly; a robot in order is believed to the bit."""

from dataclasses import replace

import numpy as np
import pytest

from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain
from gaitwright.model.kinematics import angles
from gaitwright.model.robot import Robot
from gaitwright.perception.fault_words import GOES_ON, LIES_DOWN, SENTENCES, Fault, fault_of
from gaitwright.perception.watch_memory import size_of, tables
from gaitwright.plant.faults import FaultyPlant, breakdown
from gaitwright.plant.imperfections import Imperfections
from gaitwright.plant.kinematic import KinematicPlant
from gaitwright.plant.names import FAULTS, OF_A_JOINT, OF_A_LEG
from gaitwright.plant.registry import make_plant
from gaitwright.session import Push, Session
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill
from oracles import robot_called

GO2, FLAT = robot_called("go2"), load_scene("flat")
BREAKS = 1.5
"""When what is tried breaks [s]."""


def trotting(
    seconds: float,
    faults: tuple[tuple[str, str, str], ...] = (),
    robot: Robot = GO2,
    skill: str = "trot",
    imperfections: Imperfections | None = None,
    watches: bool = True,
    plant: str = "mujoco",
) -> Session:
    chooser = fixed_skill(robot, skill, None, 0.0, None, "numerical")
    brain = Brain.of(robot, FLAT, chooser, watches=watches)
    broken = [breakdown(robot, *names, BREAKS) for names in faults]
    world = FaultyPlant(make_plant(plant, robot, FLAT), robot, broken, imperfections)
    return Session(brain, world, Mission(()), seconds, 4)


def faults_of(session: Session) -> tuple[Fault, ...]:
    """What was noticed until the end."""
    for _ in session:
        pass
    assert session.lap
    return session.lap.faults


def example(kind: str, robot: Robot = GO2) -> tuple[str, str, str]:
    leg = robot.legs[1] if kind in OF_A_JOINT + OF_A_LEG else ""
    return kind, leg, "knee" if kind in OF_A_JOINT else ""


@pytest.mark.parametrize("kind", FAULTS)
def test_what_breaks_is_noticed_and_named(kind: str) -> None:
    session = trotting(BREAKS + 0.6, (example(kind),))
    found = faults_of(session)
    names = example(kind)
    assert [(f.kind, f.leg or "", f.joint or "") for f in found] == [names]
    assert BREAKS - 0.05 <= found[0].since <= found[0].noticed <= BREAKS + 0.4
    assert session.lap and session.closed and not session.lap.fell
    if found[0].answer == LIES_DOWN:
        assert session.lap.stopped_because == found[0].sentence
        assert session.lap.sensed.time == pytest.approx(found[0].noticed)


def test_motors_of_other_robots_are_named_too() -> None:
    hexapod = robot_called("hexapod")
    found = faults_of(trotting(BREAKS + 0.6, (("motor-dead", hexapod.legs[3], "hip2"),), hexapod, "tripod"))
    assert [(f.kind, f.leg, f.joint) for f in found] == [("motor-dead", hexapod.legs[3], "hip2")]


def test_a_foot_that_feels_nothing_is_done_without() -> None:
    faults = (("foot-off", "RL", ""),)
    walks, falls = trotting(5.0, faults), trotting(5.0, faults, watches=False)
    found = faults_of(walks)
    assert [(f.kind, f.leg, f.answer) for f in found] == [("foot-off", "RL", GOES_ON)]
    assert walks.lap and walks.lap.stopped_because == "the 5 s asked for are over"
    carried = walks.lap.sensed.load
    assert carried.max() > 0.0
    assert faults_of(falls) == () and falls.lap and falls.lap.fell


@pytest.mark.parametrize("skill", ["stand", "walk", "gallop", "pronk"])
def test_a_robot_in_order_is_believed_to_the_bit(skill: str) -> None:
    watched, alone = (trotting(2.0, skill=skill, watches=watches) for watches in (True, False))
    for one, other in zip(watched, alone, strict=True):
        np.testing.assert_array_equal(one.sensed.row, other.sensed.row)
        assert one.faults == ()


@pytest.mark.parametrize(
    "off",
    [
        Imperfections(late=4),
        Imperfections(0.01, 1.5, 0.1, 0.2, 0.05),
        Imperfections(angle_bias=0.02, attitude_bias=0.05),
    ],
    ids=["late", "noise", "bias"],
)
def test_what_is_only_off_raises_no_alarm(off: Imperfections) -> None:
    assert faults_of(trotting(3.0, imperfections=off)) == ()


def test_a_push_raises_no_alarm() -> None:
    for direction in (90.0, 0.0):
        session = trotting(3.0)
        session.push(Push(1.0, direction, at=1.0))
        assert faults_of(session) == ()


@pytest.mark.parametrize("skill", ["walk", "climb"])
def test_a_knee_that_leans_on_its_stop_raises_no_alarm(skill: str) -> None:
    """The stop bears what no motor does: a leg that is stretched out is not stuck."""
    short = GO2.q_max.copy()
    short[:, 2] = angles(GO2, GO2.nominal_feet)[0][:, 2] + 0.05
    assert faults_of(trotting(2.0, robot=replace(GO2, q_max=short), skill=skill)) == ()


def test_the_other_plant_raises_no_alarm() -> None:
    assert faults_of(trotting(0.6, plant="armstrong")) == ()


def test_a_robot_heavier_than_known_raises_no_alarm() -> None:
    session = trotting(3.0)
    heavy = replace(GO2, base_mass=GO2.base_mass + 3.0)
    session.plant = FaultyPlant(make_plant("mujoco", heavy, FLAT), heavy)
    session.measured = session.plant.reset(4)
    assert faults_of(session) == ()


def test_a_plant_without_mechanics_is_not_watched() -> None:
    brain = Brain.of(GO2, FLAT, fixed_skill(GO2, "trot", 0.4, 0.0, 0.0, "kinematic"))
    session = Session(brain, KinematicPlant(GO2, FLAT), Mission((), driver="kinematic"), 0.3, lowers=True)
    assert session.brain.watch is None and not session.lowers
    assert faults_of(session) == ()


def test_every_kind_has_a_sentence_that_a_person_understands() -> None:
    assert tuple(SENTENCES) == tuple(FAULTS)
    found = fault_of(GO2, 1, 0, 2, 2.31, 2.4, 0.002)
    assert found.sentence == "the front left knee's motor gives no torque since 2.31 s"
    assert fault_of(GO2, 11, -1, 20, 2.0, 2.1, 0.002).sentence.startswith("readings come 40 ms late")
    for kind in range(1, len(FAULTS) + 1):
        assert "{" not in fault_of(GO2, kind, 1, 1, 1.0, 1.1, 0.002).sentence


def test_the_tables_fill_the_row() -> None:
    for legs in (4, 6):
        row = np.zeros(size_of(legs))
        for table in tables(row, legs):
            for field in table:
                field[...] = 1.0
        assert (row == 1.0).all()
