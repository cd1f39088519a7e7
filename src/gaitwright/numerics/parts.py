"""A part of a row as an array of some shape, at the least cost: a view, for Python and for kernels.

numba's own slice and `reshape` look at every view whether it fits and whether the row is contiguous, which
came to a fifth of a tick's kernels; the layouts of `numerics.packing` fit by construction.
"""

from math import prod
from typing import Any

import numpy as np
from jaxtyping import Float
from numba.core import cgutils, types
from numba.core.imputils import impl_ret_borrowed
from numba.extending import intrinsic, overload
from numba.np.arrayobj import make_array, populate_array


def part(row: Float[np.ndarray, "numbers"], start: int, shape: tuple[int, ...]) -> np.ndarray:
    """The numbers of `row` from `start` on as an array of `shape`, a view. In kernels nothing is checked."""
    return row[start : start + prod(shape)].reshape(shape)


@overload(part)
def compiled_part(row, start, shape):
    return lambda row, start, shape: view_of(row, start, shape)  # noqa: PLW0108 # pyright: ignore


def lent(row: Float[np.ndarray, "numbers"], start: int, shape: tuple[int, ...]) -> np.ndarray:
    """`part` for kernels that were handed the row: there, the view does not keep it alive.

    Who keeps a row is counted in atomic steps, which took a quarter of a tick's kernels. A kernel that makes
    a row itself must hold it for as long as it reads views of it.
    """
    return part(row, start, shape)


@overload(lent)
def compiled_lent(row, start, shape):
    return lambda row, start, shape: lent_view_of(row, start, shape)  # noqa: PLW0108 # pyright: ignore


@intrinsic
def view_of(typing_context, row, start, shape):
    """`part` as machine code: an array that points into the row and keeps it alive."""
    return pointing_into(row, shape, keeps=True)


@intrinsic
def lent_view_of(typing_context, row, start, shape):
    """`lent` as machine code: an array that points into the row, whoever keeps that alive."""
    return pointing_into(row, shape, keeps=False)


def pointing_into(row: Any, shape: Any, keeps: bool) -> tuple[Any, Any]:
    """Signature and machine code of a view of a row, both given as types."""
    result = types.Array(row.dtype, len(shape), "C")

    def code(context, builder, signature, values):
        row_type, start_type, shape_type = signature.args
        of, out = make_array(row_type)(context, builder, values[0]), make_array(result)(context, builder)
        first = context.cast(builder, values[1], start_type, types.intp)
        asked = zip(cgutils.unpack_tuple(builder, values[2]), shape_type, strict=True)
        lengths = [context.cast(builder, length, of_type, types.intp) for length, of_type in asked]
        strides = [of.itemsize]
        for length in reversed(lengths[1:]):
            strides.insert(0, builder.mul(strides[0], length))
        data = builder.gep(of.data, [first])
        keeper = (of.meminfo, of.parent) if keeps else (None, None)
        populate_array(out, data, lengths, strides, of.itemsize, *keeper)
        return impl_ret_borrowed(context, builder, result, out._getvalue())

    return result(row, types.intp, shape), code
