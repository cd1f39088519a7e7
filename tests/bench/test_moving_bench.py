"""What `bench moving` counts: touches by MuJoCo's contacts, and whose they are."""

from gaitwright.bench import claims_named
from gaitwright.bench.claims.moving import Course, Met, figures, met, wanted_of
from gaitwright.bench.evidence.touches import Touch, Touches
from gaitwright.ground.moving import Mover
from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.locomotion import Brain
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import Session
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill
from oracles import robot_called

GO2 = robot_called("go2")


def touched(mover: Mover, skill: str, speed: float, seconds: float) -> list[Touch]:
    """What a robot touches that knows of nothing."""
    brain = Brain.of(GO2, Scene("empty", Flat()), fixed_skill(GO2, skill, speed, 0.0, 0.0, "numerical"))
    touches = Touches(MujocoPlant(GO2, Scene("yard", Flat(), movers=(mover,))))
    for _ in Session(brain, touches, Mission(()), seconds, 1):
        pass
    return touches.touches


def test_who_stands_is_run_into() -> None:
    (touch,) = touched(Mover(Box(0.0, -1.0, 0.0, 0.6, 0.4, 0.5), ((0.0, 1.0),), 0.4), "stand", 0.0, 3.0)
    assert not touch.walked and 0.4 / 0.4 < touch.time < 0.8 / 0.4


def test_who_goes_towards_it_walks_into_it() -> None:
    (touch,) = touched(
        Mover(Box(1.2, -0.2, 0.0, 0.4, 0.6, 0.5), ((1.2, 0.2),), 0.05, loop=True), "trot", 0.4, 3.0
    )
    assert touch.walked and touch.thing == 0


def test_who_goes_by_is_run_into_from_aside() -> None:
    """It comes at right angles, and meets the flank of who has passed its line."""
    found = touched(Mover(Box(1.0, -1.6, 0.0, 0.4, 0.4, 0.5), ((1.0, 2.0),), 0.5), "trot", 0.4, 4.0)
    assert [touch.walked for touch in found] == [False]


def test_who_touches_nothing_touched_nothing() -> None:
    assert touched(Mover(Box(3.0, 3.0, 0.0, 0.4, 0.4, 0.5), ((3.0, 1.0),), 0.5), "stand", 0.0, 1.0) == []


def test_every_way_to_end_is_counted() -> None:
    walked, hit = Touch(0, 3.0, True), Touch(1, 4.0, False)
    found = [
        Met(True, False, "arrived at the goal", 30.0, ()),
        Met(True, False, "arrived at the goal", 32.0, (hit,)),
        Met(False, True, "fell: the body leaned 61°", 9.0, (walked, hit)),
    ]
    courses = [Course("crossing", seed, None, True) for seed in range(3)]
    arrived, free, own = figures("crossing, things told", courses, found)
    assert (arrived.measured, free.measured, own.measured) == (2.0, 1.0, 2.0)
    assert arrived.reached is False and "1 fell" in arrived.note and "2: fell" in arrived.note
    assert wanted_of(courses[0]) == 0.9 and wanted_of(Course("crossing", 0, None, False)) is None


def test_it_is_a_claim_of_unknown_ground() -> None:
    assert ("unknown", "moving") in claims_named(["unknown"])


def test_a_course_is_made_from_plain_values() -> None:
    found = met(Course("crossing:0", 3, None, True))
    assert found.arrived and not found.fell and found.touches == ()
