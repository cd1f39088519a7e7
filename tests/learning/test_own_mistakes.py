"""What a robot notices of its own mistakes, in physics, and what it learns from the first of them."""

from functools import cache

import pytest

from gaitwright.cli import main
from gaitwright.knowledge.memory import Action
from gaitwright.learning.live import LiveLessons
from gaitwright.learning.notes import pupil_of
from gaitwright.learning.own_mistakes import STOP, calmer, lesson_of, mistakes_in
from gaitwright.learning.skill_pupil import SkillPupil, told_at
from gaitwright.learning.teacher import Shown
from gaitwright.locomotion import Brain
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import Session, record, scene_for
from gaitwright.signals import Mission
from gaitwright.skillbook import Skillbook, open_for_learning
from gaitwright.skills.chooser import fixed_skill
from gaitwright.skills.situation import FOREST
from learning.roads import moment
from oracles import robot_called

DOG = robot_called("dog")
TROT, WALK, CREEP = Action("trot", 0.2, 1.0), Action("walk", 0.1, 0.3), Action("walk", 0.05, 0.15)
TURN = Action("turn-left", 0.1, 0.5)


@cache
def walked(scene: str, skill: str, speed: float, seconds: float):
    ground = scene_for(DOG, scene, 0)
    chooser = fixed_skill(DOG, skill, speed, 0.0, None, "numerical")
    brain = Brain.of(DOG, ground, chooser)
    session = Session(brain, MujocoPlant(DOG, ground), Mission(((6.0, 0.0),), speed), seconds)
    return record(session, 0, scene)


@cache
def knows_trot_and_walk() -> SkillPupil:
    """A pupil who has trotted and walked, never where it is slippery."""
    pupil = SkillPupil()
    for k in range(12):
        for action, possible in ((TROT, 0.5 + k / 30), (WALK, 0.1 + k / 70)):
            shown = Shown(action.skill, action, about="possible")
            pupil.hear(told_at(moment(possible=possible, remaining=2.0 + k), shown, f"scene {k % 3}"))
    return pupil


def test_who_walks_on_good_ground_made_no_mistake():
    assert mistakes_in(walked("flat", "trot", 0.5, 2.0)) == ()


def test_feet_that_slip_are_noticed_before_the_fall():
    recording = walked("slippery:0.08", "trot", 0.9, 6.0)
    first = mistakes_in(recording)[0]
    assert "slip" in first.sentence or "fell" in first.sentence
    assert 0.0 <= first.time < recording["time"][-1]


def test_who_stands_where_there_is_somewhere_to_go_makes_no_way():
    (mistake,) = mistakes_in(walked("flat", "stand", 0.0, 8.0))
    assert "made no way" in mistake.sentence and mistake.time == pytest.approx(2.0, abs=0.1)


def test_the_next_calmer_way_to_go_is_tried_and_at_last_none():
    known = [TROT, CREEP, WALK, TURN]
    assert calmer(TROT, known) == WALK and calmer(WALK, known) == CREEP and calmer(CREEP, known) == STOP


def test_one_mistake_is_enough_to_do_otherwise_there_and_only_there():
    pupil = knows_trot_and_walk().copied()
    told = lesson_of(walked("slippery:0.08", "trot", 0.9, 6.0), pupil, "ice")
    assert told is not None and (told.given, told.action) == ("by itself", WALK)
    assert told.facts["grip"] == pytest.approx(0.08)
    pupil.hear(told)
    assert pupil.choose(moment(grip=0.08, possible=0.9)).action == WALK
    assert pupil.choose(moment(possible=0.7, remaining=6.0)).action == TROT


def test_a_mission_learns_into_its_book(tmp_path, capsys):
    path = Skillbook.new(FOREST, "go2", "ice").save(tmp_path / "ice.skills")
    with open_for_learning(path) as ledger:
        room = LiveLessons(ledger, SkillPupil())
        for told in knows_trot_and_walk().told:
            room.keep(room.tried(told))
    words = ["mission", "--driver", "hybrid", "--skillbook", str(path), "--scene", "slippery:0.1"]
    words += ["--goal", "4", "0", "--speed", "0.9", "--seconds", "6", "--learn"]
    assert main(words) == 1
    assert "would have been better" in " ".join(capsys.readouterr().err.split())
    last = pupil_of(Skillbook.load(path)).told[-1]
    assert last.given == "by itself" and last.id.startswith("slippery:0.1 (seed 0) at")
    assert main(["mission", "--goal", "1", "0", "--learn"]) == 2
    assert "--skillbook FILE go with it" in capsys.readouterr().err
