"""A grey picture (PNG) → a height field: black is low, white is high, the picture's top is ahead of +y.

Untrusted: its size is looked at before it is decoded, and only what is grey, of 8 or 16 bits, is a height
map. Pillow decodes it: MuJoCo brings no reader that the ground may ask, and the other way is one of our own.
"""

import io
import math
import re
import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float
from PIL import Image, PngImagePlugin, UnidentifiedImageError

from gaitwright.errors import BadFile, WrongUse, printable, short
from gaitwright.files import content_of
from gaitwright.ground.terrain import HeightField

MAX_BYTES = 20_000_000
MOST_PIXELS = 4_000_000
MOST_ACROSS = 4096
"""Pixels of a side."""
DEPTH = {"L": 255.0, "I;16": 65535.0, "I": 65535.0, "I;16B": 65535.0}
"""White, by what Pillow calls the kinds of grey."""

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
    grey = grey_of(path)
    return HeightField(*corner, across / (grey.shape[1] - 1), relief * grey[::-1])


def grey_of(path: Path | str) -> Float[np.ndarray, "rows columns"]:
    """The pixels of a grey PNG from 0 (black) to 1 (white), its top row first. Raises `BadFile`."""
    asked = f"height map {short(str(path))}"
    content = content_of(path, "height map", MAX_BYTES)
    try:
        image = opened(content)
    except (UnidentifiedImageError, Image.DecompressionBombError):
        raise BadFile(f"{asked} is no PNG picture, or too large a one") from None
    except (OSError, SyntaxError, ValueError) as error:
        raise BadFile(f"{asked} is a damaged PNG: {error}") from None
    _check(asked, image)
    try:
        pixels = np.asarray(image)
    except (OSError, SyntaxError, ValueError, EOFError) as error:
        raise BadFile(f"{asked} is a damaged PNG: {error}") from None
    return pixels.astype(float) / DEPTH[image.mode]


def opened(content: bytes) -> Image.Image:
    """A PNG, not decoded yet. Raises what Pillow raises."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", Image.DecompressionBombWarning)  # its size is looked at by `_check`
        return Image.open(io.BytesIO(content), formats=("PNG",))


def _check(asked: str, image: Image.Image) -> None:
    """Raises `BadFile` for a picture that is no height map, before it is decoded."""
    columns, rows = image.size
    if image.mode not in DEPTH or not isinstance(image, PngImagePlugin.PngImageFile):
        raise BadFile(
            f"{asked} is a picture of kind {image.mode}: a height map is grey, of 8 or 16 bits, "
            "without colours or transparency"
        )
    if min(columns, rows) < 2:
        raise BadFile(f"{asked} has {columns} × {rows} pixels: a height map has two or more of each")
    if columns * rows > MOST_PIXELS or max(columns, rows) > MOST_ACROSS:
        raise BadFile(
            f"{asked} has {columns} × {rows} pixels: a height map has at most {MOST_PIXELS:,}, and no side "
            f"of more than {MOST_ACROSS:,}"
        )
    if getattr(image, "is_animated", False):
        raise BadFile(f"{asked} is an animation: a height map is one picture")
