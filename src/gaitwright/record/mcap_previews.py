"""What the terrain scanner held, in a file for Foxglove and Rerun: as JSON, and drawn on the ground.

Topics: `/gaitwright/scanner` (JSON: `preview_facts`), `/gaitwright/support` (foxglove.SceneUpdate: support
polygon green, the coming one blue, reachable areas grey, critical feet red, the centre of gravity black).
"""

import json
from typing import Any

import numpy as np
from mcap_ros2.writer import Writer

from gaitwright.ground.scene import Scene
from gaitwright.model.robot import Robot
from gaitwright.perception.reach_outline import separate
from gaitwright.perception.terrain_preview import TerrainPreview, corners_of
from gaitwright.record.preview_facts import facts_of
from gaitwright.record.previews import previews_in
from gaitwright.record.recording import Recording
from gaitwright.record.scenery import SCHEMA, colour, entity, point, pose, update

Colour = tuple[float, float, float, float]
GREEN, BLUE, GREY = (0.18, 0.62, 0.27, 1.0), (0.10, 0.44, 0.76, 1.0), (0.5, 0.5, 0.5, 0.6)
RED, DARK = (0.88, 0.19, 0.19, 1.0), (0.11, 0.15, 0.20, 1.0)
ABOVE = 0.01
"""Lines are drawn this far over the ground [m]."""
BALL = 2.5
"""Across a ball at a foot, in radii of the foot."""
NUMBER, LIST = {"type": ["number", "null"]}, {"type": "array"}
FACTS = {
    "title": "gaitwright.TerrainPreview",
    "type": "object",
    "properties": {
        **dict.fromkeys(("time_s", "heading_rad", "margin_m", "roll_rad", "pitch_rad"), NUMBER),
        **dict.fromkeys(("position_m", "centre_of_gravity_m", "supporting_feet", "critical_feet"), LIST),
        **dict.fromkeys(("support_polygon_m", "lowered_polygon_m", "coming_polygon_m"), LIST),
        "feet": {"type": "object"},
    },
}


def write_previews(writer: Writer, r: Recording, scene: Scene | str) -> None:
    """Both topics, as often as there are previews; nothing where there are none."""
    if r.previews is None:
        return
    raw = writer._writer  # the ROS 2 writer offers no JSON; the one it wraps does
    facts = raw.register_schema("gaitwright.TerrainPreview", "jsonschema", json.dumps(FACTS).encode())
    shapes = raw.register_schema("foxglove.SceneUpdate", "jsonschema", json.dumps(SCHEMA).encode())
    told = raw.register_channel("/gaitwright/scanner", "json", facts)
    drawn = raw.register_channel("/gaitwright/support", "json", shapes)
    for held in previews_in(r.previews):
        at = round(held.time * 1e9)
        raw.add_message(told, at, json.dumps(facts_of(r.robot, held)).encode(), at)
        raw.add_message(drawn, at, json.dumps(preview_update(r.robot, held, scene)).encode(), at)


def preview_update(robot: Robot, held: TerrainPreview, scene: Scene | str) -> dict[str, Any]:
    """What is drawn of a preview, in place of the one before."""
    drawn = [(ring, GREY) for outline in held.reach_w for ring in separate(outline)]
    for polygon, shade in ((held.coming_w, BLUE), (held.support_w, GREEN)):
        corners = corners_of(polygon)
        if len(corners) > 1:
            drawn.append((np.concatenate([corners, corners[:1]]), shade))
    paths = [held.centre_w[None], *(path for path, _ in drawn)]
    ends = np.cumsum([len(path) for path in paths])[:-1]
    centre, *lifted = np.split(over_ground(np.concatenate(paths), held, scene), ends)
    size = BALL * float(robot.foot_radius.max())
    feet = zip(held.feet_w[held.supporting], held.critical[held.supporting], strict=True)
    balls = [ball(place, size, RED if critical else GREEN) for place, critical in feet]
    balls.append(ball(centre[0], size, DARK))
    lines = [line(places, shade) for places, (_, shade) in zip(lifted, drawn, strict=True)]
    return update([entity("support", held.time, lines=lines, spheres=balls)])


def line(places: np.ndarray, shade: Colour) -> dict[str, Any]:
    """A line over places `(n, 3)`."""
    points = [point(*place) for place in places.round(4).tolist()]
    drawn = {"type": 0, "pose": pose(), "thickness": 2.0, "scale_invariant": True, "points": points}
    return drawn | {"color": colour(shade), "colors": [], "indices": []}


def ball(place: np.ndarray, size: float, shade: Colour) -> dict[str, Any]:
    """A ball at a place."""
    return {"pose": pose(point(*place.tolist())), "size": point(size, size, size), "color": colour(shade)}


def over_ground(points: np.ndarray, held: TerrainPreview, scene: Scene | str) -> np.ndarray:
    """Points `(n, 2)` a little over the ground, `(n, 3)`; without a scene at the height of the feet on it."""
    if isinstance(scene, Scene):
        heights = np.asarray(scene.height(*points.T), dtype=float)
    else:
        feet = held.feet_w[held.supporting] if held.supporting.any() else held.feet_w
        heights = np.full(len(points), feet[:, 2].mean())
    return np.column_stack([points, heights + ABOVE])
