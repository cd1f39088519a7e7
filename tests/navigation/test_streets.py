"""Streets: every search is exact against scipy, and how much each has to look at."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from gaitwright.errors import WrongUse
from gaitwright.navigation.streets import EW, NS, SEARCHES, StreetMap, replanned, route

BY_STREETS = ("breadth-first", "alternating", "smaller-front")
BY_METRES = ("Dijkstra", "two-way Dijkstra", "A*")


def town(seed: int, columns: int, rows: int, blocked: float = 0.2, even: bool = False) -> StreetMap:
    """A grid of streets, a share of them blocked; blocks of equal or random sizes."""
    rng = np.random.default_rng(seed)
    xs, ys = (
        np.cumsum(np.ones(n) if even else rng.integers(20, 200, n).astype(float)) for n in (columns, rows)
    )
    streets = StreetMap.grid(xs.tolist(), ys.tolist())
    every = sorted(streets.streets)
    chosen = rng.permutation(len(every))[: int(blocked * len(every))]
    return streets.blocked(*(every[k] for k in chosen))


def true_length(streets: StreetMap, start: int, goal: int, in_metres: bool) -> float:
    """By scipy."""
    a, b = np.array(sorted(streets.streets), dtype=int).reshape(-1, 2).T
    cost = [streets.length(*street) if in_metres else 1.0 for street in sorted(streets.streets)]
    size = len(streets.places)
    return float(
        dijkstra(coo_array((cost, (a, b)), (size, size)).tocsr(), directed=False, indices=start)[goal]
    )


@given(st.integers(0, 10_000), st.sampled_from(sorted(SEARCHES)), st.booleans())
@settings(max_examples=60)
def test_every_search_is_exact(seed: int, search: str, even: bool) -> None:
    rng = np.random.default_rng(seed)
    streets = town(seed, int(rng.integers(1, 9)), int(rng.integers(1, 9)), rng.uniform(0.0, 0.6), even)
    start, goal = rng.integers(0, len(streets.places), 2).tolist()
    in_metres = search in BY_METRES
    found = route(streets, start, goal, search)
    assert found.length == pytest.approx(true_length(streets, start, goal, in_metres))
    if found.junctions:
        assert (found.junctions[0], found.junctions[-1]) == (start, goal)
        legs = list(zip(found.junctions, found.junctions[1:], strict=False))
        assert all((min(leg), max(leg)) in streets.streets for leg in legs)
        assert found.length == pytest.approx(sum(streets.length(*leg) if in_metres else 1.0 for leg in legs))


def test_two_fronts_look_at_less_between_any_two_places() -> None:
    """Over one town, sums over twenty pairs; the goal shut in is found to be so at once from its side."""
    streets, rng = town(1, 60, 60), np.random.default_rng(2)
    pairs = [rng.integers(0, 3600, 2).tolist() for _ in range(20)]
    looked = {name: sum(route(streets, *pair, name).expansions for pair in pairs) for name in SEARCHES}
    assert looked["breadth-first"] > 1.3 * looked["smaller-front"]
    assert looked["Dijkstra"] > 1.2 * looked["two-way Dijkstra"]
    assert looked["Dijkstra"] > 5.0 * looked["A*"]
    walled = town(1, 60, 60, 0.0)
    goal = 30 * 60 + 30
    shut = walled.blocked(*((goal, other) for other in walled.neighbours[goal]))
    assert route(shut, 0, goal, "breadth-first").expansions == 3599
    for name in ("alternating", "smaller-front", "two-way Dijkstra"):
        assert route(shut, 0, goal, name).expansions <= 20 and not route(shut, 0, goal, name).junctions


def test_the_first_common_level_is_not_the_shortest_in_metres() -> None:
    """Appendix A's stop rule counts streets: by metres three long streets lose against four short ones."""
    places = ((0.0, 0.0), (0.0, 300.0), (100.0, 300.0), (10.0, 0.0), (20.0, 0.0), (30.0, 0.0), (100.0, 0.0))
    streets = StreetMap(places, frozenset({(0, 1), (1, 2), (2, 6), (0, 3), (3, 4), (4, 5), (5, 6)}))
    for name in BY_METRES:
        assert route(streets, 0, 6, name).junctions == (0, 3, 4, 5, 6)
    for name in BY_STREETS:
        assert route(streets, 0, 6, name).junctions == (0, 1, 2, 6)


def test_a_blocked_street_is_gone_around() -> None:
    streets = town(3, 12, 12, 0.1)
    here, goal = 0, 143
    left = route(streets, here, goal)
    walked = 0.0
    while here != goal:
        on = left.junctions[1]
        if (here * 7 + on) % 5 == 0 and len(streets.neighbours[here]) > 2:
            streets, left = replanned(streets, here, goal, [(here, on)])
            assert left.length == pytest.approx(true_length(streets, here, goal, in_metres=True))
            continue
        walked += streets.length(here, on)
        here = on
        left = route(streets, here, goal)
    assert walked > 0.0


def test_types_and_places() -> None:
    streets = StreetMap.grid([0.0, 10.0], [0.0, 20.0])
    assert (streets.type_of(0, 1), streets.type_of(0, 2)) == (EW, NS)
    assert streets.nearest((9.0, 18.0)) == 3
    assert streets.blocked((1, 0)).opened((0, 1)) == streets
    assert route(streets, 2, 2) == ((2,), 0.0, 0)


def test_what_makes_no_sense_is_said() -> None:
    streets = StreetMap.grid([0.0, 10.0], [0.0, 20.0])
    with pytest.raises(WrongUse, match="no search 'a star'"):
        route(streets, 0, 1, "a star")
    with pytest.raises(WrongUse, match="no junction 9"):
        route(streets, 0, 9)
    with pytest.raises(WrongUse, match="neither"):
        StreetMap(((0.0, 0.0), (1.0, 1.0)), frozenset({(0, 1)}))
    with pytest.raises(WrongUse, match="two junctions"):
        StreetMap(((0.0, 0.0), (1.0, 0.0)), frozenset({(0, 2)}))
    assert math.isinf(route(streets.blocked((0, 1), (0, 2)), 0, 3).length)
