"""Scene → MuJoCo geometry: the surface and the boxes, as the robot's feet meet them."""

from xml.etree.ElementTree import Element

import mujoco
import numpy as np

from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Box, Flat, HeightField, Slope, sampled
from gaitwright.numerics.geometry import yaw_quaternion
from gaitwright.plant.mujoco.mjcf import child

SAMPLE = 0.05
"""Grid spacing for surfaces that MuJoCo has no shape for [m]."""


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
    solid = touching(scene, 1, 0)
    if isinstance(scene.surface, Flat | Slope):
        normal = scene.surface.normal(0.0, 0.0)
        child(world, "geom", solid, name="ground", type="plane", size=[0, 0, 1], zaxis=normal)
    else:
        _add_field(root, world, _field(scene), solid)
    for k, box in enumerate(scene.boxes):
        _add_box(world, f"box_{k}", box, scene.top(box), solid)


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


def _add_box(world: Element, name: str, box: Box, top: float, solid: dict[str, str]) -> None:
    """A box from its top down to what it stands on, and as deep again, so that no gap opens on a slope."""
    depth = box.height + max(box.lx, box.ly)
    size = [box.lx / 2, box.ly / 2, depth / 2]
    centre = [box.x, box.y, top - depth / 2]
    child(world, "geom", solid, name=name, type="box", pos=centre, size=size, quat=yaw_quaternion(box.yaw))
