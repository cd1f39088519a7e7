"""Claim: the learned controller plays what it was taught, as fast and as steadily, in pushes too."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from gaitwright.bench.claims.walks import failure
from gaitwright.bench.context import Context
from gaitwright.bench.evidence.played_share import played_shares
from gaitwright.bench.measurement import Figure, at_most, count
from gaitwright.bench.trial import Outcome, Push, Then, Trial
from gaitwright.skills.library import skill_names

STARTS, SECONDS = 20, 20.0
HANDED_OVER = 2.0
"""The numerical controller drives first [s]."""
UPRIGHT = 0.98
"""Share of the starts that must go to the end."""
PUSHES = (
    ("trot", 1.2, 90.0, 40, 0.90),
    ("trot", 1.5, 90.0, 40, None),
    ("trot", 2.0, 0.0, 40, 0.95),
    ("walk", 0.8, 90.0, 20, None),
    ("gallop", 0.6, 90.0, 20, None),
)
"""Skill, impulse [N·s/kg], direction [°], starts, and the share that must survive (`None`: only shown)."""
GROUND = ("slope:15", "slope:-15", "rough:0.05")
NOTE = (
    "One profile a skill, taught at the speed that the skill is meant for, on level ground, from two starts. "
    "The numerical controller drives the first two seconds, then the learned one takes over at whatever "
    "phase the seed gives; beside it the numerical one goes on. Gains are the numerical controller's."
)
DRIVERS = ("numerical", "learned")


def measure(context: Context) -> Iterator[Figure]:
    """Every skill, from a hand-over and from standing; pushes; slopes and rough ground; what is played."""
    yield from skills(context)
    yield from standing_starts(context)
    yield from pushes(context)
    yield from grounds(context)
    yield from played_shares(context, skill_names(4))


def handed_over(skill: str, driver: str, seed: int, seconds: float, scene: str = "flat") -> Trial:
    """A skill at its own speed, driven by `driver` from some time on."""
    then = Then(skill, HANDED_OVER, driver, same_velocity=True)
    return Trial("go2", scene, seconds, seed, skill, None, None, then=then)


def both(context: Context, what: str, trials: Sequence[Trial]) -> dict[str, list[Outcome]]:
    """The same trials under either driver."""
    found = {}
    for driver in DRIVERS:
        asked = [replace(t, then=replace(t.then, driver=driver)) if t.then else t for t in trials]
        found[driver] = context.outcomes(f"{what}, {driver}", asked)
    return found


def survived(what: str, found: dict[str, list[Outcome]], least: float | None) -> Figure:
    """How many went to the end under the learned controller, beside the numerical one."""
    good = {driver: sum(o.kept_up for o in outcomes) for driver, outcomes in found.items()}
    learned = found["learned"]
    note = f"numerical {good['numerical']} of {len(learned)}"
    note += f"; {failure(learned)}" if failure(learned) else ""
    every = {driver: [o.plain() for o in outcomes] for driver, outcomes in found.items()}
    return count(what, good["learned"], len(learned), least, note, every)


def skills(context: Context) -> Iterator[Figure]:
    """Every skill from a hand-over: falls, and how far the speed is from the teacher's."""
    seconds, off = context.seconds(SECONDS, 6.0), {}
    for skill in skill_names(4):
        trials = [handed_over(skill, "learned", seed, seconds) for seed in context.seeds(STARTS)]
        found = both(context, skill, trials)
        yield survived(f"go2 {skill}: {seconds:g} s without a fall", found, UPRIGHT)
        off[skill] = 1.0 - mean_held(found["learned"]) / mean_held(found["numerical"])
    worst = max(off, key=lambda skill: abs(off[skill]))
    what = "share of the teacher's speed that is lost, the worst skill"
    yield Figure(what, 100.0 * abs(off[worst]), "%", at_most(2.0), len(off), worst)


def mean_held(outcomes: Sequence[Outcome]) -> float:
    """Share of the velocity asked for that was held, over the starts that went to the end."""
    return float(np.mean([o.held for o in outcomes if o.kept_up] or [float("nan")]))


def standing_starts(context: Context) -> Iterator[Figure]:
    """Every skill from standing, under the learned controller alone."""
    good, every, notes = 0, 0, []
    for skill in skill_names(4):
        trials = [
            Trial("go2", "flat", 6.0, seed, skill, None, None, driver="learned")
            for seed in context.seeds(STARTS)
        ]
        outcomes = context.outcomes(f"{skill} from standing", trials)
        fell = sum(not o.kept_up for o in outcomes)
        good, every = good + len(outcomes) - fell, every + len(outcomes)
        notes += [f"{skill} {fell} fell"] if fell else []
    what = "from standing under the learned controller alone, all skills"
    yield count(what, good, every, 0.95, ", ".join(notes), {})


def pushes(context: Context) -> Iterator[Figure]:
    """Pushes at phases spread over the cycle, each in both directions."""
    for skill, impulse, direction, starts, least in PUSHES:
        trials = []
        seeds = context.seeds(starts, quick=4)
        for i, seed in enumerate(seeds):
            push = Push(impulse, direction * (-1) ** i, 3.0, (i // 2) / max(1, len(seeds) // 2))
            trials.append(replace(handed_over(skill, "learned", seed, 7.5), push=push))
        way = "forward" if direction == 0.0 else "sideways"
        what = f"{skill}, pushed {impulse:g} N·s/kg {way}"
        yield survived(f"go2 {what}: survived", both(context, what, trials), least)


def grounds(context: Context) -> Iterator[Figure]:
    """Slopes and rough ground, which no profile has seen."""
    for scene in GROUND:
        for skill in ("trot", "walk"):
            trials = [handed_over(skill, "learned", s, 8.0, scene) for s in context.seeds(STARTS)]
            found = both(context, f"{skill} on {scene}", trials)
            yield survived(f"go2 {skill} on {scene}: 8 s without a fall", found, UPRIGHT)
