"""Whole lists found anew now and then: what one repair after another would never arrive at."""

import numpy as np

from gaitwright.induction.cases import Cases, picked
from gaitwright.induction.decision_list import Lines, as_arrays, as_lines, match_all, room_for
from gaitwright.induction.prune import prune
from gaitwright.induction.search import improve
from gaitwright.induction.starts import cover, from_tree

ENOUGH = 1500
"""Cases that a revision looks at, at most: all that a list gets wrong, and others by chance."""
PLACES = 64
"""Rules of a list that is begun anew, at most."""
STARTS = (("tree", 0.0), ("cover", 2.0), ("tree", 8.0), ("cover", 1.0), ("cover", 4.0))
"""How lists are begun, one after the other."""
ROOM = 8
"""Rules that a search may add to a list."""


def revised(lines: Lines, cases: Cases, rounds: int, seed: int) -> tuple[Lines, float]:
    """The list after so many rounds of search, and its bits."""
    rules, n = as_arrays(lines, ROOM)
    holds, fire = np.empty((len(rules.action) - 1, cases.n), np.bool_), np.empty(cases.n, np.int64)
    match_all(cases.x, rules, n, holds)
    n, bits = improve(cases, rules, n, holds, rounds, seed, cases.n, fire)
    return as_lines(rules, n), float(bits)


def begun(cases: Cases, kind: int, rounds: int, seed: int) -> tuple[Lines, float]:
    """A list from nothing, pruned and searched for so many rounds, and its bits."""
    how, setting = STARTS[kind % len(STARTS)]
    rules, fire = room_for(PLACES), np.empty(cases.n, np.int64)
    holds, use = np.empty((PLACES - 1, cases.n), np.bool_), np.ones(len(cases.price), np.bool_)
    if how == "tree":
        n = from_tree(cases, rules, holds, setting, use, fire)
    else:
        n = cover(cases, rules, 0, holds, setting, use, cases.n, fire)
    n, _ = prune(cases, rules, n, holds, cases.n, fire)
    n, bits = improve(cases, rules, n, holds, rounds, seed, cases.n, fire)
    return as_lines(rules, n), float(bits)


def sample(cases: Cases, wrong: np.ndarray, seed: int) -> Cases:
    """Enough of the cases: those at the places `wrong`, and others drawn by chance."""
    if cases.n <= ENOUGH:
        return cases
    rng = np.random.default_rng(seed)
    others = np.setdiff1d(np.arange(cases.n), wrong)
    kept = rng.choice(others, max(0, ENOUGH - len(wrong)), replace=False)
    return picked(cases, np.sort(np.concatenate([wrong[:ENOUGH], kept])))
