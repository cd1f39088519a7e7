"""What stands in a scene file, entry by entry: each is checked when read, and makes its part of a `Scene`.

An *outline* is a list of corners, or a circle or a rectangle by its numbers.
"""

from pathlib import Path
from typing import Annotated

import numpy as np
from msgspec import Meta, field

from gaitwright.ground.entry_types import (
    MAX_CONTROLS,
    MAX_NODES,
    Angle,
    Base,
    Controls,
    Corners,
    Incline,
    Length,
    Place,
    Row,
    Size,
    Spacing,
    Strict,
)
from gaitwright.ground.height_map import height_map
from gaitwright.ground.moving_entries import Timed
from gaitwright.ground.outlines import Outline, mended, outline_of, regular
from gaitwright.ground.solids import Cylinder, Prism, Pyramid, Sphere, Wedge
from gaitwright.ground.splines import fineness, spline_field
from gaitwright.ground.terrain import Box, Flat, HeightField, Slope, Solid, Surface, rectangle

MAX_BOXES = 2000
MAX_HOLES = 200
MAX_NAME = 80
MOST_SAMPLES = 4_000_000
"""Nodes that a net is sampled at: 16 MB in the physics."""
ROUND = 24
"""Corners of the polygon that a circle is taken for."""


# --- the surface -----------------------------------------------------------------------------------
class FlatEntry(Strict, frozen=True, tag="flat"):
    def surface(self, _: Path) -> Surface:
        return Flat()


class SlopeEntry(Strict, frozen=True, tag="slope"):
    pitch: Incline = 0.0
    cross: Incline = 0.0

    def surface(self, _: Path) -> Surface:
        return Slope(self.pitch, self.cross)


class HeightsEntry(Strict, frozen=True, tag="heights"):
    x_min: Place
    y_min: Place
    spacing: Spacing
    heights: Annotated[list[Row], Meta(min_length=2, max_length=MAX_NODES)]

    def surface(self, _: Path) -> Surface:
        return HeightField(self.x_min, self.y_min, self.spacing, even(self.heights))


class CardinalEntry(Strict, frozen=True, tag="cardinal"):
    """A net of heights that a smooth surface goes through."""

    x_min: Place
    y_min: Place
    spacing: Spacing
    heights: Annotated[list[Controls], Meta(min_length=2, max_length=MAX_CONTROLS)]
    tension: Annotated[float, Meta(ge=0.0, le=1.0)] = 0.0

    def surface(self, _: Path) -> Surface:
        return spline_field(self.x_min, self.y_min, self.spacing, checked_net(self), self.tension)


class BezierEntry(Strict, frozen=True, tag="bezier"):
    """A net of heights of Bézier patches: 4, 7, 10 … along both sides."""

    x_min: Place
    y_min: Place
    spacing: Spacing
    heights: Annotated[list[Controls], Meta(min_length=4, max_length=MAX_CONTROLS)]

    def surface(self, _: Path) -> Surface:
        net = checked_net(self)
        if any(count % 3 != 1 for count in net.shape):
            rows, columns = net.shape
            raise ValueError(
                f"surface.heights has {rows} rows of {columns}: Bézier patches take 4, 7, 10 … of each"
            )
        return spline_field(self.x_min, self.y_min, self.spacing, net, None)


class ImageEntry(Strict, frozen=True, tag="image"):
    """A grey PNG as heights, named from the scene file's folder."""

    file: Annotated[str, Meta(min_length=1, max_length=200)]
    across: Size
    relief: Size
    x_min: Place = 0.0
    y_min: Place = 0.0

    def surface(self, folder: Path) -> Surface:
        return height_map(inside(folder, self.file), self.across, self.relief, (self.x_min, self.y_min))


SurfaceEntry = FlatEntry | SlopeEntry | HeightsEntry | CardinalEntry | BezierEntry | ImageEntry


def even(heights: list[list[float]]) -> np.ndarray:
    """Rows as an array; `ValueError` where they are of different lengths."""
    if len({len(row) for row in heights}) > 1:
        raise ValueError("surface.heights has rows of different lengths")
    return np.array(heights, dtype=float)


def checked_net(entry: CardinalEntry | BezierEntry) -> np.ndarray:
    """The control heights of a net; `ValueError` where it would be sampled into more than memory holds."""
    net, fine = even(entry.heights), fineness(entry.spacing)
    rows, columns = ((count - 1) * fine + 1 for count in net.shape)
    if rows * columns > MOST_SAMPLES:
        raise ValueError(
            f"surface would be sampled at {rows} × {columns} nodes, and takes at most {MOST_SAMPLES:,}: "
            "fewer control points do"
        )
    return net


