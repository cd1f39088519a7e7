"""Teachers who go by places of numbers, comparisons, exceptions, momentum and habit.

Units: slope, 'off the path' and 'direction' in degrees; lengths of the ground in body heights; 'remaining'
and 'obstacle' in body lengths; speeds in m/s.
"""

import numpy as np

from gaitwright.bench.teachers.conditions import Doing, at_least, between, less_than, over, rule, size, under
from gaitwright.bench.teachers.kinds import BenchTeacher, RuleList
from gaitwright.bench.teachers.met import met_quantile
from gaitwright.bench.teachers.random_lists import until_balanced


def round_places() -> BenchTeacher:
    """Kind 1."""
    return RuleList(
        "round places",
        "One threshold per situation, all of them at round places.",
        True,
        rules=(
            rule("stop", under("remaining", 0.5)),
            rule("turn-in-place", size("off the path", 60.0)),
            rule("turn-left", over("off the path", 15.0)),
            rule("turn-right", under("off the path", -15.0)),
            rule("bound", over("gap", 0.4)),
            rule("climb", over("slope", 8.0)),
            rule("descend", under("slope", -8.0)),
            rule("creep", over("roughness", 0.1)),
            rule("creep", under("obstacle", 2.0)),
            rule("walk", under("possible", 0.5)),
            rule("trot", under("possible", 1.2)),
        ),
        otherwise="run",
    )


def odd_places(draw: np.random.Generator) -> BenchTeacher:
    """Kind 2."""

    def any_place(name: str, low: float = 0.1, high: float = 0.9) -> float:
        return met_quantile(name, float(draw.uniform(low, high)))

    def one() -> RuleList:
        calm = any_place("sway", 0.5)
        what = "One threshold per situation, drawn anywhere in what is met."
        return RuleList(
            "odd places",
            what,
            True,
            rules=(
                rule("stop", under("remaining", any_place("remaining", 0.1, 0.3))),
                rule("turn-in-place", size("off the path", float(draw.uniform(1.0, 60.0)))),
                rule("climb", over("slope", any_place("slope", 0.55))),
                rule("descend", under("slope", any_place("slope", 0.1, 0.45))),
                rule(
                    "creep", over("step up", any_place("step up")), over("sway", any_place("sway", 0.1, 0.6))
                ),
                rule("recover", over("sway", calm)),
                rule("pace", over("effort", any_place("effort"))),
                rule("walk", under("wished", any_place("wished"))),
                rule("trot", under("possible", any_place("possible"))),
                rule("walk", over("points left", any_place("points left", 0.5))),
            ),
            otherwise="run",
        )

    return until_balanced(one)


def headway() -> BenchTeacher:
    """Kind 3."""
    return RuleList(
        "headway",
        "Compares a way with so many times the speed, and the wished speed with the speed.",
        True,
        rules=(
            rule("stop", less_than("remaining", 2.3, "speed")),
            rule("creep", less_than("obstacle", 8.5, "speed")),
            rule("turn-in-place", size("off the path", 35.0), under("speed", 0.35)),
            rule("sidestep", size("off the path", 22.0)),
            rule("walk", less_than("remaining", 13.0, "speed")),
            rule("gallop", at_least("wished", 2.9, "speed"), over("possible", 1.35)),
            rule("run", at_least("wished", 2.9, "speed"), over("possible", 0.55)),
            rule("walk", less_than("wished", 1.15, "speed")),
        ),
        otherwise="trot",
    )


def exceptions() -> BenchTeacher:
    """Kind 4."""
    hill, astray, eager = size("slope", 3.5), size("off the path", 14.0), over("wished", 1.25)
    return RuleList(
        "but unless except",
        "Exceptions to exceptions, three levels deep.",
        True,
        rules=(
            rule("turn-in-place", size("off the path", 75.0), over("speed", 0.17)),
            rule("sidestep", over("speed", 0.17), astray),
            rule("turn-in-place", astray),
            rule("pace", over("remaining", 27.0), over("effort", 0.38), over("wished", 0.7), hill),
            rule("walk", over("effort", 0.38), over("wished", 0.7), hill),
            rule("bound", over("wished", 0.7), hill),
            rule("walk", hill),
            rule("run", under("sway", 0.022), over("feet down", 0.6), eager),
            rule("walk", over("feet down", 0.6), eager),
            rule("run", eager),
            rule("creep", over("roughness", 0.07)),
        ),
        otherwise="trot",
    )


def momentum() -> BenchTeacher:
    """Kind 5, by numbers."""
    return RuleList(
        "momentum",
        "Goes on turning, or at its speed, down to a lower bound than it begins at.",
        True,
        rules=(
            rule("turn-in-place", size("off the path", 6.0), over("turning", 0.5)),
            rule("turn-in-place", size("off the path", 40.0)),
            rule("stop", under("speed", 0.09), under("wished", 0.28)),
            rule("stop", under("remaining", 0.25)),
            rule("gallop", over("speed", 0.85), over("possible", 0.75)),
            rule("gallop", over("possible", 1.62)),
            rule("trot", over("speed", 0.24), over("possible", 0.21)),
            rule("trot", over("possible", 0.93)),
        ),
        otherwise="walk",
    )


def habit() -> BenchTeacher:
    """Kind 5, by what it has been doing."""
    return RuleList(
        "habit",
        "Goes on with what it has been doing until a lower bound ('doing' is a condition).",
        True,
        rules=(
            rule("recover", over("sway", 0.22)),
            rule("turn-in-place", size("off the path", 9.0), Doing(("turning", "standing"))),
            rule("turn-in-place", size("off the path", 55.0)),
            rule("pace", size("off the path", 18.0)),
            rule("bound", over("possible", 0.65), Doing(("flying",))),
            rule("bound", over("possible", 1.7)),
            rule("trot", over("possible", 0.26), Doing(("trotting", "flying"))),
            rule("trot", over("possible", 1.05), under("effort", 0.58)),
            rule("creep", under("possible", 0.145)),
        ),
        otherwise="walk",
    )


def strange_looks() -> BenchTeacher:
    """Kind 6."""
    return RuleList(
        "strange looks",
        "Looks at numbers that hardly anybody would think of.",
        True,
        rules=(
            rule("creep", at_least("wished", 1.0, "possible", 0.34)),
            rule("recover", over("effort", 0.66)),
            rule("pronk", under("effort", 0.31), under("feet down", 0.6)),
            rule("sidestep", over("direction", 127.0)),
            rule("sidestep", under("direction", -168.0)),
            rule("run", over("familiar", 0.5)),
            rule("pace", between("direction", -63.0, -9.0), under("remaining", 31.0)),
            rule("gallop", between("remaining", 37.0, 71.0)),
            rule("walk", at_least("speed", 1.0, "wished", -0.04)),
            rule("bound", over("points left", 2.5), over("sway", 0.03)),
        ),
        otherwise="trot",
    )
