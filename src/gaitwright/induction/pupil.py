"""Who is taught: lesson by lesson, cases in and an ordered list of rules out (thesis 5.4.2, 6.7)."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Bool, Float, Int

from gaitwright.induction.cases import NOBODY, Cases, no_cases, table_of, widened, with_case
from gaitwright.induction.columns import Vocabulary
from gaitwright.induction.decision_list import Lines, actions_of, fired
from gaitwright.induction.drift import WINDOW, Drift
from gaitwright.induction.marks import settled
from gaitwright.induction.repair import bits_of, lightened, repaired
from gaitwright.induction.revision import FEW, begun, revised, sample
from gaitwright.induction.standing import Standing, standing_of, upper_marks

SHORTER = 2.0
"""Bits that a revision must save to be adopted."""
EACH_LESSON, EACH_MISTAKE, DRAFT = 2, 5, 4
"""Rounds of search on the list after a lesson that was known, after one that was not, and on the draft."""
OFTENER, UNTIL = 4, 400
"""While cases are few, search is cheap: so many times the rounds at first, and no more from so many on."""
RIPE = 40
"""Rounds after which a draft is compared with the list."""
RIVALS, FAR = 6, 40.0
"""Other lists that are kept, and how many bits longer than the best they may be."""
MANY = 16
"""Columns over which cases are compared at most."""
DOUBT, NEIGHBOURS = 0.25, 0.1
"""What a change of mind leaves of the weight of what was taught before it, and the share of all cases that is
most alike to a surprise."""
LOSS, REGAIN, LEAST, ALIKE, FEWEST = 0.5, 1.1, 0.05, 0.15, 3
"""What a decision that proves wrong leaves of the weight of the cases most like it, what each right one gives
back, the least that is left; and the share of a rule's cases that are most alike, and how few may be."""

