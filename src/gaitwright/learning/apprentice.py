"""The apprentice: watches a teacher's trip and turns it into lessons until its rules do the same (§5.4.2)."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.correction import relapses, teach
from gaitwright.knowledge.features import accept, propose_features
from gaitwright.knowledge.modifier import Inconsistency, Learned, Lesson, learn
from gaitwright.knowledge.repair import mend
from gaitwright.knowledge.restructure import Mended
from gaitwright.knowledge.rules import Event, Rulebook
from gaitwright.learning.critic import DecisionPoint, TraceStep, criticise
from gaitwright.learning.teacher import Correction, Teacher
from gaitwright.skills.book_trees import in_trees_of
from gaitwright.skills.rule_chooser import DOING, goes_on
from gaitwright.skills.situation import READ_FROM

MOST_REPAIRS = 8
"""Contradictions mended for one lesson, before it is given up."""
MOST_RECALLS = 3
"""Rounds in which what a correction made the rules forget is taught again."""


@dataclass(frozen=True, slots=True)
class LearningStep:
    """One step of a rulebook, as a ledger keeps it."""

    how: Literal["taught", "learned", "mended", "edited"]
    lesson: Lesson
    result: Learned | Mended
    """What the lesson made of the rulebook; of a new feature, `Learned` with the rulebook that has it."""


@dataclass(frozen=True, slots=True)
class Studied:
    """A rulebook after lessons: how many there were, what moved, and contradictions nobody could mend."""

    rulebook: Rulebook
    lessons: int = 0
    corrections: int = 0
    events: tuple[Event, ...] = ()
    open: tuple[Inconsistency, ...] = ()
    steps: tuple[LearningStep, ...] = ()
    """Every step from the rulebook before to this one, in order."""

    def then(self, other: "Studied") -> "Studied":
        """Both, one after the other."""
        return Studied(
            other.rulebook,
            self.lessons + other.lessons,
            self.corrections + other.corrections,
            self.events + other.events,
            self.open + other.open,
            self.steps + other.steps,
        )


def step_of(rulebook: Rulebook, moment: DecisionPoint) -> TraceStep:
    """What the rules do at a moment (algorithm C): a rule whose condition does not hold yet goes on."""
    doing = str(moment.memory.get(DOING, ""))
    for rule in rulebook.rules:
        if rule.name == doing and goes_on(rule.action, moment.situation):
            return TraceStep(moment, rule.action, doing)
    moment = in_own_trees(rulebook, moment)
    name = consult(rulebook, moment.situation).rule
    return TraceStep(moment, rulebook[name].action if name else None, name or "")


def study(rulebook: Rulebook, teacher: Teacher, moments: Sequence[DecisionPoint], passes: int = 3) -> Studied:
    """The rulebook after a trip of the teacher's was watched: the critic's lessons, one difference at a time.

    Each pass goes through the trip once: what was right is confirmed, each first difference corrected.
    """
    studied = Studied(rulebook)
    moments = [moment for moment in moments if teacher.ideal(moment.raw).clear]
    for _ in range(passes):
        before = studied.corrections
        ideal = [TraceStep(moment, teacher.ideal(moment.raw).action) for moment in moments]
        start = 0
        while start < len(moments):
            done = [step_of(studied.rulebook, moment) for moment in moments[start:]]
            found = criticise(ideal[start:], done)
            for step in found.right:
                studied = studied.then(confirmed(studied.rulebook, step))
            if found.wrong is None:
                break
            correction = teacher.judge(found.wrong.action, found.wrong.moment.raw)
            if correction is not None and not only_goes_on(found.wrong):
                studied = studied.then(corrected(studied.rulebook, found.wrong.moment, correction))
            start += found.at + 1
        if studied.corrections == before:
            break
    return studied


def only_goes_on(step: TraceStep) -> bool:
    """Whether a moment tells nothing of the trees, because what was begun before went on."""
    begun = bool(step.rule) and step.moment.memory.get(DOING) == step.rule
    return begun and goes_on(step.action, step.moment.situation)


def confirmed(rulebook: Rulebook, step: TraceStep) -> Studied:
    """The rulebook with a positive instance for the rule that was right."""
    if not step.rule or only_goes_on(step):
        return Studied(rulebook)
    moment = in_own_trees(rulebook, step.moment)
    lesson = Lesson("positive", step.rule, moment.situation, moment.id, "was right", moment.raw)
    learned = learn(rulebook, lesson)
    return Studied(learned.rulebook, 1, 0, learned.events, steps=(LearningStep("learned", lesson, learned),))


def outranked(rulebook: Rulebook, teacher: Teacher, moment: DecisionPoint) -> Studied:
    """The rulebook in which rules that could have fired too, but come later, keep out of this moment.

    What the teacher did there says that their actions were wrong. Where their marks cannot keep out, the
    order of the rules goes on doing it.
    """
    moment = in_own_trees(rulebook, moment)
    right, studied = teacher.ideal(moment.raw).action, Studied(rulebook)
    for name in consult(rulebook, moment.situation).conflict[1:]:
        rule = rulebook[name]
        correction = teacher.judge(rule.action, moment.raw) if rule.action != right else None
        if correction is None:
            continue
        blame = blame_of(rulebook, correction)
        lesson = Lesson("commission", name, moment.situation, moment.id, "was outranked", moment.raw, blame)
        learned = learn(studied.rulebook, lesson)
        if learned.trouble is None:
            taken = (LearningStep("learned", lesson, learned),)
            studied = studied.then(Studied(learned.rulebook, 1, 0, learned.events, steps=taken))
    return studied


def corrected(rulebook: Rulebook, moment: DecisionPoint, correction: Correction) -> Studied:
    """The rulebook after one correction; what was right before and no longer is, is taught again from
    memory."""
    shown, moment = correction.right, in_own_trees(rulebook, moment)
    lesson = Lesson(
        "omission",
        shown.rule,
        moment.situation,
        moment.id,
        shown.because,
        moment.raw,
        blame_of(rulebook, correction),
        shown.action,
    )
    after, trouble, steps = taught(rulebook, lesson, correction.about)
    for _ in range(MOST_RECALLS):
        forgotten = relapses(after)
        if trouble is not None or not forgotten:
            break
        for old in forgotten:
            if old.situation.trees == after.forest.names:
                after, _, more = taught(after, old, "")
                steps += more
        if step_of(after, moment).action != shown.action:
            again = replace(lesson, situation=in_own_trees(after, moment).situation)
            after, trouble, more = taught(after, again, "")
            steps += more
    events = after.events[len(rulebook.events) :]
    return Studied(after, 1, 1, events, (trouble,) if trouble is not None else (), steps)


def taught(
    rulebook: Rulebook, lesson: Lesson, about: str
) -> tuple[Rulebook, Inconsistency | None, tuple[LearningStep, ...]]:
    """The rulebook after one lesson, mended wherever it contradicts itself; the contradiction if nothing
    mends it; and the steps that were taken. `about` is the number that a new feature may be made from."""
    steps: tuple[LearningStep, ...] = ()
    for _ in range(MOST_REPAIRS):
        learned = teach(rulebook, lesson)
        rulebook, steps = learned.rulebook, (*steps, LearningStep("taught", lesson, learned))
        if learned.trouble is None:
            return rulebook, None, steps
        mended = mend(rulebook, learned.trouble, lesson.blame)
        if mended.how != "none":
            rulebook, steps = mended.rulebook, (*steps, LearningStep("mended", lesson, mended))
            continue
        grown = with_feature(rulebook, learned.trouble, about)
        if grown is None:
            return rulebook, learned.trouble, steps
        rulebook, steps = grown.rulebook, (*steps, LearningStep("edited", lesson, grown))
        value = lesson.raw.get(rulebook.forest.trees[-1].source)
        if value is None:
            return rulebook, None, steps
        leaves = {**dict(lesson.situation.items()), rulebook.forest.names[-1]: value}
        lesson = replace(lesson, situation=rulebook.forest.situation(leaves))  # pyright: ignore[reportArgumentType]
    return rulebook, None, steps


def blame_of(rulebook: Rulebook, correction: Correction) -> str:
    """The tree in which the number that a teacher names is read; empty where there is none."""
    tree = READ_FROM.get(correction.about, correction.about)
    return tree if tree in rulebook.forest.names else ""


def with_feature(rulebook: Rulebook, trouble: Inconsistency, about: str) -> Learned | None:
    """The rulebook with a new tree that resolves right and wrong in one situation (constructive induction).

    Only a number that the teacher names will do: among a few instances, chance tells almost any apart.
    """
    for proposal in propose_features(rulebook, trouble):
        if about and proposal.tree.source == about:
            learned = accept(rulebook, proposal)
            return learned if learned.trouble is None else None
    return None


def in_own_trees(rulebook: Rulebook, moment: DecisionPoint) -> DecisionPoint:
    """The moment in the rulebook's own trees: those it grew since are read from the numbers."""
    return replace(moment, situation=in_trees_of(rulebook, moment.situation, moment.raw))
