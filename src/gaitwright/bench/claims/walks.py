"""Claim: Go2 trots and walks for a minute without a fall, at the speed asked for, with its body level."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import ceil, degrees, isnan

from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, at_most, count
from gaitwright.bench.trial import Outcome, Trial, robot_named
from gaitwright.control.numerical import Method
from gaitwright.record.metrics import SETTLED
from gaitwright.skills.library import find_skill, gait_of


@dataclass(frozen=True)
class Walk:
    """A skill held for a time from many starts, and what is wanted of it."""

    robot: str
    skill: str
    speed: float
    """[m/s]"""
    seconds: float
    starts: int
    scene: str = "flat"
    turn: float = 0.0
    """[rad/s]"""
    method: Method = "qp"
    plant: str = "mujoco"
    least: float | None = 1.0
    """Share of the starts that must go to the end without a fall; `None` where it is only shown."""
    velocity: float | None = None
    """Largest velocity error in any start [m/s]."""
    roll: float | None = None
    """Largest spread of the roll angle in any start [°]."""
    yaw_rate: float | None = None
    """Largest error of the yaw rate in any start [rad/s]."""

    @property
    def what(self) -> str:
        """What it does, in words."""
        moves = f" {self.speed:g} m/s" if self.speed else f" {self.turn:g} rad/s" if self.turn else ""
        where = "" if self.scene == "flat" else f" on {self.scene}"
        how = " by LP" if self.method == "lp" else ""
        how += " on the Armstrong plant" if self.plant == "armstrong" else ""
        return f"{self.robot} {self.skill}{moves}{where}{how}"

    @property
    def settled(self) -> float:
        """From when on there is a velocity error [s]: the skill has settled, and another cycle is over."""
        robot = robot_named(self.robot)
        return (SETTLED + 1) * gait_of(find_skill(self.skill, robot), robot).period

    def trial(self, seed: int, seconds: float) -> Trial:
        """The start of that seed."""
        return Trial(
            self.robot,
            self.scene,
            seconds,
            seed,
            self.skill,
            self.speed,
            self.turn,
            method=self.method,
            plant=self.plant,
        )


WALKS = (
    Walk("go2", "trot", 0.4, seconds=60.0, starts=20, velocity=0.02, roll=2.5),
    Walk("go2", "walk", 0.25, seconds=60.0, starts=20, velocity=0.02, roll=2.5),
)


def measure(context: Context) -> Iterator[Figure]:
    """The figures of Go2's walks on flat ground."""
    return measure_walks(context, WALKS)


def measure_walks(context: Context, walks: Sequence[Walk]) -> Iterator[Figure]:
    """The figures of some walks, each from its starts."""
    for walk in walks:
        seconds = context.seconds(walk.seconds, float(ceil(1.3 * walk.settled)))
        trials = [walk.trial(seed, seconds) for seed in context.seeds(walk.starts)]
        yield from figures(walk, seconds, context.outcomes(walk.what, trials))


def figures(walk: Walk, seconds: float, outcomes: Sequence[Outcome]) -> Iterator[Figure]:
    """The figures of one walk: falls first, then the worst start of each error that has a bound."""
    starts, good = len(outcomes), sum(outcome.kept_up for outcome in outcomes)
    note = failure(outcomes) or spread(outcomes)
    each = {"each": [outcome.plain() for outcome in outcomes]}
    yield count(f"{walk.what}: {seconds:g} s without a fall", good, starts, walk.least, note, each)
    steady = all(outcome.report.duration_s >= walk.settled for outcome in outcomes)
    unknown = float("nan")
    for what, values, unit, bound in (
        (
            "velocity error",
            [o.report.velocity_error_mps if steady else unknown for o in outcomes],
            "m/s",
            walk.velocity,
        ),
        ("roll std", [degrees(o.report.roll_std_rad) for o in outcomes], "°", walk.roll),
        (
            "yaw rate error",
            [o.report.yaw_rate_error_radps if steady else unknown for o in outcomes],
            "rad/s",
            walk.yaw_rate,
        ),
    ):
        if bound is not None:
            yield worst(f"{walk.what}: {what}, worst start", values, unit, bound)


def worst(what: str, values: Sequence[float], unit: str, bound: float) -> Figure:
    """The largest of the errors of all starts; NaN where a start was too short to have one."""
    if any(isnan(value) for value in values):
        why = "a start ended before the gait was steady"
        return Figure(what, float("nan"), unit, at_most(bound), len(values), why)
    note = f"mean {sum(values) / len(values):.3g}"
    return Figure(what, max(values), unit, at_most(bound), len(values), note, {"values": values})


def failure(outcomes: Sequence[Outcome]) -> str:
    """Why the first start that failed did so, with its seed."""
    failed = [outcome.report for outcome in outcomes if not outcome.kept_up]
    return f"seed {failed[0].seed}: {failed[0].stopped_because}" if failed else ""


def spread(outcomes: Sequence[Outcome]) -> str:
    """Mean velocity error, roll and cost of transport over the starts."""
    reports, starts = [outcome.report for outcome in outcomes], len(outcomes)
    error = sum(report.velocity_error_mps for report in reports) / starts
    roll = degrees(sum(report.roll_std_rad for report in reports)) / starts
    cost = sum(report.cost_of_transport for report in reports) / starts
    return f"velocity error {error:.4f} m/s, roll {roll:.1f}°, cost of transport {cost:.2f}"
