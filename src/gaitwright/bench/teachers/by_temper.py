"""Teachers who slip, change their mind, weigh, count, or attend to what is rare.

Units: slope, 'off the path' and 'direction' in degrees; lengths of the ground in body heights; 'remaining'
and 'obstacle' in body lengths; speeds in m/s.
"""

from dataclasses import replace

import numpy as np

from gaitwright.bench.teachers.conditions import Rule, between, over, rule, size, under
from gaitwright.bench.teachers.kinds import BenchTeacher, Counting, RuleList, Weighing
from gaitwright.bench.teachers.met import made_up_moments


def slowest_allowed(seed: int) -> BenchTeacher:
    """Kind 7."""
    caps = {
        "creep": (over("roughness", 0.115), under("obstacle", 1.9), over("sway", 0.31), size("slope", 17.5)),
        "walk": (
            over("roughness", 0.066),
            under("obstacle", 3.6),
            over("sway", 0.13),
            size("slope", 9.5),
            under("wished", 0.22),
        ),
        "trot": (size("off the path", 33.0), over("sway", 0.062), size("slope", 4.2), under("wished", 0.9)),
        "run": (size("off the path", 4.0), over("effort", 0.47), under("wished", 1.45)),
    }
    rules = tuple(rule(gait, cap) for gait, found in caps.items() for cap in found)
    return RuleList(
        "slipping",
        "Each number allows a top gait, the slowest counts; 5 % slips.",
        True,
        seed,
        0.05,
        rules=rules,
        otherwise="gallop",
    )


def changed_mind() -> BenchTeacher:
    """Kind 8."""

    def rules(after: bool) -> tuple[Rule, ...]:
        return (
            rule("stop", under("remaining", 0.42)),
            rule("turn-in-place", size("off the path", 78.0 if after else 38.0)),
            rule("recover", over("effort", 0.61) if after else over("sway", 0.16)),
            rule("climb", over("slope", 2.6 if after else 7.1)),
            rule("descend", under("slope", -8.8)),
            rule("sidestep", size("off the path", 11.0)),
            rule("creep", over("roughness", 0.058)),
            rule("run", over("wished", 1.64)),
            rule("trot", over("wished", 1.02 if after else 0.55)),
        )

    return RuleList(
        "changed mind",
        "At lesson 400 some thresholds move and one skill gets another use.",
        True,
        rules=rules(False),
        later=rules(True),
        otherwise="walk",
    )


def weighing(draw: np.random.Generator) -> BenchTeacher:
    """Kind 10."""
    looks = (
        ("wished", False, 0.75),
        ("effort", False, -0.6),
        ("sway", False, -0.7),
        ("slope", True, -0.8),
        ("remaining", False, 0.5),
        ("speed", False, 0.5),
        ("off the path", True, -0.6),
    )
    weights = tuple((n, by_size, w * float(draw.uniform(0.7, 1.4))) for n, by_size, w in looks)
    plain = Weighing(
        "weighing",
        "A weighted sum of seven standardised numbers, cut in bands.",
        False,
        weights=weights,
        cuts=(0.0,),
        bands=("walk", "run"),
    )
    columns = made_up_moments()
    rows = zip(*(columns[n].tolist() for n, _, _ in looks), strict=True)
    sums = [sum(plain.parts({n: v for (n, _, _), v in zip(looks, row, strict=True)})) for row in rows]
    levels = np.array([0.1, 0.32, 0.6, 0.83]) + draw.uniform(-0.04, 0.04, 4)
    return replace(
        plain,
        cuts=tuple(np.quantile(sums, levels).tolist()),
        bands=("creep", "walk", "trot", "run", "gallop"),
    )


def careful_operator() -> BenchTeacher:
    """Kind 11."""
    return RuleList(
        "careful operator",
        "Arrival, path, stumbles, hills, broken ground, obstacles, speed.",
        True,
        rules=(
            rule("stop", over("arrived", 0.5)),
            rule("stop", under("remaining", 0.35)),
            rule("turn-in-place", size("off the path", 48.0)),
            rule("recover", over("sway", 0.2), over("speed", 0.11)),
            rule("walk", over("sway", 0.12)),
            rule("climb", over("slope", 7.5)),
            rule("climb", over("step up", 0.12)),
            rule("descend", under("slope", -6.5)),
            rule("descend", over("step down", 0.14)),
            rule("creep", over("roughness", 0.052)),
            rule("sidestep", under("obstacle", 3.2)),
            rule("walk", under("possible", 0.33)),
            rule("trot", under("possible", 1.1)),
        ),
        otherwise="run",
    )


def rare_but_important() -> BenchTeacher:
    """Kind 12."""
    return RuleList(
        "rare",
        "Plain gaits; important exceptions in 1 to 2 % of moments each.",
        True,
        rules=(
            rule("climb", over("step up", 0.6)),
            rule("pronk", over("gap", 0.77)),
            rule("recover", over("effort", 0.87)),
            rule("stop", under("obstacle", 0.95)),
            rule("descend", under("slope", -15.9)),
            rule("turn-in-place", size("off the path", 27.0)),
            rule("gallop", over("possible", 1.3), under("effort", 0.52)),
            rule("trot", over("wished", 0.5)),
        ),
        otherwise="walk",
    )


def lopsided() -> BenchTeacher:
    """Kind 13."""
    return RuleList(
        "lopsided",
        "Signed bands around zero, not alike on both sides.",
        True,
        rules=(
            rule("turn-in-place", under("off the path", -64.0)),
            rule("turn-in-place", over("off the path", 97.0)),
            rule("turn-right", under("off the path", -19.0)),
            rule("turn-left", over("off the path", 7.5)),
            rule("climb", over("slope", 4.3)),
            rule("descend", under("slope", -11.2)),
            rule("creep", under("slope", -2.2)),
            rule("sidestep", between("off the path", -4.4, -1.3)),
            rule("pace", between("direction", -130.0, -12.0)),
            rule("walk", between("direction", 24.0, 171.0)),
            rule("walk", between("slope", 0.6, 4.3)),
        ),
        otherwise="trot",
    )


def counting_worries() -> BenchTeacher:
    """Kind 14: the same skill follows from many different pairs of mild thresholds."""
    return Counting(
        "worries",
        "Counts how many of four mild worries there are: the more, the slower.",
        True,
        rules=(rule("turn-in-place", size("off the path", 65.0)),),
        worries=(over("sway", 0.041), size("slope", 2.8), over("effort", 0.43), under("wished", 1.16)),
        gaits=("gallop", "run", "trot", "creep"),
    )
