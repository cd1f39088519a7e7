"""The parts of a field of heights that are too steep to walk on, as solids that are walked around."""

from collections.abc import Iterator

import numpy as np
import shapely
from jaxtyping import Bool, Float

from gaitwright.ground.outlines import outline_of
from gaitwright.ground.solids import Prism
from gaitwright.ground.terrain import STEEPEST, HeightField

AROUND = 0.25
"""A part is a hole where the ground around it lies no farther below its rim than this share of its depth."""
THIN = 1e-4
"""A ring is cut open by so much, in cells, to be outlines without holes."""


def steep_parts(field: HeightField, step: float, wide: float) -> list[Prism]:
    """Parts steeper than 45° that rise or fall by more than a step [m].

    A hole is left to the feet unless a circle of diameter `wide` [m] has room in it.
    """
    steep = steep_cells(field)
    parts = outlined(field, steep)
    low, high = heights_in(field, steep, parts)
    return [
        Prism(outline_of(shapely.get_coordinates(piece.exterior)[:-1]), float(high[k] - low[k]))
        for k, part in enumerate(parts)
        if high[k] - low[k] > step and not is_narrow_hole(field, part, (low[k], high[k]), wide)
        for piece in opened(shapely.simplify(part, 0.5 * field.spacing), THIN * field.spacing)
    ]


def steep_cells(field: HeightField) -> Bool[np.ndarray, "rows columns"]:
    """Which cells have a side that is too steep."""
    heights, most = field.heights, STEEPEST * field.spacing
    along = np.abs(np.diff(heights, axis=1)) > most
    across = np.abs(np.diff(heights, axis=0)) > most
    return along[:-1] | along[1:] | across[:, :-1] | across[:, 1:]


def outlined(field: HeightField, cells: Bool[np.ndarray, "rows columns"]) -> list[shapely.Polygon]:
    """Cells that hang together by their sides, as polygons [m]."""
    change = np.diff(np.pad(cells, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    (rows, begins), ends = np.nonzero(change == 1), np.nonzero(change == -1)[1]
    x, y, spacing = field.x_min, field.y_min, field.spacing
    runs = shapely.box(x + begins * spacing, y + rows * spacing, x + ends * spacing, y + (rows + 1) * spacing)
    return list(shapely.get_parts(shapely.union_all(runs)))


def heights_in(
    field: HeightField, cells: Bool[np.ndarray, "rows columns"], parts: list[shapely.Polygon]
) -> tuple[Float[np.ndarray, "parts"], Float[np.ndarray, "parts"]]:
    """Lowest and highest node of the cells of each part [m]."""
    rows, columns = np.nonzero(cells)
    middles = shapely.points(
        field.x_min + (columns + 0.5) * field.spacing, field.y_min + (rows + 0.5) * field.spacing
    )
    cell, part = shapely.STRtree(parts).query(middles, predicate="within")
    low, high = np.full(len(parts), np.inf), np.full(len(parts), -np.inf)
    for up in (0, 1):
        for right in (0, 1):
            nodes = field.heights[rows[cell] + up, columns[cell] + right]
            np.minimum.at(low, part, nodes)
            np.maximum.at(high, part, nodes)
    return low, high


def is_narrow_hole(
    field: HeightField, part: shapely.Polygon, heights: tuple[float, float], wide: float
) -> bool:
    """Whether a part with nodes between two heights [m] is a hole in which no circle `wide` has room."""
    low, high = heights
    whole = shapely.Polygon(part.exterior)
    beside = shapely.get_coordinates(whole.buffer(field.spacing, join_style="mitre").exterior)
    if high - float(np.median(field.height(*beside.T))) > AROUND * (high - low):
        return False
    return 2.0 * shapely.maximum_inscribed_circle(whole).length <= wide


def opened(part: shapely.Polygon, thin: float) -> Iterator[shapely.Polygon]:
    """A polygon as polygons without holes: it is cut across each of them."""
    if not part.interiors:
        yield part
        return
    x = shapely.Polygon(part.interiors[0]).representative_point().x
    _, low, _, high = part.bounds
    cut = shapely.box(x - 0.5 * thin, low - 1.0, x + 0.5 * thin, high + 1.0)
    for piece in shapely.get_parts(shapely.difference(part, cut)):
        yield from opened(piece, thin)
