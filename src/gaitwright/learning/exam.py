"""Exams: is a pupil right where nobody taught her, and what does one correction do? (no physics)"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gaitwright.knowledge.forest import replace_value
from gaitwright.knowledge.memory import Action
from gaitwright.learning.decision_point import DecisionPoint
from gaitwright.learning.skill_pupil import SkillPupil, told_at
from gaitwright.learning.teacher import Teacher
from gaitwright.learning.trips import EXAM, trips
from gaitwright.model.robot import Robot
from gaitwright.skills.situation import FOREST, named

ASIDE = (
    *("feet down", "front feet", "hind feet", "left feet", "right feet", "effort", "speed", "wished"),
    *("remaining", "points left", "direction", "direction at the start", "direction at the end", "familiar"),
)
"""Numbers that vary freely from variant to variant of one fault."""
JITTER = 0.05
"""All other numbers vary by this share."""


def held_out(robot: Robot, teacher: Teacher, seed: int, n: int = 200) -> tuple[DecisionPoint, ...]:
    """Moments to be examined on, from trips in scenes that no school has seen; at most eight of a trip."""
    found: list[DecisionPoint] = []
    for trip in trips(robot, teacher, EXAM * 1000 + seed):
        rng = np.random.default_rng([seed, len(found), 8])
        picked = sorted(rng.choice(len(trip), min(8, len(trip)), replace=False).tolist())
        found += [trip[k] for k in picked]
        if len(found) >= n:
            break
    return tuple(found[:n])


@dataclass(frozen=True, slots=True)
class Result:
    """What came of an exam, as shares of its moments."""

    right: float
    sure: float
    wrong_while_sure: float


def examined(pupil: SkillPupil, teacher: Teacher, moments: Sequence[DecisionPoint]) -> Result:
    """How a pupil does at moments that nobody taught her."""
    right = rights(pupil, teacher, moments)
    sure = np.array([choice.sure for choice in pupil.choose_all(moments)])
    return Result(float(right.mean()), float(sure.mean()), float((sure & ~right).mean()))


def rights(pupil: SkillPupil, teacher: Teacher, moments: Sequence[DecisionPoint]) -> np.ndarray:
    """Whether the pupil would do what the teacher would, moment by moment."""
    done = pupil.choose_all(moments)
    wanted = [pupil.learned(teacher.ideal(moment.facts).action) for moment in moments]
    return np.array([choice.action == action for choice, action in zip(done, wanted, strict=True)])


# --- one correction --------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class Trial:
    """What one correction did."""

    moment: DecisionPoint
    variants: int
    """Unseen variants of the fault, at which the rules were wrong in the same way."""
    mended: int
    """Of these, right afterwards."""
    earlier: int
    """Earlier moments at which the rules were right."""
    broken: int
    """Of these, wrong afterwards."""


def faults(pupil: SkillPupil, teacher: Teacher, moments: Sequence[DecisionPoint]) -> list[DecisionPoint]:
    """The moments at which a teacher would correct the rules."""
    right = rights(pupil, teacher, moments)
    return [moment for moment, is_right in zip(moments, right, strict=True) if not is_right]


def trial(
    pupil: SkillPupil,
    teacher: Teacher,
    fault: DecisionPoint,
    pool: Sequence[DecisionPoint],
    rng: np.random.Generator,
) -> Trial:
    """One fault corrected once, then looked at again in other circumstances, and at all earlier moments; the
    pupil herself is left as she was."""
    drawn = variants(teacher, fault, pool, rng)
    unseen = alike(pupil, drawn, pupil.choose(fault).action)
    before = rights(pupil, teacher, pool)
    after = pupil.copied()
    after.hear(told_at(fault, teacher.ideal(fault.facts), "the fault"))
    still = rights(after, teacher, pool)
    mended = int(rights(after, teacher, unseen).sum()) if unseen else 0
    return Trial(fault, len(unseen), mended, int(before.sum()), int((before & ~still).sum()))


def alike(pupil: SkillPupil, moments: Sequence[DecisionPoint], wrong: Action | None) -> list[DecisionPoint]:
    """The moments at which a pupil makes a certain mistake."""
    done = pupil.choose_all(moments)
    return [moment for moment, choice in zip(moments, done, strict=True) if choice.action == wrong]


def variants(
    teacher: Teacher,
    fault: DecisionPoint,
    pool: Sequence[DecisionPoint],
    rng: np.random.Generator,
    n: int = 20,
) -> list[DecisionPoint]:
    """The same fault in other circumstances: what the teacher does not go by is taken from other moments, the
    rest varies a little; only such at which she would do the same."""
    right, found = teacher.ideal(fault.facts), []
    for k in rng.permutation(len(pool))[: 3 * n].tolist():
        raw = {
            name: value * float(rng.uniform(1.0 - JITTER, 1.0 + JITTER)) for name, value in fault.raw.items()
        }
        raw |= {name: fault.raw[name] for name in ("arrived", "turning")}
        raw |= {name: pool[k].raw[name] for name in ASIDE}
        situation = replace_value(FOREST, named(raw), "doing", str(fault.situation["doing"]))
        variant = DecisionPoint(f"{fault.id}, variant {k}", situation, raw, fault.memory)
        if teacher.ideal(variant.facts).action == right.action:
            found.append(variant)
    return found[:n]
