"""A pupil who learns which skill to use: moments of trips and a teacher's words in, a rulebook out.

What she is told goes to `induction.pupil` as numbers; here are the words: which action has which place, what
the teacher calls each rule, and the situation as people speak of it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from gaitwright.induction.cases import NOBODY
from gaitwright.induction.columns import Fact
from gaitwright.induction.pupil import Heard, Lesson, Pupil
from gaitwright.knowledge.expressed import Lessons, expressed
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.rules import Instance, Rulebook
from gaitwright.learning.critic import DecisionPoint
from gaitwright.learning.teacher import Shown
from gaitwright.skills.vocabulary import VOCABULARY
from gaitwright.skills.wording import WORDING


@dataclass(frozen=True, slots=True)
class Choice:
    """What a pupil would do at a moment: the action (`None` before the first lesson), and whether that is
    sure."""

    action: Action | None
    sure: bool = False


@dataclass
class SkillPupil:
    """A pupil of skills. The same words in the same order and the same seed make the same rules."""

    seed: int = 0
    pupil: Pupil = field(init=False)
    actions: list[Action] = field(default_factory=list)
    """What a teacher has shown, each action once, in the order in which they came."""
    instances: list[Instance] = field(default_factory=list)
    names: list[str] = field(default_factory=list)
    """What she called the rule, moment by moment."""
    scenes: dict[str, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.pupil = Pupil(VOCABULARY, self.seed)

    def choose(self, moment: DecisionPoint) -> Choice:
        """What the rules do at a moment."""
        return self.choose_all([moment])[0]

    def choose_all(self, moments: Sequence[DecisionPoint]) -> list[Choice]:
        """What the rules do at many moments."""
        if not self.instances:
            return [Choice(None)] * len(moments)
        rows = np.array([VOCABULARY.row(facts_of(moment)) for moment in moments])
        actions, _, sure = self.pupil.decide_all(rows.T)
        return [Choice(self.actions[a], s) for a, s in zip(actions.tolist(), sure.tolist(), strict=True)]

    def hear(self, moment: DecisionPoint, shown: Shown, scene: str) -> Heard:
        """One word of the teacher's: what is right at a moment of a scene, and the number that decided her.

        A reason that is no fact of the vocabulary counts as none.
        """
        if shown.action not in self.actions:
            self.actions.append(shown.action)
        facts = facts_of(moment)
        reason = VOCABULARY.place_of(shown.about) if shown.about in VOCABULARY.names else NOBODY
        place = self.scenes.setdefault(scene, len(self.scenes))
        self.instances.append(Instance(moment.id, "positive", moment.situation, facts, shown.because))
        self.names.append(shown.rule)
        return self.pupil.hear(Lesson(VOCABULARY.row(facts), self.actions.index(shown.action), reason, place))

    def rulebook(self) -> Rulebook:
        """What was learned, as rules over feature trees."""
        pupil, taught = self.pupil, Lessons(self.instances, self.actions, self.names)
        return expressed(pupil.lines, pupil.cases, pupil.standing, VOCABULARY, WORDING, taught)


def facts_of(moment: DecisionPoint) -> Mapping[str, Fact]:
    """The numbers of a moment and what the robot has been doing."""
    return {**moment.raw, "doing": str(moment.situation["doing"])}
