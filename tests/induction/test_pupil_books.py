"""What a pupil keeps fits together after every lesson, and is the same for the same lessons."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pupils import School, plain_columns, taught, three_thresholds
from random_tables import decisions_of, places_of, random_lines, table_of
from test_rule_standings import check_same

from gaitwright.induction.cases import NOBODY
from gaitwright.induction.decision_list import Bound, Lines, RuleLine
from gaitwright.induction.drift import Drift
from gaitwright.induction.pupil import FAR, LEAST, RIVALS, SHORTER, Lesson, Pupil
from gaitwright.induction.repair import bits_of
from gaitwright.induction.revision import PLACES, revised
from gaitwright.induction.standing import standing_of, upper_marks

seeds = st.integers(0, 2**32 - 1)


def lessons(seed: int, n: int, columns: int = 4) -> list[Lesson]:
    """Lessons of ties, gaps, slips, reasons and few scenes."""
    rng = np.random.default_rng(seed)
    x = rng.integers(0, 9, (columns, n)) / 8.0
    x[rng.random((columns, n)) < 0.05] = np.nan
    said = np.where(x[0] > 0.6, 1, np.where(x[1] < 0.4, 2, 0))
    said = np.where(rng.random(n) < 0.1, rng.integers(0, 4, n), said)
    names: dict[int, int] = {}
    places = [names.setdefault(action, len(names)) for action in said.tolist()]
    reasons = rng.integers(NOBODY, columns, n).tolist()
    scenes = rng.integers(0, 5, n).tolist()
    return [
        Lesson(x[:, k].copy(), place, reasons[k], scenes[k])
        for k, place in enumerate(places)
        if place <= max(places[:k], default=-1) + 1
    ]


def state(pupil: Pupil) -> tuple:
    return pupil.lines, pupil.rivals, pupil.draft, pupil.age, pupil.drafts, pupil.cases.weight.tolist()


@pytest.mark.parametrize("seed", [0, 1])
def test_the_same_lessons_and_seed_make_the_same_pupil_whatever_happens_beside(seed):
    one, other = Pupil(plain_columns(4), seed), Pupil(plain_columns(4), seed)
    beside = table_of(np.random.default_rng(1).random((2, 20)), np.arange(20) % 2)
    for k, lesson in enumerate(lessons(seed, 120)):
        first = one.hear(lesson)
        revised(Lines(), beside, 2, k)  # other draws from the same source of chance
        assert other.hear(lesson) == first
        assert state(one) == state(other)
    assert one.decide_all(np.random.default_rng(0).random((4, 50)))[2].tolist() == (
        other.decide_all(np.random.default_rng(0).random((4, 50)))[2].tolist()
    )


@settings(max_examples=8)
@given(seeds)
def test_all_that_is_kept_fits_together_after_every_lesson(seed):
    pupil, before = Pupil(plain_columns(4), seed % 7), Lines()
    for k, lesson in enumerate(lessons(seed, 70)):
        expected = pupil.decide(lesson.row)
        heard = pupil.hear(lesson)
        assert heard.before == before and heard.after == pupil.lines
        assert heard.verdict == expected
        assert not (heard.how and heard.verdict.action == lesson.action)
        before = pupil.lines
        assert pupil.cases.n == len(pupil.scene) == k + 1
        weight = pupil.cases.weight
        assert (weight >= LEAST).all() and (weight <= 1.0).all()
        assert len(pupil.rivals) <= RIVALS
        assert len(set(pupil.rivals)) == len(pupil.rivals)
        if heard.before != heard.after or pupil.lines != Lines():
            check_standing(pupil, heard.aside)


def test_a_list_is_no_rival_of_itself():
    for seed in range(5):
        pupil = Pupil(plain_columns(4), seed)
        for lesson in lessons(seed, 50):
            pupil.hear(lesson)
            assert pupil.lines not in pupil.rivals


def check_standing(pupil: Pupil, aside: tuple[int, ...]) -> None:
    """The standings are those of all cases, and what is set aside is what the list decides otherwise."""
    if pupil.lines == Lines():
        return  # the first lesson counts otherwise until the list has changed once
    check_same(pupil.standing, standing_of(pupil.lines, pupil.cases, pupil.scene))
    wrong = decisions_of(pupil.lines, pupil.cases.x) != pupil.cases.action
    assert aside == tuple(np.flatnonzero(wrong).tolist())


@given(seeds)
def test_many_cases_are_decided_as_each_alone(seed):
    rng = np.random.default_rng(seed)
    pupil, asked = PUPIL, rng.random((5, 15))
    actions, rules, sure = pupil.decide_all(asked)
    np.testing.assert_array_equal(rules, places_of(pupil.lines, asked))
    np.testing.assert_array_equal(actions, decisions_of(pupil.lines, asked))
    for k in range(15):
        verdict = pupil.decide(asked[:, k])
        assert (verdict.action, verdict.rule, verdict.sure) == (actions[k], rules[k], sure[k])


PUPIL = taught(three_thresholds, 150, 5, 4).pupil


@given(seeds)
def test_what_is_sure_is_said_by_all_rivals_and_by_a_firm_rule(seed):
    asked = np.random.default_rng(seed).random((5, 15))
    actions, rules, sure = PUPIL.decide_all(asked)
    meant = places_of(upper_marks(PUPIL.lines, PUPIL.cases, PUPIL.standing.fire), asked)
    for k in np.flatnonzero(sure):
        assert meant[k] >= rules[k]  # no earlier rule could be meant as well
        assert PUPIL.standing.firm[rules[k]]
        assert all(decisions_of(rival, asked[:, [k]])[0] == actions[k] for rival in PUPIL.rivals)
        mine = (PUPIL.standing.fire == rules[k]) & PUPIL.standing.right
        values = PUPIL.cases.x[:, mine]
        assert (values.min(axis=1) <= asked[:, k]).all() and (asked[:, k] <= values.max(axis=1)).all()


def test_nothing_is_sure_where_an_earlier_rule_could_be_meant_as_well():
    pupil = Pupil(plain_columns(1))
    for k, value in enumerate([0.1, 0.2, 0.3, 0.5, 0.65, 0.7, 0.8, 0.95] * 5):
        pupil.hear(Lesson(np.array([value]), int(0.6 <= value < 0.9), NOBODY, k))
    pupil.lines, pupil.rivals = Lines((RuleLine(1, (Bound(0, 0.6, 0.9),)),), 0), []
    pupil.standing = standing_of(pupil.lines, pupil.cases, pupil.scene)
    asked = np.array([[0.15, 0.49, 0.55, 0.62, 0.72, 0.85, 0.93, 0.95, 0.97]])
    actions, _, sure = pupil.decide_all(asked)
    assert actions.tolist() == [0, 0, 0, 1, 1, 1, 0, 0, 0]
    # From 0.5 on the rule might reach, up to 0.95; and beyond that nothing was seen.
    assert sure.tolist() == [True, True, False, False, True, False, False, True, False]


@settings(max_examples=10)
@given(seeds)
def test_the_shortest_list_found_is_adopted_and_the_others_are_rivals(seed):
    rng = np.random.default_rng(seed)
    pupil = Pupil(plain_columns(4), 0)
    for lesson in lessons(seed, 30):
        pupil.hear(lesson)
    actions, own = len(pupil.cases.named), pupil.lines
    found = [random_lines(rng, 3, 4, actions) for _ in range(3)] + [own] + pupil.rivals
    found[0] = Lines((), int(rng.integers(0, actions)))
    pupil.lines, pupil.rivals = (found[0], []) if rng.random() < 0.5 else (own, pupil.rivals)
    was = pupil.lines
    others = [lines for lines in found if lines != was]
    least = min(bits_of(lines, pupil.cases) for lines in others)
    adopted = pupil.adopt(others)
    now = bits_of(pupil.lines, pupil.cases)
    assert adopted == (least < bits_of(was, pupil.cases) - SHORTER)
    assert now == least if adopted else pupil.lines == was
    near = [lines for lines in found if lines != pupil.lines and bits_of(lines, pupil.cases) <= now + FAR]
    weighed = sorted(bits_of(lines, pupil.cases) for lines in set(near))[:RIVALS]
    assert [bits_of(lines, pupil.cases) for lines in pupil.rivals] == weighed


def test_rivals_are_other_lists_hardly_longer():
    own = bits_of(PUPIL.lines, PUPIL.cases)
    assert PUPIL.rivals
    # Weighed when one was last found: cases that came later may have made one longer.
    assert all(bits_of(rival, PUPIL.cases) <= own + 2.0 * FAR for rival in PUPIL.rivals)


def test_a_lesson_heard_again_changes_no_decision():
    school = taught(three_thresholds, 100, 5, 4)
    x, actions = school.pupil.cases.x.copy(), school.pupil.cases.action.copy()
    names = {place: action for action, place in school.names.items()}
    school.teach(x, np.array([names[place] for place in actions.tolist()]))
    assert (decisions_of(school.pupil.lines, x) == actions).all()


@pytest.mark.parametrize("kind", ["noise", "ties", "names"])
def test_nothing_grows_without_end_where_nothing_is_to_be_learned(kind):
    rng = np.random.default_rng(11)
    n = 120
    x = {
        "noise": rng.random((3, n)),
        "ties": rng.integers(0, 2, (3, n)).astype(float),
        "names": np.eye(3)[rng.integers(0, 3, n)].T.copy(),
    }[kind]
    school = School(3).teach(x, rng.integers(0, 4, n))
    assert len(school.pupil.lines.rules) < PLACES - 4
    assert all(len(rival.rules) < PLACES for rival in school.pupil.rivals)
    empty = bits_of(Lines((), 0), school.pupil.cases)
    assert bits_of(school.pupil.lines, school.pupil.cases) < empty


def test_a_change_of_mind_is_noticed_and_slips_are_none():
    rng = np.random.default_rng(0)
    steady, changed = Drift(), Drift()
    assert not any(steady.notes(bool(slip)) for slip in rng.random(600) < 0.05)
    assert not any(changed.notes(bool(slip)) for slip in rng.random(150) < 0.05)
    noticed = [changed.notes(bool(slip)) for slip in rng.random(60) < 0.6]
    assert any(noticed) and noticed.index(True) < 30
