"""The bench of lessons: one scene taught and driven, the same again, and no figure without its failures."""

import pytest

from gaitwright import bench
from gaitwright.bench.claims import lessons
from gaitwright.bench.context import Context
from gaitwright.bench.evidence import taught_missions
from gaitwright.bench.evidence.taught_missions import Trip, driven, lesson_from_a_person
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.workers import Workers

SHORT = Trip("flat", 1.0, (1.0, 0.0), 0.5)


@pytest.fixture
def context():
    with Workers(1) as workers, Context(workers, quick=True) as context:
        yield context


@pytest.fixture
def one_scene(monkeypatch):
    monkeypatch.setattr(taught_missions, "LESSONS", (SHORT,))


def test_a_person_steps_in_where_the_rules_err_and_the_same_again(context, one_scene):
    pupil, times = lesson_from_a_person(context, context.seed)
    assert 1 <= times == len(pupil.told) <= taught_missions.MOST
    assert {told.given for told in pupil.told} == {"corrected"}
    again, _ = lesson_from_a_person(context, context.seed)
    assert again.told == pupil.told and again.rulebook() == pupil.rulebook()
    report = driven(SHORT, pupil.rulebook()).report()
    assert report.arrived and set(report.driver_share) == {"hybrid"}


def test_a_figure_counts_what_failed_and_says_where(context):
    far = Trip("slippery:0.06", 0.0, (9.0, 0.0), 1.3)
    figure = lessons.arrived(context, "trips", [SHORT, far], None)
    assert (figure.measured, figure.starts) == (50.0, 2)
    assert "slippery:0.06 at 1.3 m/s" in figure.note


def test_lessons_are_a_claim_and_an_empty_pupil_is_no_driver():
    assert ("rules", "lessons") in bench.claims_named(["rules"])
    assert driven(SHORT, SkillPupil().rulebook()).report().arrived, "where no rule fires, the plain ones do"
