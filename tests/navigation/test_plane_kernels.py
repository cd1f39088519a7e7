"""What the map is made of, beside shapely: distances, cells, known ground, what is cut out of pieces."""

import math
from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import LineString, Point, Polygon

from gaitwright.navigation.path_check import crossed, is_path_cut
from gaitwright.navigation.piece_grid import (
    clearance,
    is_free,
    leaves,
    lines_apart2,
    piece_grid,
    point_apart2,
)
from gaitwright.navigation.piece_rows import SEEN, joined_rows, rows_of
from gaitwright.navigation.raster import blank, is_known, with_sight, with_way
from gaitwright.navigation.roads import RoadMap, find_links
from gaitwright.navigation.tolerances import HALF_STEP, NODE
from gaitwright.navigation.unlearning import INSIDE, unlearned

BOUNDS = (-1.0, -2.0, 6.0, 4.0)
ROOM = 0.3
on_lattice = st.integers(-4, 24).map(lambda k: 0.25 * k - 1.0)
"""Places that often share a line or an end."""
lines = st.tuples(on_lattice, on_lattice, on_lattice, on_lattice)


def drawn(seed: int, count: int) -> np.ndarray:
    """Random pieces within the bounds."""
    rng = np.random.default_rng(seed)
    ends = rng.uniform(BOUNDS[:2], BOUNDS[2:], (count, 2))
    other = np.clip(ends + rng.normal(0.0, 1.0, (count, 2)), BOUNDS[:2], BOUNDS[2:])
    return np.hstack([ends, other])


def geometry(piece) -> LineString:
    return LineString([piece[:2], piece[2:]])


def strings(pieces: np.ndarray) -> np.ndarray:
    return np.atleast_1d(shapely.linestrings(np.asarray(pieces).reshape(-1, 2, 2)))


@given(lines, lines)
def test_distances_are_those_of_shapely(one, other) -> None:
    a, b = np.array(one), np.array(other)
    assert math.sqrt(lines_apart2(a, b)) == pytest.approx(geometry(a).distance(geometry(b)), abs=1e-12)
    assert math.sqrt(point_apart2(a[0], a[1], b)) == pytest.approx(
        Point(a[:2]).distance(geometry(b)), abs=1e-12
    )


@given(st.integers(0, 10_000), st.integers(0, 60), st.sampled_from([0.1, ROOM]))
def test_a_grid_answers_as_all_pieces_do(seed: int, count: int, room: float) -> None:
    pieces, asked = drawn(seed, count), drawn(seed + 1, 40)
    grid, every = piece_grid(pieces, BOUNDS, ROOM), strings(pieces)
    for a, line in zip(asked, strings(asked), strict=True):
        apart, own = shapely.distance(every, line), shapely.distance(every, Point(a[:2]))
        if np.abs(apart - room).min(initial=1.0) > 1e-9:
            assert is_free(grid, *a, room) == bool((apart >= room).all())
        if np.abs(apart - np.minimum(room, own)).min(initial=1.0) > 1e-8 or (apart >= own - 1e-10).all():
            assert leaves(grid, *a, room, 0.0) == bool((apart >= np.minimum(room, own) - 1e-9).all())
        assert clearance(grid, a[0], a[1], ROOM) == pytest.approx(own.min(initial=ROOM), abs=1e-12)


@given(st.integers(0, 10_000))
def test_a_path_is_cut_by_what_comes_near(seed: int) -> None:
    pieces, path = drawn(seed, 12), drawn(seed + 2, 3)[:, :2]
    near = shapely.distance(strings(pieces), LineString(path))
    assert crossed(pieces, path, ROOM).tolist() == (near < ROOM).tolist()
    far = pieces[shapely.distance(strings(pieces), Point(path[0])) > 2.0 * ROOM]
    near = shapely.distance(strings(far), LineString(path)).min(initial=1.0)
    assert is_path_cut(far, path, ROOM, 0.0) == (near < ROOM)


@given(st.integers(0, 10_000))
def test_nodes_are_where_a_disc_may_turn(seed: int) -> None:
    """Each is a little farther than r from every piece, at r / cos 15° at most from its own end."""
    pieces = drawn(seed, 10)
    nodes = RoadMap(BOUNDS, ROOM, pieces).roads.nodes.at
    ends = pieces.reshape(-1, 2)
    for node in nodes:
        assert shapely.distance(strings(pieces), Point(node[:2])).min() >= ROOM - 1e-12
        away = np.hypot(*(ends - node[:2]).T)
        own = away[np.abs(ends + away[:, None] * node[2:] - node[:2]).max(axis=1) < 1e-9]
        assert len(own) and ROOM < own.min() <= (ROOM + NODE) / math.cos(HALF_STEP) + 1e-12


