"""Map notes with a few numbers, as skillbooks may hold them."""

import numpy as np

from gaitwright.skillbook.map_notes import MapNotes

WALL = (1.0, -0.25, 1.0, 0.75, 1.0, 0.0, 4.0, 0.0)
"""A piece: its ends [m], a corner, in how many looks it was seen, and its kind."""
TOUCHED = (0.5, 1.0, 0.5, 1.125, 0.0, 0.0, 1.0, 1.0)


def map_notes(
    place: str = "blocks (seed 1)", rows=(WALL, TOUCHED), ways=((0.0, 0.0, 0.5, -0.125),)
) -> MapNotes:
    """A map of a field of 2 × 2 m, a corner of which was seen to be free."""
    free = np.zeros((11, 11), dtype=bool)
    free[3:8, 4:9] = True
    pieces, *walked = (np.asarray(numbers, "<f8").tobytes() for numbers in (rows, *ways))
    bits, shape = np.packbits(free).tobytes(), free.shape
    bounds = (-0.5, -1.0, 1.5, 1.0)
    return MapNotes(place, bounds, 0.16, "optimistic", 0.0125, pieces, 0.2, shape, bits, tuple(walked))


def some_maps() -> tuple[MapNotes, ...]:
    """Three, in the order of their places: one without pieces, one without ways."""
    return (
        map_notes(ways=((0.0, 0.0, 0.5, -0.125, 1.0 / 3.0, 0.1), (0.5, -0.125, -0.0, 0.0))),
        map_notes("rooms (seed 0)", (), ()),
        map_notes("»yard« (seed 12)", ways=()),
    )
