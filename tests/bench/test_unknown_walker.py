"""The disc that walks in unknown worlds, and how its trips are counted."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from unknown_by_hand import boxes_by_lot, free_places, made

from gaitwright.bench.claims import worlds
from gaitwright.bench.context import Context
from gaitwright.bench.measurement import at_most
from gaitwright.bench.unknown_worlds import contestants, standings, walker
from gaitwright.bench.unknown_worlds.baselines import AStar, GridWay
from gaitwright.bench.unknown_worlds.body import advance
from gaitwright.bench.unknown_worlds.contestants import (
    ANY_ANGLE,
    BASELINES,
    LEARNED,
    THESIS,
    planner,
)
from gaitwright.bench.unknown_worlds.drawn import world
from gaitwright.bench.unknown_worlds.eyes import Camera
from gaitwright.bench.unknown_worlds.optimum import Optimum
from gaitwright.bench.unknown_worlds.tours import Asked, Found, toured
from gaitwright.bench.unknown_worlds.walker import (
    ARRIVED,
    LOST,
    MOST_CONTACTS,
    NONE,
    RATE,
    SPEED,
    STEP,
    TURN,
    Planner,
    Trip,
    Walker,
)
from gaitwright.bench.unknown_worlds.world import RADIUS, TOUCH, Point, World
from gaitwright.signals import Sight
from gaitwright.workers import Workers


@dataclass(frozen=True)
class Blind:
    """Goes straight on whatever it sees, and after each touch aside by lot."""

    touches: int = 0

    def seen(self, sight: Sight) -> "Blind":
        return self

    def felt(self, place: Point, direction: float) -> "Blind":
        return replace(self, touches=self.touches + 1)

    def walked(self, way: np.ndarray) -> "Blind":
        return self

    def is_cut(self, path: np.ndarray) -> bool:
        return False

    def way(self, start: Point, goal: Point, facing: float) -> GridWay:
        angle = np.random.default_rng(self.touches).uniform(0.0, 2.0 * math.pi) if self.touches else 0.0
        aside = (start[0] + 3.0 * math.cos(angle), start[1] + 3.0 * math.sin(angle))
        path = np.array([aside, goal] if self.touches % 2 else [goal])
        return GridWay(path, 1.0, 0)


# --- the body --------------------------------------------------------------------------------------
@given(st.integers(0, 10_000), st.floats(-3.2, 3.2))
def test_a_step_ends_where_the_disc_touches(seed: int, toward: float) -> None:
    one, room = made(boxes_by_lot(seed, 25)), RADIUS - TOUCH
    ((x, y),) = free_places(one, seed, 1, RADIUS)
    free = advance(one.edges, x, y, toward, 4.0, room)
    ahead = np.array([math.cos(toward), math.sin(toward)])
    ways = [
        shapely.LineString([(x, y), np.array([x, y]) + max(f, 1e-9) * ahead]) for f in (free, free + 1e-5)
    ]
    near, nearer = shapely.distance(ways, one.solid)
    assert near >= room - 1e-9
    assert free == 4.0 or nearer < room


def test_a_disc_that_touches_may_leave_but_not_go_on() -> None:
    edges = np.array([[1.0, -1.0, 1.0, 1.0]])
    at = 1.0 - RADIUS + TOUCH / 2.0
    for toward, free in ((0.0, 0.0), (0.5, 0.0), (math.pi, 0.3), (math.pi / 2.0, 0.3)):
        assert advance(edges, at, 0.0, toward, 0.3, RADIUS) == free


@pytest.mark.parametrize("seed", range(4))
def test_whatever_its_planner_wants_the_disc_never_enters_an_obstacle(seed: int) -> None:
    one = made(boxes_by_lot(seed, 40))
    wanderer = Walker(replace(one, start=free_places(one, seed, 1, 0.3)[0]), Blind(), Camera())
    trip = wanderer.trip((19.9, 19.9))  # in the wall
    assert trip.end == LOST and trip.contacts > MOST_CONTACTS
    assert shapely.distance(shapely.LineString(trip.way), one.solid) >= RADIUS - TOUCH - 1e-9
    assert trip.nearest >= RADIUS - TOUCH - 1e-9


@dataclass(frozen=True)
class Stuck(Blind):
    """Wants to be where it is."""

    def way(self, start: Point, goal: Point, facing: float) -> GridWay:
        return GridWay(np.array([start]), 0.0, 0)


def test_a_trip_without_an_end_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(walker, "MOST_PLANS", 50)
    one = made([])
    assert Walker(one, Stuck(), Camera()).trip(one.goal).end == LOST
    monkeypatch.setattr(walker, "FARTHEST", 5.0)
    far = Walker(one, Blind(), Camera()).trip(one.goal)
    assert far.end == LOST and far.metres < 5.0 + 2.0 * STEP


@pytest.mark.parametrize("planner", [AStar, BASELINES["any-angle A*"]])
def test_what_a_trip_costs_is_what_it_went(planner: type[AStar]) -> None:
    one = world(0, 14)
    trip = Walker(one, planner(), Camera()).trip(one.goal)
    steps = np.diff(trip.way, axis=0)
    lengths = np.hypot(*steps.T)
    assert trip.end == ARRIVED and tuple(trip.way[0]) == one.start and tuple(trip.way[-1]) == one.goal
    assert trip.metres == pytest.approx(lengths.sum()) and lengths.max() <= STEP + 1e-9
    turns = np.abs(np.diff(np.unwrap(np.arctan2(*steps.T[::-1])))).sum()
    assert trip.seconds >= trip.metres / SPEED + turns / RATE - 1e-6
    assert trip.looks >= trip.metres / STEP + turns / TURN
    assert shapely.distance(shapely.LineString(trip.way), one.solid) >= RADIUS - TOUCH - 1e-9


def test_the_same_trip_twice_is_the_same() -> None:
    one = world(0, 10)
    trips = [Walker(one, AStar(), Camera(), blur=3, body=0.13).trip(one.goal) for _ in range(2)]
    np.testing.assert_array_equal(trips[0].way, trips[1].way)


def test_a_map_that_is_kept_makes_the_way_shorter() -> None:
    trap = [
        shapely.box(9.0, 5.0, 12.0, 5.3),
        shapely.box(9.0, 14.7, 12.0, 15.0),
        shapely.box(11.7, 5.0, 12.0, 15.0),
    ]
    one = made(trap)
    disc = Walker(one, AStar(), Camera())
    first, _, third = (disc.trip(goal) for goal in (one.goal, one.start, one.goal))
    assert third.metres < 0.9 * first.metres


def test_every_contestant_is_a_planner() -> None:
    assert all(isinstance(planner(name), Planner) for name in (LEARNED, THESIS, *BASELINES))


# --- counting --------------------------------------------------------------------------------------
def trip(end: str = ARRIVED, metres: float = 10.0) -> Trip:
    """A trip by hand."""
    return Trip(end, metres, 2.0 * metres, np.empty((0, 2)), (1.0, 0.5), 1.0, 10, 0, 5, metres, 0.0, 0.2)


def found(truth: str, *trips: Trip, name: str = "forest 1") -> Found:
    """What became of a world, by hand."""
    tours = {"ours": trips, "other": tuple(trip(one.end, 10.0) for one in trips)}
    return Found(name, "forest", "open", None, truth, Optimum(8.0, 8.1), tours)


@pytest.mark.parametrize(
    ("truth", "ends", "right"),
    [
        ("way", [ARRIVED] * 5, True),
        ("way", [ARRIVED, NONE], False),
        ("way", [NONE], False),
        ("way", [ARRIVED, LOST], False),
        ("none", [NONE], True),
        ("none", [LOST], False),
        ("none", [ARRIVED] * 5, False),
        ("either", [NONE], True),
        ("either", [ARRIVED] * 5, True),
        ("either", [ARRIVED, NONE], False),
        ("either", [LOST], False),
    ],
)
def test_an_answer_is_right_or_wrong(truth: str, ends: list[str], right: bool) -> None:
    one = found(truth, *map(trip, ends))
    assert one.is_right("ours") is right
    assert standings.wrong_answers([one], "ours", at_most(0.0)).reached is right


def test_sums_are_over_worlds_in_which_all_arrived() -> None:
    trips = (trip(metres=9.0), trip(metres=7.0), trip(NONE, 1.0))
    all_of_it = [found("way", one, name=f"forest {k}") for k, one in enumerate(trips)]
    figure = standings.saved(all_of_it, ("ours", "other"), ("ours", "other"), standings.metres, -5.0)
    assert (figure.measured, figure.starts, figure.reached) == (pytest.approx(-20.0), 2, True)
    low, high = figure.numbers["interval"]
    assert low == pytest.approx(-30.0) and high == pytest.approx(-10.0)
    near = standings.near_optimum(all_of_it, "ours", 0, 0.5)
    assert (near.measured, near.starts, near.reached) == (1, 3, False)
    assert standings.mean_travel(all_of_it, "ours", 0, None).measured == pytest.approx(1.0)


@pytest.fixture
def context(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Context]:
    """A bench of three worlds in this process: one with a gap, and two open ones."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(worlds, "numbers", lambda context: (2, 10, 12))
    with Context(Workers(1), quick=True) as context:
        monkeypatch.setattr(context, "each", lambda what, task, given: [task(one) for one in given])
        yield context