STEPPED_IN = 3.0
"""What a correction counts: where the teacher steps in she means it, and is followed at once."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """What the list does in a case: the action, the place of the rule, and whether that is sure."""

    action: int
    rule: int
    sure: bool


@dataclass(frozen=True, slots=True)
class Lesson:
    """One case taught: a row of columns, what is right, the place of the fact that decided, the scene's, and
    how much it counts."""

    row: Float[np.ndarray, " columns"]
    action: int
    reason: int = NOBODY
    scene: int = 0
    weight: float = 1.0


@dataclass(frozen=True, slots=True)
class Heard:
    """What one lesson did: the list before and after, what was decided before, how that was repaired ("": it
    was not), whether the list was revised, and the cases that are set aside now."""

    before: Lines
    after: Lines
    verdict: Verdict
    how: str = ""
    revised: bool = False
    aside: tuple[int, ...] = ()


@dataclass
class Pupil:
    """All that was taught, and the list that says it. The same lessons and seed, the same list."""

    vocabulary: Vocabulary
    seed: int = 0
    lines: Lines = field(default_factory=Lines)
    rivals: list[Lines] = field(default_factory=list)
    draft: Lines | None = None
    age: int = 0
    """Rounds of search that the draft has had."""
    drafts: int = 0
    cases: Cases = field(init=False)
    scene: Int[np.ndarray, " cases"] = field(init=False)
    standing: Standing = field(init=False)
    drift: Drift = field(default_factory=Drift)
    since: int = 0
    """The first case after the teacher changed her mind."""
    surprises: list[bool] = field(default_factory=list)
    """Whether each lesson was another than what had been decided."""
    _widest: Lines | None = field(default=None, init=False, repr=False)

    def __post_init__(self) -> None:
        self.cases = no_cases(self.vocabulary.reads, self.vocabulary.price)
        self.scene = np.zeros(0, np.int64)
        self.standing = standing_of(self.lines, self.cases, self.scene)

    @staticmethod
    def who_knows(
        vocabulary: Vocabulary, cases: Cases, scene: Int[np.ndarray, " cases"], lines: Lines, seed: int = 0
    ) -> "Pupil":
        """A pupil who was taught these cases, in these scenes, and says them by this list."""
        pupil = Pupil(vocabulary, seed, lines)
        pupil.cases, pupil.scene = cases, scene
        pupil.surprises = [False] * cases.n
        pupil.standing = standing_of(lines, cases, scene)
        return pupil

    # --- deciding ----------------------------------------------------------------------------------
    def decide(self, row: Float[np.ndarray, " columns"]) -> Verdict:
        """What the list does in a case; nothing before the first lesson."""
        if not self.cases.n:
            return Verdict(NOBODY, 0, False)
        actions, rules, sure = self.decide_all(row[:, None])
        return Verdict(int(actions[0]), int(rules[0]), bool(sure[0]))

    def decide_all(
        self, x: Float[np.ndarray, "columns asked"]
    ) -> tuple[Int[np.ndarray, " asked"], Int[np.ndarray, " asked"], Bool[np.ndarray, " asked"]]:
        """Action, place of the rule, and sureness for many cases.

        Sure is what lies among the cases at which a firm rule was right, in every plain column, where no
        earlier rule could be meant as well, and every rival does the same.
        """
        rules = fired(self.lines, x)
        actions = actions_of(self.lines, rules)
        plain = self.vocabulary.plain
        sure = self.standing.firm[rules] & self.standing.holds(rules, x[plain], plain)
        if sure.any():
            sure &= fired(self.widest, x) >= rules
        for rival in self.rivals:
            sure &= actions_of(rival, fired(rival, x)) == actions
        return actions, rules, sure

    @property
    def widest(self) -> Lines:
        """The list as wide as no case forbids."""
        if self._widest is None:
            self._widest = upper_marks(self.lines, self.cases, self.standing.fire)
        return self._widest

    # --- learning ----------------------------------------------------------------------------------
    def hear(self, lesson: Lesson) -> Heard:
        """Takes one lesson in: what was right stands firmer, what was wrong is repaired, and then there is
        some search for a shorter list."""
        before, verdict = self.lines, self.decide(lesson.row)
        self._widest = None
        self.cases = with_case(self.cases, lesson.row, lesson.action, lesson.reason, lesson.weight)
        self.scene = np.append(self.scene, lesson.scene)
        is_right = verdict.action == lesson.action or (self.cases.n == 1 and not lesson.action)
        self.standing.take_in(self.cases, lesson.scene, verdict.rule, is_right)
        self.trust(verdict, is_right)
        self.surprises.append(not is_right)
        if self.drift.notes(not is_right):
            self.doubt_the_past()
        how = ""
        if not is_right:
            self.lines, how = repaired(self.lines, self.cases, self.cases.n - 1)
        was_revised = self.revise(EACH_LESSON if is_right else EACH_MISTAKE)
        if self.lines != before or self.since == self.cases.n - WINDOW:
            self.lines = settled(self.lines, self.cases, self.vocabulary.known, before)
            self.rivals = [lines for lines in self.rivals if lines != self.lines]
            self.standing = standing_of(self.lines, self.cases, self.scene, self.since)
        return Heard(before, self.lines, verdict, how, was_revised, tuple(self.standing.aside.tolist()))

    def forget(self, case: int) -> None:
        """Takes a lesson out, as if it had never been heard, and with it what it alone was kept for."""
        self._widest, before, rule = None, self.lines, int(self.standing.fire[case])
        rest = np.delete(np.arange(self.cases.n), case)
        old = self.cases
        table = table_of(old.x.T[rest], old.action[rest], old.reason[rest], len(old.named), old)
        self.cases = table._replace(weight=old.weight[rest])
        self.scene = self.scene[rest]
        self.since -= self.since > case
        del self.surprises[case]
        if not len(rest):
            self.lines, self.rivals, self.draft = Lines(), [], None
        else:
            self.lines = lightened(self.lines, self.cases, rule)
            self.lines = settled(self.lines, self.cases, self.vocabulary.known, before)
        self.standing = standing_of(self.lines, self.cases, self.scene, self.since)

    def widen(self, vocabulary: Vocabulary) -> None:
        """More facts to go by, which hold in nothing that was taught so far: each is a name, so that every
        column stays in its place."""
        self.vocabulary, self._widest = vocabulary, None
        self.cases = widened(self.cases, vocabulary.reads, vocabulary.price)
        self.standing = standing_of(self.lines, self.cases, self.scene, self.since)

    def trust(self, verdict: Verdict, is_right: bool) -> None:
        """Weighs anew what spoke for a decision: a right one regains a little; of one that proves wrong,
        where the rule stood firm, the cases most like the new one lose.

        So a slip is soon forgotten, and a change of mind is followed where it took place.
        """
        if not is_right and not (verdict.action != NOBODY and self.standing.firm[verdict.rule]):
            return
        mine = np.flatnonzero((self.standing.fire == verdict.rule) & (self.cases.action == verdict.action))
        mine = mine[mine < self.cases.n - 1]
        if not is_right:
            most = max(FEWEST, round(ALIKE * len(mine)))
            matter = self.columns_that_matter(verdict.rule)
            mine = most_alike(self.cases, self.cases.n - 1, mine, matter, most)
        weight = self.cases.weight.copy()
        most = np.maximum(weight[mine], 1.0)
        weight[mine] = np.clip(weight[mine] * (REGAIN if is_right else LOSS), LEAST, most)
        self.cases = self.cases._replace(weight=weight)

    def doubt_the_past(self) -> None:
        """After a change of mind: what was taught before, is most like what came as a surprise and says
        otherwise, weighs little until it proves right again. The past alone makes nothing sure."""
        weight, last = self.cases.weight.copy(), self.cases.n - 1
        self.since = self.cases.n - WINDOW
        before = np.arange(self.since)
        most = round(NEIGHBOURS * self.cases.n)
        for k in range(last, last - WINDOW, -1):
            if self.surprises[k]:
                others = before[self.cases.action[before] != self.cases.action[k]]
                matter = self.columns_that_matter(int(self.standing.fire[k]))
                near = most_alike(self.cases, k, others, matter, most)
                weight[near] = np.maximum(DOUBT * weight[near], LEAST)
        self.cases = self.cases._replace(weight=weight)

    def columns_that_matter(self, rule: int) -> list[int]:
        """The columns that the list asks for; where these are many, those that one of its rules asks for."""
        rules = self.lines.rules
        asked = {bound.column for line in rules for bound in line.bounds}
        if len(asked) > MANY and rule < len(rules):
            asked = {bound.column for bound in rules[rule].bounds}
        return sorted(asked)[:MANY]

    def revise(self, rounds: int) -> bool:
        """Searches on, from the list and from a draft of another; whether a shorter one was adopted."""
        seed = self.seed * 1_000_003 + self.cases.n
        wrong = np.flatnonzero(actions_of(self.lines, fired(self.lines, self.cases.x)) != self.cases.action)
        some = sample(self.cases, wrong, len(self.lines.rules), seed)
        often = min(OFTENER, max(1, UNTIL // self.cases.n))
        better, saved = revised(self.lines, some, often * rounds, seed)
        found = [better] if saved > SHORTER else []
        if self.draft is None:
            few = sample(self.cases, wrong, len(self.lines.rules), seed, FEW)
            self.draft, self.age = begun(few, self.drafts, seed), 0
            self.drafts += 1
        else:
            self.draft = revised(self.draft, some, often * DRAFT, seed)[0]
            self.age += often * DRAFT
        if self.age >= RIPE or self.cases.n < RIPE:
            found.append(self.draft)
            self.draft = None
        return self.adopt([lines for lines in found if lines != self.lines])

    def adopt(self, found: Sequence[Lines]) -> bool:
        """Takes the shortest list for the pupil's own, where it saves enough; the others may be rivals."""
        if not found:
            return False
        old = self.lines
        others = dict.fromkeys([*self.rivals, *found, old])
        bits = {lines: bits_of(lines, self.cases) for lines in others}
        best = min(found, key=lambda lines: bits[lines])
        if bits[best] < bits[old] - SHORTER:
            self.lines = best
        near = [lines for lines in others if lines != self.lines and bits[lines] <= bits[self.lines] + FAR]
        self.rivals = sorted(near, key=lambda lines: bits[lines])[:RIVALS]
        return self.lines != old


def most_alike(
    cases: Cases, case: int, among: Int[np.ndarray, " some"], columns: Sequence[int], most: int
) -> Int[np.ndarray, " near"]:
    """Of some cases those most like one: nearest in rank, over the columns that matter."""
    far = np.zeros(len(among))
    for c in columns:
        x, order = cases.x[c], cases.order[c]
        here, there = (np.searchsorted(x, v, sorter=order) for v in (x[case], x[among]))
        far += np.abs(there - here) / cases.n
    return among[np.argsort(far, kind="stable")[:most]]
