"""Maps that missions leave in a skillbook: kept however a trip ends, used on the next, listed and drawn."""

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from gaitwright.cli import main, trips
from gaitwright.knowledge.json_form import dumps
from gaitwright.learning.map_books import learned_map_of, length_of, notes_of
from gaitwright.locomotion import Lap
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.skillbook import Skillbook
from skillbook.places import map_notes, some_maps
from skillbook.schooling import begun

BAY = {
    "boxes": [
        {"x": 1.9, "y": 0.0, "lx": 0.1, "ly": 1.5, "height": 0.5},
        {"x": 1.3, "y": 0.7, "lx": 1.2, "ly": 0.1, "height": 0.5},
        {"x": 1.3, "y": -0.7, "lx": 1.2, "ly": 0.1, "height": 0.5},
    ],
    "bounds": [-1, -1.6, 3.4, 1.6],
}
"""A bay that is open towards the start, deeper than the camera sees."""
LOOKING = ["mission", "--scene", "bay.json", "--sight", "camera", "--camera", "range=0.9"]
WALKING = [*LOOKING, "--plant", "kinematic", "--driver", "kinematic"]
INTO = ["--skillbook", "a.skills"]
GOAL = ["--goal", "2.6", "0.1"]
SHORT = [*GOAL, "--seconds", "0.1"]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("bay.json").write_text(json.dumps(BAY))
    return tmp_path


def said(words: list[str], code: int, capsys: pytest.CaptureFixture[str]) -> str:
    """All that a command tells, on one line."""
    assert main(words) == code
    out, err = capsys.readouterr()
    return " ".join((out + err).split())


def bay_in(path: str) -> LearnedMap:
    (notes,) = Skillbook.load(path).maps
    assert notes.place == "bay (seed 0)"
    return learned_map_of(notes)


# --- missions ---------------------------------------------------------------------------------------
def test_the_same_mission_with_one_book_gets_shorter():
    """The first trip goes into the bay and out again, the second past it; in processes of their own, where
    nobody checks types five hundred times a second."""
    words = [sys.executable, "-m", "gaitwright", *WALKING, *GOAL, *INTO]
    first, second = (subprocess.run(words, capture_output=True, text=True, check=True) for _ in range(2))
    assert "a.skills is not there: a skillbook is begun" in first.stderr
    assert "nothing is known of bay (seed 0) yet" in first.stderr
    assert "the map of bay (seed 0) is now: 1 trip, " in first.stderr
    assert "the map of bay (seed 0): 1 trip, " in second.stderr and "is now: 2 trips, " in second.stderr
    assert Skillbook.load("a.skills").robot == "go2"
    into, past = map(length_of, bay_in("a.skills").trips)
    assert past < 0.9 * into


def test_a_trip_that_is_interrupted_keeps_its_map(monkeypatch, capsys):
    def interrupt(self: trips.Simulating, lap: Lap) -> None:
        if lap.sensed.time > 1.5:
            raise KeyboardInterrupt

    monkeypatch.setattr(trips.Simulating, "__call__", interrupt)
    assert "is now: 1 trip, " in said([*WALKING, *GOAL, *INTO], 130, capsys)
    ((begin, *_, end),) = bay_in("a.skills").trips
    assert begin[0] < 0.1 and 0.2 < end[0] < 0.9


def test_where_there_is_no_way_what_was_seen_is_kept(capsys):
    Path("bay.json").write_text(json.dumps({"boxes": [{"x": 1, "y": 0, "lx": 0.2, "ly": 2, "height": 0.5}]}))
    told = said([*LOOKING, "--goal", "1", "0", *INTO], 1, capsys)
    assert "there is no way to the goal: on (1, 0) stands an obstacle" in told and "is now: 0 trips, " in told
    learned = bay_in("a.skills")
    assert len(learned.rows) and learned.raster.cells.any() and not learned.trips


