"""Algorithm C compiled: per leaf one bit for each rule that may fire there; a decision is a few ANDs.

Bit r belongs to the r-th rule of the book, so the lowest bit that is left is the rule that fires.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Int

from gaitwright.errors import WrongUse, unknown
from gaitwright.knowledge.rules import Rulebook
from gaitwright.numerics.compiled import kernel

WORD = 64
ONE = np.uint64(1)
ALL = np.uint64(0xFFFF_FFFF_FFFF_FFFF)


@dataclass(frozen=True, slots=True, eq=False)
class Compiled:
    """A rulebook as bits. `upper[first[t] + k]` has the rules whose upper mark leaf k of tree t is below, in
    64-bit words, `lower` the same of the lower marks; `rows` and `low_rows` the same as ints, by tree and
    leaf."""

    names: tuple[str, ...]
    trees: tuple[str, ...]
    upper: np.ndarray
    lower: np.ndarray
    first: np.ndarray
    rows: tuple[tuple[int, ...], ...]
    low_rows: tuple[tuple[int, ...], ...]
    by_value: tuple[dict[str, tuple[int, int]], ...]


def compile_book(rulebook: Rulebook) -> Compiled:
    """The rulebook as masks. It knows nothing of later changes: compile anew after a lesson."""
    forest = rulebook.forest
    rows, low_rows = [], []
    for place, tree in enumerate(forest.trees):
        ups, lows = [0] * len(tree.leaves), [0] * len(tree.leaves)
        for bit, rule in enumerate(rulebook.rules):
            marks = rule.marks[place]
            below = tree.leaf_set(marks.upper) if rule.may_fire else 0
            inside = tree.leaf_set(marks.lower) if marks.lower is not None else 0
            for leaf in range(len(tree.leaves)):
                ups[leaf] |= (below >> leaf & 1) << bit
                lows[leaf] |= (inside >> leaf & 1) << bit
        rows.append(tuple(ups))
        low_rows.append(tuple(lows))
    sizes = [len(tree.leaves) for tree in forest.trees]
    words = max(1, -(-len(rulebook.rules) // WORD))
    return Compiled(
        tuple(rule.name for rule in rulebook.rules),
        forest.names,
        _words(rows, words),
        _words(low_rows, words),
        np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64),
        tuple(rows),
        tuple(low_rows),
        tuple(
            dict(zip(tree.leaves, zip(up, low, strict=True), strict=True))
            for tree, up, low in zip(forest.trees, rows, low_rows, strict=True)
        ),
    )


def decide_leaves(compiled: Compiled, leaves: Sequence[int]) -> tuple[int, bool]:
    """The place of the rule that fires (−1: none) and whether it is sure, from leaves by their places in a
    tree. Raises `IndexError` beyond a tree's leaves."""
    mask, inside = -1, -1
    for ups, lows, leaf in zip(compiled.rows, compiled.low_rows, leaves, strict=True):
        mask &= ups[leaf]
        inside &= lows[leaf]
    lowest = mask & -mask
    return lowest.bit_length() - 1, lowest & inside != 0


def decide(compiled: Compiled, values: Mapping[str, str]) -> tuple[str | None, bool]:
    """The rule that fires, and whether it is sure, from a leaf per tree by name.

    Raises `WrongUse` for a tree left out or a value that is no leaf.
    """
    mask, inside = -1, -1
    try:
        for tree, table in zip(compiled.trees, compiled.by_value, strict=True):
            up, low = table[values[tree]]
            mask &= up
            inside &= low
    except KeyError:
        raise _misfit(compiled, values) from None
    lowest = mask & -mask
    return (compiled.names[lowest.bit_length() - 1] if lowest else None), lowest & inside != 0


def decide_many(
    compiled: Compiled, leaves: Int[np.ndarray, "situations trees"]
) -> tuple[Int[np.ndarray, " situations"], Bool[np.ndarray, " situations"]]:
    """`decide_leaves` for many situations at once. Raises `WrongUse` where a leaf does not exist."""
    sizes = np.diff(compiled.first)
    if leaves.shape[1] != len(sizes) or (leaves < 0).any() or (leaves >= sizes).any():
        raise WrongUse(
            f"situations have {len(sizes)} leaves, below {sizes.tolist()}; got an array {leaves.shape}"
        )
    rules, sure = np.empty(len(leaves), np.int64), np.empty(len(leaves), np.bool_)
    decide_all(compiled.upper, compiled.lower, compiled.first, leaves.astype(np.int64), rules, sure)
    return rules, sure


@kernel
def decide_all(upper, lower, first, leaves, rules, sure):
    """`decide_one` for each row of `leaves`, into `rules` and `sure`."""
    for k in range(len(leaves)):
        rules[k], sure[k] = decide_one(upper, lower, first, leaves[k])


@kernel
def decide_one(upper, lower, first, leaves):
    """The first rule below all of whose upper marks the leaves are (−1: none), and whether below the lower
    too."""
    for word in range(upper.shape[1]):
        mask, inside = ALL, ALL
        for tree in range(len(leaves)):
            row = first[tree] + leaves[tree]
            mask &= upper[row, word]
            inside &= lower[row, word]
        if mask:
            bit = lowest_bit(mask)
            return word * WORD + bit, (inside >> np.uint64(bit)) & ONE == ONE
    return -1, False


@kernel
def lowest_bit(word):
    """The place of the lowest bit that is set in a word that is not zero."""
    place = 0
    for width in (32, 16, 8, 4, 2, 1):
        if word & ((ONE << np.uint64(width)) - ONE) == np.uint64(0):
            word >>= np.uint64(width)
            place += width
    return place


def _words(rows: list[tuple[int, ...]], words: int) -> np.ndarray:
    """Masks of any length as 64-bit words, `(leaves of all trees, words)`."""
    flat = [mask for row in rows for mask in row]
    cut = [[mask >> WORD * word & int(ALL) for word in range(words)] for mask in flat]
    return np.array(cut, dtype=np.uint64)


def _misfit(compiled: Compiled, values: Mapping[str, str]) -> WrongUse:
    """What is wrong with values that are no situation."""
    for tree, table in zip(compiled.trees, compiled.by_value, strict=True):
        if tree not in values:
            return WrongUse(f"a situation has a value in every tree; missing: {tree}")
        if values[tree] not in table:
            return unknown(f"value of {tree}", values[tree], table)
    return WrongUse(f"no situation: {dict(values)}")
