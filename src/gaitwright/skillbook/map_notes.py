"""A learned map as a skillbook holds it: of which place, for which disc, and what is known as numbers."""

from collections.abc import Sequence
from typing import Annotated

import numpy as np
from jaxtyping import Float
from msgspec import Meta

from gaitwright.knowledge.json_form import Label, Strict

MOST = 256
"""Maps in a book."""
MOST_WAYS = 1024
"""Ways in a map."""
LARGEST = 1e6
"""No number of a map is beyond this [m]."""
ROW, POINT = 8, 2
"""Numbers of a piece, of a point of a way."""
KINDS = 3
"""Kinds of pieces."""
Number = Annotated[float, Meta(ge=-LARGEST, le=LARGEST)]
Numbers = Annotated[bytes, Meta(max_length=2_000_000)]
"""64-bit floats, the lowest byte first."""
Pieces = Annotated[bytes, Meta(max_length=64 * 32_768)]
"""The same, eight numbers a piece: with more of them joining two maps takes too long."""
Bits = Annotated[bytes, Meta(max_length=1_000_000)]
"""Eight a byte, the first one highest."""
Cells = Annotated[int, Meta(ge=1, le=8_000_000)]


class MapNotes(Strict, frozen=True, omit_defaults=True):
    """What `navigation.learned_map.LearnedMap` knows of a place."""

    place: Label
    bounds: tuple[Number, Number, Number, Number]
    """x_min, y_min, x_max, y_max of the field [m]."""
    radius: Annotated[float, Meta(gt=0.0, le=LARGEST)]
    """Of the disc that learned it last [m]."""
    strategy: Label
    noise: Annotated[float, Meta(ge=0.0, le=LARGEST)]
    """Standard deviation of where pieces were seen [m]."""
    pieces: Pieces
    """Rows that follow each other, each as `navigation.piece_rows` has it."""
    cell: Annotated[float, Meta(gt=0.0, le=LARGEST)]
    """Size of a cell of the free ground [m]."""
    shape: tuple[Cells, Cells]
    """Rows (along y) and columns of the free ground."""
    free: Bits
    """Which cells were seen to be free or walked on, row by row."""
    ways: Annotated[tuple[Numbers, ...], Meta(max_length=MOST_WAYS)] = ()
    """Points x, y of each way that was walked [m], the last one walked last."""


def place_of(notes: MapNotes) -> str:
    """What a map is called in a book."""
    return notes.place


def fault_in(maps: Sequence[MapNotes]) -> str:
    """Why a book cannot hold these, as a sentence; empty: it can."""
    if len(maps) > MOST:
        return f"it holds {len(maps)} maps; {MOST} is the most"
    for notes in maps:
        if not is_sound(notes):
            return f"its map of {notes.place} makes no sense"
    if len({notes.place for notes in maps}) < len(maps):
        return "it holds two maps of one place"
    return ""


def is_sound(notes: MapNotes) -> bool:
    """Whether there is a field, and its pieces, cells and ways are whole, finite and of a possible size."""
    x_min, y_min, x_max, y_max = notes.bounds
    rows, columns = notes.shape
    if not (x_min < x_max and y_min < y_max) or len(notes.free) != -(-rows * columns // 8):
        return False
    if len(notes.pieces) % (8 * ROW) or any(len(way) % (8 * POINT) or not way for way in notes.ways):
        return False
    numbers = [numbers_of(some) for some in (notes.pieces, *notes.ways)]
    return all(bool((np.abs(some) <= LARGEST).all()) for some in numbers) and are_pieces(numbers[0])


def are_pieces(numbers: Float[np.ndarray, " n"]) -> bool:
    """Whether rows of pieces have a length, and flags, looks and kinds that there are."""
    rows = numbers.reshape(-1, ROW)
    has_length = np.hypot(rows[:, 2] - rows[:, 0], rows[:, 3] - rows[:, 1]) > 0.0
    flags, looks, kinds = rows[:, 4:6], rows[:, 6], rows[:, 7]
    is_known = np.isin(flags, (0.0, 1.0)).all(axis=1) & np.isin(kinds, range(KINDS)) & (looks >= 1.0)
    return bool((has_length & is_known).all())


def numbers_of(content: bytes) -> Float[np.ndarray, " n"]:
    """The numbers that are held as bytes."""
    return np.frombuffer(content, "<f8").astype(np.float64)
