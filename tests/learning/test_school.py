"""A short school: few demonstrations, then right nearly everywhere, the same for the same seed."""

import os
import subprocess
import sys
from functools import cache
from pathlib import Path

import numpy as np

import gaitwright
from gaitwright.ground.scene import load_scene
from gaitwright.knowledge.modifier import audit
from gaitwright.knowledge.rules import Rulebook
from gaitwright.learning.apprentice import study
from gaitwright.learning.exam import ASIDE, faults, held_out, is_right, right_share, trial, variants
from gaitwright.learning.school import attend, demonstrate, demonstrations
from gaitwright.learning.teacher import POLICY, ScriptedTeacher
from gaitwright.learning.trips import trips
from gaitwright.locomotion import Brain, think
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.signals import Mission
from gaitwright.skills.situation import FOREST
from oracles import robot_called

DOG = robot_called("dog")
TEACHER = ScriptedTeacher()


@cache
def schooled():
    return attend(DOG, TEACHER, seed=0, trips_watched=2)


@cache
def first_shown():
    return demonstrations(DOG, TEACHER, 3, 1, 1)


@cache
def exam():
    return held_out(DOG, TEACHER, 5, 40)


def test_a_short_school_makes_rules_that_are_mostly_right_where_nobody_taught_them():
    book, report = schooled().rulebook, schooled().report
    assert right_share(book, TEACHER, exam()) > 0.85
    assert not audit(book) and report.trips == 2 and len(report.interventions) == 2
    assert max(report.demonstrations.values()) <= 5
    assert {rule.action for rule in book.rules} <= {clause.action for clause in POLICY}


WHOLE = """
from gaitwright.description.load import load_robot
from gaitwright.learning.exam import held_out, right_share
from gaitwright.learning.school import attend
from gaitwright.learning.teacher import ScriptedTeacher
robot, teacher = load_robot("go2"), ScriptedTeacher()
for seed in (1, 2):
    book = attend(robot, teacher, seed).rulebook
    print(right_share(book, teacher, held_out(robot, teacher, seed)))
"""


def test_a_whole_school_is_right_in_98_of_100_situations_that_nobody_taught():
    """In a process of its own, where no call is slowed down by type checks."""
    paths = str(Path(gaitwright.__file__).parents[1])
    done = subprocess.run(
        [sys.executable, "-c", WHOLE], env={**os.environ, "PYTHONPATH": paths},
        capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    right = [float(word) for word in done.stdout.split()]
    assert len(right) == 2 and np.mean(right) >= 0.98


def test_untaught_it_knows_nothing_and_demonstrations_alone_teach_most():
    shown = first_shown()
    assert right_share(Rulebook(FOREST), TEACHER, exam()) == 0.0
    studied = demonstrate(Rulebook(FOREST), TEACHER, shown)
    assert right_share(studied.rulebook, TEACHER, exam()) > 0.5
    clear = [(TEACHER.ideal(moment.raw), one.rule) for one in shown for moment in one.moments]
    clear = [(ideal.rule, rule) for ideal, rule in clear if ideal.clear]
    assert len(clear) > 4 and all(ideal == rule for ideal, rule in clear)


def test_the_same_seed_is_the_same_school_and_another_is_not():
    one, again, other = (next(trips(DOG, TEACHER, seed)) for seed in (4, 4, 5))
    assert one == again and one != other
    books = [study(Rulebook(FOREST), TEACHER, one).rulebook for _ in range(2)]
    assert books[0] == books[1]


def test_exams_are_not_lessons():
    lessons = {event.instance for event in schooled().rulebook.events}
    assert not lessons & {moment.id for moment in exam()}


def test_a_trial_counts_what_a_correction_mends_and_breaks():
    book = demonstrate(Rulebook(FOREST), TEACHER, first_shown()).rulebook
    wrong = faults(book, TEACHER, exam())
    found = trial(book, TEACHER, wrong[0], exam(), np.random.default_rng(1))
    assert 0 < found.mended <= found.variants and 0 <= found.broken <= found.earlier
    assert found.earlier == sum(is_right(book, TEACHER, moment) for moment in exam())
    found = variants(TEACHER, wrong[0], exam(), np.random.default_rng(2))
    assert len(found) > 10
    for variant in found:
        assert TEACHER.ideal(variant.raw).action == TEACHER.ideal(wrong[0].raw).action
        assert any(all(variant.raw[name] == m.raw[name] for name in ASIDE) for m in exam())


def test_what_was_learned_without_physics_drives_a_robot_with_it():
    """Half a second in full physics: the rules choose, the numerical controller drives."""
    scene = load_scene("stairs:0.05")
    brain, plant = Brain.of(DOG, scene, rulebook=schooled().rulebook), MujocoPlant(DOG, scene)
    sensed = plant.reset(0)
    mind = brain.begin(Mission(((6.0, 0.0),), 0.4, "hybrid"), sensed)
    laps = []
    for _ in range(250):
        lap, mind = think(brain, mind, sensed)
        laps.append(lap)
        sensed = plant.step(lap.command)
    assert {lap.call.driver for lap in laps} == {"hybrid"}
    assert any(lap.call.because.startswith("rule trot") for lap in laps)
    assert all(lap.command.status.startswith("solved") for lap in laps)