def inside(folder: Path, name: str) -> Path:
    """A file in a folder or below it; `ValueError` for one that lies outside."""
    try:
        path = (folder / name).resolve()
        is_inside = path.is_relative_to(folder.resolve())
    except (OSError, RuntimeError, ValueError) as error:
        raise ValueError(f"surface.file is {name!r}: {getattr(error, 'strerror', None) or error}") from None
    if not is_inside:
        raise ValueError(f"surface.file is {name!r}, which lies outside the folder of the scene file")
    return path


# --- outlines ----------------------------------------------------------------------------------------
class CircleEntry(Strict, frozen=True, tag="circle"):
    x: Place
    y: Place
    radius: Size


class RectangleEntry(Strict, frozen=True, tag="rectangle"):
    x: Place
    y: Place
    lx: Size
    ly: Size
    yaw: Angle = 0.0


OutlineEntry = Corners | CircleEntry | RectangleEntry


def read_outline(entry: OutlineEntry) -> tuple[Outline, str]:
    """An outline, and what was mended in it; `ValueError` where it is none."""
    if isinstance(entry, CircleEntry):
        return outline_of(regular(entry.x, entry.y, entry.radius, ROUND)), ""
    if isinstance(entry, RectangleEntry):
        return outline_of(rectangle(entry.x, entry.y, entry.yaw, entry.lx, entry.ly)), ""
    return mended(entry)


class HoleEntry(Strict, frozen=True):
    outline: OutlineEntry
    depth: Annotated[float, Meta(ge=0.001, le=100.0)]


class PatchEntry(Strict, frozen=True):
    outline: OutlineEntry
    friction: Annotated[float, Meta(ge=1e-4, le=5.0)]


# --- what stands there -----------------------------------------------------------------------------
class BoxEntry(Timed, frozen=True):
    x: Place
    y: Place
    lx: Length
    ly: Length
    height: Length
    yaw: Angle = 0.0
    base: Base = 0.0

    def solid(self) -> tuple[Solid, str]:
        return Box(**self.numbers), ""


class Rectangular(Timed, frozen=True):
    x: Place
    y: Place
    lx: Size
    ly: Size
    height: Size
    yaw: Angle = 0.0
    base: Base = 0.0


class BoxShape(Rectangular, frozen=True, tag="box"):
    def solid(self) -> tuple[Solid, str]:
        return Box(**self.numbers), ""


class WedgeShape(Rectangular, frozen=True, tag="wedge"):
    def solid(self) -> tuple[Solid, str]:
        return Wedge(**self.numbers), ""


class PyramidShape(Rectangular, frozen=True, tag="pyramid"):
    top: Annotated[float, Meta(ge=0.0, le=0.95)] = 0.0

    def solid(self) -> tuple[Solid, str]:
        return Pyramid(**self.numbers), ""


class CylinderShape(Timed, frozen=True, tag="cylinder"):
    x: Place
    y: Place
    radius: Size
    height: Size
    base: Base = 0.0

    def solid(self) -> tuple[Solid, str]:
        return Cylinder(**self.numbers), ""


class SphereShape(Timed, frozen=True, tag="sphere"):
    x: Place
    y: Place
    radius: Size
    height: Size | None = None
    base: Base = 0.0

    def solid(self) -> tuple[Solid, str]:
        height = self.radius if self.height is None else self.height
        if height > 2.0 * self.radius:
            raise ValueError(
                f"is a sphere of radius {self.radius:g} and stands out {height:g}: at most twice that"
            )
        return Sphere(self.x, self.y, self.radius, height, self.base), ""


class PrismShape(Timed, frozen=True, tag="prism"):
    outline: OutlineEntry
    height: Size
    base: Base = 0.0

    def solid(self) -> tuple[Solid, str]:
        outline, said = read_outline(self.outline)
        return Prism(outline, self.height, self.base), said


ShapeEntry = BoxShape | CylinderShape | PyramidShape | WedgeShape | SphereShape | PrismShape


class SceneEntry(Strict, frozen=True):
    name: Annotated[str, Meta(max_length=MAX_NAME)] = ""
    surface: SurfaceEntry = FlatEntry()
    boxes: Annotated[list[BoxEntry], Meta(max_length=MAX_BOXES)] = field(default_factory=list)
    shapes: Annotated[list[ShapeEntry], Meta(max_length=MAX_BOXES)] = field(default_factory=list)
    holes: Annotated[list[HoleEntry], Meta(max_length=MAX_HOLES)] = field(default_factory=list)
    patches: Annotated[list[PatchEntry], Meta(max_length=MAX_HOLES)] = field(default_factory=list)
    bounds: tuple[Place, Place, Place, Place] = (-4.0, -4.0, 10.0, 4.0)
    start: tuple[Place, Place, Angle] = (0.0, 0.0, 0.0)
    goal: tuple[Place, Place] | None = None
    friction: Annotated[float, Meta(gt=0.0, le=5.0)] = 0.8
