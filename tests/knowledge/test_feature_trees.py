"""Trees are lattices of leaf sets; what is no tree, or no situation, is refused by name."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from random_books import children, is_below, parent, random_forest, random_tree

from gaitwright.errors import WrongUse
from gaitwright.knowledge.forest import Forest, replace_value
from gaitwright.knowledge.memory import Action, applied, remembered
from gaitwright.knowledge.tree_checks import MAX_DEPTH
from gaitwright.knowledge.trees import FeatureTree, interval_tree, tree

TERRAIN = tree("terrain", {"even": ("flat", "slippery"), "slope": ("uphill", "downhill"), "stairs": ()})
SPEED = interval_tree("speed", "m/s", (0.5, 1.0, 2.0), ("slow", "medium", "fast", "very fast"))
seeds = st.integers(0, 2**32 - 1)


def drawn(seed: int) -> tuple[FeatureTree, list[str]]:
    """A random tree and three of its values."""
    rng = np.random.default_rng(seed)
    grown = random_tree(rng, "t", 8)
    return grown, [str(value) for value in rng.choice(grown.values, 3)]


def test_values_stand_in_order_and_know_what_is_above_and_below():
    assert TERRAIN.leaves == ("flat", "slippery", "uphill", "downhill", "stairs")
    assert TERRAIN.path("uphill") == ("any", "slope", "uphill")
    assert parent(TERRAIN, "slope") == "any" and parent(TERRAIN, "any") is None
    assert children(TERRAIN, "any") == ("even", "slope", "stairs")
    assert TERRAIN.leaves_below("slope") == ("uphill", "downhill")
    assert TERRAIN.steps("flat", "uphill") == 4 and TERRAIN.steps("flat", "flat") == 0


@given(seeds)
def test_least_upper_bound_is_one(seed):
    grown, (a, b, c) = drawn(seed)
    bound = grown.least_upper_bound(a, b)
    assert bound == grown.least_upper_bound(b, a)
    assert is_below(grown, a, bound) and is_below(grown, b, bound)
    assert grown.least_upper_bound(a, a) == a
    assert grown.least_upper_bound(bound, c) == grown.least_upper_bound(a, grown.least_upper_bound(b, c))
    for other in grown.values:
        if is_below(grown, a, other) and is_below(grown, b, other):
            assert is_below(grown, bound, other)


@given(seeds)
def test_below_is_the_way_down(seed):
    grown, (a, b, _) = drawn(seed)
    assert grown.is_below(a, b) == is_below(grown, a, b)
    assert grown.is_below(a, b) == (set(grown.leaves_below(a)) <= set(grown.leaves_below(b)))


@given(seeds)
def test_values_below_one_value_exclude_each_other_and_leave_nothing_out(seed):
    grown, _ = drawn(seed)
    for value in grown.values:
        parts = children(grown, value)
        below = [leaf for part in parts for leaf in grown.leaves_below(part)]
        assert not parts or sorted(below) == sorted(grown.leaves_below(value))


@given(st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=8, unique=True), st.floats(allow_nan=False))
def test_every_number_is_in_the_interval_that_says_so(bounds, number):
    grown = interval_tree("length", "m", sorted(bounds))
    leaf = grown.leaves.index(grown.leaf_of(number))
    assert leaf == 0 or sorted(bounds)[leaf - 1] <= number
    assert leaf == len(bounds) or number < sorted(bounds)[leaf]


def test_intervals_are_halved_and_named_by_their_ends():
    assert children(SPEED, "any") == ("slow to medium", "fast to very fast")
    assert SPEED.leaf_of(0.5) == "medium" and SPEED.leaf_of(math.inf) == "very fast"
    chosen = interval_tree("speed", "m/s", (1.0, 2.0), {"calm": ("slow", "medium"), "fast": ()})
    assert chosen.leaves_below("calm") == ("slow", "medium")
    assert interval_tree("d", "m", (1.0, 2.5)).leaves == ("< 1 m", "1 … 2.5 m", "≥ 2.5 m")


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: tree("t", ("a", "b", "a")), "'a' twice"),
        (lambda: tree("t", ("any", "b")), "'any' twice"),
        (lambda: tree("t", {"a": ("b",), "c": ()}), "'b' is the only value below 'a'"),
        (lambda: tree("t", ()), "2 to 512"),
        (lambda: tree("t", {"a": {"b", "c"}, "d": ()}), "in order, as dicts and tuples"),
        (lambda: tree("t", ("a", "\n")), "no label"),
        (lambda: tree("t", ("a", "b" * 201)), "no label"),
        (lambda: tree("t", tuple(f"v{k}" for k in range(600))), "2 to 512"),
        (lambda: tree("t", _deep(MAX_DEPTH + 1)), f"deeper than {MAX_DEPTH}"),
        (lambda: FeatureTree("t", ("any", "a", "b"), (-1, 2, 1)), "hangs below place 2"),
        (lambda: interval_tree("t", "m", (2.0, 1.0)), "ascending"),
        (lambda: interval_tree("t", "m", (1.0, math.nan)), "finite"),
        (lambda: interval_tree("t", "m", (1.0,), ("a", "b", "c")), "2 intervals, got 3 labels"),
        (lambda: SPEED.leaf_of(math.nan), "speed is not a number"),
        (lambda: TERRAIN.leaf_of(1.0), "names, not intervals"),
        (lambda: TERRAIN.is_below("flt", "any"), "did you mean 'flat'"),
        (lambda: Forest((SPEED, SPEED)), "two trees named 'speed'"),
        (lambda: Forest(()), "1 to 64 trees"),
        (lambda: Forest((SPEED,))["sped"], "did you mean 'speed'"),
    ],
)
def test_what_is_no_tree_is_refused(make, message):
    with pytest.raises(WrongUse, match=message):
        make()


def _deep(depth: int) -> dict:
    """A shape with one value below the other."""
    return {f"a{depth}": _deep(depth - 1) if depth else (), f"b{depth}": ()}


def test_a_situation_has_one_leaf_per_tree():
    forest = Forest((TERRAIN, SPEED))
    situation = forest.situation({"terrain": "flat", "speed": 1.5})
    assert situation["speed"] == "fast" and situation["terrain"] == "flat"
    assert forest.at(forest.leaf_places(situation)) == situation
    assert replace_value(forest, situation, "speed", 0.0)["speed"] == "slow"
    facts = {"terrain": "stairs", "speed": 3.0, "weather": "fine"}
    assert forest.read({}, facts).values == ("stairs", "very fast")
    assert forest.read({"terrain": "flat"}, {"terrain": "stairs"}).values == ("flat", None)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"terrain": "flat"}, "missing: speed"),
        ({"terrain": "even", "speed": 1.0}, "still leaves open: flat, slippery"),
        ({"terrain": "mud", "speed": 1.0}, "no value of terrain 'mud'; there is: flat"),
        ({"terain": "flat", "speed": 1.0}, "did you mean 'terrain'"),
        ({"terrain": "flat", "speed": math.nan}, "not a number"),
    ],
)
def test_what_is_no_situation_is_refused(values, message):
    with pytest.raises(WrongUse, match=message):
        Forest((TERRAIN, SPEED)).situation(values)


def test_random_forests_differ():
    rng = np.random.default_rng(1)
    assert len({random_forest(rng, 3) for _ in range(20)}) > 15


def test_actions_edit_memory_deletions_first():
    memory = remembered({"at": "A", "load": 2.0})
    action = Action("walk", 0.2, 0.6, until="at B", adds=(("at", "B"),), deletes=("at", "load"))
    assert dict(applied(action, memory)) == {"at": "B"}
    assert dict(memory) == {"at": "A", "load": 2.0}
    with pytest.raises(WrongUse, match="no range"):
        Action("walk", 1.0, 0.5)
    with pytest.raises(WrongUse, match="no range"):
        Action("walk", 0.0, math.inf)
