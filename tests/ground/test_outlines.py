"""Outlines: what can be mended is mended and told, and convex parts fill a region without a crack."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from gaitwright.ground.outlines import circle, convex_parts, mended, outline_of, regular

SQUARE = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))


def test_either_direction_is_the_same_outline() -> None:
    assert mended(SQUARE) == (SQUARE, "")
    assert set(mended(SQUARE[::-1])[0]) == set(SQUARE)
    assert shapely.LinearRing(mended(SQUARE[::-1])[0]).is_ccw


@pytest.mark.parametrize(
    ("corners", "lost"),
    [
        ([*SQUARE, SQUARE[0]], 1),
        ([SQUARE[0], *SQUARE], 1),
        ([SQUARE[0], (0.0004, 0.0), *SQUARE[1:], (0.0, 0.0003)], 2),
    ],
)
def test_repeated_and_snapped_corners_are_left_out_and_told(corners: list, lost: int) -> None:
    outline, said = mended(corners)
    assert outline == SQUARE
    assert said.startswith(f"{lost} corner") and "left out" in said


@pytest.mark.parametrize(
    ("corners", "told"),
    [
        ([(0.0, 0.0), (1.0, 1.0)], "2 different corners"),
        ([(0.0, 0.0)] * 5, "1 different corners"),
        ([(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)], "no area"),
        ([(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)], "crosses itself at (0.5, 0.5)"),
        ([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 0.0), (0.0, 2.0)], "crosses itself at (1, 0)"),
    ],
)
def test_what_is_no_outline_is_told(corners: list, told: str) -> None:
    with pytest.raises(ValueError) as error:
        mended(corners)
    assert told in str(error.value)


@given(st.integers(0, 10_000), st.integers(1, 6))
def test_convex_parts_fill_a_region_without_a_crack(seed: int, holes: int) -> None:
    rng = np.random.default_rng(seed)
    region = shapely.box(-3.0, -3.0, 3.0, 3.0)
    for _ in range(holes):
        rays = rng.uniform(0.2, 1.0, 9)[:, None]
        star = regular(0.0, 0.0, 1.0, 9) * rays + rng.uniform(-3.0, 3.0, 2)
        region = shapely.difference(region, shapely.Polygon(star))
    parts = convex_parts(region)
    polygons = [shapely.Polygon(part) for part in parts]
    for part, polygon in zip(parts, polygons, strict=True):
        assert polygon.is_valid and polygon.exterior.is_ccw
        assert ConvexHull(part).volume == pytest.approx(polygon.area, rel=1e-5)
    assert sum(polygon.area for polygon in polygons) == pytest.approx(region.area)
    assert shapely.union_all(polygons).symmetric_difference(region).area < 1e-9
    triangles = sum(len(g.exterior.coords) - 3 for g in polygons)
    assert len(parts) < triangles  # some were joined


@given(st.floats(0.01, 50.0))
def test_a_circle_lies_in_its_outline_and_near_it(radius: float) -> None:
    corners = circle(2.0, -1.0, radius)
    ring = shapely.LinearRing(corners)
    assert shapely.distance(ring, shapely.Point(2.0, -1.0)) == pytest.approx(radius)
    away = np.hypot(*(corners - (2.0, -1.0)).T)
    assert away.max() - radius < (1.01e-3 if radius < 0.4 else 3e-3 * radius)
    assert len(corners) <= 48
    assert outline_of(corners)[0] == tuple(corners[0])
