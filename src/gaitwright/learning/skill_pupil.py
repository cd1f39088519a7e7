"""A pupil who learns which skill to use: moments of trips and a teacher's words in, a rulebook out.

What she is told goes to `induction.pupil` as numbers; here are the words: which action has which place, what
the teacher calls each rule, and the situation as people speak of it.
"""

from collections.abc import Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, field, replace

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.errors import WrongUse
from gaitwright.induction.cases import NOBODY
from gaitwright.induction.columns import Vocabulary
from gaitwright.induction.decision_list import Bound
from gaitwright.induction.going_on import only_goes_on, until_of
from gaitwright.induction.pupil import LEAST, STEPPED_IN, Heard, Lesson, Pupil
from gaitwright.knowledge.differences import Stage, about, allowed, differences
from gaitwright.knowledge.expressed import Lessons, Wording, expressed, rule_names
from gaitwright.knowledge.memory import Action, Fact, notes_in, read_notes
from gaitwright.knowledge.rules import Event, Instance, Rulebook
from gaitwright.knowledge.told import Given, Told
from gaitwright.learning.decision_point import DecisionPoint
from gaitwright.learning.teacher import Shown
from gaitwright.skills.situation import situation_of
from gaitwright.skills.vocabulary import IN_USE, VOCABULARY, check_note, vocabulary_with
from gaitwright.skills.wording import wording_with

UNTIL_ASKS = tuple(k for k, column in enumerate(VOCABULARY.columns) if column.form in ("is", "size"))
"""The columns that may say until when an action goes on: measured numbers and their sizes."""
WEIGHT: dict[Given, float] = dict.fromkeys(("corrected", "by itself", "by analogy"), STEPPED_IN)
"""How much a lesson counts by how it came (1). An analogy is told only where a person confirms it: she means
it too."""


@dataclass(frozen=True, slots=True)
class Choice:
    """What a pupil would do at a moment: the action (`None` before the first lesson), and whether that is
    sure."""

    action: Action | None
    sure: bool = False


@dataclass(frozen=True, slots=True)
class Taken:
    """How one lesson was taken in: what it did to the list, and what moved, in sentences."""

    heard: Heard
    events: tuple[Event, ...]


