"""A profile as a table: what nobody touched stays, a change comes back, and what cannot be is refused."""

import csv
import io
from functools import cache

import numpy as np
import pytest

from gaitwright.control.learned.profile import BINS, ROW, Profile
from gaitwright.errors import BadFile, WrongUse
from gaitwright.learning.profile_csv import ROWS, asked_in, edited, written
from gaitwright.learning.profile_lessons import taught
from oracles import robot_called

DOG = robot_called("dog")


@cache
def trot() -> Profile:
    return taught(DOG, "trot")


def with_change(column: str, change: dict[int, float]) -> str:
    """The table of the trot with something added to one column in some rows."""
    rows = list(csv.reader(io.StringIO(written(DOG, trot()))))
    place = next(k for k, head in enumerate(rows[1]) if head.startswith(column))
    for row, more in change.items():
        rows[2 + row][place] = f"{float(rows[2 + row][place]) + more:.3f}"
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows(rows)
    return out.getvalue()


def test_a_table_says_which_profile_it_is_of():
    skill, command = asked_in(written(DOG, trot()), "a.csv")
    assert skill == "trot" and np.allclose(command, trot().command, atol=1e-6)
    assert len(written(DOG, trot()).splitlines()) == 2 + ROWS


def test_what_is_changed_comes_back_and_nothing_else():
    new = edited(DOG, trot(), with_change("FR knee torque", {8: 0.5, 9: 1.0, 10: 0.5}), "a.csv")
    change, where = new.table - trot().table, ROW.slices(DOG.n)
    knee = change[:, where["free"].start + 5]
    assert knee[9 * BINS // ROWS] == pytest.approx(1.0, abs=1e-4)
    assert knee[17 * BINS // (2 * ROWS)] == pytest.approx(0.75, abs=1e-4), "straight between the rows"
    np.testing.assert_allclose(change[:, where["tau"].start + 5], knee, atol=1e-5)
    touched = {where["free"].start + 5, where["tau"].start + 5}
    others = [k for k in range(change.shape[1]) if k not in touched]
    assert not change[:, others].any() and new.edited == "up to +1.00 N·m at FR knee, phase 0.28"


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (lambda: written(DOG, trot()), "changes no torque of trot"),
        (
            lambda: with_change("FR knee torque", {9: 0.3 * DOG.tau_max.max()}),
            "FR knee leaps to the next row",
        ),
        (lambda: with_change("FL hip1 torque", {k: 99.0 for k in range(ROWS)}), "beyond what the motor has"),
    ],
)
def test_edits_that_cannot_be_are_refused(content, told):
    with pytest.raises(WrongUse, match=told):
        edited(DOG, trot(), content(), "a.csv")


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (lambda: "", "is no profile"),
        (lambda: "profile,trot,1,2\n", "is no profile"),
        (lambda: written(DOG, trot()).replace("FL stance", "FL sits"), "has not the 32 rows"),
        (lambda: "\n".join(written(DOG, trot()).splitlines()[:-1]), "has not the 32 rows"),
        (lambda: with_change("FR knee torque", {3: float("nan")}), "line 6: .* finite"),
        (lambda: written(DOG, trot()).replace("0.06250,", "much,", 1), "line 5: could not convert"),
    ],
)
def test_tables_that_are_none_are_refused(content, told):
    with pytest.raises(BadFile, match=told):
        text = content()
        asked_in(text, "a.csv")
        edited(DOG, trot(), text, "a.csv")
