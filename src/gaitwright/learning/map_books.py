"""Learned maps ↔ skillbook: what a trip learned of a place is what the next one begins with (V7)."""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from jaxtyping import Float
from shapely import LineString

from gaitwright.errors import WrongUse
from gaitwright.navigation.learned_map import STRATEGIES, LearnedMap, Path
from gaitwright.navigation.piece_rows import WIDTH
from gaitwright.navigation.raster import Raster
from gaitwright.navigation.roads import Bounds
from gaitwright.record.recording import Recording
from gaitwright.record.rows import parts
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.map_notes import MOST_WAYS, MapNotes, numbers_of, place_of

EVERY = 25
"""Ticks between two points of a way that are looked at: a robot goes some centimetres meanwhile."""
AS_WALKED = 0.02
"""A way is kept to within this length of where the robot was [m]."""
MOST_POINTS = 100_000
"""Points of all ways of a map; the newest ways are kept."""
FLOAT = "<f8"


# --- kept -------------------------------------------------------------------------------------------
def notes_of(learned: LearnedMap, place: str) -> MapNotes:
    """A map as a book holds it; of more ways than a book can hold the newest."""
    return MapNotes(
        place,
        learned.bounds,
        learned.radius,
        learned.strategy,
        learned.noise,
        as_bytes(learned.rows),
        float(learned.raster.place[2]),
        learned.raster.cells.shape,
        np.packbits(learned.raster.cells).tobytes(),
        tuple(as_bytes(np.array(way)) for way in newest(learned.trips)),
    )


def learned_map_of(notes: MapNotes) -> LearnedMap:
    """The map that a book holds. Where cells of free ground have another size today they are forgotten: they
    only prefer what was seen."""
    strategy = notes.strategy if notes.strategy in STRATEGIES else STRATEGIES[0]
    empty = LearnedMap.of(notes.bounds, notes.radius, strategy, notes.noise)
    rows = numbers_of(notes.pieces).reshape(-1, WIDTH)
    ways = tuple(tuple(map(tuple, numbers_of(way).reshape(-1, 2).tolist())) for way in notes.ways)
    raster = empty.raster
    if (notes.cell, notes.shape) == (raster.place[2], raster.cells.shape):
        raster = Raster(raster.place, free_cells(notes))
    return replace(empty, rows=rows, raster=raster, trips=ways)


def free_cells(notes: MapNotes) -> np.ndarray:
    """Which cells are free, rows along y."""
    rows, columns = notes.shape
    bits = np.frombuffer(notes.free, np.uint8)
    return np.unpackbits(bits, count=rows * columns).astype(bool).reshape(rows, columns)


def as_bytes(numbers: np.ndarray) -> bytes:
    return np.ascontiguousarray(numbers, FLOAT).tobytes()


def newest(ways: tuple[tuple[tuple[float, float], ...], ...]) -> tuple[tuple[tuple[float, float], ...], ...]:
    """The last ways, as many as a book can hold."""
    kept, points = 0, 0
    for way in reversed(ways[-MOST_WAYS:]):
        points += len(way)
        if points > MOST_POINTS:
            break
        kept += 1
    return ways[len(ways) - kept :]


# --- used -------------------------------------------------------------------------------------------
def map_in(book: Skillbook, place: str, empty: LearnedMap) -> LearnedMap | None:
    """What a book knows of a place, for whoever begins there with an empty map: its disc and its strategy
    count, and what either took for noise. `None`: nothing. Raises `WrongUse` for a map of another field."""
    notes = next((notes for notes in book.maps if notes.place == place), None)
    if notes is None:
        return None
    if notes.bounds != empty.bounds:
        raise WrongUse(f"the map of {place} is of the field {notes.bounds}, and this one is {empty.bounds}")
    noise = max(notes.noise, empty.noise)
    return replace(learned_map_of(notes), radius=empty.radius, strategy=empty.strategy, noise=noise)


def with_trip(learned: LearnedMap, recording: Recording) -> LearnedMap:
    """A map with the way that was walked in the field on a trip, as far as there was one."""
    way = way_walked(recording, learned.bounds)
    return learned.walked(way) if length_of(way) > learned.radius else replace(learned, trail=())


def way_walked(recording: Recording, bounds: Bounds) -> Float[np.ndarray, "n 2"]:
    """Where a robot was in a field on a trip, from above [m]: a line that is at most `AS_WALKED` off."""
    trip = recording.of_trip().sound()
    position = trip.channel("position_w")
    taken = [position[part][::EVERY] for part in parts(len(trip))]
    points = in_field(np.concatenate([*taken, position[len(trip) - 1 :]])[:, :2], bounds)
    if len(points) < 2:
        return points
    return np.array(LineString(points).simplify(AS_WALKED).coords)


def in_field(way: Float[np.ndarray, "n 2"], bounds: Bounds) -> Float[np.ndarray, "m 2"]:
    """A way until it first left a field."""
    x_min, y_min, x_max, y_max = bounds
    outside = np.flatnonzero(~((way >= (x_min, y_min)) & (way <= (x_max, y_max))).all(axis=1))
    return way[: outside[0]] if len(outside) else way


# --- joined -----------------------------------------------------------------------------------------
def maps_of_both(ours: Iterable[MapNotes], theirs: Iterable[MapNotes]) -> tuple[MapNotes, ...]:
    """Our maps, with what theirs know more of the same fields, and theirs of other places."""
    found = {notes.place: notes for notes in ours}
    for notes in theirs:
        mine = found.get(notes.place)
        found[notes.place] = notes if mine is None else joined(mine, notes)
    return tuple(sorted(found.values(), key=place_of))


def joined(ours: MapNotes, theirs: MapNotes) -> MapNotes:
    """Our map with what theirs knows more; ours, where that is nothing, or another field."""
    if ours.bounds != theirs.bounds:
        return ours
    is_walked = set(theirs.ways) <= set(ours.ways)
    if is_walked and ours.shape == theirs.shape and not (free_cells(theirs) & ~free_cells(ours)).any():
        return ours
    return notes_of(learned_map_of(ours).joined(learned_map_of(theirs)), ours.place)


# --- told -------------------------------------------------------------------------------------------
def known(learned: LearnedMap) -> str:
    """How much a map knows, in words."""
    trips, pieces = len(learned.trips), len(learned.rows)
    counted = [f"{n} {what}{'' if n == 1 else 's'}" for n, what in ((trips, "trip"), (pieces, "piece"))]
    return f"{', '.join(counted)}, {free_ground(learned):.0f} m² free"


def length_of(way: Path) -> float:
    """How long a way is [m]."""
    return float(np.hypot(*np.diff(np.array(way), axis=0).T).sum())


def free_ground(learned: LearnedMap) -> float:
    """How much ground is known to be free [m²]."""
    return float(learned.raster.cells.sum() * learned.raster.place[2] ** 2)
