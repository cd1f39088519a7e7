"""Body height, pitch and roll from the feet that stand (row J5; equations.md §2, eq. 3-20 … 3-29)."""

import math
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.errors import WrongUse
from gaitwright.gait.contact_plane import APART, Plane, fit_plane, plane_normal
from gaitwright.numerics.compiled import kernel

LEVEL = Plane(0.0, 0.0, 0.0, 0.0, 0.0)
"""Level ground at height 0: the past of a robot that has none."""


class Regulation(NamedTuple):
    """The pose of a body that lies in the plane of its feet."""

    roll: float
    """[rad], turns in the order yaw, pitch, roll."""
    pitch: float
    """[rad], positive nose down."""
    height: float
    """Of the base origin, world z [m]."""
    plane: Plane
    """The plane of the foot centres; hand it in as `before` at the next call."""
    determined: float
    """How far the feet determine the plane: 1 least squares, 0 the past plane across the line of the feet."""
    sentence: str
    """What the plane was made of."""


def regulate(
    feet_w: Float[np.ndarray, "feet 3"],
    place: Float[np.ndarray, "3"],
    stand: float,
    before: Plane = LEVEL,
) -> Regulation:
    """Roll, pitch and height of a body over the feet that stand.

    `feet_w`: any number of foot centres, world [m]: those in contact, and for a lifted foot its last contact
    point, where there is one. `place`: world x, y [m] of the base origin and its yaw [rad]. `stand`: its
    distance from the plane of the foot centres, square to it [m] (`Robot.stand`). `before`: the plane so
    far, which decides what the feet leave open: fewer than three, or all on a line. Raises `WrongUse` for an
    array of another shape and a number that is not finite. Nothing is smoothed here: the coordinator
    low-passes the plane.
    """
    points = np.ascontiguousarray(feet_w, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 3:
        raise WrongUse(f"feet of shape {points.shape}; expected (feet, 3): a row x, y, z [m] for each foot")
    if np.shape(place) != (3,) or len(before) != 5:
        raise WrongUse(
            f"place of shape {np.shape(place)} and a plane of {len(before)} numbers; expected x, y, yaw "
            "and a `Plane`"
        )
    for what, values in (("foot", points), ("place", place), ("stand", stand), ("plane before", before)):
        if not np.isfinite(values).all():
            raise WrongUse(f"{what} {np.asarray(values).tolist()} is not finite; expected numbers in metres")
    plane, determined = fit_plane(points, before)
    normal = plane_normal(plane)
    roll, pitch = roll_pitch_in_plane(normal, place[2])
    ground = plane.z + plane.slope_x * (place[0] - plane.x) + plane.slope_y * (place[1] - plane.y)
    height = height_over(float(ground), stand, normal)
    return Regulation(roll, pitch, height, plane, determined, told(points, determined))


@kernel
def roll_pitch_in_plane(normal, yaw):
    """Roll and pitch [rad] of a body at `yaw` whose z axis is the unit `normal` (replaces eq. 3-28, 3-29)."""
    c, s = math.cos(yaw), math.sin(yaw)
    sine = min(max(normal[0] * s - normal[1] * c, -1.0), 1.0)
    return math.asin(sine), math.atan2(normal[0] * c + normal[1] * s, normal[2])


@kernel
def height_over(ground, stand, normal):
    """Height [m] over a plane that is at `ground` there, of a point at the distance `stand` square to it."""
    return ground + stand / normal[2]


def in_one_place(points: Float[np.ndarray, "feet 3"]) -> bool:
    """Whether feet have no direction seen from above, by the bound of `fit_plane`."""
    spread = points[:, :2] - points[:, :2].mean(axis=0)
    return bool(np.linalg.norm(spread, 2) <= np.sqrt(len(points)) * APART)


def told(points: Float[np.ndarray, "feet 3"], determined: float) -> str:
    """What a plane was made of."""
    feet = len(points)
    if feet == 0:
        return "no foot stands: the plane is kept"
    if feet == 1:
        return "one foot stands: the slope is kept, the plane goes through the foot"
    if in_one_place(points):
        return f"{feet} feet stand in one place: the slope is kept, the plane goes through their mean"
    if determined <= 0.0:
        return f"{feet} feet stand on a line: the plane goes through it, nearest to the one before"
    if determined < 1.0:
        return f"{feet} feet stand almost on a line: across it the past counts for {1.0 - determined:.0%}"
    return f"the plane is the least-squares fit of {feet} feet"
