"""The scene of a recording, as things that Foxglove shows: the ground as triangles, boxes, and the way.

The messages are those that Foxglove publishes the schema of, `foxglove.SceneUpdate` in JSON.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely
from jaxtyping import Float, Int

from gaitwright.ground.holes import Pitted
from gaitwright.ground.outlines import convex_parts
from gaitwright.ground.scene import Scene
from gaitwright.ground.solids import Sphere
from gaitwright.ground.terrain import Box, Flat, HeightField, Slope, Solid, lifted, sampled
from gaitwright.numerics.geometry import yaw_quaternion

MOST_NODES = 160_000
"""A finer grid of heights is shown by every second node, or third, and so on."""
SAMPLE = 0.05
"""Least spacing of the grid for surfaces that have none [m]."""
GROUND, BOX, WAY = (0.62, 0.63, 0.60, 1.0), (0.80, 0.62, 0.38, 1.0), (0.13, 0.47, 0.71, 1.0)
"""Colours: red, green, blue, opacity."""


def scene_update(scene: Scene, seconds: float) -> dict[str, Any]:
    """Ground, boxes and other shapes of a scene, there from a time on [s]."""
    shown = shapes(scene, [*scene.boxes, *scene.shapes])
    boxes = shown.pop("cubes")
    entities = [entity("ground", seconds, triangles=[ground(scene)])]
    if boxes:
        entities.append(entity("boxes", seconds, cubes=boxes))
    if any(shown.values()):
        entities.append(entity("shapes", seconds, **shown))
    return update(entities)


def things_update(scene: Scene, seconds: float) -> dict[str, Any]:
    """The moving things of a scene where they are at a time [s]; it replaces those of the message before."""
    now = scene.at(seconds)
    return update([entity("things", seconds, **shapes(now, now.things))])


def shapes(scene: Scene, solids: Sequence[Solid]) -> dict[str, list[dict[str, Any]]]:
    """Solids as the shapes of an entity."""
    return {
        "cubes": [cube(scene, solid) for solid in solids if isinstance(solid, Box)],
        "spheres": [ball(scene, solid) for solid in solids if isinstance(solid, Sphere)],
        "triangles": [hull(scene, solid) for solid in solids if not isinstance(solid, Box | Sphere)],
    }


def way_update(scene: Scene, points: Sequence[tuple[float, float]], seconds: float) -> dict[str, Any]:
    """A way over points on the ground [m], with a ball at its end."""
    places = [point(x, y, float(scene.height(x, y)) + 0.02) for x, y in points]
    line = {"type": 0, "pose": pose(), "thickness": 0.02, "scale_invariant": False, "points": places}
    ball = {"pose": pose(places[-1]), "size": point(0.1, 0.1, 0.1), "color": colour(WAY)}
    line |= {"color": colour(WAY), "colors": [], "indices": []}
    return update([entity("way", seconds, lines=[line], spheres=[ball])])


def ground(scene: Scene) -> dict[str, Any]:
    """The surface."""
    return mesh(*ground_triangles(scene), GROUND)


Triangles = tuple[Float[np.ndarray, "nodes 3"], Int[np.ndarray, "triangles 3"]]
"""Places [m], and the three of each triangle."""


def ground_triangles(scene: Scene) -> Triangles:
    """The surface: two triangles for each cell of its grid, the very ones that feet meet unless thinned."""
    if isinstance(scene.surface, Pitted):
        return pitted(scene.surface, scene.bounds)
    x, y, z = grid(scene)
    rows, columns = z.shape
    first = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    last = first + columns + 1
    corners = np.column_stack([first, first + 1, last, first, last, first + columns])
    across, along = np.meshgrid(x, y)
    return np.column_stack([across.ravel(), along.ravel(), z.ravel()]), corners.reshape(-1, 3)


def pitted(surface: Pitted, bounds: tuple[float, float, float, float]) -> Triangles:
    """A plane with holes: its level parts, their walls and their floors."""
    left: shapely.Geometry = shapely.box(*bounds)
    faces: list[Float[np.ndarray, "_ 3"]] = []
    for hole in sorted(surface.holes, key=lambda hole: -hole.depth):
        floor = shapely.intersection(shapely.Polygon(hole.outline), left)
        left = shapely.difference(left, floor)
        for part in convex_parts(floor):
            faces.append(lifted(part, np.asarray(surface.plane.height(*part.T)) - hole.depth))
        rim = np.array(hole.outline)[::-1]  # seen from within
        height = np.asarray(surface.plane.height(*rim.T))
        faces += walls(lifted(rim, height), height - hole.depth)
    for part in convex_parts(left):
        faces.append(lifted(part, np.asarray(surface.plane.height(*part.T))))
    return fans(faces)


def hull(scene: Scene, solid: Solid) -> dict[str, Any]:
    """A solid."""
    return mesh(*hull_triangles(scene, solid), BOX)


def hull_triangles(scene: Scene, solid: Solid) -> Triangles:
    """A solid's top and sides, which go down below the ground that is not level."""
    level = scene.level(solid)
    depth = 0.0 if isinstance(scene.surface, Flat) else 2.0 * solid.reach
    faces: list[Float[np.ndarray, "_ 3"]] = []
    for top in solid.tops():
        placed = top + np.array([0.0, 0.0, level])
        faces += [placed, *walls(placed, level - depth)]
    return fans(faces)


