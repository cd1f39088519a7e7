"""A pupil of skills: what she decides is what her rulebook says, and whole trips teach her."""

from dataclasses import replace

import numpy as np
import pytest

from gaitwright.description.load import load_robot
from gaitwright.knowledge.audit import audit
from gaitwright.knowledge.compiled import compile_book, decide
from gaitwright.knowledge.expressed import number_columns, shown
from gaitwright.knowledge.json_form import dumps, loads
from gaitwright.knowledge.rules import Instance
from gaitwright.learning.exam import held_out
from gaitwright.learning.school import attend
from gaitwright.learning.skill_pupil import SkillPupil, told_at
from gaitwright.learning.teacher import ScriptedTeacher
from gaitwright.skills.vocabulary import IN_USE, VOCABULARY
from gaitwright.skills.wording import WORDING

TRIPS = 5


@pytest.fixture(scope="module")
def robot():
    return load_robot("go2")


@pytest.fixture(scope="module")
def teacher():
    return ScriptedTeacher()


@pytest.fixture(scope="module")
def pupil(robot, teacher):
    taught = SkillPupil(3)
    attend(taught, robot, teacher, seed=3, trips=TRIPS, asks_always=True)
    return taught


@pytest.fixture(scope="module")
def exam(robot, teacher):
    return held_out(robot, teacher, 4, 300)


def test_trips_teach_what_no_trip_showed(pupil, teacher, exam):
    right = [
        c.action == teacher.ideal(m.facts).action for c, m in zip(pupil.choose_all(exam), exam, strict=True)
    ]
    assert np.mean(right) > 0.7
    commonest = max(
        np.mean([teacher.ideal(m.facts).action == action for m in exam]) for action in pupil.actions
    )
    assert np.mean(right) > commonest + 0.1


def test_the_rulebook_decides_as_the_pupil_does(pupil, exam):
    book = pupil.rulebook()
    compiled, numbers = compile_book(book), number_columns(VOCABULARY, WORDING)
    by_list = [{name: fact for name, fact in moment.facts.items() if name != IN_USE} for moment in exam]
    for moment, choice in zip(exam, pupil.choose_at(by_list), strict=True):
        instance = Instance("", "positive", moment.situation, moment.facts)
        situation = shown(book.forest, VOCABULARY, numbers, instance, "positive").situation
        rule, _ = decide(compiled, dict(situation.items()))
        assert rule is not None and replace(book[rule].action, until="") == choice.action


def test_the_rulebook_is_sound_and_comes_back_from_json(pupil):
    book = pupil.rulebook()
    assert audit(book) == ()
    assert loads(dumps(book), "a test") == book
    assert book.lessons == len(pupil.told)
    assert len(book.rules) <= len(pupil.pupil.lines.rules) + 1


def test_values_that_had_a_name_keep_it(pupil):
    book = pupil.rulebook()
    for tree in WORDING.forest.trees:
        grown = book.forest[tree.name]
        assert set(tree.values) <= set(grown.values)
        for value in tree.values:
            below = {leaf for leaf in grown.leaves if value in grown.path(leaf)}
            assert below == set(grown.leaves_below(value))


def test_a_reason_that_is_no_fact_counts_as_none(pupil, robot, teacher, exam):
    silent, odd = SkillPupil(1), SkillPupil(1)
    for moment in exam[:30]:
        word = teacher.ideal(moment.facts)
        silent.hear(told_at(moment, type(word)(word.rule, word.action), "a"))
        odd.hear(told_at(moment, type(word)(word.rule, word.action, about="the weather"), "a"))
    assert silent.pupil.lines == odd.pupil.lines


def test_the_same_words_make_the_same_rules(robot, teacher):
    books = []
    for _ in range(2):
        taught = SkillPupil(7)
        attend(taught, robot, teacher, seed=7, trips=1)
        books.append(taught.rulebook())
    assert books[0] == books[1]


def test_before_the_first_lesson_nothing_is_chosen(exam):
    assert SkillPupil().choose(exam[0]).action is None
    assert SkillPupil().rulebook().rules == ()
