"""How well each rule of a list stands: what it was right and wrong at, how widely, and in how many scenes."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from gaitwright.induction.cases import Cases
from gaitwright.induction.decision_list import Lines, actions_of, fired
from gaitwright.induction.marks import gap_of

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


def standing_of(lines: Lines, cases: Cases, scene: Int[np.ndarray, " cases"]) -> Standing:
    """How the rules of a list stand."""
    fire = fired(lines, cases.x)
    right = actions_of(lines, fire) == cases.action
    n = len(lines.rules) + 1
    low, high = np.full((n, len(cases.x)), np.inf), np.full((n, len(cases.x)), -np.inf)
    scenes: list[set[int]] = []
    for r in range(n):
        mine = np.flatnonzero(right & (fire == r))
        scenes.append(set(scene[mine].tolist()))
        if len(mine):
            values = cases.x[:, mine]
            low[r], high[r] = np.fmin.reduce(values, axis=1), np.fmax.reduce(values, axis=1)
    rights, wrongs = (np.bincount(fire[which], minlength=n) for which in (right, ~right))
    return Standing(fire, right, low, high, rights, wrongs, scenes)


def upper_marks(lines: Lines, cases: Cases, fire: Int[np.ndarray, " cases"]) -> Lines:
    """The list with every bound moved out to its upper mark: the nearest case that it alone keeps out."""
    rules = []
    for r, rule in enumerate(lines.rules):
        bounds = []
        for j, bound in enumerate(rule.bounds):
            upper, lower = (gap_of(rule, j, r, cases, fire, side) for side in (1, -1))
            low = float(np.nextafter(lower.outer, np.inf)) if lower else bound.low
            high = upper.outer if upper else bound.high
            bounds.append(type(bound)(bound.column, low, high))
        rules.append(type(rule)(rule.action, tuple(bounds)))
    return Lines(tuple(rules), lines.otherwise)
