"""Robot, scene and map → plain JSON values that a page draws. Meshes are base64 of 32-bit numbers."""

import base64
import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from gaitwright.ground.scene import Scene
from gaitwright.ground.solids import Sphere
from gaitwright.ground.terrain import Box, Flat, Solid
from gaitwright.model.robot import Robot
from gaitwright.navigation.travel import Travel
from gaitwright.numerics.geometry import quaternion_of
from gaitwright.perception.terrain_preview import TerrainPreview, corners_of
from gaitwright.record.scenery import Triangles, ground_triangles, hull_triangles
from gaitwright.signals import GroundMap

ABOVE = 0.004
"""Lines on the ground are drawn this much above it [m]."""
MOST_CELLS = 40_000
"""A map of more cells is shown by every second one, or third, and so on."""


def robot_shown(robot: Robot) -> dict[str, Any]:
    """The numbers that a robot is drawn by (`Robot`'s, with rotations as quaternions)."""
    return {
        "name": robot.name,
        "legs": list(robot.legs),
        "hip": robot.hip.tolist(),
        "frame": [quaternion_of(R).tolist() for R in robot.leg_frame],
        "offset": robot.offset.tolist(),
        "sign": robot.sign.tolist(),
        "foot_radius": robot.foot_radius.tolist(),
        "trunk": robot.trunk.tolist(),
        "tau_max": robot.tau_max.tolist(),
        "q_min": robot.q_min.tolist(),
        "q_max": robot.q_max.tolist(),
        "height": robot.height,
        "mass": robot.total_mass,
    }


def world_shown(scene: Scene, robots: Iterable[Robot], boxes: Mapping[int, Box]) -> dict[str, Any]:
    """A scene with its robots. `boxes`: those of it that can be taken hold of, by number."""
    others = [solid for solid in scene.shapes if not isinstance(solid, Box | Sphere)]
    return {
        "say": "world",
        "scene": scene.name,
        "seed": scene.seed,
        "robots": [robot_shown(robot) for robot in robots],
        "ground": mesh(ground_triangles(scene)),
        "boxes": boxes_shown(scene, boxes),
        "spheres": [
            {"x": one.x, "y": one.y, "z": scene.top(one) - one.radius, "radius": one.radius}
            for one in scene.shapes
            if isinstance(one, Sphere)
        ],
        "meshes": [mesh(hull_triangles(scene, solid)) for solid in others],
        "bounds": list(scene.bounds),
        "start": list(scene.start),
        "goal": list(scene.goal) if scene.goal else None,
    }


def boxes_shown(scene: Scene, boxes: Mapping[int, Box]) -> list[dict[str, Any]]:
    """Boxes that can be taken hold of, by their numbers."""
    return [{"id": name, **box_shown(scene, box)} for name, box in boxes.items()]


def box_shown(scene: Scene, box: Box) -> dict[str, float]:
    """A box by its middle; on uneven ground let into it, so that no gap opens below."""
    depth = box.height + (0.0 if isinstance(scene.surface, Flat) else max(box.lx, box.ly))
    place = {"x": box.x, "y": box.y, "z": scene.top(box) - depth / 2, "yaw": box.yaw}
    return {**place, "lx": box.lx, "ly": box.ly, "lz": depth}


def things_shown(scene: Scene, things: Iterable[Solid]) -> dict[str, Any]:
    """Things that move, where they are now: by the boxes around them."""
    shown = []
    for number, thing in enumerate(things):
        x_min, y_min, x_max, y_max = thing.extent()
        box = thing if isinstance(thing, Box) else None
        x, y = thing.centre
        sides = (box.lx, box.ly) if box else (x_max - x_min, y_max - y_min)
        shown.append(
            {
                "id": number,
                "x": x,
                "y": y,
                "z": scene.top(thing) - thing.height / 2,
                "lx": sides[0],
                "ly": sides[1],
                "lz": thing.height,
                "yaw": box.yaw if box else 0.0,
            }
        )
    return {"say": "moved", "things": shown}


def scan_shown(preview: TerrainPreview, scene: Scene) -> dict[str, Any]:
    """The terrain scanner's outputs, lines laid on the ground."""

    def on_ground(points: np.ndarray) -> list[list[float]]:
        return [[x, y, float(scene.height(x, y)) + ABOVE] for x, y in points[:, :2].tolist()]

    return {
        "say": "scan",
        "support": on_ground(corners_of(preview.support_w)),
        "predicted": on_ground(corners_of(preview.coming_w)),
        "cog": on_ground(preview.centre_w[None])[0],
        "reach": [on_ground(outline) for leg in preview.reach_w for outline in split(leg)],
        "critical": preview.critical.tolist(),
        "margin": number(preview.margin),
        "roll": preview.roll,
        "pitch": preview.pitch,
        "slope": [number(value) for value in preview.slope],
        "elevation": [number(value) for value in preview.elevation],
    }


def split(outlines: np.ndarray) -> list[np.ndarray]:
    """Outlines one by one, out of rows in which each ends with NaN."""
    ends = np.flatnonzero(np.isnan(outlines[:, 0]))
    parts = np.split(outlines, ends)
    kept = (part[~np.isnan(part[:, 0])] for part in parts)
    return [part for part in kept if len(part) > 1]


def seen_shown(ground: GroundMap, travel: Travel | None, around: tuple[float, float], far: float) -> dict:
    """What the robot knows of the ground: heights within `far` [m] of a place, obstacles that it was told,
    walls that it found (x0, y0, x1, y1), and ways that it walked."""
    xs, ys = (np.arange(middle - far, middle + far, 2.0 * far / math.isqrt(MOST_CELLS)) for middle in around)
    grid_x, grid_y = np.meshgrid(xs, ys)
    eyes = ground.elevation
    heights = np.full(grid_x.shape, np.nan) if eyes is None else np.asarray(eyes.height(grid_x, grid_y))
    return {
        "say": "seen",
        "x": float(xs[0]),
        "y": float(ys[0]),
        "spacing": float(xs[1] - xs[0]),
        "rows": len(ys),
        "columns": len(xs),
        "heights": packed(heights, "<f4"),
        "obstacles": [outline.tolist() for outline in ground.obstacles],
        "walls": travel.known.rows[:, :4].tolist() if travel else [],
        "walked": [np.array(way).tolist() for way in travel.known.trips] if travel else [],
    }


# --- numbers ----------------------------------------------------------------------------------------
def mesh(triangles: Triangles) -> dict[str, str]:
    """Places and corners of triangles."""
    points, corners = triangles
    return {"points": packed(points, "<f4"), "indices": packed(corners, "<u4")}


def packed(numbers: np.ndarray, kind: str) -> str:
    """An array as base64 of little-endian numbers."""
    return base64.b64encode(np.ascontiguousarray(numbers, kind).tobytes()).decode()


def number(value: float) -> float | None:
    """A number that JSON has; `None` for one that is none."""
    return float(value) if math.isfinite(value) else None
