"""Meshes that MuJoCo does not read, COLLADA and STL as text → their corners: all that is wanted of them."""

import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from jaxtyping import Float

from gaitwright.description.xmlfile import MAX_BYTES, declared_first, parsed
from gaitwright.errors import BadFile

READ_HERE = (".dae", ".stl")
"""What is read here."""
VERTEX = re.compile(rb"^\s*vertex\s+(\S+)\s+(\S+)\s+(\S+)\s*$", re.MULTILINE)
FEWEST, MOST = 4, 2_000_000
"""A body has so many corners at least, and a mesh that is read at most."""

Vertices = Float[np.ndarray, "corners 3"]


def vertices_of(path: Path) -> Vertices | None:
    """Corners of the mesh in a file, as it stands there; `None` where it is none of those read here."""
    try:
        if path.stat().st_size > MAX_BYTES:
            return None
        data = path.read_bytes()
        found = collada(data) if path.suffix.lower() == ".dae" else stl_text(data)
    except (OSError, BadFile, ValueError, OverflowError):
        return None
    if not np.isfinite(found).all():
        return None
    corners = np.unique(found, axis=0)
    return corners if len(corners) >= FEWEST else None


def stl_text(data: bytes) -> Vertices:
    """Corners of an STL file in its form as text."""
    return np.array([[float(x) for x in corner] for corner in VERTEX.findall(data)]).reshape(-1, 3)


# --- COLLADA ---------------------------------------------------------------------------------------
def collada(data: bytes) -> Vertices:
    """Corners of all that a COLLADA scene shows [m], in the file's axes, as ROS takes them."""
    root = parsed(declared_first(data))
    unit = root.find("asset/unit")
    metre = float(unit.get("meter", "1")) if unit is not None else 1.0
    shapes = {geometry.get("id"): positions(geometry) for geometry in root.iter("geometry")}
    parts, corners = [], 0
    for part in (part for scene in root.iter("visual_scene") for part in shown(scene, np.eye(4), shapes)):
        parts.append(part)
        corners += len(part)
        if corners > MOST:
            raise BadFile(f"its scene has more than {MOST} corners")
    return metre * np.concatenate(parts or [*shapes.values()] or [np.empty((0, 3))])


def positions(geometry: ET.Element) -> Vertices:
    """Corners of one geometry."""
    wanted = geometry.find("mesh/vertices/input[@semantic='POSITION']")
    name = "" if wanted is None else wanted.get("source", "")
    for source in geometry.iterfind("mesh/source"):
        array = source.find("float_array")
        if "#" + source.get("id", "") == name and array is not None:
            accessor = source.find("technique_common/accessor")
            stride = 3 if accessor is None else int(accessor.get("stride", "3"))
            if stride < 3:
                raise BadFile(f"its corners have {stride} numbers; expected 3")
            return np.array((array.text or "").split(), float).reshape(-1, stride)[:, :3]
    return np.empty((0, 3))


def shown(node: ET.Element, above: np.ndarray, shapes: dict[str | None, Vertices]) -> Iterator[Vertices]:
    """Corners of what a node and those below it show."""
    here = above
    for child in node:
        here = here @ transform(child)
    for instance in node.iterfind("instance_geometry"):
        corners = shapes.get(instance.get("url", "").removeprefix("#"))
        if corners is not None:
            yield corners @ here[:3, :3].T + here[:3, 3]
    for child in node.iterfind("node"):
        yield from shown(child, here, shapes)


def transform(step: ET.Element) -> Float[np.ndarray, "4 4"]:
    """What one element of a node does to what is below it; nothing where it is no transformation."""
    result = np.eye(4)
    if step.tag not in ("matrix", "translate", "scale", "rotate"):
        return result
    numbers = np.array((step.text or "").split(), float)
    if step.tag == "matrix":
        return numbers.reshape(4, 4)
    if step.tag == "translate":
        result[:3, 3] = numbers
    elif step.tag == "scale":
        result[:3, :3] = np.diag(numbers)
    else:
        x, y, z = numbers[:3] / np.linalg.norm(numbers[:3])
        cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        angle = math.radians(numbers[3])
        result[:3, :3] += math.sin(angle) * cross + (1.0 - math.cos(angle)) * cross @ cross
    return result
