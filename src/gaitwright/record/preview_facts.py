"""TerrainPreview → plain JSON values, for files and for the screen."""

import math
from typing import Any

import numpy as np

from gaitwright.model.robot import Robot
from gaitwright.perception.reach_outline import area_in, separate
from gaitwright.perception.terrain_preview import TerrainPreview, corners_of


def facts_of(robot: Robot, held: TerrainPreview) -> dict[str, Any]:
    """What the terrain scanner held at a moment, world axes [m, rad]; null for what is not known."""
    return {
        "time_s": round(held.time, 6),
        "position_m": plain(held.position_w),
        "heading_rad": plain(held.yaw),
        "supporting_feet": names_of(robot, held.supporting),
        "support_polygon_m": plain(corners_of(held.support_w)),
        "lowered_polygon_m": plain(corners_of(held.lowered_w)),
        "coming_polygon_m": plain(corners_of(held.coming_w)),
        "centre_of_gravity_m": plain(held.centre_w),
        "margin_m": plain(held.margin),
        "critical_feet": names_of(robot, held.critical),
        "roll_rad": plain(held.roll),
        "pitch_rad": plain(held.pitch),
        "feet": {name: facts_of_foot(held, leg) for leg, name in enumerate(robot.legs)},
    }


def facts_of_foot(held: TerrainPreview, leg: int) -> dict[str, Any]:
    """Of one foot: where it is and is to land, where it could be put, and the ground ahead of it."""
    outline = held.reach_w[leg]
    return {
        "place_m": plain(held.feet_w[leg]),
        "foothold_m": plain(held.footholds_w[leg]) if np.isfinite(held.footholds_w[leg]).all() else None,
        "reachable_m": [plain(ring) for ring in separate(outline)],
        "reachable_m2": plain(area_in(outline)),
        "slope_ahead_rad": plain(held.slope[leg]),
        "elevation_ahead_m": plain(held.elevation[leg]),
    }


def names_of(robot: Robot, legs: np.ndarray) -> list[str]:
    """The legs of which something holds."""
    return [name for name, holds in zip(robot.legs, legs, strict=True) if holds]


def plain(value: Any) -> Any:
    """Numbers, also in arrays, to a hundredth of a millimetre or milliradian."""
    if isinstance(value, np.ndarray):
        return [plain(part) for part in value.tolist()]
    if isinstance(value, list):
        return [plain(part) for part in value]
    return round(value, 5) if math.isfinite(value) else None
