"""What was edited lasts: leg cycles as files, profiles and operators in a skillbook; undone, it is gone."""

from pathlib import Path

import numpy as np
import pytest

from gaitwright.control.learned.profile import BINS, ROW, Profile
from gaitwright.errors import WrongUse
from gaitwright.gait.leg_cycles.files import cycle_of, load_cycle
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle
from gaitwright.gait.operators import SHARES, Operator
from gaitwright.learning.operator_books import notes_of as operator_notes
from gaitwright.learning.profile_books import in_book, notes_of
from gaitwright.skillbook import Skillbook
from gaitwright.skillbook.profile_notes import name_of
from gaitwright.skillbook.writer import open_for_learning
from gaitwright.skills.situation import FOREST
from gaitwright.studio.curve_history import Snapshot
from gaitwright.studio.curve_keeping import Keeper
from gaitwright.studio.curve_torque import TorqueCurve, TorqueEdit
from gaitwright.studio.curve_walk import Walk
from gaitwright.studio.curves import Curves
from oracles import robot_called

GO2 = robot_called("go2")
LOW = LegCycle(
    "trot",
    ((0.0, -0.5, 0.0), (0.3, -0.3, 0.1 / 3), (0.7, 0.3, 0.1), (1.0, 0.5, 0.0)),
    ((0.0, -0.5, 0.0), (0.3, -0.3, 0.2), (0.7, 0.3, 0.2), (1.0, 0.5, 0.0)),
    'from "trot", edited\nin the studio',
)


def over(name: str) -> Operator:
    path = np.zeros((SHARES, 2))
    path[10:20, 1] = 1.0
    return Operator(name, ("block",), 0.1, path, np.zeros((SHARES, 3)), 0.15, taught="by hand")


@pytest.fixture
def book(tmp_path: Path) -> Path:
    path = tmp_path / "book.sqlite"
    Skillbook.new(FOREST, "go2", "book").save(path)
    return path


def test_a_leg_cycle_is_a_file_that_is_read_back_as_it_was(tmp_path: Path) -> None:
    keeper = Keeper(None, tmp_path)
    (said,) = keeper.keep(Snapshot({"trot": LOW}), {})
    assert said == f"leg cycle of trot: {tmp_path / 'trot.json'}"
    assert load_cycle(tmp_path / "trot.json") == LOW
    with pytest.raises(WrongUse, match="no edit to keep"):
        keeper.keep(Snapshot({"trot": LOW}), {})
    keeper.keep(Snapshot(), {})
    assert load_cycle(tmp_path / "trot.json") == cycle_of("trot"), "what was undone is as it was"


def test_a_kept_leg_cycle_counts_at_the_next_start_and_can_be_undone(tmp_path: Path) -> None:
    Keeper(None, tmp_path).keep(Snapshot({"trot": LOW}), {})
    (tmp_path / "walk.json").write_text("[]")
    curves = Curves(GO2, folder=tmp_path)
    assert dict(curves.history.now.cycles) == {"trot": LOW}
    (fault,) = curves.faults
    assert "walk.json" in fault
    curves.history.undo()
    curves.keep()
    assert not Curves(GO2, folder=tmp_path).history.now.cycles, "undone and kept: it is as it was"


def test_an_edited_profile_stands_beside_what_it_was(book: Path) -> None:
    walk = Walk.of(GO2, "trot")
    plain = Profile(walk.gait, (0.4, 0.0, 0.0), np.ones((BINS, ROW.size(4))))
    curve = TorqueCurve(walk, TorqueEdit(plain, plain, {}), 0)
    points = curve.points
    points[8][3] += 2.0
    edit = curve.edited(points, mirror=False, who="Ada")
    with open_for_learning(book) as ledger:
        ledger.keep_profiles([notes_of(plain)])
        keeper = Keeper(ledger, None)
        (said,) = keeper.keep(Snapshot(torques={("trot", plain.command): edit}), {})
        assert "N·m at FL knee" in said and "by Ada in the studio" in said
        first, second = in_book(Skillbook.load(book), GO2, "the book")["trot"]
        assert not first.edited and second.edited == edit.profile.edited
        np.testing.assert_array_equal(second.table, edit.profile.table)
        keeper.keep(Snapshot(), {})
    assert [name_of(notes) for notes in Skillbook.load(book).profiles] == [name_of(notes_of(plain))]


def test_operators_of_this_hand_come_first_and_go_again(book: Path) -> None:
    with open_for_learning(book) as ledger:
        ledger.keep_operators([operator_notes(over("old")), operator_notes(over("over a block"))])
        keeper = Keeper(ledger, None)
        keeper.keep(Snapshot(operators=(over("over a block"),)), {})
        assert [notes.name for notes in ledger.book.operators] == ["over a block", "old"]
        keeper.keep(Snapshot(), {})
        assert [notes.name for notes in ledger.book.operators] == ["old", "over a block"]


def test_without_a_place_nothing_is_kept() -> None:
    with pytest.raises(WrongUse, match="no folder"):
        Keeper(None, None).keep(Snapshot({"trot": LOW}), {})
    with pytest.raises(WrongUse, match="a skillbook, and none is open"):
        Keeper(None, None).keep(Snapshot(operators=(over("x"),)), {})
