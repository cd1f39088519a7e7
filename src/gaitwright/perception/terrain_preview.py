"""What the terrain scanner holds of a moment: the thesis's seven outputs (row V3, thesis 6.2), and the ground
ahead of each foot.

One value, made by one function of the state, what is known of the ground, and what the gait is about to do.
No stage needs it at every tick, so nobody makes it there: recordings have it, and who shows a robot asks.
"""

import math
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.model.centre_of_mass import centres_of_mass
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, roll_pitch_yaw, rotation
from gaitwright.numerics.packing import Layout
from gaitwright.numerics.polygon import hull, margins
from gaitwright.perception.elevation_map import lowest_points
from gaitwright.perception.reach_outline import RIM, reach_outlines
from gaitwright.signals import Elevation, Gait, GroundMap, Sensed

IN_CONTACT = 0.02
"""A foot that carries this share of the weight supports the robot."""
AHEAD, SPACING, FEWEST = 1.0, 0.07, 3
"""The ground ahead of a foot: so far, and from sample to sample, in body heights; of fewer samples that are
known it has no slope."""
EVENT = 0.02
"""Lift-offs and touch-downs within this share of a cycle are one event."""


class Steps(NamedTuple):
    """What the gait is about to do."""

    phase: float
    """Phase φ of the gait, in [0, 1)."""
    gait: Gait
    stance: Bool[np.ndarray, "legs"]
    """Legs that it has on the ground."""
    footholds_w: Float[np.ndarray, "legs 3"]
    """Centre of each foot where its swing is to end, world [m]; of use for the other legs."""


class TerrainPreview(NamedTuple):
    """Seven outputs of the terrain scanner, numbered as in the thesis, and the ground ahead of each foot.

    World axes; legs in the robot's order. Polygons are convex, their corners anticlockwise, seen from above:
    `corners_of` takes them out of arrays in which the rows that are left over are NaN.
    """

    time: float
    """Since the start [s]."""
    position_w: Float[np.ndarray, "3"]
    """Origin of the base [m]."""
    yaw: float
    """Heading [rad]."""
    feet_w: Float[np.ndarray, "legs 3"]
    """(1) The lowest point of each foot [m]; those that support are told apart by `supporting`."""
    supporting: Bool[np.ndarray, "legs"]
    """(1) Feet that carry 2 % of the weight or more."""
    support_w: Float[np.ndarray, "legs 2"]
    """(2) Polygon of the supporting feet [m]; of two feet a line, of none nothing."""
    lowered_w: Float[np.ndarray, "legs 2"]
    """(3) The same if every foot in the air were lowered at once, where it is."""
    coming_w: Float[np.ndarray, "legs 2"]
    """(3) The one of the coming support phase: after the next lift-off or touch-down of the gait, feet that
    land then at their footholds; NaN where the gait is not known."""
    footholds_w: Float[np.ndarray, "legs 3"]
    """Where feet that swing are to land [m]; NaN for others, and where it is not known."""
    centre_w: Float[np.ndarray, "2"]
    """(4) Vertical projection of the centre of mass of the whole robot [m]."""
    margin: float
    """How far inside the support polygon that is [m]; negative outside, NaN without a foot on the ground."""
    reach_w: Float[np.ndarray, "legs rim 2"]
    """(5) Where each foot can be put on known ground from where the body is [m]: outlines with a row of NaN
    after each, those of its parts anticlockwise, those of holes in it clockwise; closed."""
    critical: Bool[np.ndarray, "legs"]
    """(6) Supporting feet without which the centre of mass is outside the support polygon."""
    roll: float
    pitch: float
    """(7) Attitude of the body [rad]; pitch is positive nose down."""
    slope: Float[np.ndarray, "legs"]
    """Mean slope of the ground ahead of each foot along the heading, uphill positive [rad]."""
    elevation: Float[np.ndarray, "legs"]
    """Mean height of that ground, world [m]; both are NaN where too little of it is known."""


LAYOUT = Layout.of(TerrainPreview, rim=RIM)
preview_in = LAYOUT.views(TerrainPreview)
"""The `TerrainPreview` in a row, as views."""


