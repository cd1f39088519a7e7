"""The critic's algorithm B, and what the apprentice makes of it."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import audit
from gaitwright.knowledge.rules import Rulebook
from gaitwright.learning.apprentice import confirmed, corrected, step_of, study
from gaitwright.learning.critic import DecisionPoint, TraceStep, criticise
from gaitwright.learning.teacher import POLICY, Correction, ScriptedTeacher, Shown
from gaitwright.skills.rule_chooser import DOING
from gaitwright.skills.situation import FOREST, READ_FROM, named

EASY = {
    **dict.fromkeys(READ_FROM, 0.0),
    "feet down": 1.0,
    "remaining": 20.0,
    "points left": 1.0,
    "possible": 0.6,
    "wished": 0.6,
    "obstacle": 20.0,
    "effort": 0.4,
}
TEACHER = ScriptedTeacher()
names = st.lists(st.sampled_from(["walk", "trot", "run"]), min_size=1, max_size=12)


def moment(memory=(), **changes) -> DecisionPoint:
    raw = EASY | {name.replace("_", " "): value for name, value in changes.items()}
    return DecisionPoint(f"{changes}", named(raw), raw, dict(memory))


def trace(skills) -> list[TraceStep]:
    return [TraceStep(moment(remaining=5.0 + k), Action(skill), skill) for k, skill in enumerate(skills)]


@given(names, st.data())
def test_the_first_difference_is_where_the_traces_part(skills, data):
    other = data.draw(st.lists(st.sampled_from(["walk", "trot"]), min_size=len(skills), max_size=len(skills)))
    found = criticise(trace(skills), trace(other))
    parts = next((k for k, (a, b) in enumerate(zip(skills, other, strict=True)) if a != b), len(skills))
    assert found.at == parts and [step.rule for step in found.right] == other[:parts]
    if parts == len(skills):
        assert found.wrong is None and found.ideal is None
    else:
        assert found.wrong.rule == other[parts] and found.ideal.rule == skills[parts]
        assert found.wrong.moment == found.ideal.moment


def test_traces_of_different_trips_are_not_compared():
    with pytest.raises(ValueError, match="shorter"):
        criticise(trace(["walk"]), trace([]))


ROADS = (
    moment(),
    moment(slope=15.0),
    moment(slope=-15.0),
    moment(roughness=0.2),
    moment(off_the_path=90.0),
    moment(off_the_path=25.0),
    moment(off_the_path=-25.0),
    moment(possible=1.3),
    moment(possible=1.9),
    moment(sway=0.5),
    moment(obstacle=0.5),
    moment(possible=0.2),
    moment(arrived=1.0),
)


def test_each_line_of_the_policy_is_met():
    assert {TEACHER.ideal(m.raw).rule for m in ROADS} == {clause.rule for clause in POLICY}


@pytest.mark.parametrize("order", range(6))
def test_after_a_trip_was_studied_the_rules_do_on_it_what_the_teacher_did(order):
    moments = [ROADS[k] for k in np.random.default_rng(order).permutation(len(ROADS))]
    studied = study(Rulebook(FOREST), TEACHER, moments, passes=6)
    assert not audit(studied.rulebook) and not studied.open
    wrong = [m for m in moments if step_of(studied.rulebook, m).action != TEACHER.ideal(m.raw).action]
    assert len(wrong) <= 1, "what one lesson teaches, a later one may still overrule"
    assert studied.corrections >= len({TEACHER.ideal(m.raw).rule for m in moments})


def test_one_correction_is_enough_and_keeps_what_was_right():
    book = study(Rulebook(FOREST), TEACHER, [moment()]).rulebook
    stairs = moment(step_up=0.4, slope=10.0)
    assert step_of(book, stairs).rule == "trot"
    after = corrected(book, stairs, TEACHER.judge(step_of(book, stairs).action, stairs.raw)).rulebook
    assert step_of(after, stairs).rule == "climb" and step_of(after, moment()).rule == "trot"
    higher = moment(step_up=0.6, slope=20.0, effort=0.9, familiar=1.0)
    assert step_of(after, higher).rule == "climb", "the reason was the road, so nothing else matters"


def test_what_goes_on_teaches_nothing_about_the_trees():
    book = study(Rulebook(FOREST), TEACHER, [moment(off_the_path=90.0)]).rulebook
    going_on = moment({DOING: "turn-in-place"}, off_the_path=25.0, turning=1.0)
    step = step_of(book, going_on)
    assert step.action.skill == "turn-in-place" and confirmed(book, step).rulebook == book


def test_a_missing_feature_is_made_from_the_number_that_the_teacher_names():
    book = Rulebook(FOREST)
    slow, fast = Action("walk", 0.1, 0.2), Action("trot", 0.2, 1.0)
    for possible, action in ((0.5, slow), (0.8, fast), (0.55, slow), (0.85, fast), (0.5, slow), (0.8, fast)):
        one = moment(possible=possible)
        if step_of(book, one).action != action:
            shown = Shown(action.skill, action, about="possible")
            book = corrected(book, one, Correction(shown, "possible")).rulebook
    assert "possible" in book.forest.names and not audit(book)
    assert step_of(book, moment(possible=0.52)).action == slow
    assert step_of(book, moment(possible=0.9)).action == fast
    unnamed = replace(one, situation=moment().situation)
    assert consult(book, book.forest.situation({**dict(unnamed.situation.items()), "possible": 0.9})).rule
