"""One learner at a time, readers meanwhile, and no acknowledged lesson lost by a kill."""

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from schooling import forget_in, noted, random_lesson, settle, taught_skillbook, tell_in

import gaitwright
from gaitwright.bench.claims.kills import Tally, kill_through
from gaitwright.errors import BadFile, WrongUse
from gaitwright.learning.notes import pupil_of, relearned
from gaitwright.skillbook import Skillbook, open_for_learning
from gaitwright.skillbook import writer as ledger

SOURCE = str(Path(gaitwright.__file__).parents[1])


@pytest.fixture
def path(tmp_path):
    return taught_skillbook(21, 6).save(tmp_path / "a.skills")


def tell_more(learner, rng):
    """One more lesson, heard and stored."""
    tell_in(learner, pupil_of(learner.book), random_lesson(rng, f"lesson {len(learner.book.steps)}"))


def test_a_second_learner_is_refused_at_once_and_readers_are_not(path, rng):
    with open_for_learning(path) as first:
        tell_more(first, rng)
        with pytest.raises(BadFile, match="in use by another process"):
            open_for_learning(path)
        with pytest.raises(BadFile, match="in use by another process"):
            first.book.save(path)
        tell_more(first, rng)
        assert Skillbook.load(path) == first.book
        done = subprocess.run(
            [sys.executable, "-c", SECOND, str(path)],
            env={**os.environ, "PYTHONPATH": SOURCE},
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
        assert done.stdout.split() == [str(len(first.book.steps)), "refused"], done.stderr
    with open_for_learning(path) as second:
        assert second.book == first.book


SECOND = """
import sys
from gaitwright.errors import BadFile
from gaitwright.skillbook import Skillbook, open_for_learning
print(len(Skillbook.load(sys.argv[1]).steps))
try:
    open_for_learning(sys.argv[1])
except BadFile:
    print("refused")
"""


def test_the_log_of_a_killed_learner_is_read_and_never_into_another_book(tmp_path, path, rng):
    script = "import shutil, sys; [shutil.copy(a, b) for a, b in zip(sys.argv[1::2], sys.argv[2::2])]"
    with open_for_learning(path) as learner:
        tell_more(learner, rng)
        for name in ("b", "c"):  # by another process: a closed descriptor would drop this one's locks
            pairs = [f"{path}", f"{tmp_path}/{name}.skills", f"{path}-wal", f"{tmp_path}/{name}.skills-wal"]
            subprocess.run([sys.executable, "-c", script, *pairs], check=True)
        book = learner.book
    assert Skillbook.load(tmp_path / "b.skills") == book
    other = taught_skillbook(22, 4)
    other.save(tmp_path / "c.skills")
    assert Skillbook.load(tmp_path / "c.skills") == other
    with open_for_learning(tmp_path / "b.skills") as learner:
        assert learner.book == book
    assert sorted(os.listdir(tmp_path)) == ["a.skills", "b.skills", "c.skills"]


def test_a_disk_that_is_full_leaves_the_book_as_it_was(path, rng, monkeypatch):
    monkeypatch.setattr(ledger, "MAX_BYTES", 4096)
    with open_for_learning(path) as learner:
        before = learner.book
        with pytest.raises(BadFile, match="full"):
            for _ in range(200):
                before = learner.book
                tell_more(learner, rng)
        assert learner.book == before == Skillbook.load(path)
    with open_for_learning(path) as learner:
        assert learner.book == before


def test_a_lesson_is_told_once_and_forgotten_once(path, rng):
    with open_for_learning(path) as learner:
        book, pupil = learner.book, pupil_of(learner.book)
        told = book.steps[1].told
        with pytest.raises(WrongUse, match="was told before"):
            learner.tell(told)
        forget_in(learner, pupil, told.id)
        assert learner.book.steps[-1].note == told.id and told not in pupil.told
        after = learner.book
        with pytest.raises(WrongUse, match="is forgotten already"):
            learner.forget(told.id, after.rulebook, noted(learner, pupil), ())
        with pytest.raises(WrongUse, match="was never told"):
            learner.forget("nothing", after.rulebook, noted(learner, pupil), ())
        with pytest.raises(WrongUse, match="was told before"):
            learner.tell(told)  # a name is never given twice
        assert learner.book == after == Skillbook.load(path)
    assert relearned(Skillbook.load(path)).rules == after.rulebook.rules


def test_what_was_told_and_not_settled_is_heard_when_she_goes_on(path, rng):
    told = [random_lesson(rng, f"new {k}") for k in range(5)]
    whole = pupil_of(Skillbook.load(path))
    for one in told:
        whole.hear(one)
    with open_for_learning(path) as learner:
        pupil = pupil_of(learner.book)
        for one in told[:3]:
            tell_in(learner, pupil, one)
    before = Skillbook.load(path)
    assert before.pupil.heard < len(before.steps) - 1 and relearned(before).rules == before.rulebook.rules
    with open_for_learning(path) as learner:
        pupil = pupil_of(learner.book)
        for one in told[3:]:
            tell_in(learner, pupil, one)
        settle(learner, pupil)
    assert Skillbook.load(path).rulebook.rules == whole.rulebook().rules


def test_an_interrupt_while_storing_leaves_nothing_half_stored(path, rng, monkeypatch):
    with open_for_learning(path) as learner:
        book = learner.book

        def interrupted(*_):
            raise KeyboardInterrupt

        with monkeypatch.context() as patch:
            patch.setattr(ledger.rows, "put", interrupted)
            with pytest.raises(KeyboardInterrupt):
                tell_more(learner, rng)
        assert learner.book == book == Skillbook.load(path)
        tell_more(learner, rng)
        assert Skillbook.load(path) == learner.book != book


def test_a_file_replaced_while_it_is_opened_is_not_taught(path, monkeypatch):
    prepare = ledger._prepare

    def replaced_first(db, real):
        shutil.copy(path, f"{path}.new")
        prepare(db, real)
        os.replace(f"{path}.new", path)

    monkeypatch.setattr(ledger, "_prepare", replaced_first)
    with pytest.raises(BadFile, match="was replaced"):
        open_for_learning(path)


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="this system has no SIGKILL")
def test_ten_kills_lose_nothing_acknowledged(tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", SOURCE)
    tally = Tally()
    seed = int.from_bytes(os.urandom(3), "big")
    while tally.kills < 10:
        kill_through(tmp_path / f"{seed}.skills", seed, 10, tally)
        seed += 1
    assert (tally.lost, tally.kept, tally.same) == (0, tally.runs, tally.runs), tally.first
    assert tally.alike == tally.books > 0, tally.first
    assert tally.lessons > 10 and tally.longest_ms > 0
