"""What makes values a feature tree: labels to tell apart, an order, leaves that exclude each other."""

import math
from itertools import pairwise
from typing import TYPE_CHECKING

from gaitwright.errors import WrongUse

if TYPE_CHECKING:
    from gaitwright.knowledge.trees import FeatureTree

ROOT = "any"
"""The value at the top of every tree, true in every situation (the thesis's TRUE)."""
MAX_LEAVES = 512
MAX_DEPTH = 16
MAX_LABEL = 200


def check_labels(t: "FeatureTree") -> None:
    """Raises `WrongUse` for labels that no person could tell apart or read."""
    for label in (t.name, *t.values):
        if not label.strip() or len(label) > MAX_LABEL or not label.isprintable():
            raise WrongUse(
                f"tree {t.name!r}: {label!r} is no label; it needs 1 to {MAX_LABEL} printable characters"
            )
    seen: set[str] = set()
    for value in t.values:
        if value in seen:
            raise WrongUse(f"tree {t.name} has the value {value!r} twice")
        seen.add(value)


def check_parents(t: "FeatureTree") -> None:
    """Raises `WrongUse` where the values do not stand in order, each branch to its end before the next."""
    if len(t.parents) != len(t.values) or not t.values or t.values[0] != ROOT or t.parents[0] != -1:
        raise WrongUse(f"tree {t.name} must begin with {ROOT!r} and give each other value its parent")
    branch = [0]  # from the root to the value before
    for k, above in enumerate(t.parents[1:], start=1):
        if above not in branch:
            raise WrongUse(f"tree {t.name}: {t.values[k]!r} hangs below place {above}; it may be {branch}")
        branch = [*branch[: branch.index(above) + 1], k]
        if len(branch) > MAX_DEPTH + 1:
            raise WrongUse(f"tree {t.name} is deeper than {MAX_DEPTH}")


def check_leaves(t: "FeatureTree", leaves: tuple[str, ...]) -> None:
    """Raises `WrongUse` for a value that has one value below it, for too many leaves, or bounds that do
    not fit."""
    for k, value in enumerate(t.values):
        if t.parents.count(k) == 1:
            only = t.values[t.parents.index(k)]
            raise WrongUse(
                f"tree {t.name}: {only!r} is the only value below {value!r}, so both mean the same"
            )
    if not 2 <= len(leaves) <= MAX_LEAVES:
        raise WrongUse(f"tree {t.name} has {len(leaves)} leaves; a tree has 2 to {MAX_LEAVES}")
    ascending = all(low < high for low, high in pairwise(t.bounds))
    if t.bounds and not (
        len(t.bounds) + 1 == len(leaves) and ascending and all(math.isfinite(bound) for bound in t.bounds)
    ):
        raise WrongUse(
            f"tree {t.name}: bounds must be finite, ascending and one fewer than its {len(leaves)} leaves; "
            f"got {list(t.bounds)}"
        )
