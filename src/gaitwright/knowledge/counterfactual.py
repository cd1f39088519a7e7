"""What would have to be different for another rule to fire: the smallest change, found and then tried."""

from collections.abc import Collection
from dataclasses import dataclass
from heapq import heappop, heappush
from itertools import count

from gaitwright.errors import unknown
from gaitwright.knowledge.compiled import Compiled, compile_book
from gaitwright.knowledge.consult import Decision, consult
from gaitwright.knowledge.forest import Forest, Situation
from gaitwright.knowledge.rules import Rulebook
from gaitwright.knowledge.trees import FeatureTree

MAX_TRIED = 20_000
"""So many partial changes are looked at before the search gives up."""


@dataclass(frozen=True, slots=True)
class Change:
    """One tree's value as it is and as it would have to be."""

    tree: str
    before: str
    after: str


@dataclass(frozen=True, slots=True)
class Counterfactual:
    """The smallest change and what is decided after it, tried by consulting; no decision where none was
    found."""

    changes: tuple[Change, ...]
    decision: Decision | None
    sentence: str


Options = tuple[tuple[int, int, int], ...]
"""Leaves worth trying in a tree: steps away, rules that may fire there, place."""


def counterfactual(
    rulebook: Rulebook,
    situation: Situation,
    to: str = "",
    keep: Collection[str] = (),
    compiled: Compiled | None = None,
) -> Counterfactual:
    """The change of fewest trees, and of these of fewest steps in them, after which `to` fires.

    Without `to`, after which anything else is decided, no rule included. Trees in `keep` may not change.
    `compiled` spares compiling a book that is asked often. Raises `WrongUse` for a rule or tree that does
    not exist.
    """
    forest, table = rulebook.forest, compiled or compile_book(rulebook)
    for tree in keep:
        forest[tree]
    now = consult(rulebook, situation)
    if to and to not in table.names:
        raise unknown("rule", to, table.names)
    if to and now.rule == to:
        return Counterfactual((), now, f"{to} fires as it is")
    bits = [table.names.index(to)] if to else [k for k, name in enumerate(table.names) if name != now.rule]
    targets: list[int | None] = [*bits] if to or now.rule is None else [*bits, None]
    start = forest.leaf_places(situation)
    found = _search(forest, table, start, targets, {forest.names.index(tree) for tree in keep})
    if found is None:
        wanted = f"{to} fires" if to else "anything else is decided"
        return Counterfactual((), None, f"no change was found after which {wanted}{_kept_text(keep)}")
    changed = forest.at(found)
    decision = consult(rulebook, changed)
    assert decision.rule == (to or decision.rule) and decision.rule != now.rule, (
        "the search misjudged a change"
    )
    changes = tuple(
        Change(tree, str(before), str(after))
        for (tree, before), after in zip(situation.items(), changed.values, strict=True)
        if before != after
    )
    condition = " and ".join(_said(forest[change.tree], change) for change in changes)
    return Counterfactual(changes, decision, f"{decision.rule or 'no rule'} would fire if {condition}")


def _search(
    forest: Forest, table: Compiled, start: tuple[int, ...], targets: list[int | None], keep: set[int]
) -> tuple[int, ...] | None:
    """Best first over partial changes. A target rule's own trees take the nearest leaf it allows; then,
    for the first rule that still comes before it, every tree that could exclude that rule is tried."""
    order, queue, seen = count(), [], set()
    away = [
        [tree.steps(tree.leaves[leaf], other) for other in tree.leaves]
        for tree, leaf in zip(forest.trees, start, strict=True)
    ]
    for bit in targets:
        options = [
            _options(table.rows[place], away[place], start[place], bit, place in keep)
            for place in range(len(start))
        ]
        if all(options):
            leaves = tuple(choices[0][2] for choices in options)
            heappush(queue, (*_cost(away, start, leaves), next(order), bit, leaves, frozenset(), options))
    for _ in range(MAX_TRIED):
        if not queue:
            return None
        *_, bit, leaves, fixed, options = heappop(queue)
        mask = _fires(table, leaves)
        blocking = mask if bit is None else mask & ((1 << bit) - 1)
        if not blocking:
            return leaves
        first = blocking & -blocking
        for place in set(range(len(leaves))) - fixed:
            for _, allowed, leaf in options[place]:
                changed = (*leaves[:place], leaf, *leaves[place + 1 :])
                state = (bit, changed, fixed | {place})
                if not allowed & first and state not in seen:
                    seen.add(state)
                    cost = _cost(away, start, changed)
                    heappush(queue, (*cost, next(order), bit, changed, fixed | {place}, options))
    return None


def _options(row: tuple[int, ...], away: list[int], now: int, bit: int | None, kept: bool) -> Options:
    """The leaves of a tree that a target allows, nearest first, without those that a nearer one is as good
    as."""
    before = (1 << bit) - 1 if bit is not None else -1
    worth: list[tuple[int, int, int]] = []
    for leaf in sorted([now] if kept else range(len(row)), key=lambda leaf: away[leaf]):
        allowed = row[leaf]
        if bit is not None and not allowed >> bit & 1:
            continue
        if all(better & ~allowed & before for _, better, _ in worth):
            worth.append((away[leaf], allowed, leaf))
    return tuple(worth)


def _fires(table: Compiled, leaves: tuple[int, ...]) -> int:
    mask = -1
    for row, leaf in zip(table.rows, leaves, strict=True):
        mask &= row[leaf]
    return mask


def _cost(away: list[list[int]], start: tuple[int, ...], leaves: tuple[int, ...]) -> tuple[int, int]:
    """How many trees change, and by how many steps in all."""
    changed = sum(a != b for a, b in zip(start, leaves, strict=True))
    return changed, sum(steps[leaf] for steps, leaf in zip(away, leaves, strict=True))


def _said(tree: FeatureTree, change: Change) -> str:
    return f"{tree.about or tree.name + ' is'} {change.after} instead of {change.before}"


def _kept_text(keep: Collection[str]) -> str:
    return f" while {', '.join(keep)} stays as it is" if keep else ""
