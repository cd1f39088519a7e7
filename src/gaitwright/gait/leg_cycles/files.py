"""Leg cycles as JSON files that people edit and share: limited, checked, the wrong point named (row J3).

```json
{"about": "a low swing",
 "points": [[0, -0.5, 0], [0.3, -0.3, 0.1], [0.7, 0.3, 0.1], [1, 0.5, 0]],
 "hind": [[0, -0.5, 0], [0.3, -0.3, 0.2], [0.7, 0.3, 0.2], [1, 0.5, 0]]}
```
A point is: share of the swing, forward in strides, height in body heights (`leg_cycle.py`). `about`
and `hind` may be left out; the name of the cycle is that of the file.
"""

import re
from functools import cache
from pathlib import Path
from typing import Annotated

import msgspec
from msgspec import Meta

from gaitwright.errors import BadFile, short, unknown
from gaitwright.files import content_of, is_there, json_of
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle, Point, fault_of

MAX_BYTES = 100_000
MAX_LISTED = 1000
"""More points than this are not even counted."""
BUILT_IN = Path(__file__).parent / "cycles"
DEFAULT = "trot"
"""The cycle of every skill that has none of its own."""

Points = Annotated[list[Point], Meta(max_length=MAX_LISTED)]


class CycleEntry(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a file holds."""

    points: Points
    about: Annotated[str, Meta(max_length=200)] = ""
    hind: Points | None = None


def cycle_names() -> tuple[str, ...]:
    """Names of the cycles that come along."""
    return tuple(sorted(path.stem for path in BUILT_IN.glob("*.json")))


def load_cycle(name_or_path: str | Path) -> LegCycle:
    """The leg cycle of that name, or the one in that JSON file.

    Raises `WrongUse` for a name that does not exist and `BadFile` for a file that cannot be used.
    """
    asked = str(name_or_path)
    if asked in cycle_names():
        return built_in(asked)
    if isinstance(name_or_path, Path) or Path(asked).suffix == ".json" or is_there(asked):
        return read(asked)
    raise unknown("leg cycle", asked, (*cycle_names(), "or the path of a JSON file"))


def cycle_of(skill: str) -> LegCycle:
    """The cycle of a skill: its own where one comes along under its name, else that of trot."""
    return built_in(skill if skill in cycle_names() else DEFAULT)


@cache
def built_in(name: str) -> LegCycle:
    """A cycle that comes along."""
    return read(str(BUILT_IN / f"{name}.json"))


# --- reading ---------------------------------------------------------------------------------------
def read(path: str) -> LegCycle:
    """The cycle in a JSON file. Raises `BadFile` with one sentence."""
    name, asked = Path(path).name, f"leg cycle {short(path)}"
    try:
        entry = json_of(content_of(path, "leg cycle", MAX_BYTES), CycleEntry, asked)
    except msgspec.ValidationError as error:
        raise BadFile(f"{asked}: {sentence(str(error), name)}") from None
    points, hind = tuple(entry.points), None if entry.hind is None else tuple(entry.hind)
    fault = fault_of(points, name, hind)
    if fault:
        raise BadFile(f"{asked}: {fault}")
    return LegCycle(Path(path).stem, points, hind, entry.about)


def sentence(message: str, name: str) -> str:
    """msgspec's "Expected … - at `$.points[4][1]`" with the point named first."""
    found = re.fullmatch(r"(.*) - at `\$\.(points|hind)\[(\d+)\](?:\[(\d)\])?`", message)
    if not found:
        return message
    what, part, point, number = found.groups()
    of = f"the hind legs of {name}" if part == "hind" else name
    which = f", {('share of the swing', 'forward', 'height')[int(number)]}" if number else ""
    return f"point {int(point) + 1} of {of}{which}: {what[0].lower()}{what[1:]}"