def test_a_map_of_another_field_of_that_name_is_learned_anew(capsys):
    other = notes_of(LearnedMap.of((0.0, 0.0, 1.0, 1.0), 0.2), "bay (seed 0)")
    replace(begun(), maps=(other, *some_maps())).save("a.skills")
    assert "it is learned anew" in said([*LOOKING, *SHORT, *INTO], 1, capsys)
    book = Skillbook.load("a.skills")
    assert book.maps[0].bounds == (-1.0, -1.6, 3.4, 1.6) and len(book.maps) == 4


def test_rules_alone_drive_without_a_map(capsys):
    Path("rules.json").write_bytes(dumps(begun().rulebook))
    words = [*LOOKING, *SHORT, "--driver", "hybrid", "--skillbook", "rules.json"]
    assert "rules.json holds rules alone: no map is kept" in said(words, 1, capsys)


@pytest.mark.parametrize(
    ("words", "code", "sentence"),
    [
        ([*SHORT, "--sight", "known"], 2, "--camera goes with --sight camera"),
        ([*SHORT, "--skillbook", "notes.txt"], 3, "notes.txt is no skillbook"),
        ([*SHORT, "--skillbook", "no/a.skills"], 2, "there is no folder no for a.skills"),
        ([*SHORT, "--driver", "hybrid", *INTO], 3, "no file a.skills"),
        ([*SHORT, "--driver", "hybrid"], 2, "with --sight camera any driver may have one, for the map"),
        ([*SHORT, "--learn", *INTO], 2, "so driver hybrid and --skillbook FILE go with it"),
        ([*SHORT, "--balance", "b.json", *INTO], 2, "add --skillbook FILE and its driver"),
        ([*SHORT, *INTO, "--start", "1.3", "0.7", "0"], 2, "is on an obstacle"),
    ],
)
def test_what_cannot_be_is_said_and_leaves_no_book(words, code, sentence, capsys):
    Path("notes.txt").write_text("nothing of a book")
    before = sorted(Path().iterdir())
    assert sentence in said([*LOOKING, *words], code, capsys)
    assert sorted(Path().iterdir()) == before


# --- books map --------------------------------------------------------------------------------------
def test_maps_are_listed_with_their_figures(capsys):
    replace(begun(), maps=some_maps()).save("a.skills")
    told = said(["books", "map", "a.skills"], 0, capsys)
    assert "blocks (seed 1) 2 × 2 2 0.5 2 1 0.32" in told and "rooms (seed 0) 2 × 2 0 – 0 1 0.32" in told
    assert main(["books", "map", "a.skills", "blocks (seed 1)", "--json", "-"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["maps"] == {
        "blocks (seed 1)": {
            "bounds": [-0.5, -1.0, 1.5, 1.0], "trips": [0.795, 0.515], "pieces": 2, "free_m2": 1.0,
            "radius": 0.16, "noise": 0.0125, "strategy": "optimistic",
        }
    }  # fmt: skip
    begun().save("b.skills")
    assert "b.skills has no maps: `gaitwright mission" in said(["books", "map", "b.skills"], 0, capsys)


def test_a_map_is_drawn(capsys):
    replace(begun(), maps=(map_notes(),)).save("a.skills")
    assert "picture: " in said(["books", "map", "a.skills", "--out", "map.png"], 0, capsys)
    assert Path("map.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("words", "code", "sentence"),
    [
        (
            ["a.skills", "blocks (seed 2)"],
            2,
            "no map in a.skills 'blocks (seed 2)'; there is: blocks (seed 1)",
        ),
        (
            ["a.skills", "--out", "map.png"],
            2,
            "--out draws one map: name its place, of blocks (seed 1), rooms",
        ),
        (["a.skills", "rooms (seed 0)", "--out", "map.txt"], 2, "the picture is a PNG file"),
        (["none.skills"], 3, "no file none.skills"),
        (["a.skills", "a", "b"], 2, "books map takes 1 to 2: BOOK [PLACE]; got"),
    ],
)
def test_what_cannot_be_shown_is_said(words, code, sentence, capsys):
    replace(begun(), maps=some_maps()).save("a.skills")
    before = {path.name: path.read_bytes() for path in Path().iterdir()}
    assert sentence in said(["books", "map", *words], code, capsys)
    assert {path.name: path.read_bytes() for path in Path().iterdir()} == before
