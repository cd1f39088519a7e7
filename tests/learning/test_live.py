"""A person's lessons: shown before they are kept, durable when they are, taken back as if never said."""

from dataclasses import replace

import pytest

from gaitwright.errors import WrongUse
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.told import Told
from gaitwright.learning.live import LiveLessons, Seen
from gaitwright.learning.notes import pupil_of
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.skillbook import Skillbook, open_for_learning
from gaitwright.skills.situation import FOREST
from learning.roads import moment

TROT, WALK = Action("trot", 0.2, 1.0), Action("walk", 0.1, 0.25)


def told(name: str, action: Action, about: str = "", **changes: float) -> Told:
    facts = moment(**changes).facts
    return Told(name, facts, action.skill, action, "", about, name.split(",", maxsplit=1)[0])


@pytest.fixture
def path(tmp_path):
    return Skillbook.new(FOREST, "go2", "mine").save(tmp_path / "mine.skills")


@pytest.fixture
def lessons(path):
    """A pupil who knows the trot, at forty moments of four scenes, and what a person saw of a mission."""
    with open_for_learning(path) as ledger:
        room = LiveLessons(ledger, SkillPupil(0))
        for k in range(40):
            easy = told(f"scene {k % 4}, {k}", TROT, possible=0.4 + k / 80, remaining=3.0 + k)
            room.keep(room.tried(replace(easy, given="confirmed")))
        room.seen = [
            Seen(0.2 * k, moment(grip=0.8 if k < 10 else 0.3, remaining=20.0 - k), "trot") for k in range(20)
        ]
        yield room


def ice(name: str = "ice at 3.00 s") -> Told:
    return told(name, WALK, "grip", grip=0.3)


def test_a_lesson_is_shown_first_and_changes_nothing_until_it_is_kept(lessons, path):
    before = path.read_bytes(), lessons.pupil.pupil.lines
    tried = lessons.tried(ice())
    assert (path.read_bytes(), lessons.pupil.pupil.lines) == before
    (stretch,) = tried.stretches
    assert (stretch.before, stretch.after) == (TROT, WALK)
    assert (stretch.begin, stretch.end) == (pytest.approx(2.0), pytest.approx(3.8))
    assert tried.is_followed and not tried.broken
    assert any("the grip of the ground is under 0.5" in event.why for event in tried.taken.events)


def test_what_is_kept_is_followed_at_once_and_is_on_the_disk(lessons, path):
    lessons.keep(lessons.tried(ice()))
    book = Skillbook.load(path)
    assert book == lessons.ledger.book and book.steps[-1].told == ice()
    assert book.rulebook.rules == lessons.pupil.rulebook().rules
    for pupil in (lessons.pupil, pupil_of(book)):
        assert pupil.choose(moment(grip=0.2, possible=0.9)).action == WALK
        assert pupil.choose(moment()).action == TROT


def test_what_is_taken_back_was_never_said_but_stays_in_the_history(lessons, path):
    rules = lessons.pupil.rulebook().rules
    lessons.keep(lessons.tried(ice()))
    name, events = lessons.forget()
    assert name == ice().id and any("is gone" in event.why for event in events)
    assert lessons.pupil.rulebook().rules == rules
    book = Skillbook.load(path)
    assert [step.how for step in book.steps[-2:]] == ["told", "forgotten"]
    assert pupil_of(book).rulebook().rules == rules
    with pytest.raises(WrongUse, match="no lesson 'ice at 3"):
        lessons.forget(ice().id)
    again = lessons.tried(ice())
    assert again.told.id != ice().id and again.told.id.startswith(ice().id) and again.is_followed
    lessons.keep(again)
    with pytest.raises(WrongUse, match="was taught before"):
        lessons.tried(again.told)
    assert pupil_of(Skillbook.load(path)).rulebook().rules == lessons.pupil.rulebook().rules


def test_her_last_word_wins_in_the_same_situation_and_it_says_what_breaks(lessons):
    contrary = told("again, 1", WALK, "remaining", possible=0.4 + 20 / 80, remaining=23.0)
    tried = lessons.tried(contrary)
    assert tried.is_followed and [one.id for one in tried.broken] == ["scene 0, 20"]
    assert tried.pupil.choose(moment(possible=0.65, remaining=23.0)).action == WALK
    assert tried.pupil.choose(moment(possible=0.6, remaining=30.0)).action == TROT


def test_how_fast_is_learned_from_the_speeds_that_were_shown(lessons):
    for k, speed in enumerate((0.15, 0.3, 0.2)):
        lessons.keep(
            lessons.tried(told(f"ice, {k}", Action("walk", speed, speed), "grip", grip=0.2 + k / 20))
        )
    assert lessons.pupil.choose(moment(grip=0.22)).action == Action("walk", 0.15, 0.3)
    assert Action("walk", 0.15, 0.3) in {rule.action for rule in lessons.ledger.book.rulebook.rules}
    lessons.forget("ice, 1")
    assert lessons.pupil.choose(moment(grip=0.22)).action == Action("walk", 0.15, 0.2)


def test_nothing_can_be_taken_back_before_anything_was_said(path):
    with open_for_learning(path) as ledger, pytest.raises(WrongUse, match="nothing was taught"):
        LiveLessons(ledger, SkillPupil()).forget()


def test_a_lesson_cut_off_is_there_whole_or_not_at_all(lessons, path, monkeypatch):
    def cut(*_):
        raise KeyboardInterrupt

    tried = lessons.tried(ice())
    with monkeypatch.context() as interrupt:
        interrupt.setattr(lessons.ledger, "settle", cut)
        with pytest.raises(KeyboardInterrupt):
            lessons.keep(tried)
    book = Skillbook.load(path)
    assert book.steps[-1].told == ice(), "the lesson is durable, though the rules did not come any more"
    assert pupil_of(book).choose(moment(grip=0.2)).action == WALK, "and is heard when the book is opened"
