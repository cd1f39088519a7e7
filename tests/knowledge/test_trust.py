"""Trust in a skill grows with what was driven, falls with a motion bug, and is a function of its history."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.knowledge.trust import (
    GRADES,
    GROWS,
    LEAST,
    Experience,
    fault_in_history,
    grade_of,
    grades_in,
    moved,
    trust_in,
)

SECONDS = st.floats(0.0, 1e4)
BUG, TAUGHT = Experience("trot", "bug"), Experience("trot", "taught")


def drove(seconds: float, skill: str = "trot") -> Experience:
    return Experience(skill, "drove", seconds)


@given(st.floats(0.0, 1.0), SECONDS, SECONDS)
def test_it_grows_with_the_seconds_however_they_are_cut(trust, one, other):
    apart = moved(moved(trust, drove(one)), drove(other))
    assert trust - 1e-12 <= apart <= 1.0 and apart == pytest.approx(moved(trust, drove(one + other)))


@given(st.floats(0.0, 1.0))
def test_a_bug_halves_it_and_no_watching_makes_more_than_an_assistant(trust):
    assert moved(trust, BUG) == trust / 2 <= moved(trust, Experience("trot", "returned")) <= trust
    watched = moved(trust, Experience("trot", "watched", 1e5))
    assert watched == max(trust, LEAST["assistant"])
    assert moved(trust, TAUGHT) == 0.0


@pytest.mark.parametrize("grade", GRADES)
def test_a_grade_that_a_person_set_is_the_one_that_is_read(grade):
    by_hand = Experience("trot", "set", grade=grade)
    assert grades_in([drove(100.0), by_hand]) == {"trot": grade}
    lower = grades_in([by_hand, BUG])["trot"]
    assert lower == grade == "apprentice" or GRADES.index(lower) < GRADES.index(grade)


def test_a_skill_goes_from_apprentice_to_skilled_and_back():
    history = [TAUGHT, *[drove(GROWS / 8)] * 14, *[BUG] * 4]
    passed = [grades_in(history[: k + 1])["trot"] for k in range(len(history))]
    assert [*dict.fromkeys(passed)] == list(GRADES)
    assert passed[14] == "skilled" and passed[15:] == ["partner", "assistant", "assistant", "apprentice"]


def test_each_skill_has_its_own():
    history = [TAUGHT, drove(5.0), drove(40.0, "walk"), Experience("walk", "bug"), drove(5.0)]
    trust = trust_in(history)
    assert trust["trot"] == pytest.approx(moved(0.0, drove(10.0))) and trust["walk"] < 0.5
    assert grade_of(trust["trot"]) == "partner", "two tries of five seconds make a partner"


def test_a_grade_belongs_to_what_a_person_set():
    assert not fault_in_history((drove(1.0), Experience("trot", "set", grade="partner")))
    assert "nobody set" in fault_in_history((Experience("trot", "drove", grade="partner"),))


def test_a_history_that_does_not_begin_with_a_lesson_begins_as_a_partners():
    assert grades_in([drove(0.5)]) == {"trot": "partner"} and grades_in([BUG]) == {"trot": "assistant"}