def walls(
    top: Float[np.ndarray, "corners 3"], below: Float[np.ndarray, "corners"] | float
) -> list[Float[np.ndarray, "4 3"]]:
    """What stands below the edges of a face, down to heights [m]."""
    low = lifted(top[:, :2], below)
    return [np.array([low[k - 1], low[k], top[k], top[k - 1]]) for k in range(len(top))]


def fans(faces: list[Float[np.ndarray, "_ 3"]]) -> Triangles:
    """Convex faces as triangles: the places of their corners, and the corners of each triangle."""
    first = np.cumsum([0, *(len(face) for face in faces)])
    corners = [
        (start, start + k, start + k + 1)
        for start, face in zip(first, faces, strict=False)
        for k in range(1, len(face) - 1)
    ]
    return np.concatenate(faces), np.array(corners)


def mesh(
    nodes: Float[np.ndarray, "n 3"], corners: Int[np.ndarray, "triangles 3"], rgba: tuple
) -> dict[str, Any]:
    """Triangles between places, to 0.1 mm."""
    return {
        "pose": pose(),
        "points": [point(*node) for node in nodes.round(4).tolist()],
        "color": colour(rgba),
        "colors": [],
        "indices": corners.ravel().tolist(),
    }


def ball(scene: Scene, sphere: Sphere) -> dict[str, Any]:
    """A sphere, as far in the ground as it is."""
    centre = point(sphere.x, sphere.y, scene.top(sphere) - sphere.radius)
    size = 2.0 * sphere.radius
    return {"pose": pose(centre), "size": point(size, size, size), "color": colour(BOX)}


def grid(scene: Scene) -> tuple[Float[np.ndarray, " columns"], Float[np.ndarray, " rows"], np.ndarray]:
    """Nodes along x and y, and heights (rows along y) [m]."""
    x_min, y_min, x_max, y_max = scene.bounds
    if isinstance(scene.surface, Flat | Slope):
        x, y = np.array([x_min, x_max]), np.array([y_min, y_max])
        return x, y, np.asarray(scene.surface.height(x[None, :], y[:, None]))
    field = scene.surface
    if not isinstance(field, HeightField):
        spacing = max(SAMPLE, math.sqrt((x_max - x_min) * (y_max - y_min) / MOST_NODES))
        field = sampled(field, scene.bounds, spacing)
    step = math.ceil(math.sqrt(max(1.0, field.heights.size / MOST_NODES)))
    rows, columns = (np.unique([*range(0, count, step), count - 1]) for count in field.heights.shape)
    x, y = field.x_min + field.spacing * columns, field.y_min + field.spacing * rows
    return x, y, field.heights[np.ix_(rows, columns)]


