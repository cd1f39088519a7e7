"""The situation space: an ordered forest of feature trees, and situations as one leaf per tree (§5.4.2.1)."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from gaitwright.errors import WrongUse, unknown
from gaitwright.knowledge.memory import Fact
from gaitwright.knowledge.trees import FeatureTree

MAX_TREES = 64
OTHER = "other"
"""The leaf, in a tree made of names met so far, for those that nobody has met yet."""


@dataclass(frozen=True, slots=True)
class Situation:
    """One leaf per tree of a forest, in its order; `None` where an old instance noted none."""

    trees: tuple[str, ...]
    values: tuple[str | None, ...]

    def __getitem__(self, tree: str) -> str | None:
        if tree not in self.trees:
            raise unknown("tree", tree, self.trees)
        return self.values[self.trees.index(tree)]

    def items(self) -> Iterator[tuple[str, str | None]]:
        return zip(self.trees, self.values, strict=True)


@dataclass(frozen=True, slots=True)
class Forest:
    """The features in which situations differ, in order."""

    trees: tuple[FeatureTree, ...]
    names: tuple[str, ...] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        """Raises `WrongUse` for trees of the same name, for none, or for more than `MAX_TREES`."""
        names = tuple(tree.name for tree in self.trees)
        if not 1 <= len(names) <= MAX_TREES:
            raise WrongUse(f"a forest has 1 to {MAX_TREES} trees, got {len(names)}")
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise WrongUse(f"the forest has two trees named {twice[0]!r}")
        object.__setattr__(self, "names", names)

    def __getitem__(self, name: str) -> FeatureTree:
        """The tree of that name. Raises `WrongUse` naming the trees there are."""
        if name not in self.names:
            raise unknown("tree", name, self.names)
        return self.trees[self.names.index(name)]

    def situation(self, values: Mapping[str, str | float]) -> Situation:
        """A leaf for every tree, from leaves or, for interval trees, numbers.

        Raises `WrongUse` for a tree or value that does not exist, one that is no leaf, or a tree left out.
        """
        for name in values:
            if name not in self.names:
                raise unknown("tree", name, self.names)
        missing = [name for name in self.names if name not in values]
        if missing:
            raise WrongUse(f"a situation has a value in every tree; missing: {', '.join(missing)}")
        return Situation(self.names, tuple(_leaf(tree, values[tree.name]) for tree in self.trees))

    def read(self, known: Mapping[str, str | None], facts: Mapping[str, Fact]) -> Situation:
        """The situation of known leaves; trees that these leave out are read from facts, and are open where
        no fact tells. What no tree asks for is left aside (C, step b)."""
        values = (known[tree.name] if tree.name in known else leaf_in(tree, facts) for tree in self.trees)
        return Situation(self.names, tuple(values))

    def leaf_places(self, situation: Situation) -> tuple[int, ...]:
        """The place of each leaf among its tree's leaves, as compiled decisions take it.

        Raises `WrongUse` where the situation is of another forest or leaves a value open.
        """
        if situation.trees != self.names:
            raise WrongUse(f"a situation in {', '.join(situation.trees)} is none in {', '.join(self.names)}")
        return tuple(
            tree.leaf_place[_leaf(tree, value if value is not None else "")]
            for tree, value in zip(self.trees, situation.values, strict=True)
        )

    def at(self, places: tuple[int, ...]) -> Situation:
        """The situation of leaves given by their places."""
        return Situation(
            self.names, tuple(tree.leaves[k] for tree, k in zip(self.trees, places, strict=True))
        )


def replace_value(forest: Forest, situation: Situation, tree: str, value: str | float) -> Situation:
    """The situation with another value in one tree."""
    place = forest.names.index(forest[tree].name)
    values = list(situation.values)
    values[place] = _leaf(forest.trees[place], value)
    return Situation(situation.trees, tuple(values))


def leaf_in(tree: FeatureTree, facts: Mapping[str, Fact]) -> str | None:
    """The leaf that the fact which a tree is read from falls into; `None` where it was not measured, or is
    none that the tree could place."""
    fact = facts.get(tree.source or tree.name)
    if tree.bounds:
        return None if fact is None or isinstance(fact, str) or math.isnan(fact) else tree.leaf_of(fact)
    if fact is None or (isinstance(fact, str) and tree.is_leaf(fact)):
        return fact
    return OTHER if OTHER in tree.leaf_place else None


def _leaf(tree: FeatureTree, value: str | float) -> str:
    """A leaf of the tree, from its name or a number. Raises `WrongUse` naming the leaves there are."""
    if not isinstance(value, str):
        return tree.leaf_of(float(value))
    if value in tree.leaf_place:
        return value
    if value in tree.place:
        below = ", ".join(tree.leaves_below(value))
        raise WrongUse(f"{tree.name} is {value!r}, which still leaves open: {below}")
    raise unknown(f"value of {tree.name}", value, tree.leaves)