@dataclass
class SkillPupil:
    """A pupil of skills. The same words in the same order and the same seed make the same rules."""

    seed: int = 0
    pupil: Pupil = field(init=False)
    kinds: list[Action] = field(default_factory=list)
    """What a teacher has shown, each kind of action once, in the order in which they came (`kind_of`)."""
    told: list[Told] = field(default_factory=list)
    """What counts, in order."""
    scenes: dict[str, int] = field(default_factory=dict)
    instances: list[Instance] = field(default_factory=list)
    """What counts, in the situation as people speak of it: made once, since a book has many."""
    notes: list[str] = field(default_factory=list)
    """The notes in working memory that an action makes, in the order in which they came."""
    ends: dict[int, Bound] = field(default_factory=dict)
    """By the place of a kind of action: while which number lies where it goes on, once it was begun."""
    said: Bool[np.ndarray, " told"] = field(default_factory=lambda: np.zeros(0, np.bool_))
    """Which of the lessons an end says."""

    def __post_init__(self) -> None:
        self.pupil = Pupil(VOCABULARY, self.seed)

    def copied(self) -> "SkillPupil":
        """Another one who knows the same: to try out what a lesson would do."""
        lists = (
            [*self.kinds],
            [*self.told],
            {**self.scenes},
            [*self.instances],
            [*self.notes],
            {**self.ends},
            self.said,
        )
        other = SkillPupil(self.seed, *lists)
        other.pupil = deepcopy(self.pupil, {id(self.vocabulary): self.vocabulary})
        return other

    @property
    def vocabulary(self) -> Vocabulary:
        """What she may go by: what is measured, and the notes."""
        return self.pupil.vocabulary

    @property
    def wording(self) -> Wording:
        return wording_with(tuple(self.notes))

    @property
    def actions(self) -> list[Action]:
        """What was taught to do: where a teacher drove at one speed and another, from the slowest to the
        fastest of these."""
        return [self.as_fast_as_shown(kind) for kind in self.kinds]

    def as_fast_as_shown(self, kind: Action) -> Action:
        """A kind of action with the speeds that were shown of it."""
        if kind.fastest > 0.0:
            return kind
        shown = (told.action for told in self.told if told.action.skill == kind.skill)
        speeds = [action.fastest for action in shown if kind_of(action) == kind]
        return replace(kind, slowest=min(speeds, default=0.0), fastest=max(speeds, default=0.0))

    def learned(self, action: Action) -> Action:
        """What she does where an action was shown: as fast as its kind was."""
        return self.as_fast_as_shown(kind_of(action))

    # --- deciding ----------------------------------------------------------------------------------
    def choose(self, moment: DecisionPoint) -> Choice:
        """What the rules do at a moment."""
        return self.choose_all([moment])[0]

    def choose_all(self, moments: Sequence[DecisionPoint]) -> list[Choice]:
        """What the rules do at many moments."""
        return self.choose_at([moment.facts for moment in moments])

    def choose_at(self, facts: Sequence[Mapping[str, Fact]]) -> list[Choice]:
        """What the rules do where these facts hold, one set of them after the other."""
        if not self.told or not facts:
            return [Choice(None)] * len(facts)
        rows = np.array([self.row(one) for one in facts])
        places, _, sure = self.pupil.decide_all(rows.T)
        for k, one in enumerate(facts if self.ends else ()):
            kept = self.goes_on(one, rows[k])
            if kept is not None:
                places[k], sure[k] = kept, True
        done = {a: self.as_fast_as_shown(self.kinds[a]) for a in set(places.tolist())}
        return [Choice(done[a], s) for a, s in zip(places.tolist(), sure.tolist(), strict=True)]

    def row(self, facts: Mapping[str, Fact]) -> Float[np.ndarray, " columns"]:
        """What every column says where these facts hold; what is not in memory is not noted."""
        return self.vocabulary.row({**facts, **read_notes(self.notes, facts)})

    def goes_on(self, facts: Mapping[str, Fact], row: Float[np.ndarray, " columns"]) -> int | None:
        """The place of the action in use, where it goes on, and there is somewhere to go."""
        for a, bound in self.ends.items():
            in_use = facts.get(IN_USE) == self.kinds[a].skill and facts.get("arrived", 0.0) == 0.0
            if in_use and bound.low <= row[bound.column] < bound.high:
                return a
        return None

    # --- learning ----------------------------------------------------------------------------------
    def hear(self, told: Told) -> Taken:
        """One word of the teacher's: what is right at a moment of a scene, and the number that decided her.

        A reason that is no fact of the vocabulary counts as none.
        """
        self.note(told)
        fire, right = self.pupil.standing.fire, self.pupil.standing.right
        heard = self.pupil.hear(self.lesson_of(told))
        before = [one.rule for one in self.told]
        self.told.append(told)
        self.instances.append(self.instance_of(told))
        self.said = np.append(self.said, False)
        ended = self.learn_ends(told.id)
        if heard.before == heard.after:
            return Taken(heard, ended)
        names = rule_names(heard.before, fire, right, before)
        stage = Stage(heard.before, np.append(fire, heard.verdict.rule), names)
        moved = differences(stage, self.stage(), told.id, self.vocabulary, self.wording)
        return Taken(heard, (*moved, *ended))

    def forget(self, name: str) -> tuple[Event, ...]:
        """Takes back what was told under a name; what that moved. Raises `WrongUse` where nothing was."""
        names = [told.id for told in self.told]
        if name not in names:
            last = ", ".join(names[-3:]) or "none"
            raise WrongUse(f"no lesson {name!r} that counts; the last ones are: {last}")
        k, before = names.index(name), self.stage()
        self.pupil.forget(k)
        del self.told[k], self.instances[k]
        self.said = np.delete(self.said, k)
        before = replace(before, fire=np.delete(before.fire, k))
        moved = differences(before, self.stage(), name, self.vocabulary, self.wording)
        return (*moved, *self.learn_ends(name))

    def learn_ends(self, lesson: str) -> tuple[Event, ...]:
        """Until when each action goes on, anew, the rarest first; what a lesson moved.

        What an end says the list need not say: such a lesson counts little for it.
        """
        cases, scene, before = self.pupil.cases, self.pupil.scene, self.ends
        using = np.array([str(told.facts.get(IN_USE, "")) for told in self.told])
        under_way = cases.x[self.vocabulary.places["arrived"]] == 0.0
        in_use = [(using == kind.skill) & under_way for kind in self.kinds]
        rights, said = np.bincount(cases.action, minlength=len(self.kinds)), np.zeros(cases.n, np.bool_)
        self.ends = {}
        for a in np.argsort(rights, kind="stable").tolist():
            bound = until_of(a, cases, scene, in_use[a], said, UNTIL_ASKS, self.vocabulary.known)
            if bound is not None:
                self.ends[a] = bound
                said |= only_goes_on(bound, a, cases, in_use[a])
        self.weigh(said)
        moved = {a: (before.get(a), self.ends.get(a)) for a in sorted({*before, *self.ends})}
        return tuple(self.end_moved(lesson, a, *ends) for a, ends in moved.items() if ends[0] != ends[1])

    def weigh(self, said: Bool[np.ndarray, " cases"]) -> None:
        """Lets what an end says count little for the list, and what none says any more as it was told."""
        weight = self.pupil.cases.weight.copy()
        for k in np.flatnonzero(self.said & ~said).tolist():
            weight[k] = WEIGHT.get(self.told[k].given, 1.0)
        weight[said] = LEAST
        self.said = said
        self.pupil.cases = self.pupil.cases._replace(weight=weight)

    def end_moved(self, lesson: str, action: int, old: Bound | None, new: Bound | None) -> Event:
        """That an action goes on until something else."""
        name = self.name_of(self.kinds[action])
        before, after = (self.until(bound) for bound in (old, new))
        goes_on = f"goes on until {after}" if after else "does not go on by itself any more"
        return Event(lesson, name, "", "rule", before, after, f"{name} now {goes_on}")

    def until(self, bound: Bound | None) -> str:
        """When what goes on within a bound ends, as a person says it."""
        if bound is None:
            return ""
        outside = (bound.high, np.inf) if np.isfinite(bound.high) else (-np.inf, bound.low)
        column = self.vocabulary.columns[bound.column]
        return f"{about(self.wording, column)} {allowed(column, *outside)}"

    def note(self, told: Told) -> None:
        """Gives a new action and a new scene their places."""
        if kind_of(told.action) not in self.kinds:
            self.kinds.append(kind_of(told.action))
        self.scenes.setdefault(told.scene, len(self.scenes))
        new = [name for name in dict.fromkeys(notes_in(told.action)) if name not in self.notes]
        if new:
            for name in new:
                check_note(name)
            self.notes += new
            self.pupil.widen(vocabulary_with(tuple(self.notes)))
            self.instances = [self.instance_of(one) for one in self.told]

    def lesson_of(self, told: Told) -> Lesson:
        """What was told, as numbers; its action and scene have their places."""
        names = self.vocabulary.names
        reason = names.index(told.about) if told.about in names else NOBODY
        row, action = self.row(told.facts), self.kinds.index(kind_of(told.action))
        return Lesson(row, action, reason, self.scenes[told.scene], WEIGHT.get(told.given, 1.0))

    def name_of(self, action: Action) -> str:
        """What the rule of an action was called last; its skill, where it was never taught."""
        kind = kind_of(action)
        called = (one.rule for one in reversed(self.told) if kind_of(one.action) == kind)
        return next(called, action.skill)

    def aside(self) -> list[Told]:
        """What counts and is not followed: it contradicts too much of the rest."""
        return [self.told[k] for k in self.pupil.standing.aside.tolist()]

    # --- what was learned --------------------------------------------------------------------------
    def stage(self) -> Stage:
        """The list as it is, with what its rules are called."""
        pupil = self.pupil
        fire, right = pupil.standing.fire, pupil.standing.right
        return Stage(pupil.lines, fire, rule_names(pupil.lines, fire, right, [one.rule for one in self.told]))

    def rulebook(self) -> Rulebook:
        """What was learned, as rules over feature trees."""
        pupil, names = self.pupil, [told.rule for told in self.told]
        taught = Lessons(self.instances, self.actions, names, self.ends)
        return expressed(pupil.lines, pupil.cases, pupil.standing, self.vocabulary, self.wording, taught)

    def instance_of(self, told: Told) -> Instance:
        """What was told, in the situation as people speak of it."""
        facts = {**told.facts, **read_notes(self.notes, told.facts)}
        situation = self.wording.forest.read(dict(situation_of(told.facts).items()), facts)
        return Instance(told.id, "positive", situation, facts, told.because)


def kind_of(action: Action) -> Action:
    """What an action is, however fast: a single speed is one that was driven, and says nothing of others."""
    return replace(action, slowest=0.0, fastest=0.0) if action.slowest == action.fastest else action


def told_at(moment: DecisionPoint, shown: Shown, scene: str, given: Given = "corrected") -> Told:
    """What a teacher shows at a moment, as it is told to a pupil."""
    reason = (shown.because, shown.about)
    return Told(moment.id, moment.facts, shown.rule, shown.action, *reason, scene, given)
