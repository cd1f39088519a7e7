"""A part of a row is what numpy's slice and reshape make of it, in Python and in kernels."""

import numpy as np
import pytest

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.parts import part


@kernel
def matrix_in_a_kernel(row, start, rows):
    return part(row, start, (rows, 3))


@kernel
def tensor_of_a_row_that_is_gone(size):
    """The row is the kernel's own; its part must keep it alive."""
    row = np.arange(size) * 1.0
    return part(row, 2, (2, 3, 4))


@pytest.mark.parametrize(("start", "rows"), [(0, 4), (5, 1), (7, 3), (3, 0)])
def test_a_part_is_a_slice_in_that_shape(start: int, rows: int) -> None:
    row = np.arange(20.0)
    expected = row[start : start + 3 * rows].reshape(rows, 3)
    for found in (part(row, start, (rows, 3)), matrix_in_a_kernel(row, start, rows)):
        np.testing.assert_array_equal(found, expected)
        assert found.flags.c_contiguous
        found[:] = -1.0  # a view
        assert (row[start : start + 3 * rows] == -1.0).all()
        row[:] = np.arange(20.0)


def test_a_part_keeps_its_row() -> None:
    parts = [tensor_of_a_row_that_is_gone(100) for _ in range(200)]
    for found in parts:
        np.testing.assert_array_equal(found, np.arange(2.0, 26.0).reshape(2, 3, 4))
