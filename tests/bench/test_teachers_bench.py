"""What the claim on test teachers measures with: the teachers, trips that a pupil drives, report cards."""

import math
from functools import cache

import numpy as np
import pytest

from gaitwright import bench
from gaitwright.bench.claims import teachers as claim
from gaitwright.bench.context import Context
from gaitwright.bench.evidence import driven, report_cards, taught
from gaitwright.bench.peers import rules_client
from gaitwright.bench.peers.environment import PeerUnavailable
from gaitwright.bench.teachers import teachers, without_reasons
from gaitwright.bench.trial import robot_named
from gaitwright.induction.pupil import Lesson, Pupil
from gaitwright.learning.courses import course
from gaitwright.learning.kinematic import moments_of
from gaitwright.skills.library import skill_names
from gaitwright.skills.vocabulary import VOCABULARY
from gaitwright.workers import Workers

TRIPS = 15
SMALL = {5: 10, 15: 10, 30: 12}


@pytest.fixture(scope="module")
def moments():
    """Moments of a few trips that the plain chooser drives."""
    robot = robot_named("go2")
    plain = driven.pupil_drives(robot, Pupil(VOCABULARY), ())
    trips = (moments_of(course(robot, 900 + k), plain, np.random.default_rng(k)) for k in range(TRIPS))
    return [moment.facts for trip in trips for moment in trip]


@cache
def people(seed):
    """The teachers of a seed: some are drawn until they suit, which takes long where shapes are checked."""
    return teachers(seed)


@pytest.fixture
def no_peer(monkeypatch):
    def unavailable(name):
        raise PeerUnavailable(f"{name} is not installed here")

    monkeypatch.setattr(rules_client, "peer_python", unavailable)
    monkeypatch.setattr(claim, "peer_python", unavailable)


# --- teachers --------------------------------------------------------------------------------------
@pytest.mark.parametrize("seed", [0, 4])
def test_every_teacher_uses_each_of_her_skills(moments, seed):
    for teacher in people(seed):
        used = {teacher.skill(facts, lesson) for lesson in (0, 1000) for facts in moments}
        assert used == set(teacher.skills), teacher.name


def test_slips_are_as_many_as_promised(moments):
    for teacher in people(0):
        n = 700 if teacher.slips else 20
        pairs = [(teacher.says(moments[k], k), teacher.means(moments[k], k)) for k in range(n)]
        wrong = np.mean([said.skill != meant.skill for said, meant in pairs])
        assert wrong == pytest.approx(teacher.slips, abs=0.02 if teacher.slips else 0.0), teacher.name
        assert all(said.skill in teacher.skills for said, _ in pairs)
    assert [teacher.slips for teacher in people(0) if teacher.slips] == [0.05]


def test_the_same_seed_gives_the_same_teachers_and_another_one_others(moments):
    assert teachers(0) == people(0)
    differs = {a.name for a, b in zip(people(0), people(4), strict=True) if a != b}
    assert differs == {"odd places", "slipping", "random list A", "random list B", "weighing"}
    assert len({teacher.name for teacher in people(0)}) == 16
    again = [teacher.says(facts, k) for teacher in people(0) for k, facts in enumerate(moments[:5])]
    assert again == [teacher.says(facts, k) for teacher in people(0) for k, facts in enumerate(moments[:5])]


def test_reasons_are_facts_that_a_pupil_knows_and_may_be_left_out(moments):
    for teacher in people(4):
        quiet, abouts = without_reasons(teacher), set()
        for k, facts in enumerate(moments[:150:10]):
            said = teacher.says(facts, k)
            assert (quiet.says(facts, k).skill, quiet.says(facts, k).about) == (said.skill, "")
            abouts.add(said.about)
        assert abouts - {""} and abouts - {""} <= set(VOCABULARY.names)


# --- trips -----------------------------------------------------------------------------------------
def test_whatever_a_teacher_says_can_be_carried_out():
    said = {skill for seed in (0, 4) for teacher in people(seed) for skill in teacher.skills}
    assert said <= driven.CARRIED_OUT.keys()
    assert {action.skill for action in driven.CARRIED_OUT.values()} <= set(skill_names(4))


