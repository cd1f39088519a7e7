"""Every primitive is as high as its formula, leans as its heights do, and many are as high as each alone."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from gaitwright.ground.relief import Relief
from gaitwright.ground.scene import Scene
from gaitwright.ground.solids import Cylinder, Prism, Pyramid, Sphere, Wedge
from gaitwright.ground.terrain import Box, Flat, Slope, Solid

BOW = ((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 0.5), (0.0, 2.0))
"""Not convex."""
SOLIDS = [
    Box(0.3, -0.2, 0.7, 1.0, 0.4, 0.2),
    Cylinder(0.2, 0.1, 0.7, 0.3),
    Pyramid(0.1, 0.2, 0.4, 1.6, 1.0, 0.5),
    Pyramid(-0.1, 0.2, -0.9, 1.6, 1.0, 0.5, 0.4),
    Wedge(0.2, -0.1, 2.5, 1.5, 0.8, 0.4),
    Sphere(0.1, 0.0, 0.6, 0.25),
    Sphere(0.1, 0.0, 0.4, 0.7),
    Prism(BOW, 0.3),
]
EACH = pytest.mark.parametrize("solid", SOLIDS, ids=lambda s: type(s).__name__)


def plane_pieces(solid: Solid, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Height by the pieces of its top: the plane through each, where its outline holds the place."""
    out = np.full(len(x), -np.inf)
    for piece in solid.tops():
        normal = np.linalg.svd(piece - piece.mean(axis=0))[2][2]
        middle = piece.mean(axis=0)
        z = middle[2] - (normal[0] * (x - middle[0]) + normal[1] * (y - middle[1])) / normal[2]
        held = shapely.contains_xy(shapely.Polygon(piece[:, :2]), x, y)
        out = np.where(held, np.maximum(out, z), out)
    return out


@EACH
def test_heights_are_those_of_its_shape(solid: Solid, rng: np.random.Generator) -> None:
    x, y = rng.uniform(-2.5, 2.5, (2, 3000))
    mine = Relief.of([solid], [0.0]).tops(x, y)
    if isinstance(solid, Sphere):
        room = solid.radius**2 - (x - solid.x) ** 2 - (y - solid.y) ** 2
        theirs = np.where(room >= 0, solid.height - solid.radius + np.sqrt(np.maximum(room, 0.0)), -np.inf)
    else:
        theirs = plane_pieces(solid, x, y)
    sure = np.ones(len(x), dtype=bool)
    if isinstance(solid, Cylinder):  # its outline on the map is a polygon around it
        sure = np.abs(np.hypot(x - solid.x, y - solid.y) - solid.radius) > 2e-3
    np.testing.assert_allclose(mine[sure], theirs[sure], atol=1e-12)
    assert np.isfinite(mine).sum() > 30


@EACH
def test_it_leans_as_its_heights_do(solid: Solid, rng: np.random.Generator) -> None:
    scene = Scene("one", Flat(), (), shapes=(solid,))
    x, y = rng.uniform(-1.0, 1.5, (2, 400))
    tiny = 1e-7
    rise_x = (np.asarray(scene.height(x + tiny, y)) - scene.height(x - tiny, y)) / (2 * tiny)
    rise_y = (np.asarray(scene.height(x, y + tiny)) - scene.height(x, y - tiny)) / (2 * tiny)
    smooth = np.hypot(rise_x, rise_y) < 20.0
    normal = scene.normal(x, y)
    np.testing.assert_allclose(np.linalg.norm(normal, axis=1), 1.0)
    np.testing.assert_allclose(-normal[smooth, 0] / normal[smooth, 2], rise_x[smooth], atol=1e-4)
    np.testing.assert_allclose(-normal[smooth, 1] / normal[smooth, 2], rise_y[smooth], atol=1e-4)


@EACH
def test_its_outline_holds_all_of_it(solid: Solid, rng: np.random.Generator) -> None:
    outline = shapely.Polygon(solid.corners())
    assert outline.is_valid and outline.exterior.is_ccw
    x, y = rng.uniform(-2.5, 2.5, (2, 3000))
    stands_out = Relief.of([solid], [0.0]).tops(x, y) > 0.0
    within = shapely.contains_xy(outline.buffer(1e-9), x, y)
    assert not (stands_out & ~within).any()
    near = shapely.distance(outline.exterior, shapely.points(x, y)) < 3e-3
    assert not (within & ~stands_out & ~near).any()
    assert (np.hypot(*(solid.corners() - solid.centre).T) <= solid.reach + 1e-12).all()


