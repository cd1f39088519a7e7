"""Scenes that users write, as JSON: untrusted, so everything is limited, finite and named when wrong.

```json
{"surface": {"type": "slope", "pitch": 0.1},
 "boxes": [{"x": 2, "y": 0, "yaw": 0.3, "lx": 0.5, "ly": 0.4, "height": 0.3}],
 "shapes": [{"type": "cylinder", "x": 4, "y": 1, "radius": 0.2, "height": 0.8,
             "moves": {"along": [[4, -1]], "speed": 0.4, "loop": true}}],
 "holes": [{"outline": [[5, -1], [6, -1], [6, 1]], "depth": 0.3}],
 "bounds": [-4, -4, 10, 4], "start": [0, 0, 0], "friction": 0.8}
```
docs/scenes.md tells every entry; `scene_entries` reads them.
"""

import json
import re
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

import msgspec
import shapely

from gaitwright.errors import BadFile, printable, short
from gaitwright.files import content_of, json_of
from gaitwright.ground.holes import Hole, dug
from gaitwright.ground.moving import Mover
from gaitwright.ground.moving_entries import MOST_MOVERS, outside
from gaitwright.ground.outlines import Outline
from gaitwright.ground.patches import Patch
from gaitwright.ground.scene_entries import MAX_NAME, BoxEntry, SceneEntry, ShapeEntry, read_outline
from gaitwright.ground.terrain import HeightField

MAX_BYTES = 5_000_000
MOST_CORNERS = 4000
"""Of all outlines of holes: physics has a piece of ground for every few."""
SMALLEST = 1e-4
"""Of friction [-] and of the sides of a box [m]."""
OVERLAP = 1e-6
"""Holes that share less than this do not overlap [m²]."""

Made = TypeVar("Made")


def read(path: str) -> dict[str, Any]:
    """The fields of a `Scene` from a JSON file. Raises `BadFile` with one sentence."""
    content, asked = content_of(path, "scene file", MAX_BYTES), f"scene file {short(path)}"
    try:
        entry = json_of(content, SceneEntry, asked)
    except msgspec.ValidationError as error:
        raise BadFile(f"{asked}: {_sentence(str(error), content)}") from None
    _check(asked, entry)
    _check_small(asked, entry)
    notes: list[str] = []
    boxes, going = _told_apart(asked, "boxes", entry, notes)
    shapes, others = _told_apart(asked, "shapes", entry, notes)
    movers = (*going, *others)
    if len(movers) > MOST_MOVERS:
        raise BadFile(f"{asked}: {len(movers)} things move, appear or vanish, and {MOST_MOVERS} may")
    holes = [
        Hole(outline, hole.depth)
        for outline, hole in zip(_outlines(asked, "holes", entry.holes, notes), entry.holes, strict=True)
    ]
    patches = zip(_outlines(asked, "patches", entry.patches, notes), entry.patches, strict=True)
    _look_at_holes(asked, holes, entry, notes)
    surface = _tried(asked, lambda: entry.surface.surface(Path(path).parent))
    if holes and isinstance(surface, HeightField):
        notes.append(
            f"the walls of its holes are {surface.spacing:g} m wide, as the cells of its heights are"
        )
    return {
        "name": printable(entry.name or Path(path).stem)[:MAX_NAME],
        "surface": dug(surface, holes),
        "boxes": boxes,
        "shapes": shapes,
        "movers": movers,
        "holes": tuple(holes),
        "patches": tuple(Patch(outline, patch.friction) for outline, patch in patches),
        "bounds": entry.bounds,
        "start": entry.start,
        "goal": entry.goal,
        "friction": entry.friction,
        "notes": tuple(notes),
    }


def _told_apart(
    asked: str, field: str, entry: SceneEntry, notes: list[str]
) -> tuple[tuple[Any, ...], tuple[Mover, ...]]:
    """What stands there all the time, and what moves, appears or vanishes. Raises `BadFile`."""
    entries: list[BoxEntry] | list[ShapeEntry] = getattr(entry, field)
    solids = _made(asked, field, (one.solid for one in entries), notes)
    still, movers = [], []
    for k, (one, solid) in enumerate(zip(entries, solids, strict=True)):
        if one.is_still:
            still.append(solid)
            continue
        mover = _tried(f"{asked}: {field}[{k}]", partial(one.mover, solid), between=" ")
        if said := outside(mover, entry.bounds):
            raise BadFile(f"{asked}: {field}[{k}].{said}")
        movers.append(mover)
    return tuple(still), tuple(movers)


def _made(
    asked: str, field: str, make: Iterable[Callable[[], tuple[Made, str]]], notes: list[str]
) -> list[Made]:
    """What the entries of a field make; what was mended in them joins the notes. Raises `BadFile`."""
    out = []
    for k, one in enumerate(make):
        made, said = _tried(f"{asked}: {field}[{k}]", one, between=" ")
        out.append(made)
        if said:
            notes.append(f"{field}[{k}]: {said}")
    return out


def _outlines(asked: str, field: str, entries: Iterable[Any], notes: list[str]) -> list[Outline]:
    return _made(asked, field, ((lambda e=entry: read_outline(e.outline)) for entry in entries), notes)


def _tried(asked: str, make: Callable[[], Made], between: str = ": ") -> Made:
    """What is made; `BadFile` where it cannot be."""
    try:
        return make()
    except ValueError as error:
        raise BadFile(f"{asked}{between}{error}") from None


def _look_at_holes(asked: str, holes: list[Hole], entry: SceneEntry, notes: list[str]) -> None:
    """Notes holes that overlap or lie where nobody comes. Raises `BadFile` for too many corners."""
    corners = sum(len(hole.outline) for hole in holes)
    if corners > MOST_CORNERS:
        raise BadFile(f"{asked}: the holes have {corners} corners together, and may have {MOST_CORNERS}")
    outlines = [shapely.Polygon(hole.outline) for hole in holes]
    field = shapely.box(*entry.bounds)
    notes += [
        f"holes[{k}] lies outside the bounds" for k, one in enumerate(outlines) if not one.intersects(field)
    ]
    pairs = shapely.STRtree(outlines).query(outlines, predicate="intersects").T if outlines else ()
    notes += [
        f"holes[{k}] overlaps holes[{other}]: where both are the deeper one counts"
        for k, other in pairs
        if other < k and outlines[k].intersection(outlines[other]).area > OVERLAP
    ]


def _check(asked: str, entry: SceneEntry) -> None:
    """What types cannot say. Raises `BadFile`."""
    x_min, y_min, x_max, y_max = entry.bounds
    if not (x_min < x_max and y_min < y_max):
        raise BadFile(f"{asked}: bounds is {list(entry.bounds)}, expected x_min, y_min, x_max, y_max")
    for name, place in (("start", entry.start), ("goal", entry.goal)):
        if place and not (x_min <= place[0] <= x_max and y_min <= place[1] <= y_max):
            raise BadFile(f"{asked}: {name} is {list(place)}, which lies outside bounds {list(entry.bounds)}")


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
