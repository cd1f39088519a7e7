"""Scene → MuJoCo geometry: the surface and what stands on it, as the robot's feet meet them."""

from xml.etree.ElementTree import Element

import mujoco
import numpy as np
import shapely
from jaxtyping import Float

from gaitwright.ground.holes import Pitted
from gaitwright.ground.outlines import convex_parts
from gaitwright.ground.scene import Scene
from gaitwright.ground.solids import Cylinder, Prism, Sphere
from gaitwright.ground.terrain import Box, Flat, HeightField, Slope, Solid, lifted, sampled
from gaitwright.numerics.geometry import yaw_quaternion
from gaitwright.plant.mujoco.mjcf import child

SAMPLE = 0.05
"""Grid spacing for surfaces that MuJoCo has no shape for [m]."""
BEYOND = 1.0
"""A plane with holes goes on this far beyond the bounds [m]."""
THICK = 1.0
"""Ground goes on this far below the floor of its deepest hole [m]."""


def touching(scene: Scene, kind: int, others: int) -> dict[str, str]:
    """Geom attributes: the bits of what it is and of what touches it, and the friction of the scene."""
    friction = f"{float(scene.friction)!r} 0.005 0.0001"
    return {"contype": str(kind), "conaffinity": str(others), "condim": "3", "friction": friction}


def robot_touches(scene: Scene, number: int, of: int) -> dict[str, str]:
    """Geom attributes of robot `number` of so many: it touches the ground and the others, not itself."""
    others = sum(2 << k for k in range(of) if k != number)
    return touching(scene, 2 << number, 1 | others)


def add(root: Element, world: Element, scene: Scene) -> None:
    """Adds the geoms of a scene to `world`, and to `root` what they rest on."""
    into = Pieces(root, world, touching(scene, 1, 0))
    if isinstance(scene.surface, Flat | Slope):
        normal = scene.surface.normal(0.0, 0.0)
        child(world, "geom", into.solid, name="ground", type="plane", size=[0, 0, 1], zaxis=normal)
    elif isinstance(scene.surface, Pitted):
        _add_pitted(into, scene.surface, scene.bounds)
    else:
        _add_field(root, world, _field(scene), into.solid)
    for k, box in enumerate(scene.boxes):
        _add_box(world, f"box_{k}", box, scene.top(box), into.solid)
    for k, shape in enumerate((*scene.shapes, *scene.things)):
        add_shape(into, f"shape_{k}", shape, scene.level(shape))


def fill(model: mujoco.MjModel, scene: Scene) -> None:
    """Writes the heights of a field into a compiled model (MJCF text has no room for so many digits)."""
    if model.nhfield:
        field = _field(scene)
        low, rise = _span(field)
        model.hfield_data[:] = ((field.heights - low) / rise).ravel()


def _field(scene: Scene) -> HeightField:
    surface = scene.surface
    return surface if isinstance(surface, HeightField) else sampled(surface, scene.bounds, SAMPLE)


def _span(field: HeightField) -> tuple[float, float]:
    """Lowest height, and how far the highest is above it [m]; never zero."""
    return float(field.heights.min()), max(float(np.ptp(field.heights)), 1e-6)


def _add_field(root: Element, world: Element, field: HeightField, solid: dict[str, str]) -> None:
    low, rise = _span(field)
    rows, columns = field.heights.shape
    half_x, half_y = (field.x_max - field.x_min) / 2, (field.y_max - field.y_min) / 2
    asset = child(root, "asset")
    grid = {"nrow": str(rows), "ncol": str(columns)}
    child(asset, "hfield", grid, name="ground", size=[half_x, half_y, rise, max(half_x, half_y)])
    centre = [field.x_min + half_x, field.y_min + half_y, low]
    child(world, "geom", solid, name="ground", type="hfield", hfield="ground", pos=centre)


# --- what stands on it ------------------------------------------------------------------------------
def _add_box(world: Element, name: str, box: Box, top: float, solid: dict[str, str]) -> None:
    """A box from its top down to what it stands on, and as deep again, so that no gap opens on a slope."""
    depth = box.height + max(box.lx, box.ly)
    size = [box.lx / 2, box.ly / 2, depth / 2]
    centre = [box.x, box.y, top - depth / 2]
    child(world, "geom", solid, name=name, type="box", pos=centre, size=size, quat=yaw_quaternion(box.yaw))


def add_shape(into: "Pieces", name: str, shape: Solid, level: float) -> None:
    """Another solid on its level: as MuJoCo's own shape, or as convex meshes that go down below it."""
    x, y = shape.centre
    if isinstance(shape, Box):
        _add_box(into.world, name, shape, level + shape.height, into.solid)
    elif isinstance(shape, Cylinder):
        depth = shape.height + 2.0 * shape.radius
        size, centre = [shape.radius, depth / 2], [x, y, level + shape.height - depth / 2]
        child(into.world, "geom", into.solid, name=name, type="cylinder", pos=centre, size=size)
    elif isinstance(shape, Sphere):
        centre = [x, y, level + shape.height - shape.radius]
        child(into.world, "geom", into.solid, name=name, type="sphere", pos=centre, size=shape.radius)
    else:
        tops = shape.tops()
        parts = tops if isinstance(shape, Prism) else (np.concatenate(tops),)
        for k, top in enumerate(parts):
            into.add_mesh(f"{name}_{k}", top + np.array([0.0, 0.0, level]), level - 2.0 * shape.reach)


class Pieces:
    """A model that convex pieces of ground are added to."""

    def __init__(self, root: Element, world: Element, solid: dict[str, str]) -> None:
        self.root, self.world, self.solid = root, world, solid
        self.asset: Element | None = None

    def add_mesh(self, name: str, top: Float[np.ndarray, "n 3"], bottom: float) -> None:
        """A piece from its top, world x, y, z, straight down to a height [m]."""
        if self.asset is None:
            self.asset = child(self.root, "asset")
        middle = np.array([*top[:, :2].mean(axis=0), bottom])  # MuJoCo keeps it in single precision
        points = np.unique(np.concatenate([top, lifted(top[:, :2], bottom)]) - middle, axis=0)
        child(self.asset, "mesh", name=name, vertex=points, inertia="convex")
        child(self.world, "geom", self.solid, name=name, type="mesh", mesh=name, pos=middle)


# --- a plane with holes -----------------------------------------------------------------------------
def _add_pitted(into: Pieces, ground: Pitted, bounds: tuple[float, float, float, float]) -> None:
    """The plane around the holes, and their floors, as convex pieces side by side."""
    x_min, y_min, x_max, y_max = bounds
    left = shapely.box(x_min - BEYOND, y_min - BEYOND, x_max + BEYOND, y_max + BEYOND)
    bottom = _lowest(ground, left) - max(hole.depth for hole in ground.holes) - THICK
    pieces = []
    for hole in sorted(ground.holes, key=lambda hole: -hole.depth):  # where two overlap the deeper counts
        floor = shapely.intersection(shapely.Polygon(hole.outline), left)
        left = shapely.difference(left, floor)
        pieces += [(part, hole.depth) for part in convex_parts(floor)]
    pieces += [(part, 0.0) for part in convex_parts(left)]
    for k, (part, depth) in enumerate(pieces):
        height = np.asarray(ground.plane.height(*part.T)) - depth
        into.add_mesh(f"ground_{k}", lifted(part, height), bottom)


def _lowest(ground: Pitted, field: shapely.Polygon) -> float:
    """Lowest height of the plane over a field [m]."""
    return float(np.min(ground.plane.height(*shapely.get_coordinates(field).T)))
