"""Claim: rules of balance that were learned from pushed runs save more of new ones than they lose."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, at_least, count
from gaitwright.bench.trial import robot_named
from gaitwright.control.balance_rules import ACTIONS, BalanceRule, BalanceRules
from gaitwright.control.learned.profile import Profile
from gaitwright.learning.balance_lessons import ANYTHING, RUNS, Lesson, counted, learned
from gaitwright.learning.balance_trials import SKILLS, Run, Trial, pushed, trial
from gaitwright.learning.profile_books import profile_of
from gaitwright.learning.profile_school import Task, learn

NEW, FIRST_NEW = 120, 50_000
"""New pushed runs, and from which number on they are counted: none of them was learned from."""
STILL, FIRST_STILL = 100, 70_000
"""And runs without a push, in five skills in turn."""
OTHER = "pace"
"""A skill that was never pushed."""
NOTE = (
    "Go2 by its learned controller in trot, walk, run and gallop in turn, pushed once by 1.0 to 2.6 N·s/kg "
    "(walk: 0.6 of it) to any side at any phase, a third of the runs on rough ground of 5 to 9 cm, all drawn "
    "from a run's number. An action is tried from the moment on at which something is off for 50 ms."
)


def measure(context: Context) -> Iterator[Figure]:
    """What each action does when it is always taken; the rules; new runs with and without them."""
    robot = robot_named("go2")
    found = context.each("profiles", learn, [Task(robot, skill, context.seed) for skill in (*SKILLS, OTHER)])
    every = {one.skill: [profile_of(notes, robot, "the bench") for notes in one.profiles] for one in found}
    profiles = {skill: every[skill] for skill in SKILLS}

    def make(trials: Sequence[Trial]) -> list[Run]:
        return context.each("pushed runs to learn from", pushed, trials)

    runs = 8 if context.quick else RUNS
    rules, lessons = learned(robot, profiles, context.seed, runs, make)
    for action in ACTIONS:
        yield always(action, lessons)
    said = [rule.sentence for rule in rules.rules]
    numbers = {"bands": dict(rules.bands), "rules": said}
    yield Figure("rules of balance learned", float(len(said)), "", None, runs, "; ".join(said), numbers)
    yield new_runs(context, profiles, rules)
    yield without_a_push(context, every, rules)


def always(action: str, lessons: Sequence[Lesson]) -> Figure:
    """What an action does where it is always taken."""
    fell = sum(one.fell for one in lessons)
    rule = counted(BalanceRule(ANYTHING, action), lessons)
    note = f"of {fell} that fell {rule.saved} saved, of the others {rule.lost} lost"
    what = f"pushed runs saved less those lost by always the same, {action}"
    return Figure(what, float(rule.saved - rule.lost), f"of {len(lessons)}", None, len(lessons), note)


def new_runs(context: Context, profiles: Mapping[str, Sequence[Profile]], rules: BalanceRules) -> Figure:
    """New pushed runs with the rules, and the same ones without any."""
    robot, numbers = robot_named("go2"), range(FIRST_NEW, FIRST_NEW + (8 if context.quick else NEW))
    trials = [trial(robot, profiles, number, replace(rules, rules=())) for number in numbers]
    off = context.each("new pushed runs without", pushed, trials)
    on = context.each("new pushed runs with", pushed, [replace(one, rules=rules) for one in trials])
    saved = sum(b.fell and not a.fell for a, b in zip(on, off, strict=True))
    lost = sum(a.fell and not b.fell for a, b in zip(on, off, strict=True))
    answered = sum(a.answered > 0 for a in on)
    stayed = sum(not b.fell for b in off)
    note = f"without them {stayed}; {saved} saved, {lost} lost; a rule was followed in {answered}"
    every = {"fell_with": [a.fell for a in on], "fell_without": [b.fell for b in off]}
    what, up = "new pushed runs that stayed up with the rules", sum(not a.fell for a in on)
    return count(what, up, len(on), stayed / len(off), note, every)


def without_a_push(
    context: Context, profiles: Mapping[str, Sequence[Profile]], rules: BalanceRules
) -> Figure:
    """Runs without a push in which no rule is followed: so they are the same with and without."""
    robot, numbers = robot_named("go2"), range(FIRST_STILL, FIRST_STILL + (8 if context.quick else STILL))
    trials = [trial(robot, profiles, number, rules, is_pushed=False) for number in numbers]
    found = context.each("runs without a push", pushed, trials)
    calm = sum(one.answered == 0 for one in found)
    note = f"{sum(one.fell for one in found)} fell"
    what = "runs without a push in which no rule is followed"
    return Figure(what, float(calm), f"of {len(found)}", at_least(float(len(found))), len(found), note)
