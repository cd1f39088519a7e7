"""Learned maps in skillbooks: nothing is lost on the way there and back, and trips get shorter."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, Point

from gaitwright.errors import WrongUse
from gaitwright.learning import map_books
from gaitwright.learning.map_books import (
    free_ground,
    joined,
    known,
    learned_map_of,
    length_of,
    map_in,
    maps_of_both,
    notes_of,
    with_trip,
)
from gaitwright.learning.merging import merge
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.navigation.tolerances import WORTH
from gaitwright.record.channels import columns_of
from gaitwright.record.recording import Recording
from gaitwright.skillbook import Skillbook, content_hash, export_text, import_text, open_for_learning
from navigation.plane_world import RADIUS, box_at, fence_edges, random_polygons, ring_edges, walk
from robots_by_hand import dog
from skillbook.places import map_notes, some_maps
from skillbook.schooling import begun

BOUNDS = (0.0, 0.0, 6.0, 6.0)
START, GOAL = (0.6, 0.6), (5.4, 5.4)
NARROW, NEAR = math.radians(90.0), 1.5
TRAP = [box_at(3.8, 3.0, 0.1, 3.0), box_at(2.6, 4.4, 2.4, 0.1), box_at(2.6, 1.6, 2.4, 0.1)]
"""A bay that is open to the left, deeper than the eye reaches."""
THERE, BEHIND = (0.6, 3.0), (5.4, 3.1)


def walled(polygons) -> np.ndarray:
    return np.vstack([ring_edges(polygons), fence_edges(BOUNDS)])


def empty(**given) -> LearnedMap:
    return LearnedMap.of(BOUNDS, RADIUS, **given)


def walked_map(seed: int, noise: float = 0.0) -> LearnedMap:
    """What is known after a trip through a random world, and after something was felt."""
    rng = np.random.default_rng(seed)
    edges = walled(random_polygons(rng, int(rng.integers(2, 8)), BOUNDS, (0.2, 0.9), (START, GOAL)))
    strategy = "optimistic" if seed % 2 else "thesis"
    trip = walk(edges, empty(strategy=strategy, noise=noise), START, GOAL, NARROW)
    return trip.learned.felt((1.0, 4.0), float(rng.uniform(0.0, 6.0)))


def same(a: LearnedMap, b: LearnedMap) -> bool:
    """Whether two maps are equal to the bit."""
    plain = [(m.bounds, m.radius, m.strategy, m.noise, m.trips, m.raster.cells.shape) for m in (a, b)]
    numbers = [(m.rows.tobytes(), m.raster.cells.tobytes(), m.raster.place.tobytes()) for m in (a, b)]
    return plain[0] == plain[1] and numbers[0] == numbers[1]


# --- there and back ---------------------------------------------------------------------------------
@given(seed=st.integers(0, 10_000))
@settings(max_examples=4)
def test_a_map_and_its_ways_are_the_same_to_the_bit_after_a_file_and_a_text(seed, tmp_path_factory):
    learned = walked_map(seed, noise=0.01 * (seed % 3))
    path = begun().save(tmp_path_factory.mktemp("books") / "a.skills")
    with open_for_learning(path) as ledger:
        ledger.keep_map(notes_of(learned, "here (seed 0)"))
    (notes,) = Skillbook.load(path).maps
    (again,) = import_text(export_text(Skillbook.load(path))).maps
    assert notes == again and same(learned_map_of(notes), replace(learned, trail=()))
    for goal in (GOAL, (3.0, 0.5), (0.5, 5.5)):
        assert learned_map_of(notes).way(START, goal) == replace(learned, trail=()).way(START, goal)


def test_an_empty_map_is_one_too():
    assert same(learned_map_of(notes_of(empty(), "nowhere")), empty())


def test_free_ground_in_cells_of_another_size_is_forgotten_and_nothing_else():
    learned = walked_map(5)
    notes = notes_of(learned, "here")
    for other in (replace_notes(notes, cell=0.25), replace_notes(notes, shape=(1, 8 * len(notes.free)))):
        older = learned_map_of(other)
        assert not older.raster.cells.any() and same(replace(older, raster=learned.raster), learned)
    assert learned_map_of(replace_notes(notes, strategy="of tomorrow")).strategy == "optimistic"


def replace_notes(notes, **changed):
    return type(notes)(**{name: getattr(notes, name) for name in notes.__struct_fields__} | changed)


def test_only_the_newest_ways_are_kept(monkeypatch):
    monkeypatch.setattr(map_books, "MOST_POINTS", 7)
    ways = tuple(((0.5, 0.5), (1.0, 0.1 * k), (2.0, 2.0)) for k in range(4))
    learned = replace(empty(), trips=ways)
    assert learned_map_of(notes_of(learned, "here")).trips == ways[-2:]
    monkeypatch.setattr(map_books, "MOST_POINTS", 2)
    assert learned_map_of(notes_of(learned, "here")).trips == ()


# --- four trips -------------------------------------------------------------------------------------
@pytest.mark.parametrize("strategy", ["optimistic", "thesis"])
def test_four_trips_with_one_book_get_no_longer_and_out_of_a_trap_much_shorter(strategy, tmp_path):
    """Each trip begins with what the book holds and nothing else."""
    path, lengths = begun().save(tmp_path / "a.skills"), []
    for _ in range(4):
        with open_for_learning(path) as ledger:
            before = map_in(ledger.book, "trap", empty(strategy=strategy)) or empty(strategy=strategy)
            trip = walk(walled(TRAP), before, THERE, BEHIND, NARROW, NEAR)
            assert trip.arrived
            ledger.keep_map(notes_of(trip.learned, "trap"))
        lengths.append(trip.length)
    assert all(later <= sooner + 1e-6 for sooner, later in pairwise(lengths))
    assert lengths[-1] < 0.8 * lengths[0]
    (notes,) = Skillbook.load(path).maps
    assert len(notes.ways) == 4 and [round(length_of(w), 6) for w in learned_map_of(notes).trips] == [
        round(length, 6) for length in lengths
    ]


def test_another_robot_walks_by_the_same_pieces_with_its_own_disc():
    wall = [box_at(3.0, 1.0, 0.1, 4.0), box_at(3.0, 4.9, 0.1, 3.1)]
    learned = walk(walled(wall), empty(noise=0.02), (0.6, 3.2), (5.4, 3.2), math.tau).learned
    book = replace(begun(), maps=(notes_of(learned, "a gate"),))
    thin, wide = (map_in(book, "a gate", LearnedMap.of(BOUNDS, r, "thesis", 0.01)) for r in (0.1, 0.4))
    for other, radius in ((thin, 0.1), (wide, 0.4)):
        assert (other.radius, other.strategy, other.noise) == (radius, "thesis", 0.02)
        assert np.array_equal(other.rows, learned.rows) and other.trips == learned.trips
    gate = ((2.0, 3.2), (4.0, 3.2))
    assert thin.way(*gate).length == pytest.approx(2.0, abs=0.1)
    through = wide.way(*gate)
    assert through is None or through.length > 3.0, "its gate is 0.35 m wide"


def test_a_map_of_another_field_or_place_is_not_taken():
    book = replace(begun(), maps=(notes_of(walked_map(1), "here"),))
    assert map_in(book, "there", empty()) is None
    with pytest.raises(WrongUse, match="the map of here is of the field"):
        map_in(book, "here", LearnedMap.of((0.0, 0.0, 6.0, 7.0), RADIUS))


# --- the way that was walked ------------------------------------------------------------------------
@given(st.integers(0, 10_000), st.booleans())
@settings(max_examples=5)
def test_a_trip_is_kept_to_two_centimetres_until_it_leaves_the_field(seed, leaves):
    rng = np.random.default_rng(seed)
    steps = rng.normal((0.0008, 0.0006), 0.002, (4000, 2))
    places = np.array(START) + np.cumsum(steps, axis=0)
    if leaves:
        places[3000:] += 10.0
    learned = with_trip(empty(), recorded(places))
    (way,) = learned.trips
    seen = places[: 3000 if leaves else None : 25]
    assert max(LineString(way).distance(Point(place)) for place in seen) <= 0.0201
    assert way[0] == tuple(places[0]) and len(way) < len(seen)


def test_a_robot_that_stood_still_made_no_trip():
    places = np.array(START) + np.random.default_rng(1).normal(0.0, 0.002, (3000, 2))
    assert with_trip(empty(), recorded(places)).trips == ()
    assert with_trip(empty(), recorded(places[:1])).trips == ()


def recorded(places: np.ndarray) -> Recording:
    """A recording of a robot that was there."""
    robot = dog()
    columns = columns_of(robot.n)
    data = np.zeros((len(places), max(place.stop for place in columns.values())))
    data[:, columns["position_w"].start : columns["position_w"].start + 2] = places
    data[:, columns["orientation_wb"].start] = 1.0
    return Recording(robot, "a field", 0, 0.002, ("trot",), ("numerical",), data, False, False, "over")


# --- two books --------------------------------------------------------------------------------------
def test_of_two_books_the_joined_one_knows_what_either_does_and_only_once():
    worlds = walled(TRAP)
    first = walk(worlds, empty(), THERE, BEHIND, NARROW, NEAR).learned
    second = walk(worlds, empty(), (5.4, 5.4), THERE, NARROW, NEAR).learned
    ours = replace(begun(1), maps=(map_notes("only ours"), notes_of(first, "trap")))
    theirs = replace(begun(2), maps=(map_notes("only theirs"), notes_of(second, "trap")))
    both = merge(ours, theirs).book
    assert [notes.place for notes in both.maps] == ["only ours", "only theirs", "trap"]
    learned = learned_map_of(both.maps[2])
    assert set(learned.trips) == {*first.trips, *second.trips}
    assert free_ground(learned) >= max(free_ground(first), free_ground(second))
    one_way = learned.way(THERE, BEHIND)
    assert one_way.is_walked and one_way.length <= WORTH * one_way.optimistic
    assert (both.ancestors[-1].how, both.ancestors[-1].digest) == ("merged", content_hash(theirs))
    assert merge(both, theirs).book == both and merge(both, ours).book.maps == both.maps
    assert merge(ours, ours).book == ours
    assert import_text(export_text(both)) == both


def test_a_map_of_another_field_of_that_name_stays_theirs():
    ours = notes_of(walked_map(3), "here")
    theirs = notes_of(LearnedMap.of((0.0, 0.0, 7.0, 6.0), RADIUS), "here")
    assert joined(ours, theirs) is ours
    assert maps_of_both([ours], [theirs, *some_maps()]) == tuple(
        sorted([ours, *some_maps()], key=lambda notes: notes.place)
    )


def test_it_is_said_how_much_is_known():
    assert known(empty()) == "0 trips, 0 pieces, 0 m² free"
    assert known(empty().walked([(1.0, 1.0), (3.0, 1.0)]).felt((1.0, 3.0), 0.0)).startswith(
        "1 trip, 2 pieces"
    )