def cube(scene: Scene, box: Box) -> dict[str, Any]:
    """A box, on uneven ground let into it so that no gap opens below."""
    depth = box.height + (0.0 if isinstance(scene.surface, Flat) else max(box.lx, box.ly))
    centre = point(box.x, box.y, scene.top(box) - depth / 2)
    return {
        "pose": pose(centre, yaw_quaternion(box.yaw)),
        "size": point(box.lx, box.ly, depth),
        "color": colour(BOX),
    }


# --- the parts of a message ------------------------------------------------------------------------
KINDS = ("arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models")


def update(entities: list[dict[str, Any]]) -> dict[str, Any]:
    return {"deletions": [], "entities": entities}


def entity(name: str, seconds: float, **shapes: list[dict[str, Any]]) -> dict[str, Any]:
    """Shapes in the world, which stay."""
    whole = math.floor(seconds)
    return {
        "timestamp": {"sec": whole, "nsec": min(999_999_999, round((seconds - whole) * 1e9))},
        "frame_id": "world",
        "id": name,
        "lifetime": {"sec": 0, "nsec": 0},
        "frame_locked": False,
        "metadata": [],
        **{kind: shapes.get(kind, []) for kind in KINDS},
    }


def pose(
    place: dict[str, float] | None = None, turn: Sequence[float] | np.ndarray = (1.0, 0.0, 0.0, 0.0)
) -> dict:
    """A place and a turn (w, x, y, z)."""
    w, x, y, z = map(float, turn)
    return {"position": place or point(0.0, 0.0, 0.0), "orientation": {"x": x, "y": y, "z": z, "w": w}}


def point(x: float, y: float, z: float) -> dict[str, float]:
    return {"x": x, "y": y, "z": z}


def colour(rgba: tuple[float, float, float, float]) -> dict[str, float]:
    return dict(zip("rgba", rgba, strict=True))


# --- the schema ------------------------------------------------------------------------------------
def _object(title: str, **properties: Any) -> dict[str, Any]:
    return {"title": title, "type": "object", "properties": properties, "required": list(properties)}


def _list(items: dict[str, Any]) -> dict[str, Any]:
    return {"type": "array", "items": items}


def _shape(title: str, **properties: Any) -> dict[str, Any]:
    return _object(f"foxglove.{title}Primitive", pose=POSE, **properties, color=COLOUR)


NUMBER, WHOLE, TEXT = {"type": "number"}, {"type": "integer", "minimum": 0}, {"type": "string"}
TIME = _object("time", sec=WHOLE, nsec=WHOLE | {"maximum": 999_999_999})
VECTOR = _object("foxglove.Vector3", x=NUMBER, y=NUMBER, z=NUMBER)
QUATERNION = _object("foxglove.Quaternion", x=NUMBER, y=NUMBER, z=NUMBER, w=NUMBER)
POSE = _object("foxglove.Pose", position=VECTOR, orientation=QUATERNION)
COLOUR = _object("foxglove.Color", r=NUMBER, g=NUMBER, b=NUMBER, a=NUMBER)
MANY = {"points": _list(VECTOR), "colors": _list(COLOUR), "indices": _list(WHOLE)}
SCHEMA = _object(
    "foxglove.SceneUpdate",
    deletions=_list(_object("foxglove.SceneEntityDeletion", timestamp=TIME, type=WHOLE, id=TEXT)),
    entities=_list(
        _object(
            "foxglove.SceneEntity",
            timestamp=TIME,
            frame_id=TEXT,
            id=TEXT,
            lifetime=TIME | {"title": "duration"},
            frame_locked={"type": "boolean"},
            metadata=_list(_object("foxglove.KeyValuePair", key=TEXT, value=TEXT)),
            **{kind: _list({"type": "object"}) for kind in KINDS}
            | {
                "cubes": _list(_shape("Cube", size=VECTOR)),
                "spheres": _list(_shape("Sphere", size=VECTOR)),
                "triangles": _list(_shape("TriangleList", **MANY)),
                "lines": _list(
                    _shape("Line", type=WHOLE, thickness=NUMBER, scale_invariant={"type": "boolean"}, **MANY)
                ),
            },
        )
    ),
)
"""Of a message: every part that we write, by Foxglove's names."""