def preview(robot: Robot, sensed: Sensed, ground: GroundMap, steps: Steps | None = None) -> TerrainPreview:
    """The terrain scanner's outputs at a moment. `steps`: `None` where nobody knows what the gait will do."""
    R_wb = rotation(sensed.orientation_wb)
    feet = lowest_points(robot, sensed)
    down = sensed.load > IN_CONTACT * GRAVITY * robot.total_mass
    centre = (sensed.position_w + R_wb @ centres_of_mass(robot, sensed.q[None])[0])[:2]
    roll, pitch, yaw = roll_pitch_yaw(R_wb).tolist()
    support = hull(feet[down, :2])
    holds, coming = next_support(robot, feet, steps)
    slope, elevation = ahead_of(ground.elevation, feet, yaw, robot.height)
    return TerrainPreview(
        time=sensed.time,
        position_w=sensed.position_w.copy(),
        yaw=yaw,
        feet_w=feet,
        supporting=down,
        support_w=padded(support, robot.n),
        lowered_w=padded(hull(feet[:, :2]), robot.n),
        coming_w=padded(coming, robot.n),
        footholds_w=holds,
        centre_w=centre,
        margin=float(margins(support, centre[None])[0]) if down.any() else math.nan,
        reach_w=reach_outlines(robot, sensed.position_w, R_wb, ground.elevation),
        critical=critical_feet(feet[:, :2], down, centre),
        roll=roll,
        pitch=pitch,
        slope=slope,
        elevation=elevation,
    )


def critical_feet(
    feet: Float[np.ndarray, "legs 2"], down: Bool[np.ndarray, "legs"], centre: Float[np.ndarray, "2"]
) -> Bool[np.ndarray, "legs"]:
    """Feet that may not be lifted: without them the centre of mass is outside the polygon of the others.

    Of a robot that does not stand statically, as on two feet, these are all that are down.
    """
    out = down.copy()
    for leg in np.flatnonzero(down):
        others = down.copy()
        others[leg] = False
        out[leg] = margins(hull(feet[others]), centre[None])[0] < 0.0
    return out


# --- what comes next -------------------------------------------------------------------------------
def next_support(
    robot: Robot, feet: Float[np.ndarray, "legs 3"], steps: Steps | None
) -> tuple[Float[np.ndarray, "legs 3"], Float[np.ndarray, "corners 2"]]:
    """Where swinging feet are to land, and the corners of the support polygon after the gait's next event.

    Feet that stay down keep their places.
    """
    if steps is None:
        return np.full((robot.n, 3), np.nan), np.empty((0, 2))
    soles = steps.footholds_w - np.outer(robot.foot_radius, (0.0, 0.0, 1.0))
    stance = steps.stance[:, None]
    places = np.where(stance, feet, soles)[down_next(steps.phase, steps.gait)]
    return np.where(stance, np.nan, soles), hull(places[:, :2])


def down_next(phase: float, gait: Gait) -> Bool[np.ndarray, "legs"]:
    """Legs that are down after the gait's next lift-off or touch-down."""
    share = (phase + np.array(gait.offsets)) % 1.0
    until = np.where(share < gait.duty, gait.duty, 1.0) - share
    return (share + until.min() + EVENT) % 1.0 < gait.duty


# --- the ground ahead ------------------------------------------------------------------------------
def ahead_of(
    elevation: Elevation | None, feet: Float[np.ndarray, "legs 3"], yaw: float, height: float
) -> tuple[Float[np.ndarray, "legs"], Float[np.ndarray, "legs"]]:
    """Mean slope [rad] and height [m] of the ground ahead of each foot in direction `yaw`, as far as it is
    known; `height`: of the body [m]."""
    slope, mean = np.full(len(feet), np.nan), np.full(len(feet), np.nan)
    if elevation is None:
        return slope, mean
    along = np.arange(0.0, AHEAD + 0.5 * SPACING, SPACING) * height
    x, y = feet[:, :1] + math.cos(yaw) * along, feet[:, 1:2] + math.sin(yaw) * along
    for leg, ground in enumerate(np.array(elevation.height(x, y), dtype=float)):
        known = np.isfinite(ground)
        if known.sum() < FEWEST:
            continue
        mean[leg] = ground[known].mean()
        away = along[known] - along[known].mean()
        slope[leg] = math.atan(away @ ground[known] / (away @ away))
    return slope, mean


# --- polygons in arrays ----------------------------------------------------------------------------
def padded(corners: Float[np.ndarray, "corners 2"], rows: int) -> Float[np.ndarray, "rows 2"]:
    """The corners, and NaN in the rows that are left over."""
    out = np.full((rows, 2), np.nan)
    out[: len(corners)] = corners
    return out


def corners_of(polygon: Float[np.ndarray, "rows 2"]) -> Float[np.ndarray, "corners 2"]:
    """The corners of a polygon that was padded."""
    return polygon[np.isfinite(polygon).all(axis=1)]
