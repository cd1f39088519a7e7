"""A pupil who learns which skill to use: moments of trips and a teacher's words in, a rulebook out.

What she is told goes to `induction.pupil` as numbers; here are the words: which action has which place, what
the teacher calls each rule, and the situation as people speak of it.
"""

from collections.abc import Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, field, replace

import numpy as np

from gaitwright.errors import WrongUse
from gaitwright.induction.cases import NOBODY
from gaitwright.induction.pupil import STEPPED_IN, Heard, Lesson, Pupil
from gaitwright.knowledge.differences import Stage, differences
from gaitwright.knowledge.expressed import Lessons, expressed, rule_names
from gaitwright.knowledge.memory import Action, Fact
from gaitwright.knowledge.rules import Event, Instance, Rulebook
from gaitwright.knowledge.told import Given, Told
from gaitwright.learning.decision_point import DecisionPoint
from gaitwright.learning.teacher import Shown
from gaitwright.skills.situation import situation_of
from gaitwright.skills.vocabulary import VOCABULARY
from gaitwright.skills.wording import WORDING

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

    def __post_init__(self) -> None:
        self.pupil = Pupil(VOCABULARY, self.seed)

    def copied(self) -> "SkillPupil":
        """Another one who knows the same: to try out what a lesson would do."""
        other = SkillPupil(self.seed, [*self.kinds], [*self.told], {**self.scenes}, [*self.instances])
        other.pupil = deepcopy(self.pupil, {id(VOCABULARY): VOCABULARY})
        return other

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

    # --- deciding ----------------------------------------------------------------------------------
    def choose(self, moment: DecisionPoint) -> Choice:
        """What the rules do at a moment."""
        return self.choose_all([moment])[0]

    def choose_all(self, moments: Sequence[DecisionPoint]) -> list[Choice]:
        """What the rules do at many moments."""
        return self.choose_at([facts_of(moment) for moment in moments])

    def choose_at(self, facts: Sequence[Mapping[str, Fact]]) -> list[Choice]:
        """What the rules do where these facts hold, one set of them after the other."""
        if not self.told or not facts:
            return [Choice(None)] * len(facts)
        rows = np.array([VOCABULARY.row(one) for one in facts])
        places, _, sure = self.pupil.decide_all(rows.T)
        done = {a: self.as_fast_as_shown(self.kinds[a]) for a in set(places.tolist())}
        return [Choice(done[a], s) for a, s in zip(places.tolist(), sure.tolist(), strict=True)]

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
        self.instances.append(instance_of(told))
        if heard.before == heard.after:
            return Taken(heard, ())
        names = rule_names(heard.before, fire, right, before)
        stage = Stage(heard.before, np.append(fire, heard.verdict.rule), names)
        return Taken(heard, differences(stage, self.stage(), told.id, VOCABULARY, WORDING))

    def forget(self, name: str) -> tuple[Event, ...]:
        """Takes back what was told under a name; what that moved. Raises `WrongUse` where nothing was."""
        names = [told.id for told in self.told]
        if name not in names:
            last = ", ".join(names[-3:]) or "none"
            raise WrongUse(f"no lesson {name!r} that counts; the last ones are: {last}")
        k, before = names.index(name), self.stage()
        self.pupil.forget(k)
        del self.told[k], self.instances[k]
        before = replace(before, fire=np.delete(before.fire, k))
        return differences(before, self.stage(), name, VOCABULARY, WORDING)

    def note(self, told: Told) -> None:
        """Gives a new action and a new scene their places."""
        if kind_of(told.action) not in self.kinds:
            self.kinds.append(kind_of(told.action))
        self.scenes.setdefault(told.scene, len(self.scenes))

    def lesson_of(self, told: Told) -> Lesson:
        """What was told, as numbers; its action and scene have their places."""
        reason = VOCABULARY.place_of(told.about) if told.about in VOCABULARY.names else NOBODY
        row, action = VOCABULARY.row(told.facts), self.kinds.index(kind_of(told.action))
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
        pupil, taught = self.pupil, Lessons(self.instances, self.actions, [told.rule for told in self.told])
        return expressed(pupil.lines, pupil.cases, pupil.standing, VOCABULARY, WORDING, taught)


def kind_of(action: Action) -> Action:
    """What an action is, however fast: a single speed is one that was driven, and says nothing of others."""
    return replace(action, slowest=0.0, fastest=0.0) if action.slowest == action.fastest else action


def told_at(moment: DecisionPoint, shown: Shown, scene: str, given: Given = "corrected") -> Told:
    """What a teacher shows at a moment, as it is told to a pupil."""
    reason = (shown.because, shown.about)
    return Told(moment.id, facts_of(moment), shown.rule, shown.action, *reason, scene, given)


def instance_of(told: Told) -> Instance:
    """What was told, in the situation as people speak of it."""
    return Instance(told.id, "positive", situation_of(told.facts), told.facts, told.because)


def facts_of(moment: DecisionPoint) -> dict[str, float | str]:
    """The numbers of a moment and what the robot has been doing."""
    return {**moment.raw, "doing": str(moment.situation["doing"])}
