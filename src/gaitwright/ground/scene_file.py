"""Scenes that users write, as JSON: untrusted, so everything is limited, finite and named when wrong.

```json
{"surface": {"type": "slope", "pitch": 0.1},
 "boxes": [{"x": 2, "y": 0, "yaw": 0.3, "lx": 0.5, "ly": 0.4, "height": 0.3}],
 "bounds": [-4, -4, 10, 4], "start": [0, 0, 0], "friction": 0.8}
```
Surfaces: `flat`, `slope` (pitch, cross [rad]), `heights` (x_min, y_min, spacing [m], heights: rows along y).
"""

import json
import re
from pathlib import Path
from typing import Annotated, Any

import msgspec
import numpy as np
from msgspec import Meta

from gaitwright.errors import BadFile, printable, short
from gaitwright.files import content_of, json_of
from gaitwright.ground.terrain import Box, Flat, HeightField, Slope, Surface

MAX_BYTES = 5_000_000
MAX_BOXES = 2000
MAX_NAME = 80
MAX_NODES = 1000
SMALLEST = 1e-4
"""Of friction [-] and of the sides of a box [m]."""

Place = Annotated[float, Meta(ge=-1000.0, le=1000.0)]
Length = Annotated[float, Meta(gt=0.0, le=1000.0)]
Angle = Annotated[float, Meta(ge=-7.0, le=7.0)]
Incline = Annotated[float, Meta(ge=-1.0, le=1.0)]
Row = Annotated[list[Place], Meta(min_length=2, max_length=MAX_NODES)]


class Strict(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Refuses what it does not know."""


class FlatEntry(Strict, frozen=True, tag="flat"):
    def surface(self) -> Surface:
        return Flat()


class SlopeEntry(Strict, frozen=True, tag="slope"):
    pitch: Incline = 0.0
    cross: Incline = 0.0

    def surface(self) -> Surface:
        return Slope(self.pitch, self.cross)


class HeightsEntry(Strict, frozen=True, tag="heights"):
    x_min: Place
    y_min: Place
    spacing: Annotated[float, Meta(ge=0.001, le=100.0)]
    heights: Annotated[list[Row], Meta(min_length=2, max_length=MAX_NODES)]

    def surface(self) -> Surface:
        return HeightField(self.x_min, self.y_min, self.spacing, np.array(self.heights))


class BoxEntry(Strict, frozen=True):
    x: Place
    y: Place
    lx: Length
    ly: Length
    height: Length
    yaw: Angle = 0.0
    base: Annotated[float, Meta(ge=0.0, le=1000.0)] = 0.0


class SceneEntry(Strict, frozen=True):
    name: Annotated[str, Meta(max_length=MAX_NAME)] = ""
    surface: FlatEntry | SlopeEntry | HeightsEntry = FlatEntry()
    boxes: Annotated[list[BoxEntry], Meta(max_length=MAX_BOXES)] = []
    bounds: tuple[Place, Place, Place, Place] = (-4.0, -4.0, 10.0, 4.0)
    start: tuple[Place, Place, Angle] = (0.0, 0.0, 0.0)
    friction: Annotated[float, Meta(gt=0.0, le=5.0)] = 0.8


def read(path: str) -> dict[str, Any]:
    """The fields of a `Scene` from a JSON file. Raises `BadFile` with one sentence."""
    content, asked = content_of(path, "scene file", MAX_BYTES), f"scene file {short(path)}"
    try:
        entry = json_of(content, SceneEntry, asked)
    except msgspec.ValidationError as error:
        raise BadFile(f"{asked}: {_sentence(str(error), content)}") from None
    _check(asked, entry)
    _check_small(asked, entry)
    boxes = tuple(Box(**msgspec.structs.asdict(box)) for box in entry.boxes)
    return {
        "name": printable(entry.name or Path(path).stem)[:MAX_NAME],
        "surface": entry.surface.surface(),
        "boxes": boxes,
        "bounds": entry.bounds,
        "start": entry.start,
        "friction": entry.friction,
    }


def _check(asked: str, entry: SceneEntry) -> None:
    """What types cannot say. Raises `BadFile`."""
    x_min, y_min, x_max, y_max = entry.bounds
    x, y, _ = entry.start
    if not (x_min < x_max and y_min < y_max):
        raise BadFile(f"{asked}: bounds is {list(entry.bounds)}, expected x_min, y_min, x_max, y_max")
    if not (x_min <= x <= x_max and y_min <= y <= y_max):
        raise BadFile(
            f"{asked}: start is {list(entry.start)}, which lies outside bounds {list(entry.bounds)}"
        )
    if isinstance(entry.surface, HeightsEntry) and len({len(row) for row in entry.surface.heights}) > 1:
        raise BadFile(f"{asked}: surface.heights has rows of different lengths")


def _check_small(asked: str, entry: SceneEntry) -> None:
    """Raises `BadFile` for a number that is not zero, but too small for physics."""
    sizes = {"friction": entry.friction}
    for k, box in enumerate(entry.boxes):
        sizes |= {f"boxes[{k}].{name}": getattr(box, name) for name in ("lx", "ly", "height")}
    for name, value in sizes.items():
        if value < SMALLEST:
            raise BadFile(f"{asked}: {name} is {value}: expected at least {SMALLEST:g}")


def _sentence(message: str, content: bytes) -> str:
    """msgspec's "Expected … - at `$.boxes[0].lx`" with the field first and its value told."""
    found = re.fullmatch(r"(.*) - at `\$\.?(.*)`", message)
    if not found:
        return message
    what, field = found.groups()
    try:
        value = json.loads(content)
    except (ValueError, RecursionError):
        return message
    try:
        for key, index in re.findall(r"(\w+)|\[(\d+)\]", field):
            value = value[key] if key else value[int(index)]
    except (LookupError, TypeError):
        return message
    text = repr(value)
    return f"{field} is {text if len(text) <= 60 else text[:57] + '...'}: {what[0].lower()}{what[1:]}"
