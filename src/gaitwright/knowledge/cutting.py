"""Interval trees with more bounds: the leaves that a learned bound lies in are cut there (fig. 5.6)."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from gaitwright.knowledge.trees import ROOT, FeatureTree, interval_tree


def cut_at(old: FeatureTree, bounds: Sequence[float]) -> FeatureTree:
    """The tree with these bounds beside its own; every value stays what it was as a set of numbers.

    A leaf that is cut becomes a value with its parts below it: what had a name keeps it.
    """
    new = sorted(set(bounds) - set(old.bounds))
    if not new:
        return old
    edges = (float("-inf"), *old.bounds, float("inf"))
    values, parents, moved = [], [], {}
    for k, value in enumerate(old.values):
        moved[k] = len(values)
        values.append(value)
        parents.append(moved[old.parents[k]] if k else -1)
        if not old.is_leaf(value):
            continue
        low, high = edges[old.leaf_place[value]], edges[old.leaf_place[value] + 1]
        inside = [bound for bound in new if low < bound < high]
        if inside:
            parts = pairwise((low, *inside, high))
            values += [part_label(value, a, b, (low, high)) for a, b in parts]
            parents += [moved[k]] * (len(inside) + 1)
    return replace(
        old, values=tuple(values), parents=tuple(parents), bounds=tuple(sorted((*old.bounds, *new)))
    )


def part_label(value: str, low: float, high: float, whole: tuple[float, float]) -> str:
    """What a part of an interval is called: "walking pace under 0.2"."""
    if low == whole[0]:
        return f"{value} under {high:.6g}"
    if high == whole[1]:
        return f"{value} from {low:.6g}"
    return f"{value}, {low:.6g} … {high:.6g}"


def tree_at(name: str, unit: str, bounds: Sequence[float], about: str, source: str) -> FeatureTree:
    """A tree of a number that had none, with a leaf between any two bounds."""
    return replace(interval_tree(name, unit, sorted(set(bounds)), about=about), source=source)


def run_of(tree: FeatureTree, low: float, high: float) -> int:
    """The leaves between two bounds of a tree, or its open ends, as bits."""
    edges = (float("-inf"), *tree.bounds, float("inf"))
    return sum(1 << k for k, (a, b) in enumerate(pairwise(edges)) if low <= a and b <= high)


def spoken(tree: FeatureTree, mark: str) -> str:
    """A mark as a person says it: "the road is flat", "the way left is under 0.4 body lengths"."""
    if is_word(tree, mark):  # "the speed is a walking pace", but "the speed is slow"
        about = tree.about or f"{tree.name} is"
        return f"{about.removesuffix(' a') if is_group(tree, mark) else about} {mark}"
    return f"{subject(tree)} {value_text(tree, mark)}"


def subject(tree: FeatureTree) -> str:
    """How a sentence on a number begins: "it is stumbling", but "its sway is at least 0.2"; "the speed is a
    walking pace", but "the speed is under 1"."""
    about = tree.about or f"{tree.name} is"
    return f"its {tree.source or tree.name} is" if about == "it is" else about.removesuffix(" a")


def value_text(tree: FeatureTree, mark: str) -> str:
    """The values that a mark stands for: its name where it has one, else from which number to which."""
    if is_word(tree, mark):
        return mark
    return between(*range_of(tree, mark), tree.unit)


def between(low: float, high: float, unit: str) -> str:
    """From which number to which, as a person says it."""
    unit = f" {unit}".rstrip()
    if low == float("-inf"):
        return f"under {high:.4g}{unit}"
    if high == float("inf"):
        return f"at least {low:.4g}{unit}"
    return f"from {low:.4g} to {high:.4g}{unit}"


def is_group(tree: FeatureTree, mark: str) -> bool:
    """Whether a mark has others with names of their own right below it: "slow", but not a pace that was
    cut."""
    here = tree.place.get(mark)
    below = [value for value, parent in zip(tree.values, tree.parents, strict=True) if parent == here]
    return any(is_word(tree, value) for value in below)


def is_word(tree: FeatureTree, mark: str) -> bool:
    """Whether a mark has a name of its own, and not one made of bounds."""
    return not tree.bounds or mark == ROOT or (mark in tree.place and not any(map(str.isdigit, mark)))


def range_of(tree: FeatureTree, mark: str) -> tuple[float, float]:
    """The numbers between which a mark of a tree of intervals lies."""
    bits = tree.leaf_set(mark)
    edges = (float("-inf"), *tree.bounds, float("inf"))
    return edges[(bits & -bits).bit_length() - 1], edges[bits.bit_length()]
