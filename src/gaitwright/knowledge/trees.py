"""Feature trees: the values of one feature, from "any" down to leaves that exclude each other (§5.4.2.1).

The values below a value exclude each other and leave nothing out, so a value *is* the set of the leaves
below it. That set is kept as the bits of one int: below and least upper bound are set algebra.
No value stands alone below another, so no two values of a tree mean the same leaves. Where a rule needs
leaves that have no value of their own, a mark names them: "A to B" is a run of neighbouring intervals,
"A or B" any leaves.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

from gaitwright.errors import WrongUse, unknown
from gaitwright.knowledge.tree_checks import (
    MAX_LEAVES,
    ROOT,
    check_labels,
    check_leaves,
    check_parents,
)

RUN, OR = " to ", " or "
"""Between the ends of a run of intervals, and between leaves, in the name of a mark that is no value."""

Shape = Mapping[str, Any] | Sequence[Any]
"""Nested values in order: a mapping of values to the shapes below them, or a row of leaves and mappings."""


@dataclass(frozen=True, slots=True)
class FeatureTree:
    """One feature: `values` in order, `parents` the place each hangs below (−1 for the root).

    Values stand in order, each branch to its end before the next.
    `about` is how a sentence on it begins ("the ground is"). With `bounds` the leaves are half-open
    intervals [bounds[k−1], bounds[k]) of a number in `unit`, in ascending order, open at both ends.
    `source` is the fact that the feature is read from, where it is not named as the tree is.
    """

    name: str
    values: tuple[str, ...]
    parents: tuple[int, ...]
    about: str = ""
    unit: str = ""
    bounds: tuple[float, ...] = ()
    source: str = ""
    place: dict[str, int] = field(init=False, repr=False, compare=False)
    sets: tuple[int, ...] = field(init=False, repr=False, compare=False)
    leaves: tuple[str, ...] = field(init=False, repr=False, compare=False)
    leaf_place: dict[str, int] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        """Derives the leaf sets. Raises `WrongUse` where this is no tree of exclusive values."""
        check_labels(self)
        check_parents(self)
        sets, leaves = _leaf_sets(self.values, self.parents)
        check_leaves(self, leaves)
        derive = object.__setattr__
        derive(self, "place", {value: k for k, value in enumerate(self.values)})
        derive(self, "sets", sets)
        derive(self, "leaves", leaves)
        derive(self, "leaf_place", {leaf: k for k, leaf in enumerate(leaves)})

    def at(self, value: str) -> int:
        """The place of a value. Raises `WrongUse` naming the values there are."""
        try:
            return self.place[value]
        except KeyError:
            raise unknown(f"value of {self.name}", value, self.values) from None

    def leaf_set(self, mark: str) -> int:
        """The leaves that a value, a run of intervals or a few leaves stand for, as bits. Raises `WrongUse`
        naming the values there are."""
        if mark in self.place:
            return self.sets[self.place[mark]]
        if self.bounds:
            for first, last in _parted(mark, RUN):
                low, high = self.leaf_place.get(first, 1), self.leaf_place.get(last, 0)
                if low <= high:
                    return (1 << high + 1) - (1 << low)
        several = mark.split(OR)
        if set(several) <= self.leaf_place.keys():
            return self.set_of(several)
        return self.sets[self.at(mark)]

    def label_of(self, bits: int) -> str:
        """What leaves are called: by their own value, as a run of intervals, or one by one."""
        if bits in self.sets:
            return self.values[self.sets.index(bits)]
        leaves = [leaf for k, leaf in enumerate(self.leaves) if bits >> k & 1]
        in_a_row = bits.bit_length() - (bits & -bits).bit_length() + 1 == len(leaves)
        return run_label(leaves) if self.bounds and in_a_row else OR.join(leaves)

    def is_leaf(self, value: str) -> bool:
        return value in self.leaf_place

    def path(self, value: str) -> tuple[str, ...]:
        """From the root down to the value, both included."""
        steps, here = [], self.at(value)
        while here >= 0:
            steps.append(self.values[here])
            here = self.parents[here]
        return tuple(reversed(steps))

    def is_below(self, value: str, mark: str) -> bool:
        """Whether the value is in the subtree that the mark dominates, the mark itself included."""
        return not self.leaf_set(value) & ~self.leaf_set(mark)

    def least_upper_bound(self, a: str, b: str) -> str:
        """The lowest value that both are below."""
        here, wanted = self.at(a), self.sets[self.at(b)]
        while wanted & ~self.sets[here]:
            here = self.parents[here]
        return self.values[here]

    def steps(self, a: str, b: str) -> int:
        """How many branches the way from a to b has: how unlike two values are."""
        shared = len(self.path(self.least_upper_bound(a, b)))
        return len(self.path(a)) + len(self.path(b)) - 2 * shared

    def leaves_below(self, value: str) -> tuple[str, ...]:
        bits = self.leaf_set(value)
        return tuple(leaf for k, leaf in enumerate(self.leaves) if bits >> k & 1)

    def leaf_of(self, number: float) -> str:
        """The interval that holds a number in `unit`. Raises `WrongUse` for NaN or where leaves are no
        intervals."""
        if not self.bounds:
            raise WrongUse(
                f"tree {self.name} has names, not intervals: {', '.join(self.leaves)}; got {number}"
            )
        if math.isnan(number):
            raise WrongUse(f"{self.name} is not a number [{self.unit}]: no interval holds it")
        return self.leaves[sum(number >= bound for bound in self.bounds)]

    def set_of(self, values: Sequence[str]) -> int:
        """The leaves below any of the values, as bits."""
        bits = 0
        for value in values:
            bits |= self.sets[self.at(value)]
        return bits


def tree(name: str, shape: Shape, about: str = "") -> FeatureTree:
    """A tree from nested values in order: `{"even": ("flat", "slippery"), "stairs": ()}`; a bare str is a
    leaf."""
    values, parents = [ROOT], [-1]
    _hang(name, shape, 0, values, parents)
    return FeatureTree(name, tuple(values), tuple(parents), about)


def interval_tree(
    name: str, unit: str, bounds: Sequence[float], labels: Sequence[str] | Mapping = (), about: str = ""
) -> FeatureTree:
    """Half-open intervals of a number between ascending `bounds`, one more than these.

    Labels nested as for `tree` give the grouping; a flat row of them (or none: then they say the bounds) is
    halved again and again, so that a run of neighbours has a value of its own wherever a cut allows.
    """
    cuts = tuple(float(bound) for bound in bounds)
    if isinstance(labels, Mapping) or any(not isinstance(label, str) for label in labels):
        grown = tree(name, labels)
    else:
        row = tuple(labels) or _interval_labels(cuts, unit)
        if len(row) != len(cuts) + 1:
            raise WrongUse(
                f"tree {name}: {len(cuts)} bounds make {len(cuts) + 1} intervals, got {len(row)} labels"
            )
        grown = tree(name, _halved(row))
    return FeatureTree(name, grown.values, grown.parents, about, unit, cuts)


def _hang(name: str, shape: Any, parent: int, values: list[str], parents: list[int]) -> None:
    """Appends the values of a shape below the value at place `parent`, each branch to its end before the
    next."""
    if len(values) > 2 * MAX_LEAVES:
        raise WrongUse(f"tree {name} has more than {MAX_LEAVES} leaves")
    for value, below in _entries(name, shape):
        values.append(value)
        parents.append(parent)
        if below:
            _hang(name, below, len(values) - 1, values, parents)


def _entries(name: str, shape: Any) -> Iterator[tuple[str, Any]]:
    """The values directly in a shape, each with the shape below it."""
    if isinstance(shape, Mapping):
        yield from shape.items()
        return
    if isinstance(shape, str) or not isinstance(shape, Sequence):
        raise WrongUse(f"tree {name}: values are given in order, as dicts and tuples; got {shape!r}")
    for entry in shape:
        if isinstance(entry, Mapping):
            yield from entry.items()
        else:
            yield entry, None


def _halved(row: tuple[str, ...]) -> Shape:
    """A row of neighbours as halves of halves, the inner ones labelled by their ends."""
    if len(row) <= 2:
        return row
    middle = (len(row) + 1) // 2
    halves = (row[:middle], row[middle:])
    return tuple(half[0] if len(half) == 1 else {run_label(half): _halved(half)} for half in halves)


def run_label(row: Sequence[str]) -> str:
    """What a run of neighbouring intervals is called."""
    return f"{row[0]}{RUN}{row[-1]}"


def _parted(text: str, word: str) -> Iterator[tuple[str, str]]:
    """All ways to part a text at a word."""
    at = text.find(word)
    while at >= 0:
        yield text[:at], text[at + len(word) :]
        at = text.find(word, at + 1)


def _interval_labels(cuts: tuple[float, ...], unit: str) -> tuple[str, ...]:
    between = [f"{low:g} … {high:g} {unit}".strip() for low, high in pairwise(cuts)]
    return (f"< {cuts[0]:g} {unit}".strip(), *between, f"≥ {cuts[-1]:g} {unit}".strip()) if cuts else ()


def _leaf_sets(values: Sequence[str], parents: Sequence[int]) -> tuple[tuple[int, ...], tuple[str, ...]]:
    """Per value the bits of the leaves below it, and the leaves in the order of their bits."""
    inner = set(parents)
    leaves = [k for k in range(len(values)) if k not in inner]
    sets = [0] * len(values)
    for bit, leaf in enumerate(leaves):
        here = leaf
        while here >= 0:
            sets[here] |= 1 << bit
            here = parents[here]
    return tuple(sets), tuple(values[leaf] for leaf in leaves)
