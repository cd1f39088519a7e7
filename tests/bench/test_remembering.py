"""Teachers whose word depends on what was: each is read, and each means what the bench says she does."""

import numpy as np
import pytest

from gaitwright.bench.context import Context
from gaitwright.bench.evidence import remembering
from gaitwright.bench.trial import robot_named
from gaitwright.learning.exam import held_out
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.skills.vocabulary import vocabulary_with
from gaitwright.workers import Workers

GO2 = robot_named("go2")
TEACHERS = remembering.teachers(GO2)


def test_there_are_six_and_they_differ():
    assert len(TEACHERS) == 6
    assert len({tuple(clause.rule for clause in teacher.policy) for teacher in TEACHERS.values()}) == 6


@pytest.mark.parametrize("name", TEACHERS)
def test_what_was_matters_to_each_of_them(name):
    exam = held_out(GO2, TEACHERS[name], 17, 150)
    matters = remembering.what_was_matters(TEACHERS[name], exam)
    assert 0.01 < np.mean(matters) < 0.95


def test_who_looks_at_the_moment_alone_sees_nothing_else():
    her, other = remembering.Forgetful(0), SkillPupil(0)
    facts = {"slope": 3.0, "doing": "walking", "stairs": "noted", "in use": "walk"}
    for pupil in (her, other):
        pupil.notes.append("stairs")
        pupil.pupil.widen(vocabulary_with(("stairs",)))
    places = her.vocabulary.places
    noted, doing = places["stairs is noted"], places["doing is walking"]
    assert her.row(facts)[noted] == 0.0 and np.isnan(her.row(facts)[doing])
    assert other.row(facts)[noted] == other.row(facts)[doing] == 1.0
    assert not her.learn_ends("")


def test_the_bench_tells_both_figures(monkeypatch):
    monkeypatch.setattr(remembering, "TRIPS", 3)
    monkeypatch.setattr(remembering, "EXAM", 60)
    with Workers(1) as workers, Context(workers, quick=True) as context:
        whole, past = remembering.remembering(context)
    assert 30.0 < whole.measured <= 100.0 and 0.0 <= past.measured <= 100.0
    assert "looks at the moment alone" in past.note
