"""Forests, situations and rulebooks drawn by chance."""

import numpy as np

from gaitwright.knowledge.forest import Forest, Situation
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.rules import Instance, Marks, Rule, Rulebook
from gaitwright.knowledge.trees import FeatureTree, interval_tree, tree


def random_tree(rng: np.random.Generator, name: str, most: int = 6) -> FeatureTree:
    """A tree of 2 to `most` leaves, of names in random groups or of intervals."""
    count = int(rng.integers(2, most + 1))
    if rng.random() < 0.3:
        return interval_tree(name, "m", np.arange(1.0, count).tolist())
    return tree(name, _random_shape(rng, [f"{name}{k}" for k in range(count)]))


def _random_shape(rng: np.random.Generator, row: list[str]) -> list:
    """Neighbours of a row put under values of their own, now and then."""
    if len(row) <= 2 or rng.random() < 0.3:
        return row
    cut = int(rng.integers(1, len(row)))
    parts = [part for part in (row[:cut], row[cut:]) if part]
    return [part[0] if len(part) == 1 else {"+".join(part): _random_shape(rng, part)} for part in parts]


def parent(tree: FeatureTree, value: str) -> str | None:
    """The value it hangs below; `None` for the root."""
    return (None, *tree.path(value))[-2]


def children(tree: FeatureTree, value: str) -> tuple[str, ...]:
    """The values directly below one."""
    return tuple(below for below in tree.values if parent(tree, below) == value)


def random_forest(rng: np.random.Generator, trees: int, most: int = 6) -> Forest:
    return Forest(tuple(random_tree(rng, "abcdefghijklmnop"[k], most) for k in range(trees)))


def random_situation(rng: np.random.Generator, forest: Forest) -> Situation:
    draws = rng.random(len(forest.trees)).tolist()
    values = [t.leaves[int(len(t.leaves) * draw)] for t, draw in zip(forest.trees, draws, strict=True)]
    return Situation(forest.names, tuple(values))


def random_book(rng: np.random.Generator, forest: Forest, rules: int, widest: float = 0.6) -> Rulebook:
    """Rules with marks anywhere (lower below upper); `widest` is the share of upper marks left at the
    root."""
    return Rulebook(forest, tuple(_random_rule(rng, forest, f"rule {k}", widest) for k in range(rules)))


def _random_rule(rng: np.random.Generator, forest: Forest, name: str, widest: float) -> Rule:
    seen = random_situation(rng, forest)
    marks = []
    for grown, leaf in zip(forest.trees, seen.values, strict=True):
        path = grown.path(str(leaf))
        upper = 0 if rng.random() < widest else int(rng.integers(0, len(path)))
        lower = int(rng.integers(upper, len(path)))
        marks.append(Marks(grown.name, path[upper], path[lower]))
    positive = Instance("seen", "positive", seen)
    empty = rng.random() < 0.1
    proposed = bool(rng.random() < 0.1)
    return Rule(name, Action(name), tuple(marks), () if empty else (positive,), proposed=proposed)


_paths: dict[int, tuple[FeatureTree, dict[str, frozenset[str]]]] = {}


def is_below(grown: FeatureTree, value: str, mark: str) -> bool:
    """Whether a value is below a mark, from the ways down to the values alone."""
    if id(grown) not in _paths:
        _paths[id(grown)] = grown, {value: frozenset(grown.path(value)) for value in grown.values}
    return mark in _paths[id(grown)][1][value]
