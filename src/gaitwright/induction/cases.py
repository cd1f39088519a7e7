"""What was taught, as columns of numbers: the only thing that a search looks at."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float, Int

from gaitwright.errors import WrongUse

NOBODY = -1
"""The reason of a case for which none was given."""


class Cases(NamedTuple):
    """Cases in rows of columns; kernels take it as it is."""

    x: Float[np.ndarray, "columns cases"]
    """What each column says of each case."""
    order: Int[np.ndarray, "columns cases"]
    """The cases of each column in ascending order."""
    action: Int[np.ndarray, " cases"]
    """What was right."""
    weight: Float[np.ndarray, " cases"]
    """How much a case still counts, up to 1."""
    reason: Int[np.ndarray, " cases"]
    """The fact that decided the teacher, by its place; `NOBODY` where she gave none."""
    reads: Bool[np.ndarray, "columns facts"]
    """Which facts each column is read from."""
    named: Bool[np.ndarray, "actions columns"]
    """Which columns read a fact that the teacher has named for an action."""
    price: Float[np.ndarray, " columns"]
    """Bits that a column costs beside its name: sizes and comparisons cost more than plain numbers."""

    @property
    def n(self) -> int:
        return self.x.shape[1]


def no_cases(reads: Bool[np.ndarray, "columns facts"], price: Float[np.ndarray, " columns"]) -> Cases:
    """The table before the first lesson."""
    columns = len(price)
    nothing = np.zeros(0, np.int64)
    return Cases(
        np.zeros((columns, 0)),
        np.zeros((columns, 0), np.int64),
        nothing,
        np.zeros(0),
        nothing,
        reads,
        np.zeros((0, columns), np.bool_),
        price,
    )


def with_case(cases: Cases, row: Float[np.ndarray, " columns"], action: int, reason: int) -> Cases:
    """The table with one more case. Raises `WrongUse` for an action that is neither known nor the next."""
    n, named = cases.n, cases.named
    if len(row) != len(cases.price) or not 0 <= action <= len(named) or reason >= cases.reads.shape[1]:
        raise WrongUse(
            f"a case has {len(cases.price)} columns, an action up to {len(named)} and a reason below "
            f"{cases.reads.shape[1]}; got {len(row)}, {action} and {reason}"
        )
    if action == len(named):
        named = np.vstack([named, np.zeros((1, len(row)), np.bool_)])
    if reason != NOBODY:
        named = named.copy()
        named[action] |= cases.reads[:, reason]
    places = [np.searchsorted(x, v, sorter=o) for x, o, v in zip(cases.x, cases.order, row, strict=True)]
    order = np.empty((len(row), n + 1), np.int64)
    for k, (old, place) in enumerate(zip(cases.order, places, strict=True)):
        order[k, :place], order[k, place], order[k, place + 1 :] = old[:place], n, old[place:]
    return cases._replace(
        x=np.hstack([cases.x, row[:, None]]),
        order=order,
        action=np.append(cases.action, action),
        weight=np.append(cases.weight, 1.0),
        reason=np.append(cases.reason, reason),
        named=named,
    )


def picked(cases: Cases, which: Sequence[int] | Int[np.ndarray, " some"]) -> Cases:
    """Some of the cases, in the order in which they are named."""
    x = np.ascontiguousarray(cases.x[:, which])
    order = np.argsort(x, axis=1, kind="stable")
    return cases._replace(
        x=x, order=order, action=cases.action[which], weight=cases.weight[which], reason=cases.reason[which]
    )