def test_a_pupil_drives_as_it_was_taught_and_a_trip_ends_where_it_only_stands(moments):
    robot, pupil = robot_named("go2"), Pupil(VOCABULARY)
    pupil.hear(Lesson(VOCABULARY.row(moments[0]), 0))
    stopping = driven.trip(robot, 5, driven.pupil_drives(robot, pupil, ["stop"]))
    assert len(stopping) == driven.STANDING == driven.PER_TRIP
    assert {facts["doing"] for facts in stopping} == {"standing"}
    trotting = driven.trip(robot, 5, driven.pupil_drives(robot, pupil, ["trot"]))
    assert {facts["doing"] for facts in trotting} <= {"standing", "trotting"} and len(trotting) > 1
    assert trotting == driven.trip(robot, 5, driven.pupil_drives(robot, pupil, ["trot"]))


# --- schools and figures ---------------------------------------------------------------------------
def test_a_school_asks_on_the_way_and_is_the_same_again(no_peer):
    school = taught.School(people(0)[8], 8, 0, tuple(SMALL.items()))
    one, two = taught.taught(school), taught.taught(school)
    assert one.exams == two.exams and [exam.labels for exam in one.exams] == list(SMALL)
    assert [exam.asked for exam in one.exams] == list(SMALL.values())
    for exam in one.exams:
        for marks in (exam.silent, exam.told):
            assert 0.0 <= marks.sure_wrong <= marks.sure <= 1.0 and marks.sure_wrong <= 1.0 - marks.right
            assert 1 <= marks.actions <= len(school.teacher.skills)
        assert exam.others == {}
    assert one.missing == "sklearn is not installed here" and one.slowest_wall >= 0.0 < one.slowest


def test_other_learners_see_what_the_pupil_sees(moments):
    rows = taught.rows_of(moments[:7])
    assert {len(row) for row in rows["columns"]} == {len(VOCABULARY.columns)}
    assert {len(row) for row in rows["numbers"]} == {len(VOCABULARY.names) - 1 + 5}
    assert {sum(row[-5:]) for row in rows["numbers"]} == {1.0}
    assert rules_client.SCRIPTS["sklearn"].is_file()


def test_the_claim_is_measured_and_tells_what_is_missing(no_peer, monkeypatch):
    monkeypatch.setattr(claim, "ASKED", {25: 10, 200: 10, 400: 10})
    monkeypatch.setattr(claim, "QUICK", ("round places", "weighing"))
    monkeypatch.setattr(claim, "taught", made_up)
    monkeypatch.setattr(claim, "teachers", people)
    with Workers(1) as workers, Context(workers, quick=True) as context:
        monkeypatch.setattr(workers, "each", lambda task, given, tell: [task(one) for one in given])
        figures = {figure.what: figure for figure in claim.measure(context)}
    assert figures["silent pupil: right after 25 labels"].measured == pytest.approx(50.0)
    assert math.isnan(figures["silent pupil less strongest other after 25 labels"].measured)
    assert figures["round places: silent pupil right after 200 labels"].reached is False
    assert figures["worst fall of a curve"].measured == pytest.approx(2.0)
    assert figures["rules an action after 400 labels"].measured == pytest.approx(1.5)
    assert figures["wrong while sure after 400 labels"].reached is True
    assert figures["slowest lesson"].measured == pytest.approx(20.0)
    assert ("rules", "teachers") in bench.claims_named(["rules"])


def test_the_strongest_other_is_the_best_in_the_mean_over_seeds():
    marks = taught.Marks(0.8, 0.0, 0.0, 3, 2)
    shares = ({"CART": 0.9, "forest": 0.6}, {"CART": 0.5, "forest": 0.75})
    schools = [
        taught.Taught("x", True, seed, (taught.Exam(25, 9, marks, marks, others),), 0.0, 0.0, "")
        for seed, others in enumerate(shares)
    ]
    cards = report_cards.Cards(tuple(schools))
    assert cards.strongest("x", 25) == "CART"
    assert cards.right(report_cards.STRONGEST, "x", 25) == pytest.approx([90.0, 50.0])
    assert cards.right("forest", "x", 25) == pytest.approx([60.0, 75.0])


def made_up(school):
    """A school that was not held."""
    rights = {25: 0.5, 200: 0.94, 400: 0.92}
    exams = tuple(
        taught.Exam(
            labels, n, taught.Marks(rights[labels], 0.5, 0.004, 6, 4), taught.Marks(1.0, 1.0, 0.0, 4, 4), {}
        )
        for labels, n in school.asked
    )
    name, is_list = school.teacher.name, school.teacher.is_list
    return taught.Taught(name, is_list, school.seed, exams, 0.02, 0.03, "not here")
