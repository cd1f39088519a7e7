"""A grey picture (PNG) → a height field: black is low, white is high, the picture's top is ahead of +y."""

import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

from gaitwright.errors import WrongUse, printable
from gaitwright.ground.terrain import HeightField

ACROSS, RELIEF = 14.0, 1.0
"""Metres from side to side and from black to white where nothing is said."""
NAMED = re.compile(r"(?P<path>.+\.png)(?::(?P<across>[^:]*))?(?::(?P<relief>[^:]*))?", re.IGNORECASE)


def is_named_by(asked: str) -> bool:
    """Whether a scene is asked for as a picture: `hill.png`, `hill.png:20`, `hill.png:20:1.5`."""
    return NAMED.fullmatch(asked) is not None


def read(asked: str) -> dict[str, Any]:
    """The fields of a `Scene` of a picture named like that: start in its middle. Raises `BadFile`, and
    `WrongUse` for metres that make no sense."""
    named = NAMED.fullmatch(asked)
    assert named is not None
    across = _metres(asked, "across", named["across"], ACROSS)
    relief = _metres(asked, "relief", named["relief"], RELIEF)
    field = height_map(named["path"], across, relief, (0.0, 0.0))
    x, y = -field.x_max / 2, -field.y_max / 2
    field = replace(field, x_min=x, y_min=y)
    bounds = (x, y, field.x_max, field.y_max)
    return {"name": printable(Path(named["path"]).stem)[:80], "surface": field, "bounds": bounds}


def _metres(asked: str, what: str, text: str | None, default: float) -> float:
    if text is None:
        return default
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.01 <= value <= 1000.0:
        raise WrongUse(f"scene {asked!r}: {what} is {text!r}, expected metres from 0.01 to 1000")
    return value


def height_map(path: Path | str, across: float, relief: float, corner: tuple[float, float]) -> HeightField:
    """A picture as ground: `across` metres from its first column to its last, `relief` metres from black to
    white, black at height zero. `corner`: x, y of its lower left [m]. Raises `BadFile`."""
    from gaitwright.ground.grey_png import grey_of  # noqa: PLC0415 - slow to import, and few ask for it

    grey = grey_of(path)
    return HeightField(*corner, across / (grey.shape[1] - 1), relief * grey[::-1])
