"""Whole lists found anew now and then: what one repair after another would never arrive at."""

import numpy as np

from gaitwright.induction.cases import Cases, picked
from gaitwright.induction.decision_list import Lines, as_arrays, as_lines, match_all, room_for
from gaitwright.induction.length import bits_as_it_is
from gaitwright.induction.prune import prune
from gaitwright.induction.search import draw_from, improve
from gaitwright.induction.starts import cover, from_tree

ENOUGH, FEW, LOOKS = 1500, 500, 120_000
"""Cases that a revision looks at, at most: what a list gets wrong, and others by chance; those that a list
from nothing begins with, where there are more than `ENOUGH`; and cases times rules."""
QUICKLY = 12_000
"""Cases times rules that a search gets its full rounds for; more of them, fewer rounds."""
PLACES = 64
"""Rules of a list that is begun anew, at most."""
STARTS = (("tree", 0.0), ("cover", 2.0), ("tree", 8.0), ("cover", 1.0), ("cover", 4.0))
"""How lists are begun, one after the other."""


def revised(lines: Lines, cases: Cases, rounds: int, seed: int) -> tuple[Lines, float]:
    """The list after so many rounds of search, and how many bits that saved."""
    rules, n = as_arrays(lines)
    rounds = max(1, round(rounds * min(1.0, QUICKLY / (cases.n * max(n, 1)))))
    holds, fire = np.empty((len(rules.action) - 1, cases.n), np.bool_), np.empty(cases.n, np.int64)
    match_all(cases.x, rules, n, holds)
    before = bits_as_it_is(cases, rules, n, holds, fire)
    n, bits = improve(cases, rules, n, holds, rounds, seed, fire)
    return as_lines(rules, n), float(before - bits)


def begun(cases: Cases, kind: int, seed: int) -> Lines:
    """A list from nothing, pruned."""
    draw_from(seed)
    how, setting = STARTS[kind % len(STARTS)]
    rules, fire = room_for(np.int64(PLACES)), np.empty(cases.n, np.int64)
    holds, use = np.empty((PLACES - 1, cases.n), np.bool_), np.ones(len(cases.price), np.bool_)
    if how == "tree":
        n = from_tree(cases, rules, holds, setting, use, fire)
    else:
        n = cover(cases, rules, 0, holds, setting, use, fire)
    n, _ = prune(cases, rules, n, holds, fire)
    return as_lines(rules, n)


def sample(cases: Cases, wrong: np.ndarray, rules: int, seed: int, most: int = ENOUGH) -> Cases:
    """Enough of the cases for a list of so many rules: the last of those at the places `wrong`, and others
    drawn by chance."""
    if cases.n <= ENOUGH:
        return cases
    most = max(FEW, min(most, LOOKS // max(rules, 1)))
    others = np.ones(cases.n, np.bool_)
    others[wrong] = False
    missed, rest = wrong[-(most // 2) :], np.flatnonzero(others)
    many = min(most - len(missed), len(rest))
    drawn = np.random.default_rng(seed).choice(rest, many, replace=False)
    return picked(cases, np.sort(np.concatenate([missed, drawn])))
