"""Rows: what is packed comes out whole, in Python and in kernels, for any number of legs."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from jaxtyping import Bool, Float

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.packing import Layout, Packed, packed


class Table(NamedTuple):
    number: float
    vector: Float[np.ndarray, "3"]
    matrix: Float[np.ndarray, "3 3"]
    joints: Float[np.ndarray, "legs 3"]
    down: Bool[np.ndarray, "legs"]
    tensor: Float[np.ndarray, "legs 3 3"]
    priced: Float[np.ndarray, "legs limits"]
    hints: Float[np.ndarray, "3*legs+1"]


LAYOUT = Layout.of(Table, limits=5)
read, write = LAYOUT.views(Table), LAYOUT.views(raw=True)
priced_of, start_of_hints = LAYOUT.field("priced"), LAYOUT.start("hints")


@kernel
def in_a_kernel(row):
    """What a kernel reads of each field, and that it may write to it."""
    t = read(row)
    total = t.number + t.vector[2] + t.matrix[1, 2] + t.joints[1, 2] + t.tensor[1, 2, 0] + t.hints[0]
    out = row.copy()
    write(out).number[0] = -1.0
    write(out).joints[0, 1] = -2.0
    return total + t.down.sum() + priced_of(row)[1, 4] + start_of_hints(row), out


def filled(legs: int, seed: int) -> Table:
    rng = np.random.default_rng(seed)
    return Table(
        float(rng.normal()), rng.normal(size=3), rng.normal(size=(3, 3)), rng.normal(size=(legs, 3)),
        rng.random(legs) < 0.5, rng.normal(size=(legs, 3, 3)), rng.normal(size=(legs, 5)),
        rng.normal(size=3 * legs + 1),
    )  # fmt: skip


@given(st.integers(2, 8), st.integers(0, 99))
def test_what_is_packed_comes_out_whole(legs: int, seed: int) -> None:
    table = filled(legs, seed)
    row = LAYOUT.pack(table)
    assert row.size == LAYOUT.size(legs)
    for name, value in read(row)._asdict().items():
        np.testing.assert_array_equal(value, getattr(table, name), err_msg=name)
        piece = row[LAYOUT.slices(legs)[name]]
        np.testing.assert_array_equal(piece, np.ravel(getattr(table, name)), err_msg=name)


def test_a_kernel_reads_and_writes_the_same_fields() -> None:
    table = filled(4, 1)
    row = LAYOUT.pack(table)
    total, out = in_a_kernel(row)
    expected = (
        table.number + table.vector[2] + table.matrix[1, 2] + table.joints[1, 2] + table.tensor[1, 2, 0]
    )
    expected += table.hints[0] + table.down.sum() + table.priced[1, 4] + LAYOUT.slices(4)["hints"].start
    assert total == pytest.approx(expected)
    changed = read(out)
    assert changed.number == -1.0 and changed.joints[0, 1] == -2.0
    assert (out != row).sum() == 2


@packed
@dataclass(frozen=True, slots=True)
class State(Packed):
    time: float
    q: Float[np.ndarray, "legs 3"]
    down: Bool[np.ndarray, "legs"]
    word: str = "said"


def test_a_value_of_a_row_is_the_value_of_its_fields() -> None:
    made = State(1.5, np.arange(12.0).reshape(4, 3), np.array([True, False, True, True]))
    back = State.of_row(made.row, word="heard")
    assert back.time == 1.5 and isinstance(back.time, float) and back.word == "heard"
    np.testing.assert_array_equal(back.q, made.q)
    assert back.down.dtype == bool and back.down.tolist() == made.down.tolist()


def test_a_changed_value_has_a_row_of_its_own() -> None:
    made = State.of_row(State(1.0, np.zeros((4, 3)), np.ones(4, dtype=bool)).row, word="x")
    other = replace(made, q=np.ones((4, 3)))
    assert other.row[1:13].tolist() == [1.0] * 12 and made.row[1:13].tolist() == [0.0] * 12
    with pytest.raises(AttributeError, match="State has no 'nothing'"):
        made.nothing  # noqa: B018 - asked for its error
