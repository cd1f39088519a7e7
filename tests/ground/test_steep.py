"""Steep parts of a field of heights are walked around by their outlines; what feet get over is theirs."""

import math

import numpy as np
import pytest
import shapely

from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import HeightField

STEP, SPACING = 0.1, 0.05
X = SPACING * np.arange(121) - 3.0
"""From −3 to 3 m, rows along y, columns along x."""
AT_X, AT_Y = np.meshgrid(X, X)


def outlines(heights: np.ndarray) -> list[shapely.Polygon]:
    field = HeightField(-3.0, -3.0, SPACING, heights)
    scene = Scene("field", field, bounds=(-3.0, -3.0, 3.0, 3.0))
    return [shapely.Polygon(one.corners()) for one in scene.obstacles(STEP)]


def blocked(heights: np.ndarray) -> shapely.Geometry:
    return shapely.union_all(outlines(heights))


def mesa(half: float, height: float) -> np.ndarray:
    return np.where(np.maximum(abs(AT_X), abs(AT_Y)) < half, height, 0.0)


@pytest.mark.parametrize("height", [0.5, -0.5])
def test_a_mesa_and_a_pit_are_shut_off_all_round(height: float) -> None:
    parts = outlines(mesa(1.01, height))
    assert all(part.is_valid and not part.interiors for part in parts)
    angles = 0.01 + np.linspace(0.0, 2.0 * math.pi, 73)  # not through the cut that opens the ring
    for angle in angles:
        way = shapely.LineString([(0.0, 0.0), (2.5 * math.cos(angle), 2.5 * math.sin(angle))])
        assert any(part.intersects(way) for part in parts)
    inside = shapely.Point(0.0, 0.0)
    assert not any(part.distance(inside) < 0.9 for part in parts)
    whole = shapely.union_all(parts)
    assert whole.within(shapely.box(-1.15, -1.15, 1.15, 1.15))


def test_what_is_gentle_or_low_is_no_wall() -> None:
    waves = 0.3 * np.sin(2.0 * math.pi * AT_X / 2.5)  # up to 37°
    assert not outlines(waves)
    assert not outlines(mesa(1.01, 0.09))
    assert not outlines(np.zeros_like(AT_X))


@pytest.mark.parametrize(("half", "count"), [(0.06, 0), (0.4, 1)])
def test_a_narrow_hole_is_left_to_the_feet(half: float, count: int) -> None:
    """A hole of 0.15 m at its floor is stepped over; one of 0.8 m is not."""
    assert bool(outlines(mesa(half, -0.4))) == bool(count)


def test_a_narrow_wall_is_one() -> None:
    ridge = np.where(abs(AT_X) < 0.02, 0.5, 0.0)
    assert blocked(ridge).intersects(shapely.LineString([(-1.0, 0.3), (1.0, 0.3)]))


def test_a_ramp_onto_a_mesa_leads_up_and_its_sides_do_not() -> None:
    heights = mesa(1.01, 0.4)
    ramp = (AT_X < -1.0) & (AT_X > -2.6) & (abs(AT_Y) < 0.5)
    heights = np.where(ramp, np.clip((AT_X + 2.6) / 1.6, 0.0, 1.0) * 0.4, heights)
    walls = blocked(heights)
    assert not walls.intersects(shapely.LineString([(-2.9, 0.0), (0.0, 0.0)]))
    assert walls.intersects(shapely.LineString([(-1.3, -1.0), (-1.3, 1.0)]))


def test_families_of_smooth_ground_have_none_and_holes_in_them_are_told_by_their_outlines() -> None:
    for name in ("hills:1", "waves:1", "rough:0.05"):
        assert not load_scene(name, 2).obstacles(STEP)
    mixed = load_scene("mixed", 1)
    assert {type(one).__name__ for one in mixed.obstacles(STEP)} <= {
        "Box",
        "Prism",
        "Hole",
        "Cylinder",
        "Wedge",
    }
