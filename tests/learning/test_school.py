"""A short school: few corrections, then right nearly everywhere, the same for the same seed."""

from dataclasses import replace
from functools import cache

import numpy as np

from gaitwright.ground.scene import load_scene
from gaitwright.knowledge.audit import audit
from gaitwright.learning.exam import ASIDE, examined, faults, held_out, rights, trial, variants
from gaitwright.learning.school import BEFORE_DRIVING, attend, trip_of
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.learning.teacher import POLICY, ScriptedTeacher
from gaitwright.learning.trips import trips
from gaitwright.locomotion import Brain, think
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.signals import Mission
from learning.roads import ROADS
from oracles import robot_called

DOG = robot_called("dog")
TEACHER = ScriptedTeacher()
TRIPS = 12


@cache
def schooled():
    pupil = SkillPupil(0)
    return pupil, attend(pupil, DOG, TEACHER, seed=0, trips=TRIPS)


@cache
def exam():
    return held_out(DOG, TEACHER, 5, 200)


def test_each_line_of_the_policy_is_met():
    assert {TEACHER.ideal(m.facts).rule for m in ROADS} == {clause.rule for clause in POLICY}


def test_a_short_school_makes_few_rules_that_are_mostly_right_where_nobody_taught_them():
    pupil, report = schooled()
    assert examined(pupil, TEACHER, exam()).right > 0.85
    book = pupil.rulebook()
    assert not audit(book) and len(book.rules) <= 20
    assert {replace(rule.action, until="") for rule in book.rules} <= {clause.action for clause in POLICY}
    assert report.trips == TRIPS and len(report.corrected) == TRIPS


def test_each_lesson_is_counted_as_what_it_was_and_no_correction_is_left_out():
    pupil, report = schooled()
    assert report.given["shown"] == BEFORE_DRIVING
    assert sum(report.given.values()) == len(pupil.told) < report.moments
    assert sum(report.corrected) == report.given["corrected"]
    assert [told.given for told in pupil.told].count("corrected") == report.given["corrected"]
    assert sum(report.corrected[-4:]) < sum(report.corrected[:4])


def test_who_asks_at_every_moment_hears_every_moment():
    pupil = SkillPupil(4)
    report = attend(pupil, DOG, TEACHER, seed=4, trips=1, asks_always=True)
    assert len(pupil.told) == report.moments
    assert {trip_of(told, 4) for told in pupil.told} == {0} and trip_of(pupil.told[0], 5) is None


def test_untaught_she_knows_nothing():
    assert not rights(SkillPupil(), TEACHER, exam()).any()


def test_the_same_seed_is_the_same_school_and_another_is_not():
    one, again, other = (next(trips(DOG, TEACHER, seed)) for seed in (4, 4, 5))
    assert one == again and one != other
    books = []
    for seed in (1, 1, 2):
        pupil = SkillPupil(seed)
        attend(pupil, DOG, TEACHER, seed=seed, trips=1)
        books.append(pupil.rulebook())
    assert books[0] == books[1] != books[2]


def test_exams_are_not_lessons():
    assert not {told.id for told in schooled()[0].told} & {moment.id for moment in exam()}


def test_a_trial_counts_what_a_correction_mends_and_breaks():
    pupil = SkillPupil(1)
    attend(pupil, DOG, TEACHER, seed=1, trips=2)
    lines, wrong = pupil.pupil.lines, faults(pupil, TEACHER, exam())
    found = trial(pupil, TEACHER, wrong[0], exam(), np.random.default_rng(1))
    assert 0 < found.mended <= found.variants == 20 and 0 <= found.broken <= found.earlier
    assert found.earlier == rights(pupil, TEACHER, exam()).sum()
    assert pupil.pupil.lines == lines, "a trial changes nothing"
    found = variants(TEACHER, wrong[0], exam(), np.random.default_rng(2))
    assert len(found) > 10
    for variant in found:
        assert TEACHER.ideal(variant.facts).action == TEACHER.ideal(wrong[0].facts).action
        assert any(all(variant.raw[name] == m.raw[name] for name in ASIDE) for m in exam())


def test_what_was_learned_without_physics_drives_a_robot_with_it():
    """Half a second in full physics: the rules choose, the numerical controller drives."""
    scene = load_scene("stairs:0.05")
    brain, plant = Brain.of(DOG, scene, rulebook=schooled()[0].rulebook()), MujocoPlant(DOG, scene)
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
