"""How well each rule of a list stands: what it was right and wrong at, how widely, and in how many scenes."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from gaitwright.induction.cases import Cases
from gaitwright.induction.decision_list import Bound, Lines, RuleLine, actions_of, as_arrays, fired
from gaitwright.numerics.compiled import kernel

ENOUGH_RIGHTS, ENOUGH_SCENES, MOST_ASIDE = 6, 3, 0.08
"""A rule can be sure from so many right cases on, in so many scenes, with at most that share set aside."""


@dataclass
class Standing:
    """The cases of a list, by the rule that decides each; the last line counts as a rule."""

    fire: Int[np.ndarray, " cases"]
    right: Bool[np.ndarray, " cases"]
    low: Float[np.ndarray, "rules columns"]
    """Least number of each column at which a rule was right."""
    high: Float[np.ndarray, "rules columns"]
    rights: Int[np.ndarray, " rules"]
    wrongs: Int[np.ndarray, " rules"]
    scenes: list[set[int]]

    @property
    def firm(self) -> Bool[np.ndarray, " rules"]:
        """Which rules were right often and widely enough, and hardly ever wrong."""
        wide = np.array([len(scenes) >= ENOUGH_SCENES for scenes in self.scenes])
        few_aside = self.wrongs <= MOST_ASIDE * (self.rights + self.wrongs)
        return wide & few_aside & (self.rights >= ENOUGH_RIGHTS)

    @property
    def aside(self) -> Int[np.ndarray, " some"]:
        """The cases that are decided otherwise than they were taught."""
        return np.flatnonzero(~self.right)

    def holds(self, rules: Int[np.ndarray, " asked"], x: Float[np.ndarray, "plain asked"], plain: np.ndarray):
        """Whether each case asked for lies among those at which its rule was right, in every plain column."""
        low, high = self.low[rules][:, plain].T, self.high[rules][:, plain].T
        return ((x >= low) & (x <= high)).all(axis=0)

    def take_in(self, cases: Cases, scene: int, rule: int, is_right: bool) -> None:
        """One more case, the last of the table."""
        self.fire, self.right = np.append(self.fire, rule), np.append(self.right, is_right)
        if not is_right:
            self.wrongs[rule] += 1
            return
        self.rights[rule] += 1
        self.scenes[rule].add(scene)
        self.low[rule] = np.fmin(self.low[rule], cases.x[:, -1])
        self.high[rule] = np.fmax(self.high[rule], cases.x[:, -1])


def standing_of(lines: Lines, cases: Cases, scene: Int[np.ndarray, " cases"], since: int = 0) -> Standing:
    """How the rules of a list stand; only cases from the place `since` on count as often and wide enough."""
    fire = fired(lines, cases.x)
    right = actions_of(lines, fire) == cases.action
    n = len(lines.rules) + 1
    low, high = np.full((n, len(cases.x)), np.inf), np.full((n, len(cases.x)), -np.inf)
    scenes: list[set[int]] = []
    for r in range(n):
        mine = np.flatnonzero(right & (fire == r))
        scenes.append(set(scene[mine[mine >= since]].tolist()))
        if len(mine):
            values = cases.x[:, mine]
            low[r], high[r] = np.fmin.reduce(values, axis=1), np.fmax.reduce(values, axis=1)
    late = np.arange(cases.n) >= since
    rights, wrongs = (np.bincount(fire[which & late], minlength=n) for which in (right, ~right))
    return Standing(fire, right, low, high, rights, wrongs, scenes)


def upper_marks(lines: Lines, cases: Cases, fire: Int[np.ndarray, " cases"]) -> Lines:
    """The list with every bound moved out to its upper mark: the nearest case that it alone keeps out."""
    rules, n = as_arrays(lines, 0)
    low, high = np.full(rules.low.shape, -np.inf), np.full(rules.high.shape, np.inf)
    nearest_outside(cases, rules, n, fire, low, high)
    found = (
        (rule, [(float(low[r, j]), float(high[r, j])) for j in range(len(rule.bounds))])
        for r, rule in enumerate(lines.rules)
    )
    return Lines(tuple(moved_out(rule, marks) for rule, marks in found), lines.otherwise)


def moved_out(rule: RuleLine, marks: list[tuple[float, float]]) -> RuleLine:
    """The rule with its finite bounds at the marks, where there are any."""
    bounds = []
    for bound, (low, high) in zip(rule.bounds, marks, strict=True):
        below = np.nextafter(low, np.inf) if np.isfinite(bound.low) and np.isfinite(low) else bound.low
        above = high if np.isfinite(bound.high) and np.isfinite(high) else bound.high
        bounds.append(Bound(bound.column, float(below), float(above)))
    return RuleLine(rule.action, tuple(bounds))


@kernel
def nearest_outside(cases, rules, n, fire, low, high):
    """Per condition the nearest cases of other actions, on either side, that it alone keeps out of its rule,
    among those that no earlier rule decides."""
    misses, where = np.empty(len(fire), np.int64), np.empty(len(fire), np.int64)
    for r in range(n):
        misses[:] = 0
        for j in range(rules.conditions[r]):
            values, least, most = cases.x[rules.column[r, j]], rules.low[r, j], rules.high[r, j]
            for i in range(len(fire)):
                if not least <= values[i] < most:
                    misses[i] += 1
                    where[i] = j
        for i in range(len(fire)):
            if misses[i] == 1 and fire[i] > r and cases.action[i] != rules.action[r]:
                j = where[i]
                value = cases.x[rules.column[r, j], i]
                if value >= rules.high[r, j]:
                    high[r, j] = min(high[r, j], value)
                elif value < rules.low[r, j]:
                    low[r, j] = max(low[r, j], value)
