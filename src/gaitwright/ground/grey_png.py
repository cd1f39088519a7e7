"""A grey PNG → its pixels. Untrusted: its size is looked at before it is decoded, and only grey is taken.

Pillow decodes it: MuJoCo brings no reader that the ground may ask, and the other way is one of our own.
"""

import io
import warnings
from pathlib import Path

import numpy as np
from jaxtyping import Float
from PIL import Image, PngImagePlugin, UnidentifiedImageError

from gaitwright.errors import BadFile, short
from gaitwright.files import content_of

MAX_BYTES = 20_000_000
MOST_PIXELS = 4_000_000
MOST_ACROSS = 4096
"""Pixels of a side."""
DEPTH = {"L": 255.0, "I;16": 65535.0, "I": 65535.0, "I;16B": 65535.0}
"""White, by what Pillow calls the kinds of grey."""


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
