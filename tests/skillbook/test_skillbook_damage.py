"""Damaged, foreign and newer books are refused with one sentence; nothing altered is believed."""

import json
import os
import sqlite3
import tracemalloc
from base64 import b64encode
from contextlib import closing
from dataclasses import replace

import numpy as np
import pytest
from places import WALL, map_notes, some_maps
from schooling import taught_skillbook

from gaitwright.errors import BadFile, WrongUse
from gaitwright.knowledge.lessons import Lesson
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.rules import Preference
from gaitwright.skillbook import Skillbook, open_for_learning, rows, schema
from gaitwright.skillbook.history import Step


@pytest.fixture
def book():
    """A book of lessons, with what only older ones have: a correction, and an order that was asked for."""
    book = taught_skillbook(11, 6)
    situation = book.rulebook.rules[0].positives[0].situation
    rules = [rule.name for rule in book.rulebook.rules]
    wish = Preference(rules[0], rules[1], situation, "lap 3")
    taught = Step("taught", Lesson("omission", "walk", situation, "lap 3", action=Action("walk")))
    rulebook = replace(book.rulebook, preferences=(wish,))
    return replace(book, rulebook=rulebook, steps=(*book.steps, taught), maps=some_maps())


@pytest.fixture
def path(tmp_path, book):
    return book.save(tmp_path / "a.skills")


def refused(path, match="a.skills|is no|is damaged|cannot be"):
    """The one sentence with which both doors refuse a file."""
    for door in (Skillbook.load, open_for_learning):
        with pytest.raises(BadFile, match=match) as caught:
            door(path)
        sentence = str(caught.value)
        assert sentence and "\n" not in sentence.strip() and "Traceback" not in sentence
    return sentence


def alter(path, *statements):
    with closing(sqlite3.connect(path, isolation_level=None)) as db:
        for statement in statements:
            db.execute(statement)


def test_what_is_missing_or_no_file_is_refused(tmp_path):
    refused(tmp_path / "nowhere.skills", "there is no skillbook")
    refused(tmp_path, "is not a file")
    (tmp_path / "empty.skills").touch()
    refused(tmp_path / "empty.skills", "is empty")
    (tmp_path / "lost.skills").symlink_to(tmp_path / "nowhere.skills")
    refused(tmp_path / "lost.skills", "there is no skillbook")
    (tmp_path / "round.skills").symlink_to(tmp_path / "round.skills")
    refused(tmp_path / "round.skills", "cannot be opened")
    refused(tmp_path / "a\0b", "cannot be opened")


@pytest.mark.parametrize("content", [b"\0", b"no book at all " * 1000, b"SQLite format 3\0", b"\xff" * 8192])
def test_what_is_not_sqlite_is_refused(tmp_path, content):
    path = tmp_path / "a.skills"
    path.write_bytes(content)
    refused(path, "no skillbook")
    assert path.read_bytes() == content


def test_another_programs_file_is_refused(tmp_path):
    path = tmp_path / "a.skills"
    alter(path, "CREATE TABLE songs (name)", "PRAGMA application_id=77", "PRAGMA user_version=1")
    refused(path, "an SQLite file, but no skillbook")


def test_a_newer_book_is_refused(path):
    alter(path, "PRAGMA user_version=7")
    refused(path, "written by a newer Gaitwright: book version 7, this one reads up to 6")
    alter(path, "PRAGMA user_version=0")
    refused(path, "which never was")
    alter(path, "PRAGMA user_version=-5")
    refused(path, "which never was")


def test_a_book_too_large_is_refused(path, monkeypatch):
    monkeypatch.setattr(schema, "MAX_BYTES", 10_000)
    refused(path, "MB; a skillbook may have")


@pytest.mark.parametrize(
    "statement",
    [
        "CREATE TABLE more (x)",
        "CREATE VIEW more AS SELECT * FROM rules",
        "CREATE TRIGGER t AFTER INSERT ON steps BEGIN DELETE FROM steps; END",
        "CREATE INDEX i ON steps (content)",
        "DROP TABLE wishes",
        "ALTER TABLE wishes ADD COLUMN x TEXT",
    ],
)
def test_a_book_with_other_tables_is_refused(path, statement):
    alter(path, statement)
    refused(path, "other tables than a skillbook")


