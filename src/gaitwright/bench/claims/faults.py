"""Claim: what breaks is noticed, named and answered; robots in order raise no alarm; what is off is borne.

Each kind of fault is tried from many starts, which differ in leg, joint and moment, half of them in a trot,
half in a walk. It is noticed where leg, joint and kind are named within a quarter of a second after it made a
difference: a motor that dies while it gives next to nothing shows only later. It is safe where the body, in
truth, neither tips over nor is thrown up, sinks slower than 1 m/s, and the motors are off at the end.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from gaitwright.bench.claims.walks import failure
from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, at_most, count
from gaitwright.bench.trial import Outcome, Trial, robot_named
from gaitwright.bench.witness import Change
from gaitwright.plant.faults import Breakdown
from gaitwright.plant.imperfections import LEGGED_GYM, Imperfections
from gaitwright.plant.names import FAULTS, JOINTS, OF_A_JOINT, OF_A_LEG
from gaitwright.session import Push
from gaitwright.skills.library import skill_names

NOTE = "noticed: named within 0.25 s after it shows"
GAITS = (("trot", 0.4), ("walk", 0.25))
"""[m/s]"""
STARTS = 20
BEGINS, SPREAD = 2.0, 0.8
"""A fault begins within so long after this time [s]."""
AFTER = 2.0
"""Watched for so long after it began [s]."""
SOON = 0.25
"""[s]"""
NOTICED, SAFE = 0.95, 0.90
"""Shares that are wanted."""
ROBUST_SECONDS = 10.0
ROBUST: dict[str, dict[str, object]] = {
    "3 kg on the back": {"change": Change(payload=3.0)},
    "20 % lighter than known": {"change": Change(mass=0.8)},
    "friction 0.2": {"scene": "slippery:0.2"},
    "half the torque": {"change": Change(torque=0.5)},
    **{f"readings {k} ticks late": {"imperfections": Imperfections(late=k)} for k in range(1, 7)},
    "the noise of legged_gym": {"imperfections": LEGGED_GYM},
    "all encoders off by 0.02 rad": {"imperfections": Imperfections(angle_bias=0.02)},
    "attitude off by 3°": {"imperfections": Imperfections(attitude_bias=float(np.radians(3.0)))},
}
TERRAINS = ("stairs:0.1", "rough:0.05", "ramp:15", "gap:0.15", "slippery:0.2", "cross-slope:10")


def measure(context: Context) -> Iterator[Figure]:
    """Faults, kind by kind; healthy robots; robots that are not quite what they seem."""
    for kind in FAULTS:
        yield from broken(context, kind)
    yield false_alarms(context)
    for what, asked in ROBUST.items():
        for skill, speed in GAITS:
            yield borne(context, what, asked, skill, speed)


# --- faults ----------------------------------------------------------------------------------------
def broken(context: Context, kind: str) -> Iterator[Figure]:
    """How many faults of a kind were noticed, and how many were safe."""
    trials = [trial_of(kind, seed) for seed in context.seeds(STARTS, quick=4)]
    outcomes = context.outcomes(f"fault {kind}", trials)
    shows = [(t, o) for t, o in zip(trials, outcomes, strict=True) if o.seen and o.seen.shown]
    delays = [delay(trial, outcome) for trial, outcome in shows]
    good = sum(late is not None and late <= SOON for late in delays)
    named = sorted(late for late in delays if late is not None)
    note = f"within {named[-1]:.2f} s, half of them within {named[len(named) // 2]:.2f} s" if named else ""
    note += f"; {len(trials) - len(shows)} made no difference" if len(shows) < len(trials) else ""
    wrong = [missed(t, o) for (t, o), late in zip(shows, delays, strict=True) if late is None or late > SOON]
    note += f"; {wrong[0]}" if wrong else ""
    yield count(f"{kind}: noticed and named", good, len(shows), NOTICED, note, {"delays_s": delays})
    safe = [is_safe(outcome) for outcome in outcomes]
    worst = "".join(f"; {why(o)}" for o, fine in zip(outcomes, safe, strict=True) if not fine)[:120]
    sinks = max(o.seen.sinks for o in outcomes if o.seen)
    each = {"each": [o.plain() for o in outcomes]}
    yield count(
        f"{kind}: safe", sum(safe), len(trials), SAFE, f"sinks by {sinks:.2f} m/s at most{worst}", each
    )


def trial_of(kind: str, seed: int, robot: str = "go2") -> Trial:
    """The start of that seed: leg, joint and moment are drawn from it."""
    draw, legs = np.random.default_rng([seed, 7]), robot_named(robot).n
    leg, joint, share = int(draw.integers(legs)), int(draw.integers(len(JOINTS))), float(draw.uniform())
    skill, speed = GAITS[seed % len(GAITS)]
    one = Breakdown(
        kind,
        leg if kind in OF_A_LEG + OF_A_JOINT else None,
        joint if kind in OF_A_JOINT else None,
        BEGINS + SPREAD * share,
    )
    return Trial(robot, "flat", one.at + AFTER, seed, skill, speed, faults=(one,), lowers=True)


def delay(trial: Trial, outcome: Outcome) -> float | None:
    """From when a fault showed until it was named [s]; `None` where it was not, or as something else."""
    if not outcome.report.faults or not outcome.seen:
        return None
    told, broken = outcome.report.faults[0], trial.faults[0].names(robot_named(trial.robot))
    if (told["kind"], told["leg"], told["joint"]) != broken:
        return None
    return max(0.0, told["noticed"] - outcome.seen.shown[0])


def is_safe(outcome: Outcome) -> bool:
    """Whether nothing was hurt."""
    return outcome.seen is not None and outcome.seen.safe and not outcome.report.falls


def missed(trial: Trial, outcome: Outcome) -> str:
    """What was broken, and what was said."""
    one = trial.faults[0]
    broken = ":".join(filter(None, one.names(robot_named(trial.robot))))
    told = outcome.report.faults[0]["sentence"] if outcome.report.faults else outcome.report.stopped_because
    return f"seed {trial.seed}, {broken}@{one.at:.2f}: {told}"


def why(outcome: Outcome) -> str:
    """What was not safe."""
    seen, report = outcome.seen, outcome.report
    if seen is None or report.falls:
        return f"seed {report.seed}: {report.stopped_because}"
    return f"seed {report.seed}: leaned {seen.lean:.0f}°, sank by {seen.sinks:.2f} m/s"


# --- robots in order -------------------------------------------------------------------------------
def false_alarms(context: Context) -> Figure:
    """How many healthy runs named a fault."""
    trials = healthy(context.seeds(4, quick=1))
    outcomes = context.outcomes("robots in order", trials)
    alarms = [(t, o.report.faults[0]) for t, o in zip(trials, outcomes, strict=True) if o.report.faults]
    note = "".join(f"{t.name} {t.skill} on {t.scene}, seed {t.seed}: {f['sentence']}; " for t, f in alarms)
    what = "robots in order that raised an alarm: skills, terrains, pushes, other masses, noise, delay"
    numbers = {"alarms": [{"trial": repr(trial), "fault": fault} for trial, fault in alarms]}
    return Figure(
        what, float(len(alarms)), f"of {len(trials)}", at_most(0.0), len(trials), note[:200], numbers
    )


def healthy(seeds: Sequence[int]) -> list[Trial]:
    """Robots in order in all that they do: every skill, terrain, push and imperfection."""
    found = [Trial("go2", "flat", 6.0, seed, name, None, None) for seed in seeds for name in skill_names(4)]
    found += [Trial("hexapod", "flat", 6.0, seed, "tripod", None, None) for seed in seeds]
    for seed in seeds:
        for skill, speed in GAITS:
            found += [Trial("go2", scene, 12.0, seed, skill, None, None) for scene in TERRAINS]
            for asked in ROBUST.values():
                found.append(with_change(asked, skill, speed, seed, 6.0))
        for impulse, direction in ((1.5, 90.0), (1.5, -90.0), (2.0, 0.0)):
            push = Push(impulse, direction, 2.0, (seed % 8) / 8)
            found.append(Trial("go2", "flat", 6.0, seed, "trot", 0.4, push=push))
    return found


# --- robots that are not what they seem ------------------------------------------------------------
def borne(context: Context, what: str, asked: dict[str, object], skill: str, speed: float) -> Figure:
    """How many starts with something off went to their end."""
    seconds = context.seconds(ROBUST_SECONDS, 4.0)
    trials = [with_change(asked, skill, speed, seed, seconds) for seed in context.seeds(STARTS)]
    name = f"go2 {skill} {speed:g} m/s, {what}: {seconds:g} s without a fall"
    outcomes = context.outcomes(name, trials)
    good, every = sum(o.kept_up for o in outcomes), [o.plain() for o in outcomes]
    return count(name, good, len(outcomes), 1.0, failure(outcomes), {"each": every})


def with_change(asked: dict[str, object], skill: str, speed: float, seed: int, seconds: float) -> Trial:
    """A start with something off."""
    own = {"scene": "flat", **asked}
    return Trial("go2", seconds=seconds, seed=seed, skill=skill, speed=speed, **own)  # pyright: ignore
