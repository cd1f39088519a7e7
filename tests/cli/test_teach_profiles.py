"""Torque profiles by the command line: taught once, played by the drivers, refused where they are none."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from msgspec import structs

from gaitwright.cli import main, teach, teach_profiles
from gaitwright.description.load import load_robot
from gaitwright.knowledge.json_form import dumps
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.rules import QUIET, Rulebook
from gaitwright.knowledge.trust import Experience, grades_in
from gaitwright.learning import practice, profile_lessons, profile_school
from gaitwright.learning.profile_books import notes_of
from gaitwright.learning.profile_lessons import taught
from gaitwright.skillbook import Skillbook, open_for_learning
from gaitwright.skillbook.profile_notes import ProfileNotes, name_of
from gaitwright.skills.situation import FOREST
from knowledge.hand_made import rule_of
from skillbook.profiles import profile_notes
from skillbook.schooling import begun

SKILLS = ("stand", "turn-in-place")
"""The two that are taught soonest: they have one speed."""
TEACH = ["teach", "--lesson", "profiles", "--out"]
MISSION = ["mission", "--goal", "1.5", "0", "--skillbook"]
TURN = ["skill", "--skill", "turn-in-place", "--driver", "learned", "--skillbook"]


def shorten(patch: pytest.MonkeyPatch) -> None:
    """Few skills; and the first one, which is taught in this process, in short runs."""
    patch.setattr(teach_profiles, "skill_names", lambda legs: SKILLS)
    for name in ("SETTLING", "SHOWN"):
        patch.setattr(profile_lessons, name, 0.5)
    for name, seconds in (("HANDED_OVER", 0.2), ("SECONDS", 1.0), ("LOOKED_AT", 0.5)):
        patch.setattr(profile_school, name, seconds)


@pytest.fixture(autouse=True)
def in_an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    shorten(monkeypatch)


@pytest.fixture(scope="module")
def schooled(tmp_path_factory: pytest.TempPathFactory) -> tuple[Skillbook, dict]:
    """A book that was taught two skills and no rules, and what was reported of it."""
    path = tmp_path_factory.mktemp("school") / "go2.skills"
    with pytest.MonkeyPatch.context() as few:
        shorten(few)
        assert main([*TEACH, str(path), "--json", f"{path}.json"]) == 0
    return Skillbook.load(path), json.loads(Path(f"{path}.json").read_text(encoding="utf-8"))


@pytest.fixture
def book(schooled: tuple[Skillbook, dict]) -> Skillbook:
    """The same as go2.skills in the empty folder."""
    schooled[0].save("go2.skills")
    return schooled[0]


def reported(words: list[str], capsys: pytest.CaptureFixture[str], code: int = 0) -> tuple[dict, str]:
    """What a command reports, and what it says besides."""
    capsys.readouterr()
    assert main([*words, "--json", "-"]) == code
    out, err = capsys.readouterr()
    return json.loads(out), " ".join(err.split())


def outdated(notes: ProfileNotes) -> ProfileNotes:
    """As a teacher of other gains taught it."""
    answers = 1.1 * np.frombuffer(notes.answers, "<f4")
    return structs.replace(notes, answers=answers.astype("<f4").tobytes())


def by_skill(book: Skillbook) -> dict[str, list]:
    return {skill: [notes for notes in book.profiles if notes.skill == skill] for skill in SKILLS}


# --- the school ------------------------------------------------------------------------------------
def test_each_skill_is_taught_and_tried(schooled: tuple[Skillbook, dict]) -> None:
    book, report = schooled
    assert (book.robot, len(book.steps)) == ("go2", 1)
    assert [len(notes) for notes in by_skill(book).values()] == [1, 2]
    figures = report["torque_profiles"]
    assert figures["profiles"] == 3 and list(figures["skills"]) == list(SKILLS)
    for skill, found in figures["skills"].items():
        assert found["kept_up"] == found["starts"] and found["held"] > 0.9 and found["played"] > 0.7, skill
        assert [e.how for e in book.trust if e.skill == skill] == ["taught", "drove", "drove"]


def test_a_skill_that_fell_when_it_was_tried_is_less_than_a_partners() -> None:
    cell = profile_notes("trot")
    for kept_up, grade in ((2, "partner"), (1, "assistant"), (0, "apprentice")):
        learned = profile_school.Learned("trot", (cell,), profile_school.Try(kept_up, 1.0, 1.0))
        with pytest.MonkeyPatch.context() as long:
            long.setattr(profile_school, "SECONDS", 6.0)
            long.setattr(profile_school, "HANDED_OVER", 1.0)
            assert grades_in(profile_school.lived(learned)) == {"trot": grade}
    assert profile_school.lived(profile_school.Learned("trot", why="it falls")) == []


def test_what_is_known_is_not_taught_again(
    book: Skillbook, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def learn(task):
        raise AssertionError(f"{task.skill} is taught again")

    monkeypatch.setattr(teach_profiles, "learn", learn)
    report, told = reported([*TEACH, "go2.skills"], capsys)
    assert report["torque_profiles"]["skills"] == {} and Skillbook.load("go2.skills") == book
    assert "2 skills are in go2.skills already: stand, turn-in-place" in told
    assert "next: gaitwright skill --driver learned --robot go2 --skillbook go2.skills --skill stand" in told


def test_what_is_missing_or_out_of_date_is_taught_and_nothing_else(
    book: Skillbook, capsys: pytest.CaptureFixture[str]
) -> None:
    stand, turns = by_skill(book).values()
    stale = outdated(stand[0])
    for had, said in (
        ((), "already: turn-in-place"),
        ((stale,), "the profiles of stand in go2.skills are out of date"),
    ):
        replace(book, profiles=(*had, *turns)).save("go2.skills")
        report, told = reported([*TEACH, "go2.skills"], capsys)
        assert list(report["torque_profiles"]["skills"]) == ["stand"] and said in told
        again = Skillbook.load("go2.skills")
        assert replace(again, trust=book.trust) == book, "the same seed teaches the same"
        new = again.trust[len(book.trust) :]
        assert {entry.skill for entry in new} == {"stand"} and new[0].how == "taught", "trust begins again"


def test_an_interrupted_school_goes_on(book: Skillbook, monkeypatch: pytest.MonkeyPatch) -> None:
    keep = teach_profiles.keep

    def keep_one(ledger, learned) -> None:
        keep(ledger, learned)
        raise KeyboardInterrupt

    with monkeypatch.context() as cut:
        cut.setattr(teach_profiles, "keep", keep_one)
        assert main([*TEACH, "again.skills"]) == 130
    (stand,) = Skillbook.load("again.skills").profiles
    assert stand == book.profiles[0]
    assert main([*TEACH, "again.skills"]) == 0
    again = Skillbook.load("again.skills").profiles
    assert again[0] == stand and [name_of(notes) for notes in again] == [
        name_of(notes) for notes in book.profiles
    ]


def test_both_lessons_come_in_one(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(teach, "EXAM", 8)
    monkeypatch.setattr(teach_profiles, "skill_names", lambda legs: ("stand",))
    report, _ = reported(["teach", "--lesson", "all", "--trips", "1", "--out", "go2.skills"], capsys)
    assert report["trips"] == 1 and list(report["torque_profiles"]["skills"]) == ["stand"]
    both = Skillbook.load("go2.skills")
    assert both.rulebook.rules and [notes.skill for notes in both.profiles] == ["stand"]


def test_a_book_for_another_robot_leaves_the_profiles_behind(
    book: Skillbook, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(teach_profiles, "skill_names", lambda legs: ("stand",))
    assert main([*TEACH, "six.skills", "--from", "go2.skills", "--robot", "hexapod"]) == 0
    assert [len(notes.offsets) for notes in Skillbook.load("six.skills").profiles] == [6]


# --- the drivers -----------------------------------------------------------------------------------
def test_what_was_learned_drives_a_skill(book: Skillbook, capsys: pytest.CaptureFixture[str]) -> None:
    report, _ = reported([*TURN, "go2.skills", "--seconds", "3"], capsys)
    assert report["driver_share"] == {"learned": 1.0} and report["falls"] == 0
    assert report["yaw_rate_error_radps"] < 0.1


@pytest.fixture(scope="module")
def trot() -> ProfileNotes:
    return notes_of(taught(load_robot("go2"), "trot"))


def trotting(profile: ProfileNotes, path: str) -> None:
    """A book with a firm rule, to trot, and a profile for it."""
    rule = replace(rule_of(FOREST, "trot", action=Action("trot", 0.2, 0.6)), quiet=QUIET)
    replace(Skillbook.new(Rulebook(FOREST, (rule,)), "go2"), profiles=(profile,)).save(path)


def test_both_drivers_play_what_their_book_knows_on_a_mission(
    trot: ProfileNotes, capsys: pytest.CaptureFixture[str]
) -> None:
    trotting(trot, "trot.skills")
    for driver, least in (("hybrid", 0.2), ("learned", 1.0)):
        report, told = reported([*MISSION, "trot.skills", "--driver", driver], capsys)
        assert report["arrived"] and report["driver_share"]["learned"] >= least and "out of date" not in told
        assert driver == "learned" or report["driver_share"]["learned"] < 0.95


def test_a_hybrid_goes_without_what_is_out_of_date_and_says_so(
    trot: ProfileNotes, capsys: pytest.CaptureFixture[str]
) -> None:
    trotting(outdated(trot), "trot.skills")
    report, told = reported([*MISSION, "trot.skills", "--driver", "hybrid", "--seconds", "0.5"], capsys, 1)
    assert report["driver_share"] == {"hybrid": 1.0}
    assert "the profiles of trot in trot.skills are out of date" in told
    assert "gaitwright teach --lesson profiles --robot go2 --out trot.skills" in told


def test_a_trip_that_may_learn_is_in_the_history_of_trust(
    trot: ProfileNotes, capsys: pytest.CaptureFixture[str]
) -> None:
    trotting(trot, "trot.skills")
    words = ["trot.skills", "--driver", "hybrid"]
    reported([*MISSION, *words], capsys)
    assert Skillbook.load("trot.skills").trust == (), "nothing is written unasked"
    with open_for_learning("trot.skills") as ledger:
        ledger.trust([Experience("trot", "set", grade="apprentice")])
    report, _ = reported([*MISSION, *words], capsys)
    assert "learned" not in report["driver_share"], "an apprentice watches"


def practised(trips: int) -> list[str]:
    return ["teach", "--lesson", "practice", "--trips", str(trips), "--out", "go2.skills"]


def test_practice_drives_in_physics_and_tells_trip_by_trip(
    trot: ProfileNotes, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(practice, "SECONDS", 2.0)
    monkeypatch.setattr(teach, "EXAM", 8)
    assert main(["teach", "--trips", "2", "--out", "go2.skills"]) == 0
    taught_so_far = Skillbook.load("go2.skills")
    replace(taught_so_far, profiles=(trot,)).save("go2.skills")
    report, told = reported(practised(2), capsys)
    found = report["practice"]
    assert [trip["trip"] for trip in found["trips"]] == ["1", "2"] and "trip 2 of 2" in told
    for trip in found["trips"]:
        assert sum(trip["driver_share"].values()) == pytest.approx(1.0) and trip["tick_us"]["lap"] > 0.0
        assert trip["energy_j_per_m"] >= 0.0 and trip["falls"] in (0, 1)
    assert main(practised(1)) == 0
    line = next(line for line in capsys.readouterr().out.splitlines() if "J/m" in line)
    assert "by learned" in line and "tick [µs]" in line


WRONG = [
    (
        ["teach", "--lesson", "practice", "--out", "rules.skills"],
        2,
        "no rules or no profiles of go2 to practise",
    ),
    (["teach", "--lesson", "practice", "--policy", "a.toml", "--out", "go2.skills"], 2, "leave --policy out"),
    ([*TURN, "none.skills"], 3, "no file none.skills: a book is wanted"),
    ([*TURN, "rules.json"], 3, "rules.json is no skillbook; what was exported, or rules as JSON, becomes"),
    (
        [*TURN, "rules.skills"],
        2,
        "rules.skills has no profiles of turn-in-place; it has: none; teach them by",
    ),
    (
        ["skill", "--skill", "walk", *TURN[3:], "go2.skills"],
        2,
        "of walk; it has: stand, turn-in-place; teach",
    ),
    (
        ["skill", "--skill", "stand", *TURN[3:], "go2.skills", "--robot", "hexapod"],
        2,
        "were taken from go2, not from hexapod",
    ),
    ([*TURN, "stale.skills"], 2, "turn-in-place in stale.skills are out of date: the numerical controller"),
    ([*TURN, "short.skills"], 3, "its profile turn-in-place 0.000 0.000 0.800 is of another robot than go2"),
    ([*MISSION, "none.skills", "--driver", "learned"], 3, "no file none.skills"),
    ([*MISSION, "rules.json", "--driver", "learned"], 3, "rules.json is no skillbook; what was exported"),
    (
        [*MISSION, "rules.skills", "--driver", "learned"],
        2,
        "rules.skills has no profiles to play; teach them",
    ),
    ([*MISSION, "go2.skills", "--driver", "numerical"], 2, "drivers hybrid and learned and --skillbook FILE"),
    ([*TEACH, "go2.skills", "--trips", "3"], 2, "leave --trips and --policy out"),
    ([*TEACH, "rules.json"], 2, "rules.json exists: name a new skillbook"),
    ([*TEACH, "go2.skills", "--robot", "hexapod"], 2, "was taught on the robot go2, not hexapod"),
]


@pytest.mark.parametrize(("words", "code", "sentence"), WRONG, ids=lambda value: str(value)[-50:])
def test_what_cannot_be_done_is_told_in_a_sentence_and_changes_nothing(
    words: list[str], code: int, sentence: str, book: Skillbook, capsys: pytest.CaptureFixture[str]
) -> None:
    begun().save("rules.skills")
    Path("rules.json").write_bytes(dumps(begun().rulebook))
    replace(book, profiles=tuple(map(outdated, book.profiles))).save("stale.skills")
    replace(book, profiles=(profile_notes("turn-in-place", (0.0, 0.0, 0.8)),)).save("short.skills")
    before = {path.name: path.read_bytes() for path in Path().iterdir()}
    assert main(words) == code
    out, err = capsys.readouterr()
    assert sentence in err and out == "" and err.splitlines()[-1].startswith("gaitwright: ")
    assert {path.name: path.read_bytes() for path in Path().iterdir()} == before


def test_profiles_that_another_version_wrote_are_taught_again(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(teach_profiles, "skill_names", lambda legs: ("stand",))
    replace(begun(), profiles=(profile_notes("stand"),)).save("short.skills")
    assert main([*TEACH, "short.skills"]) == 0
    assert "is of another robot than go2 or version: all are taught again" in capsys.readouterr().err
    assert len(Skillbook.load("short.skills").profiles[0].table) > 50_000