def test_a_planner_in_place_of_the_learned_map_is_judged(
    context: Context, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Any-angle A* itself: not above any-angle A*, but no better either."""
    for name in (LEARNED, THESIS):
        monkeypatch.setitem(contestants.BASELINES, name, BASELINES[ANY_ANGLE])
    monkeypatch.setattr(
        worlds, "BASELINES", {name: make for name, make in BASELINES.items() if name != LEARNED}
    )
    monkeypatch.setattr(worlds, "drawn", lambda context, everyone: worlds.standings.certainty([]))
    figures = {figure.what: figure for figure in worlds.measure(context)}
    even = figures["learned map: first trip, seconds against any-angle A*"]
    assert even.measured == 0.0 and even.reached is False
    assert figures["learned map: first trip, metres against any-angle A*"].reached is True
    assert figures["learned map: first trip, metres against A*"].measured < 0.0
    assert figures["learned map: walked way taken over optimistic, most"].measured == 0.0
    assert figures["learned map: promised at the start over optimum, most"].measured >= 1.0 - 1e-3
    assert figures["optimum: bounds apart, most"].measured_text
    assert sum("a quarter moved" in what for what in figures) == 2


def test_after_things_moved_the_truth_is_asked_again() -> None:
    asked = Asked(0, 10, ("A*",), trips=3, moves_after=2)
    one = toured(asked)
    assert one.later in {"way", "none", "either"} and len(one.tours["A*"]) == 3
    assert toured(asked).tours["A*"][2].metres == one.tours["A*"][2].metres
    assert isinstance(world(0, 10), World)