@pytest.mark.parametrize(
    "statement",
    [
        "DELETE FROM book",
        "DELETE FROM trees WHERE place = 1",
        "DELETE FROM steps WHERE place = 3",
        "DELETE FROM steps WHERE place = (SELECT max(place) FROM steps)",
        "DELETE FROM events WHERE step = 3 AND place = 0",
        "DELETE FROM events",
        "DELETE FROM instances WHERE place = 0",
        "DELETE FROM rules WHERE name = 'trot'",
        "UPDATE rules SET name = 'another' WHERE name = 'trot'",
        "UPDATE trees SET place = 100 WHERE place = 1",
        "UPDATE instances SET place = place + 50",
        "UPDATE steps SET content = replace(content, 'walking', 'talking')",
        "UPDATE steps SET seal = x'0011223344556677'",
        "UPDATE rules SET content = '{}'",
        "DELETE FROM maps WHERE place LIKE 'rooms%'",
        "UPDATE maps SET place = 'elsewhere' WHERE place LIKE 'rooms%'",
        "UPDATE maps SET content = replace(content, '0.0125', '0.0225')",
    ],
)
def test_rows_missing_or_altered_are_noticed(path, statement):
    alter(path, statement)
    refused(path, "damaged")


def reseal(path, table, edit, where="1"):
    """Alters the content of rows as one would who knows the seals."""
    names = rows.KEYS[table]
    with closing(sqlite3.connect(path, isolation_level=None)) as db:
        found = db.execute(f"SELECT {', '.join(names)}, content FROM {table} WHERE {where}").fetchall()
        for *key, content in found:
            plain = json.loads(content)
            edit(plain)
            now = json.dumps(plain)
            db.execute(
                f"UPDATE {table} SET content = ?, seal = ? WHERE {' AND '.join(f'{n} = ?' for n in names)}",
                (now, rows.seal((table, tuple(key)), now), *key),
            )


@pytest.mark.parametrize(
    ("table", "edit", "message"),
    [
        ("trees", lambda t: t["values"].__setitem__(1, "any"), "twice"),
        ("trees", lambda t: t["parents"].__setitem__(1, 9), "hangs below"),
        ("trees", lambda t: t.update(name="road"), "two trees named"),
        ("trees", lambda t: t.update(values=["any"] * 5000), "length <= 1024"),
        ("rules", lambda r: r.update(upper=["nowhere"] * 15), "no value of support 'nowhere'"),
        ("rules", lambda r: r.update(place=0), "in no order"),
        ("rules", lambda r: r["action"].update(slowest=1e308, fastest=0.0), "no range"),
        ("rules", lambda r: r["action"].update(skill=""), "names a skill"),
        ("rules", lambda r: r.update(quiet=-1), "quiet"),
        ("rules", lambda r: r.update(colour="red"), "unknown field `colour`"),
        ("instances", lambda i: i["instance"].update(values=["any"] * 15), "no leaf"),
        ("instances", lambda i: i["instance"].update(kind="guess"), "guess"),
        ("instances", lambda i: i.update(choice=None), "without a choice"),
        ("instances", lambda i: i["instance"].update(id="x" * 20_000), "length <= 10000"),
        ("book", lambda b: b.update(lessons=-1), "lessons"),
        ("book", lambda b: b.update(seed="0"), "seed"),
        ("steps", lambda s: s.update(how="mended"), "begin with a rulebook|has a lesson"),
        ("steps", lambda s: s.pop("events", 0), "do not belong together"),
        ("steps", lambda s: s.get("told", {}).update(rule=" "), "names that can be read"),
        ("steps", lambda s: s.get("told", {}).update(id="trip 0, moment 0"), "two lessons have one name"),
        ("steps", lambda s: s.get("told", {}).update(given="guessed"), "guessed"),
        ("pupil", lambda p: p.update(heard=99), "other lessons than it holds"),
        ("pupil", lambda p: p["own"].update(otherwise=50), "other lessons than it holds"),
        ("pupil", lambda p: p.update(weights=[[0, 1e9]]), "other lessons than it holds"),
        ("steps", lambda s: s.get("lesson", {}).update(situation=[["a", "x"], ["a", "y"]]), "a tree twice"),
        ("events", lambda e: e.update(mark="middle"), "middle"),
    ],
)
def test_hostile_rows_are_refused(path, table, edit, message):
    reseal(path, table, edit)
    refused(path, message)


def bytes_of(*numbers):
    """Numbers as rows of a map hold them."""
    return b64encode(np.array(numbers, "<f8").tobytes()).decode()