def test_links_are_found_both_ways() -> None:
    """Gone backwards, a way round is the other one."""
    road_map = RoadMap(BOUNDS, ROOM, drawn(5, 12))
    roads = road_map.roads._replace(targets=np.empty(100_000, dtype=np.int64))
    states = range(len(roads.found))
    assert all(find_links(roads, state) for state in states)
    links = {
        (state, int(on))
        for state in states
        for on in roads.targets[roads.found[state, 0] : roads.found[state].sum()]
    }
    assert len(links) > 20 and {(on ^ 1, state ^ 1) for state, on in links} == links


# --- known ground ------------------------------------------------------------------------------------
def star(seed: int) -> np.ndarray:
    """A star-shaped region around (2.5, 1)."""
    rng = np.random.default_rng(seed)
    angles = np.sort(rng.uniform(0.0, 2.0 * math.pi, 20))
    return np.array([2.5, 1.0]) + rng.uniform(0.3, 3.0, (20, 1)) * np.stack(
        [np.cos(angles), np.sin(angles)], 1
    )


@given(st.integers(0, 10_000))
def test_cells_are_known_whose_middle_was_seen(seed: int) -> None:
    raster, ring = with_sight(blank(BOUNDS), star(seed)), star(seed)
    rows, columns = raster.cells.shape
    x = raster.place[0] + raster.place[2] * (np.arange(columns) + 0.5)
    y = raster.place[1] + raster.place[2] * (np.arange(rows) + 0.5)
    middles = shapely.points(*np.meshgrid(x, y))
    clear = shapely.distance(Polygon(ring).exterior, middles) > 1e-9
    assert (raster.cells == shapely.contains(Polygon(ring), middles))[clear].all()


def test_a_way_that_was_walked_is_known() -> None:
    way = [(0.0, 0.0), (3.0, 1.0), (3.0, 3.0)]
    raster = with_way(blank(BOUNDS), way, 0.16)
    for a, b in pairwise(way):
        assert is_known(raster.cells, raster.place, *a, *b)
    assert not is_known(raster.cells, raster.place, 0.0, 0.0, 3.0, 3.0)
    assert raster.cells.sum() < 120


# --- what is cut, what joins -------------------------------------------------------------------------
@given(st.integers(0, 10_000))
def test_what_lies_well_inside_seen_ground_is_cut_out(seed: int) -> None:
    pieces, ring = drawn(seed, 15), star(seed + 1)
    left = unlearned(rows_of(pieces, True), ring, 0.0)
    inside = Polygon(ring).difference(Polygon(ring).exterior.buffer(INSIDE, quad_segs=64))
    every, kept = shapely.union_all(strings(pieces)), shapely.union_all(strings(left[:, :4]))
    assert shapely.length(kept) == pytest.approx(shapely.length(every.difference(inside)), abs=0.02)
    assert shapely.length(kept.intersection(inside.buffer(-1e-3))) < 1e-9
    assert shapely.length(kept.difference(every.buffer(1e-9))) < 1e-9
    corners = left[:, :4].reshape(-1, 2)[left[:, 4:6].reshape(-1) > 0.0]
    assert all(np.abs(pieces.reshape(-1, 2) - c).max(axis=1).min() < 1e-12 for c in corners)


@given(st.integers(0, 10_000), st.integers(1, 30))
def test_parts_of_a_line_are_one_line(seed: int, parts: int) -> None:
    """Parts of two lines in any order: what is left covers what they cover, in as few pieces as there are."""
    rng = np.random.default_rng(seed)
    whole = np.array([[0.0, 0.0, 4.0, 1.0], [0.0, 3.0, 5.0, -1.0]])
    which, t = rng.integers(0, 2, parts), np.sort(rng.uniform(0.0, 1.0, (parts, 2)), axis=1)
    a, d = whole[which, :2], whole[which, 2:] - whole[which, :2]
    pieces = np.hstack([a + t[:, :1] * d, a + t[:, 1:] * d])
    rows = np.empty((0, 8))
    for piece in pieces:
        rows = joined_rows(rows, rows_of(piece[None], False), 0.0)
    cover = shapely.union_all(strings(pieces).tolist()).buffer(1e-9)
    left = shapely.union_all(strings(rows[:, :4]).tolist())
    assert (rows[:, 7] == SEEN).all()
    assert left.difference(cover.buffer(2e-3)).length < 1e-9
    assert left.length == pytest.approx(0.5 * cover.area / 1e-9, rel=0.02, abs=5e-3)
    for line in (0, 1):
        spans = sorted(t[which == line].tolist())
        runs = sum(span[0] > max((s[1] for s in spans[:k]), default=-1.0) for k, span in enumerate(spans))
        along = whole[line, 2:] - whole[line, :2]
        dx, dy = (rows[:, 2:4] - rows[:, :2]).T
        off = np.abs(dx * along[1] - dy * along[0])
        assert (off < 1e-6 * np.hypot(dx, dy)).sum() <= runs