@given(st.integers(0, 10_000), st.sampled_from([1, 7, 60]))
def test_many_are_as_high_as_the_highest_one(seed: int, many: int) -> None:
    rng = np.random.default_rng(seed)
    solids, levels = [], rng.uniform(-1.0, 1.0, many).tolist()
    for _ in range(many):
        x, y = rng.uniform(-5.0, 5.0, 2)
        size = float(np.exp(rng.uniform(-4.0, 2.0)))
        kind = rng.integers(6)
        lx, ly = size * rng.uniform(0.3, 1.0, 2)
        x, y, lx, ly, yaw = (float(v) for v in (x, y, lx, ly, rng.uniform(-4, 4)))
        solids.append(
            (
                Box(x, y, yaw, lx, ly, 0.2),
                Cylinder(x, y, lx, 0.2),
                Pyramid(x, y, yaw, lx, ly, 0.2, 0.3),
                Wedge(x, y, yaw, lx, ly, 0.2),
                Sphere(x, y, lx, lx / 2),
                Prism(tuple((x + lx * a, y + ly * b) for a, b in BOW), 0.2),
            )[kind]
        )
    x, y = rng.uniform(-6.0, 6.0, (2, 200))
    x[0] = np.nan
    together = Relief.of(solids, levels).look(x, y)
    each = np.array([Relief.of([s], [level]).look(x, y) for s, level in zip(solids, levels, strict=True)])
    highest = each[..., 0].argmax(axis=0)
    np.testing.assert_array_equal(together, each[highest, np.arange(len(x))])
    assert together[0, 0] == -np.inf


@EACH
def test_on_a_slope_it_stands_upright_on_the_ground_under_its_middle(solid: Solid) -> None:
    scene = Scene("hill", Slope(0.2, -0.1), (), shapes=(solid,))
    x, y = solid.centre
    ground = x * math.tan(0.2) + y * math.tan(-0.1)
    assert scene.level(solid) == pytest.approx(ground)
    assert scene.top(solid) == pytest.approx(ground + solid.height)
    probe = np.array([x, y]) + 0.1
    flat = Relief.of([solid], [0.0]).tops(*probe)
    there = probe[0] * math.tan(0.2) + probe[1] * math.tan(-0.1)
    assert float(scene.height(*probe)) == pytest.approx(max(there, ground + flat))


@pytest.mark.parametrize(
    ("solid", "step", "rises"),
    [
        (Pyramid(0.0, 0.0, 0.0, 2.0, 2.0, math.tan(math.radians(20))), 0.1, False),
        (Pyramid(0.0, 0.0, 0.0, 2.0, 2.0, math.tan(math.radians(60))), 0.1, True),
        (Pyramid(0.0, 0.0, 0.0, 2.0, 2.0, 0.3, 0.9), 0.1, True),
        (Pyramid(0.0, 0.0, 0.0, 0.1, 0.1, 0.09), 0.1, False),
        (Sphere(0.0, 0.0, 0.5, 0.5), 0.1, True),
        (Sphere(0.0, 0.0, 5.0, 0.2), 0.1, False),
        (Cylinder(0.0, 0.0, 0.2, 0.11), 0.1, True),
        (Cylinder(0.0, 0.0, 0.2, 0.09), 0.1, False),
    ],
)
def test_what_rises_by_a_step_within_a_step_is_too_high(solid: Solid, step: float, rises: bool) -> None:
    assert solid.rises(step) == rises
    x = np.linspace(-3.0, 3.0, 6001)
    profile = np.maximum(Relief.of([solid], [0.0]).tops(x, np.zeros_like(x)), 0.0)
    far = round(step / 0.001)
    assert bool((profile[far:] - profile[:-far]).max() > step) == rises


@pytest.mark.parametrize("solid", [solid for solid in SOLIDS if not isinstance(solid, Sphere)])
def test_its_convex_pieces_fill_it(solid: Solid) -> None:
    pieces = [piece[:, :2] for piece in solid.tops()]
    assert sum(ConvexHull(piece).volume for piece in pieces) == pytest.approx(
        shapely.Polygon(solid.corners()).area
    )
