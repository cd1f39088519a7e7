"""Exams: is a rulebook right where nobody taught it, and what does one correction do? (no physics)"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gaitwright.knowledge.forest import replace_value
from gaitwright.knowledge.rules import Rulebook
from gaitwright.learning.apprentice import corrected, step_of
from gaitwright.learning.critic import DecisionPoint
from gaitwright.learning.teacher import Teacher
from gaitwright.learning.trips import EXAM, trips
from gaitwright.model.robot import Robot
from gaitwright.skills.situation import FOREST, named

ASIDE = ("feet down", "remaining", "points left", "effort", "direction", "familiar", "speed", "wished")
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


def right_share(rulebook: Rulebook, teacher: Teacher, moments: Sequence[DecisionPoint]) -> float:
    """Share of the moments at which the rules do what the teacher would."""
    return float(np.mean([is_right(rulebook, teacher, moment) for moment in moments]))


def is_right(rulebook: Rulebook, teacher: Teacher, moment: DecisionPoint) -> bool:
    """Whether the rules do what the teacher would."""
    return step_of(rulebook, moment).action == teacher.ideal(moment.raw).action


def firm_share(rulebook: Rulebook) -> float:
    """Share of the trees, over all rules that may fire, in which upper and lower mark meet."""
    met = [marks.upper == marks.lower for rule in rulebook.rules if rule.may_fire for marks in rule.marks]
    return float(np.mean(met)) if met else 0.0


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


def faults(rulebook: Rulebook, teacher: Teacher, moments: Sequence[DecisionPoint]) -> list[DecisionPoint]:
    """The moments at which a teacher would correct the rules."""
    return [m for m in moments if teacher.judge(step_of(rulebook, m).action, m.raw) is not None]


def trial(
    rulebook: Rulebook,
    teacher: Teacher,
    fault: DecisionPoint,
    pool: Sequence[DecisionPoint],
    rng: np.random.Generator,
) -> Trial:
    """One fault corrected once, then looked at again in other circumstances, and at all earlier moments."""
    wrong = step_of(rulebook, fault).action
    correction = teacher.judge(wrong, fault.raw)
    assert correction is not None, "a fault is what the teacher corrects"
    unseen = [v for v in variants(teacher, fault, pool, rng) if step_of(rulebook, v).action == wrong]
    earlier = [moment for moment in pool if is_right(rulebook, teacher, moment)]
    after = corrected(rulebook, fault, correction).rulebook
    return Trial(
        fault,
        len(unseen),
        sum(is_right(after, teacher, variant) for variant in unseen),
        len(earlier),
        sum(not is_right(after, teacher, moment) for moment in earlier),
    )


def variants(
    teacher: Teacher,
    fault: DecisionPoint,
    pool: Sequence[DecisionPoint],
    rng: np.random.Generator,
    n: int = 20,
) -> list[DecisionPoint]:
    """The same fault in other circumstances: what the teacher does not go by is taken from other moments, the
    rest varies a little; only such at which she would clearly do the same."""
    right, found = teacher.ideal(fault.raw), []
    for k in rng.permutation(len(pool))[: 3 * n].tolist():
        raw = {
            name: value * float(rng.uniform(1.0 - JITTER, 1.0 + JITTER)) for name, value in fault.raw.items()
        }
        raw |= {name: fault.raw[name] for name in ("arrived", "turning")}
        raw |= {name: pool[k].raw[name] for name in ASIDE}
        shown = teacher.ideal(raw)
        if not shown.clear or shown.action != right.action:
            continue
        situation = replace_value(FOREST, named(raw), "doing", str(fault.situation["doing"]))
        found.append(DecisionPoint(f"{fault.id}, variant {k}", situation, raw, fault.memory))
    return found[:n]
