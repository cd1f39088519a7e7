"""The claim `maps`: what it measures with is as it says."""

import math

import numpy as np
import pytest
from shapely import Point, Polygon

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.known_maps import RADIUS, drawn, ours, outline, pairs
from gaitwright.bench.evidence.street_searches import SIDE, shut_in, town
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.navigation.streets import route
from gaitwright.workers import Workers


def test_polygons_are_whole_the_same_for_a_seed_and_shown_whole() -> None:
    side, polygons = drawn(3, 12)
    assert drawn(3, 12)[1] == polygons and drawn(4, 12)[1] != polygons
    assert side == pytest.approx(math.sqrt(600.0)) and all(Polygon(ring).is_valid for ring in polygons)
    assert all(0.0 < x < side for pair in pairs(1, side, 5) for place in pair for x in place)
    bounds = (0.0, 0.0, side, side)
    shown = LearnedMap.of(bounds, RADIUS)
    for polygon in polygons:
        shown = shown.seen(outline(polygon))
    known = LearnedMap.of_polygons(bounds, RADIUS, polygons)
    for a, b in pairs(1, side, 5):
        ways = (shown.way(a, b), known.way(a, b))
        assert (ways[0] is None) == (ways[1] is None)
        if ways[1] is not None:
            assert ways[0].length == pytest.approx(ways[1].length, abs=1e-6)


def test_figures_are_medians_of_what_was_timed() -> None:
    with Context(Workers(1), quick=True) as context:
        figures = list(ours(context, 5))
    assert len(figures) == 4
    for figure in figures:
        assert figure.unit == "ms" and figure.measured == pytest.approx(
            np.median(figure.numbers["ms"]), abs=1e-4
        )


def test_a_goal_that_is_shut_in_has_no_street_out() -> None:
    streets = town(np.random.default_rng(1))
    shut, start, goal = shut_in(streets, 0, 55 * SIDE + 40)
    assert not route(shut, start, goal, "smaller-front").junctions
    assert route(shut, start, goal, "smaller-front").expansions <= 24
    middle, at = Point(shut.places[goal]), Point(shut.places[start])
    assert middle.distance(at) > 100.0
