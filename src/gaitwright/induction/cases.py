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
    """How much a case counts: 1, more where the teacher stepped in, less where she was contradicted since."""
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


def table_of(
    rows: Float[np.ndarray, "cases columns"],
    action: Int[np.ndarray, " cases"],
    reason: Int[np.ndarray, " cases"],
    actions: int,
    like: Cases,
) -> Cases:
    """The table of many cases at once, of so many known actions, over the columns of another table: what
    `with_case` makes one by one."""
    x = np.ascontiguousarray(rows.T)
    named = np.zeros((actions, len(like.price)), np.bool_)
    for a, r in zip(action.tolist(), reason.tolist(), strict=True):
        if r != NOBODY:
            named[a] |= like.reads[:, r]
    order = np.argsort(x, axis=1, kind="stable")
    return Cases(x, order, action, np.ones(len(action)), reason, like.reads, named, like.price)


def with_case(
    cases: Cases, row: Float[np.ndarray, " columns"], action: int, reason: int, weight: float = 1.0
) -> Cases:
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
    columns = zip(cases.x, cases.order, row, strict=True)
    places = [np.searchsorted(x, v, "right", sorter=o) for x, o, v in columns]
    order = np.empty((len(row), n + 1), np.int64)
    for k, (old, place) in enumerate(zip(cases.order, places, strict=True)):
        order[k, :place], order[k, place], order[k, place + 1 :] = old[:place], n, old[place:]
    return cases._replace(
        x=np.hstack([cases.x, row[:, None]]),
        order=order,
        action=np.append(cases.action, action),
        weight=np.append(cases.weight, weight),
        reason=np.append(cases.reason, reason),
        named=named,
    )


def widened(
    cases: Cases, reads: Bool[np.ndarray, "columns facts"], price: Float[np.ndarray, " columns"]
) -> Cases:
    """The table with further columns, at the end: 0 in every case so far."""
    more = len(price) - len(cases.price)
    return cases._replace(
        x=np.vstack([cases.x, np.zeros((more, cases.n))]),
        order=np.vstack([cases.order, np.tile(np.arange(cases.n), (more, 1))]),
        reads=reads,
        named=np.hstack([cases.named, np.zeros((len(cases.named), more), np.bool_)]),
        price=price,
    )


def picked(cases: Cases, which: Sequence[int] | Int[np.ndarray, " some"]) -> Cases:
    """Some of the cases, in the order in which they are named."""
    x = np.ascontiguousarray(cases.x[:, which])
    order = np.argsort(x, axis=1, kind="stable")
    return cases._replace(
        x=x, order=order, action=cases.action[which], weight=cases.weight[which], reason=cases.reason[which]
    )
