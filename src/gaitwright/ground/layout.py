"""Layout: a ground with what stands on it, as the builders of scenes hand it over."""

import math
from dataclasses import fields, replace
from typing import Any, NamedTuple

from gaitwright.ground.holes import Hole, Pitted
from gaitwright.ground.moving import Mover
from gaitwright.ground.patches import Patch
from gaitwright.ground.terrain import Box, HeightField, Solid, Surface

Bounds = tuple[float, float, float, float]

FRICTION = 0.8
"""Coefficient of friction where nothing else is said [-]."""


class Layout(NamedTuple):
    """A ground with what stands on it."""

    surface: Surface
    boxes: tuple[Box, ...]
    bounds: Bounds
    """x_min, y_min, x_max, y_max [m]."""
    friction: float = FRICTION
    shapes: tuple[Solid, ...] = ()
    holes: tuple[Hole, ...] = ()
    """Of the surface, which has them already (`holes.dug`)."""
    patches: tuple[Patch, ...] = ()
    goal: tuple[float, float] | None = None
    """Where a mission leads to [m]; left free, as the start is."""
    movers: tuple[Mover, ...] = ()
    """What moves, appears or vanishes."""


NO_LENGTHS = ("yaw", "top", "friction")
"""Numbers of a part that are no lengths."""


def scaled(layout: Layout, k: float) -> Layout:
    """A layout with every length multiplied; what moves goes as fast for its size (equal Froude numbers)."""
    if k == 1.0:
        return layout
    surface = layout.surface
    if isinstance(surface, Pitted):
        surface = replace(surface, holes=tuple(_scaled(hole, k) for hole in surface.holes))
    elif isinstance(surface, HeightField):
        x, y, spacing = (k * number for number in (surface.x_min, surface.y_min, surface.spacing))
        surface = HeightField(x, y, spacing, k * surface.heights)
    x_min, y_min, x_max, y_max = (k * number for number in layout.bounds)
    return layout._replace(
        surface=surface,
        boxes=tuple(_scaled(box, k) for box in layout.boxes),
        bounds=(x_min, y_min, x_max, y_max),
        shapes=tuple(_scaled(shape, k) for shape in layout.shapes),
        holes=tuple(_scaled(hole, k) for hole in layout.holes),
        patches=tuple(_scaled(patch, k) for patch in layout.patches),
        goal=layout.goal and (k * layout.goal[0], k * layout.goal[1]),
        movers=tuple(_scaled_mover(mover, k) for mover in layout.movers),
    )


def _scaled_mover(mover: Mover, k: float) -> Mover:
    times = {name: math.sqrt(k) * getattr(mover, name) for name in ("speed", "begins", "appears", "vanishes")}
    along = tuple((k * x, k * y) for x, y in mover.along)
    return replace(mover, solid=_scaled(mover.solid, k), along=along, **times)


def _scaled(part: Any, k: float) -> Any:
    """A solid, a hole or a patch with every length multiplied."""
    lengths = {
        field.name: getattr(part, field.name) for field in fields(part) if field.name not in NO_LENGTHS
    }
    return replace(part, **{name: _times(k, value) for name, value in lengths.items()})


def _times(k: float, value: float | tuple) -> float | tuple:
    return tuple(_times(k, one) for one in value) if isinstance(value, tuple) else k * value
