"""Leg cycles: the closed path of a foot as points that a person can edit (row J3; thesis 3.4, fig. 3.5).

A cycle has a support part, along which the foot stands still while the body passes, and a transfer part,
given by points (s, forward, height): share of the swing in [0, 1]; place along the way of the foot over
the ground in strides, −0.5 where it leaves to +0.5 where it lands; height over the ground in body heights.
The support part closes it. So one cycle serves every robot, speed and duty factor. The curve through the
points never overshoots them (`numerics/shape_preserving.py`), and the foot leaves and meets the ground
without velocity and acceleration against it.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from gaitwright.errors import WrongUse
from gaitwright.numerics.shape_preserving import curve

Point = tuple[float, float, float]
"""Share of the swing, forward [strides], height [body heights]."""

FEWEST, MOST = 4, 64
"""Number of points."""
NEAREST = 0.01
"""Two points are at least this far apart in s."""
HIGHEST = 1.0
"""Greatest height of a point [body heights]: as high as the body."""
LIFT_OFF: Point = (0.0, -0.5, 0.0)
TOUCH_DOWN: Point = (1.0, 0.5, 0.0)
BINS = 128


@dataclass(frozen=True, slots=True)
class LegCycle:
    """The path of the feet in one manner of walking. Raises `WrongUse` for points that make none."""

    name: str
    points: tuple[Point, ...]
    """Transfer part of all legs, or of the front ones."""
    hind: tuple[Point, ...] | None = None
    """Transfer part of the hind legs; `None`: as the front ones."""
    about: str = ""

    def __post_init__(self) -> None:
        fault = fault_of(self.points, self.name, self.hind)
        if fault:
            raise WrongUse(fault)

    def points_of(self, hind: bool) -> tuple[Point, ...]:
        """The points of a hind leg or of a front leg."""
        return self.hind if hind and self.hind is not None else self.points


# --- whether points make a cycle -------------------------------------------------------------------
def fault_of(points: tuple[Point, ...], name: str, hind: tuple[Point, ...] | None = None) -> str | None:
    """What is wrong with the first point that is wrong, in a sentence; `None` where all are fine."""
    own = fault_of_path(points, name)
    return own or (fault_of_path(hind, f"the hind legs of {name}") if hind is not None else None)


def fault_of_path(points: tuple[Point, ...], name: str) -> str | None:
    """`fault_of` of one transfer part."""
    if not FEWEST <= len(points) <= MOST:
        return f"{name} has {len(points)} points; a leg cycle has {FEWEST} to {MOST}"
    for i, point in enumerate(points):
        fault = fault_of_point(point, points[i - 1] if i else None)
        if fault:
            return f"point {i + 1} of {name} {fault}"
    for i, end, what in ((0, LIFT_OFF, "lift-off"), (len(points) - 1, TOUCH_DOWN, "touch-down")):
        if points[i] != end:
            return f"point {i + 1} of {name} is {written(points[i])}; {what} is always {written(end)}"
    return None


def fault_of_point(point: Point, before: Point | None) -> str | None:
    """What is wrong with a point after the one `before` it."""
    s, forward, height = point
    if not np.isfinite(point).all():
        return f"is {written(point)}; every number must be finite"
    if not 0.0 <= s <= 1.0:
        return f"is at share {s:g} of the swing; a share is between 0 and 1"
    if before is not None and s < before[0] + NEAREST - 1e-12:
        where = f"is at share {s:g} of the swing, the point before it at {before[0]:g}"
        return f"{where}; shares ascend by {NEAREST:g} or more"
    if not -0.5 <= forward <= 0.5:
        side = "behind the lift-off" if forward < 0.0 else "beyond the touch-down"
        return f"lies {abs(forward) - 0.5:g} strides {side}; forward is between -0.5 and 0.5"
    if height < 0.0:
        return f"lies {-height:g} below the ground; a height is 0 or more, in body heights"
    if height > HIGHEST:
        return f"is {height:g} body heights over the ground; at most {HIGHEST:g}"
    return None


def written(point: Point) -> str:
    """A point as people write it."""
    return f"({', '.join(f'{number:g}' for number in point)})"


# --- the curve -------------------------------------------------------------------------------------
def sampled(cycle: LegCycle, at: Float[np.ndarray, "n"], hind: bool = False) -> Float[np.ndarray, "n 6"]:
    """The transfer part at shares `at` of the swing, of front or hind legs.

    Columns: way share (0 at lift-off, 1 at touch-down; forward + 0.5) with its first and second derivative
    by s, height [body heights] with its first and second derivative by s.
    """
    s, forward, height = np.array(cycle.points_of(hind)).T.copy()
    return np.concatenate([curve(s, forward + 0.5, at), curve(s, height, at)], axis=1)


def tabulated(cycle: LegCycle, bins: int = BINS, hind: bool = False) -> Float[np.ndarray, "samples 6"]:
    """`sampled` at `bins + 1` even shares of the swing: what a kernel looks up."""
    return sampled(cycle, np.arange(bins + 1) / bins, hind)


def tabulated_legs(cycle: LegCycle, legs: int, bins: int = BINS) -> Float[np.ndarray, "legs samples 6"]:
    """`tabulated` for each leg of a robot, in its leg order: front to rear, left first."""
    both = tabulated(cycle, bins), tabulated(cycle, bins, hind=True)
    return np.stack([both[is_hind(leg, legs)] for leg in range(legs)])


def is_hind(leg: int, legs: int) -> bool:
    """Whether a leg is of the rear half; the middle pair of an odd number of pairs is not."""
    return 2 * (leg // 2) >= legs // 2


def seen_from_hip(table: Float[np.ndarray, "n 6"], at: Float[np.ndarray, "n"], duty: float):
    """Place and first two derivatives by s of a foot in its swing, `(n, 6)` as `sampled`.

    Forward is in strides from the middle of the support part: while the foot goes one stride over the
    ground, the body goes 1 − β of it (`duty`: β), so the support part is from +β/2 to −β/2.
    """
    out = table.copy()
    out[:, 0] += -0.5 - (1.0 - duty) * (at - 0.5)
    out[:, 1] -= 1.0 - duty
    return out
