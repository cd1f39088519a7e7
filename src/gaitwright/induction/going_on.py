"""Until when an action that was begun goes on: learned where it goes on in cases in which nobody begins it.

A list says when an action is right. Hysteresis it cannot say, unless some number tells what is in use: in one
and the same situation going on is right, and beginning is not. There a bound on one number, beyond which
the action always ended, says until when it goes on; the list need not say these cases then.
"""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Int

from gaitwright.induction.cases import Cases
from gaitwright.induction.decision_list import Bound
from gaitwright.induction.marks import cut_in

ENDINGS, SCENES, BAND = 3, 2, 3
"""An end is believed from so many cases on, in so many scenes; and so many cases in which it went on, and so
many in which it was not begun, must lie between where it begins and where it ends."""


def until_of(
    action: int,
    cases: Cases,
    scene: Int[np.ndarray, " cases"],
    in_use: Bool[np.ndarray, " cases"],
    said: Bool[np.ndarray, " cases"],
    columns: Sequence[int],
    known: Sequence[Sequence[float]],
) -> Bound | None:
    """While which number lies between which bounds an action goes on; `None` where nothing speaks for it.

    `in_use` says in which cases the action was in use already, `said` which the end of another one says:
    that one goes on there, which is no reason for this one to. `columns` may be asked for, `known` are their
    bounds that have a name. The number that the teacher named for the action comes first, else the one with
    the most cases between beginning and end.
    """
    right = cases.action == action
    went_on, ended = in_use & right, in_use & ~right
    begun, refused = ~in_use & right, ~in_use & ~right & ~said
    if min(went_on.sum(), refused.sum()) < BAND or not begun.any():
        return None
    if ended.sum() < ENDINGS or len(set(scene[ended].tolist())) < SCENES:
        return None
    found: list[tuple[bool, int, Bound]] = []
    kept, over = cases.x[np.ix_(columns, went_on)], cases.x[np.ix_(columns, ended)]
    for side in (1.0, -1.0):
        parted = (side * over).max(axis=1) < (side * kept).min(axis=1)  # never where one was not measured
        for column in np.array(columns)[parted].tolist():
            x = side * cases.x[column]
            end, least = x[ended].max(), x[went_on].min()
            between = (x > end) & (x < x[begun].min())
            many = min(int((between & went_on).sum()), int((between & refused).sum()))
            if many >= BAND:
                low, high = sorted((side * end, side * least))
                cut = cut_in(low, high, known[column])
                bound = Bound(column, cut, np.inf) if side > 0 else Bound(column, -np.inf, cut)
                found.append((bool(cases.named[action, column]), many, bound))
    return max(found, key=lambda one: one[:2])[2] if found else None


def only_goes_on(
    bound: Bound, action: int, cases: Cases, in_use: Bool[np.ndarray, " cases"]
) -> Bool[np.ndarray, " cases"]:
    """The cases that an end says, so that no list need say them: the action is right because it is in use."""
    x, right = cases.x[bound.column], cases.action == action
    begun = x[right & ~in_use]
    inside = (x >= bound.low) & (x < bound.high)
    beyond = x < begun.min() if np.isfinite(bound.low) else x > begun.max()
    return in_use & right & inside & beyond