NAN, FAR = bytes_of(*WALL[:2], np.nan, *WALL[3:]), bytes_of(*WALL[:2], 1e7, *WALL[3:])
SHORT, ODD = bytes_of(*WALL[:2], *WALL[:2], *WALL[4:]), bytes_of(*WALL[:7], 3.0)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"place": "elsewhere"}, "of 3 maps it has 3, or under other names"),
        ({"pieces": NAN}, "its map of rooms .seed 0. makes no sense"),
        ({"pieces": FAR}, "makes no sense"),
        ({"pieces": SHORT}, "makes no sense"),
        ({"pieces": ODD}, "makes no sense"),
        ({"pieces": bytes_of(*WALL, 1.0)}, "makes no sense"),
        ({"pieces": "no numbers"}, "base64"),
        ({"ways": [bytes_of(0.0, 1.0, 2.0)]}, "makes no sense"),
        ({"ways": [bytes_of(0.0, np.inf)]}, "makes no sense"),
        ({"ways": [""]}, "makes no sense"),
        ({"ways": [bytes_of(0.0, 1.0)] * 1025}, "length <= 1024"),
        ({"bounds": [0.0, 0.0, 0.0, 1.0]}, "makes no sense"),
        ({"bounds": [0.0, 0.0, 1e300, 1.0]}, "<= 1000000"),
        ({"radius": -1.0}, "radius"),
        ({"noise": -1.0}, "noise"),
        ({"shape": [8_000_000, 8_000_000]}, "makes no sense"),
        ({"shape": [11, 12]}, "makes no sense"),
        ({"shape": [11, 10**12]}, "shape"),
        ({"free": ""}, "makes no sense"),
        ({"colour": "red"}, "unknown field `colour`"),
    ],
)
def test_hostile_maps_are_refused(path, changed, message):
    restate(path, "maps", ("rooms (seed 0)",), changed)
    refused(path, message)


def test_a_book_holds_no_map_that_makes_no_sense(tmp_path, book):
    for maps, message in (
        ((map_notes(), map_notes()), "two maps of one place"),
        ((map_notes(rows=((np.nan,) * 8,)),), "makes no sense"),
        (tuple(map_notes(str(k)) for k in range(257)), "257 maps; 256 is the most"),
    ):
        with pytest.raises(WrongUse, match=message):
            replace(book, maps=maps).save(tmp_path / "b.skills")
    assert not (tmp_path / "b.skills").exists()


def test_marks_that_do_not_fit_their_instances_are_refused(path):
    def widen(rule):
        rule["upper"] = ["any"] * len(rule["upper"])

    reseal(path, "rules", widen)
    refused(path, "the marks do not fit")


def test_content_that_is_no_json_is_refused(path):
    for content in ("", "{", "[" * 100_000, "null"):
        with closing(sqlite3.connect(path, isolation_level=None)) as db:
            db.execute("UPDATE book SET content = ?, seal = ?", (content, rows.seal(("book", (0,)), content)))
        refused(path, "row 0 of its book")


def test_a_book_cut_off_anywhere_is_refused(path, book):
    """But for zeros at its very end, which hold nothing."""
    whole = path.read_bytes()
    held = len(whole.rstrip(b"\0"))
    for length in [*range(1, 200, 13), *range(200, held, 1777), held - 1]:
        path.write_bytes(whole[:length])
        refused(path)
    path.write_bytes(whole)
    assert Skillbook.load(path) == book


def test_a_book_with_flipped_bytes_is_refused_or_the_same(path, book):
    """Bytes that hold nothing may be anything; no others."""
    seed = int.from_bytes(os.urandom(4), "big")
    rng = np.random.default_rng(seed)
    whole, unlike = path.read_bytes(), 0
    places = [*range(0, 100), *rng.integers(100, len(whole), 250).tolist()]
    for place in places:
        spoiled = bytearray(whole)
        spoiled[place] ^= 1 << int(rng.integers(8))
        path.write_bytes(bytes(spoiled))
        try:
            assert Skillbook.load(path) == book, f"byte {place} of seed {seed}"
        except BadFile:
            unlike += 1
        for left in path.parent.glob("a.skills-*"):
            left.unlink()
    assert unlike > 50


@pytest.mark.parametrize("count", ["steps", "rules", "wishes", "trees", "ancestors", "profiles", "maps"])
def test_a_count_of_a_book_takes_no_memory_before_it_is_believed(path, count):
    restate(path, "book", (0,), {count: 900_000})
    told, peak = told_within(path)
    assert peak < 5_000_000 and "900000" in told


def test_events_that_a_step_claims_take_no_memory(path):
    restate(path, "steps", (2,), {"events": 900_000})
    told, peak = told_within(path)
    assert peak < 5_000_000 and "do not belong together" in told


def test_a_count_beyond_all_limits_is_refused(path):
    restate(path, "steps", (2,), {"events": 10**12})
    assert "events" in refused(path)


def told_within(path):
    """With which sentence a book is refused, and how much memory that took [bytes]."""
    tracemalloc.start()
    try:
        return refused(path), tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def restate(path, table, key, changed):
    """Says something else in a row, under a seal that fits."""
    with closing(sqlite3.connect(path, isolation_level=None)) as db:
        where = " AND ".join(f"{name} = ?" for name in rows.KEYS[table])
        (content,) = db.execute(f"SELECT content FROM {table} WHERE {where}", key).fetchone()
        rows.put(db, {(table, key): json.dumps(json.loads(content) | changed)})
