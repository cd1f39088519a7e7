"""Figure 6.11: how much a map knows, how ways go, what is claimed of them, and two traversals in physics."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.reproduce import figure_6_11 as figure
from gaitwright.reproduce.map_measures import along, are_known, distances, edges_of, near_share
from gaitwright.reproduce.traversal_sheet import draw_traversals
from gaitwright.reproduce.traversals import Traversal, rims_of, shortest_way, traversed
from oracles import robot_called

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
NOTHING = LearnedMap.of((0.0, 0.0, 5.0, 5.0), 0.2)


# --- measures --------------------------------------------------------------------------------------
def test_an_edge_is_known_where_pieces_lie_along_the_most_of_it():
    edges = edges_of([SQUARE, SQUARE + 3.0])
    assert edges.shape == (8, 4) and edges[0].tolist() == [0.0, 0.0, 1.0, 0.0]
    assert not are_known(edges, np.empty((0, 4))).any()
    beside = np.array([[0.0, 0.03, 0.9, 0.03], [1.0, 0.0, 1.0, 0.5]])  # nine tenths of one, half of another
    assert are_known(edges, beside).tolist() == [True] + 7 * [False]
    assert are_known(edges, edges[4:]).tolist() == 4 * [False] + 4 * [True]


def test_distances_are_those_to_the_nearest_piece():
    places = np.array([[0.5, 0.5], [2.0, 0.0], [-3.0, 4.0]])
    pieces = np.array([[0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 0.0]])
    assert distances(places, pieces) == pytest.approx([0.5, 1.0, 5.0])


def test_how_much_of_a_way_was_walked_before():
    way = np.array([[0.0, 0.0], [2.0, 0.0]])
    before = [np.array([[0.0, 0.1], [1.0, 0.1]]), np.array([[5.0, 5.0], [6.0, 5.0], [6.0, 6.0]])]
    assert near_share(way, before, 0.1 + 1e-9) == pytest.approx(0.5, abs=0.01)
    assert near_share(way, [], 1.0) == 0.0
    assert len(along(way)) == 101


# --- claims ----------------------------------------------------------------------------------------
def went(route: tuple[int, int], way: list[tuple[float, float]], shortest: float, arrived=True) -> Traversal:
    return Traversal(route, np.array(way), arrived, "it ended", 10.0, shortest, NOTHING)


def runs(first: float = 1.0, again: float = 0.0, arrived: bool = True) -> dict[str, list[Traversal]]:
    """Of both strategies: a first way with a detour, two others, and all three again, each `again` aside."""
    ways = [
        went((1, 2), [(0.0, 0.0), (1.0, first), (2.0, 0.0)], 2.0),
        went((2, 3), [(2.0, 0.0), (2.0, 2.0)], 2.0),
        went((3, 1), [(2.0, 2.0), (0.0, 0.0)], 8.0**0.5),
        went((1, 2), [(0.0, 0.0), (1.0, again), (2.0, 0.0)], 2.0, arrived),
        went((2, 3), [(2.0, 0.0), (2.0, 2.0)], 2.0),
        went((3, 1), [(2.0, 2.0), (0.0, 0.0)], 8.0**0.5),
    ]
    return {figure.BETTER: ways, figure.THESIS: ways}


def test_a_map_that_does_not_grow_differs():
    known = {figure.BETTER: [4, 11, 12, 12, 12, 12], figure.THESIS: [4, 6, 9, 11, 11, 12]}
    assert figure.growing(known, 20).agrees
    assert "0, 4, 11, 12, 12; " in figure.growing(known, 20).ours
    assert figure.growing(known | {figure.THESIS: [4, 4, 4, 4, 4, 4]}, 20).agrees is False
    assert figure.growing(known | {figure.THESIS: [0, 4, 4, 4, 4, 4]}, 20).agrees is False
    assert figure.complete(known, 20).agrees is None


def test_a_way_that_is_made_again_is_shorter_and_optimal():
    assert figure.shorter(runs()).agrees and figure.optimal(runs()).agrees
    assert figure.shorter(runs(again=1.0)).agrees is False
    assert figure.optimal(runs(again=0.5)).agrees is False


def test_who_does_not_arrive_is_named():
    assert went((1, 2), [(0.0, 0.0), (3.0, 0.0)], 2.0).ratio == 1.5
    assert went((1, 2), [(0.0, 0.0), (3.0, 0.0)], 2.0, arrived=False).ratio is None
    assert went((1, 2), [(0.0, 0.0), (3.0, 0.0)], float("nan")).ratio is None
    assert figure.always_a_path(runs()).agrees
    lost = figure.always_a_path(runs(arrived=False))
    assert lost.agrees is False and "the thesis's rule, 1 → 2: it ended" in lost.ours
    assert figure.shorter(runs(arrived=False)).agrees is False
    assert figure.optimal(runs(arrived=False)).agrees is False


def test_a_way_over_fresh_ground_is_no_way_walked_before():
    assert figure.walked_before(runs(first=0.2)).agrees
    assert figure.walked_before(runs(first=1.0, again=-1.0)).agrees is False


def test_the_rule_of_the_thesis_keeps_near_to_edges():
    close = edges_of([SQUARE + np.array([0.5, 0.75])])  # its lower edge is 0.2 m off the first way
    assert figure.along_edges(runs(first=0.0), close).agrees is False
    assert figure.along_edges(runs(first=0.55), close).agrees


def test_the_micro_world_is_one_in_which_every_route_has_a_way():
    robot, scene = robot_called("go2"), figure.micro_world()
    rims = rims_of(robot, scene)
    assert len(rims) == 7
    for a, b in zip(figure.TOUR, figure.TOUR[1:], strict=False):
        ends = np.array([figure.POINTS[a], figure.POINTS[b]])
        assert shortest_way(robot, scene, 0.2, ends) > np.hypot(*(ends[1] - ends[0]))
    blocked = replace(scene, boxes=(Box(0.5, 3.2, 0.0, 2.0, 6.4, 0.4),))
    assert np.isnan(shortest_way(robot, blocked, 0.2, np.array([[3.0, 1.0], [0.2, 0.2]])))


# --- in physics ------------------------------------------------------------------------------------
def test_the_second_traversal_begins_with_what_the_first_has_learned(tmp_path: Path):
    robot = robot_called("go2")
    scene = Scene("a block", Flat(), (Box(1.2, 0.2, 0.0, 0.3, 0.8, 0.4),), (-0.8, -1.5, 3.2, 1.5))
    points, told = {1: (0.0, 0.0), 2: (2.4, 0.0)}, []
    there, back = traversed(robot, scene, points, (1, 2, 1), figure.BETTER, told.append)
    assert told == ["optimistic: 1 → 2", "optimistic: 2 → 1"]
    assert there.arrived and back.arrived
    assert np.hypot(*(there.way[-1] - points[2])) < 0.2
    assert np.hypot(*(back.way[0] - there.way[-1])) < 0.05  # from where it came to rest
    assert there.shortest <= there.length * 1.001 < 1.3 * there.shortest
    assert len(there.known.trips) == 1 and len(back.known.trips) == 2
    edges = edges_of(rims_of(robot, scene))
    first, second = (int(are_known(edges, one.known.pieces).sum()) for one in (there, back))
    assert 0 < first <= second
    assert there.plain()["route"] == (1, 2) and there.plain()["pieces"]
    rows = {"ours": [("there", "map", there), ("back", "map", back)]}
    draw_traversals(tmp_path / "a.png", ("title", "line"), (robot, scene, points), rows)
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
