"""LearnedMap ↔ bytes, so that what was learned of a field can be kept in a book or a file."""

import math
from typing import Annotated

import msgspec
import numpy as np
from msgspec import Meta

from gaitwright.errors import BadFile, WrongUse
from gaitwright.navigation.learned_map import FARTHEST, STRATEGIES, LearnedMap
from gaitwright.navigation.piece_rows import CORNERS, KIND, LOOKS, MOST_LOOKS, SUPPOSED, WIDTH
from gaitwright.navigation.raster import Raster

LARGEST = 64 * 1024 * 1024
"""More bytes than this are no map."""
MOST_TRIPS, MOST_POINTS = 10_000, 100_000
"""A map has no more trips, and a trip no more points."""

KeptPoint = tuple[float, float]
KeptTrip = Annotated[tuple[KeptPoint, ...], Meta(max_length=MOST_POINTS)]


class KeptMap(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A map as plain data."""

    bounds: tuple[float, float, float, float]
    radius: float
    strategy: str
    noise: float
    rows: bytes
    """Pieces: 8 little-endian float64 each (`piece_rows`)."""
    known: bytes
    """Cells of known ground, row by row, 8 a byte."""
    trips: Annotated[tuple[KeptTrip, ...], Meta(max_length=MOST_TRIPS)] = ()


def to_bytes(learned: LearnedMap) -> bytes:
    """A map as bytes (MessagePack); equal maps give equal bytes."""
    rows, known = learned.rows.astype("<f8").tobytes(), np.packbits(learned.raster.cells).tobytes()
    settings = (learned.bounds, learned.radius, learned.strategy, learned.noise)
    return msgspec.msgpack.encode(KeptMap(*settings, rows, known, learned.trips))


def of_bytes(data: bytes) -> LearnedMap:
    """The map that `to_bytes` made these of. Raises `BadFile` for bytes that are no map."""
    if len(data) > LARGEST:
        raise BadFile(f"a learned map has at most {LARGEST} bytes, this one {len(data)}")
    try:
        kept = msgspec.msgpack.decode(data, type=KeptMap)
    except (msgspec.DecodeError, UnicodeDecodeError) as problem:
        raise BadFile(f"this is no learned map: {problem}") from problem
    return of_kept(kept)


def of_kept(kept: KeptMap) -> LearnedMap:
    """The map of plain data. Raises `BadFile` for data that make no sense."""
    if kept.strategy not in STRATEGIES:
        raise BadFile(f"a learned map has no strategy {kept.strategy!r}; there is: {', '.join(STRATEGIES)}")
    try:
        empty = LearnedMap.of(kept.bounds, kept.radius, kept.strategy, kept.noise)
    except WrongUse as problem:
        raise BadFile(f"a learned map cannot be read: {problem}") from problem
    if len(kept.rows) % (8 * WIDTH):
        raise BadFile("a learned map's pieces are cut off")
    rows = np.frombuffer(kept.rows, dtype="<f8").astype(float).reshape(-1, WIDTH)
    points = [number for trip in kept.trips for point in trip for number in point]
    if not (np.isfinite(rows).all() and (np.abs([*points, *rows[:, :4].flat]) <= FARTHEST).all()):
        raise BadFile("a place of a learned map is no finite number, or too far away")
    looks, kinds = rows[:, LOOKS], rows[:, KIND]
    if not (np.isin(rows[:, CORNERS], (0.0, 1.0)).all() and np.isin(kinds, np.arange(SUPPOSED + 1.0)).all()):
        raise BadFile("a learned map has pieces of a kind that there is not")
    if not ((looks >= 1.0) & (looks <= MOST_LOOKS)).all():
        raise BadFile(f"a learned map has pieces that were not seen 1 to {MOST_LOOKS:g} times")
    shape = empty.raster.cells.shape
    if len(kept.known) != math.ceil(shape[0] * shape[1] / 8):
        raise BadFile("a learned map's known ground is not that of its field")
    bits = np.unpackbits(np.frombuffer(kept.known, dtype=np.uint8), count=shape[0] * shape[1])
    raster = Raster(empty.raster.place, bits.reshape(shape).astype(bool))
    return LearnedMap(
        kept.bounds, kept.radius, kept.strategy, kept.noise, rows, raster, tuple(map(tuple, kept.trips))
    )
