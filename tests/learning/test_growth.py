"""What a trip does to trust: motion bugs are noticed and blamed on who drove, the rest of the way counts."""

from dataclasses import replace

import numpy as np
import pytest

from gaitwright.knowledge.trust import Experience, grades_in
from gaitwright.learning.growth import bugs_in, grown, lived_through
from gaitwright.learning.own_mistakes import AT_LIMIT, NO_GROUND, motion_bugs_in
from gaitwright.record.channels import columns_of
from gaitwright.record.recording import Recording
from gaitwright.skillbook import Skillbook, open_for_learning
from gaitwright.skills.situation import FOREST
from learning.test_own_mistakes import walked

SECONDS = 2.0


def trip(drivers: tuple[str, ...] = ("learned",), **changed) -> Recording:
    """Two seconds of a trot to a goal, driven by the first of `drivers` for half of the way and then by the
    last; `changed`: channels, each a function that alters what was recorded."""
    plain = walked("flat", "trot", 0.5, SECONDS)
    data, places = np.array(plain.data[:, :]), columns_of(plain.robot.n)
    data[:, places["driver"]] = 0.0
    data[len(data) // 2 :, places["driver"]] = len(drivers) - 1.0
    for channel, alter in changed.items():
        alter(data[:, places[channel]], plain)
    return replace(plain, data=data, drivers=drivers)


def ticks(begin: float, seconds: float, recording: Recording) -> slice:
    return slice(round(begin / recording.dt), round((begin + seconds) / recording.dt) + 1)


def no_ground(begin: float, seconds: float):
    """The front left foot should carry, and does not."""

    def alter(load, recording):
        load[ticks(begin, seconds, recording), 0] = 0.0

    def down(stance, recording):
        stance[ticks(begin, seconds, recording), 0] = 1.0

    return {"load": alter, "stance": down}


def too_much(begin: float, seconds: float):
    """The rear right knee is asked for all that it has."""

    def alter(tau, recording):
        tau[ticks(begin, seconds, recording), 11] = -recording.robot.tau_max[3, 2]

    return {"tau": alter}


def at_stop(begin: float, seconds: float):
    def alter(q, recording):
        q[ticks(begin, seconds, recording), 2] = recording.robot.q_min[0, 2]

    return {"q": alter}


def test_a_walk_on_good_ground_has_no_motion_bug():
    assert motion_bugs_in(trip()) == ()


@pytest.mark.parametrize(
    ("kind", "seconds", "sentence"),
    [
        (no_ground, NO_GROUND, "foot FL found no ground at 0.6 s"),
        (too_much, AT_LIMIT, "RR knee was asked for more torque than it has at 0.6 s"),
        (at_stop, AT_LIMIT, "FL knee stood at its stop at 0.6 s"),
    ],
)
def test_a_failed_step_and_an_illegal_operation_are_noticed_once_they_last(kind, seconds, sentence):
    assert sentence in [bug.sentence for bug in motion_bugs_in(trip(**kind(0.6, seconds + 0.01)))]
    assert sentence not in [bug.sentence for bug in motion_bugs_in(trip(**kind(0.6, seconds - 0.1)))]


def test_a_bug_is_blamed_on_the_learned_controller_only_where_it_drove():
    late = too_much(1.5, 0.3)
    assert [bug.skill for bug in bugs_in(trip(("numerical", "learned"), **late))] == ["trot"]
    assert bugs_in(trip(("numerical",), **late)) == []
    assert bugs_in(trip(("learned", "numerical"), **late)) == []


def test_a_trip_without_a_bug_counts_the_seconds_that_were_driven():
    (entry,) = lived_through(trip(("numerical", "learned")), "the meadow")
    assert (entry.skill, entry.how, entry.why) == ("trot", "drove", "the meadow")
    assert entry.seconds == pytest.approx(SECONDS / 2, abs=0.05)
    assert lived_through(trip(("numerical",)), "the meadow") == []


def test_a_trip_with_a_bug_tells_where_it_was_and_counts_nothing():
    (entry,) = lived_through(trip(**too_much(0.6, 0.3)), "the meadow")
    assert (entry.skill, entry.how) == ("trot", "bug") and entry.why.startswith("the meadow: RR knee")
    assert "possible" in entry.facts, "all that was measured there"


def test_a_hand_back_is_no_bug_and_is_told_apart():
    entries = lived_through(trip(), "the meadow", ((1.2, "trot"), (1.6, "trot")))
    assert [entry.how for entry in entries] == ["drove", "returned"]
    assert "handed back for not being the taught situation at 1.2 s" in entries[1].why and entries[1].facts


def test_an_apprentice_watches_and_nobody_else_does():
    driven = trip(("numerical",))
    (entry,) = lived_through(driven, "the meadow", grades={"trot": "apprentice"})
    assert entry.how == "watched" and entry.seconds == pytest.approx(SECONDS, abs=0.05)
    assert lived_through(driven, "the meadow", grades={"trot": "partner"}) == []


def test_what_was_lived_through_is_in_the_book_and_told_where_it_changes_a_grade(tmp_path):
    path = Skillbook.new(FOREST, "dog", "growing").save(tmp_path / "a.skills")
    with open_for_learning(path) as ledger:
        assert grown(ledger, []) == []
        assert grown(ledger, [Experience("trot", "drove", 1.0, why="one")]) == []
        (up,) = grown(ledger, [Experience("trot", "drove", 60.0, why="two")])
        assert up == "trust in trot: partner → skilled (two)"
        (down,) = grown(ledger, [Experience("trot", "bug", why="three: it fell")])
        assert down == "trust in trot: skilled → partner (three: it fell)"
    book = Skillbook.load(path)
    assert [entry.why for entry in book.trust] == ["one", "two", "three: it fell"]
    assert grades_in(book.trust) == {"trot": "partner"}
