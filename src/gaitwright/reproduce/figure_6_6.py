"""Figure 6.6: the joint torques of a complete trotting cycle."""

import numpy as np

from gaitwright.description.load import load_robot
from gaitwright.reproduce.claim import Claim, Picture, Reproduction, Say
from gaitwright.reproduce.gait_claims import (
    Run,
    alternation,
    azimuth_in_swing,
    hip_in_stance,
    hip_in_swing,
    knee_in_swing,
    lift_off,
    posture,
    run_grid,
    symmetry,
)
from gaitwright.reproduce.gaits import STEPS, cycle_of, trot
from gaitwright.reproduce.patterns import (
    KNEE,
    PSI,
    THETA,
    same_instant_difference,
    time_mirror_difference,
)
from gaitwright.reproduce.torques import GIVING_WAY, POINT_FEET, cycle_torques, held_feet

PLATE = 0.5
"""Lever of the foot moments at which the heavy robot still trots [m]."""
SMOOTH = 0.01
"""Price of a change of force that keeps the solution where it is [per weight]."""

OPEN = (
    "two feet can press against each other along the line between them: the objective decides how hard, and "
    "as printed it holds all of it equal"
)

ABOUT = (
    "Duty factor 0.5, stride 3 m, 1/6 m/s, so 18 s for a cycle; body level, feet lifted 0.5 m; a value every "
    "1/8 s, the robot moving exactly as desired. The scan of the thesis has no curves: what its text says "
    "about them is judged claim by claim.",
    "Two point feet cannot balance a body whose centre is beside the line between them, and this trot keeps "
    "it there for 9 s. T (`thesis-table`, 18.8 kg) is balanced by moments on its feet, as in the thesis's "
    "program with six components a foot. P (`thesis`, 10.0 kg) has point feet: it carries its weight, and "
    "the moment about the line between its feet stays unbalanced; such a trot can only be walked faster. "
    "Held feet have no limit on their moments, as in the thesis; feet of ± 0.5 m those that flat feet give.",
)


def reproduce(say: Say) -> Reproduction:
    """The figure, with what the thesis says about it."""
    t, p = load_robot("thesis-table"), load_robot("thesis")
    runs = []
    for label, robot, settings in (
        ("T, held feet", t, held_feet()),
        ("P, point feet", p, GIVING_WAY),
        ("T, held feet, changes priced", t, held_feet()._replace(change=SMOOTH)),
        (f"T, feet of ± {PLATE:g} m", t, held_feet(PLATE)),
        ("T, point feet", t, GIVING_WAY),
        ("P, point feet, balanced", p, POINT_FEET),
        ("P, point feet, printed objective", p, GIVING_WAY._replace(literal=1.0, change=0.0)),
    ):
        say(f"{label}: {STEPS} samples")
        runs.append(Run(label, cycle_torques(robot, cycle_of(robot, trot()), settings)))
    say("swings at higher speeds")
    both = runs[:2]
    claims = [
        *posture(both[0]),
        rhythm(both[0]),
        hip_in_stance(both, "always remains in flexion", 1.0),
        lift_off(both),
        hip_in_swing(t, trot, "reverses between flexion and extension only there"),
        knee_in_swing(both),
        azimuth_in_swing(both[0], "from extension to flexion"),
        alternation(
            KNEE, both, both[1].label, "judged by point feet; T's knees are loaded one way throughout"
        ),
        alternation(PSI, [*both, runs[-1]], None, OPEN),
        at_the_limit(both[0]),
        same_instant(runs[2], both),
        time_mirror(both),
        symmetry(
            both,
            "half a cycle between any leg and its fellow on the other side",
            "so in their torques",
            "g₁(t) = g₂(t + T/2)",
        ),
    ]
    return Reproduction(
        "figure-6.6",
        "Figure 6.6: the 12 joint torques for a complete trotting cycle",
        ABOUT,
        claims,
        [run_grid(runs)],
        [picture(both)],
        {"runs": [run.plain() for run in runs]},
    )


# --- claims ----------------------------------------------------------------------------------------
def rhythm(run: Run) -> Claim:
    """The relative phases."""
    offsets = run.torques.cycle.gait.offsets
    so = offsets[0] == offsets[3] and offsets[1] == offsets[2] and abs(offsets[0] - offsets[2]) == 0.5
    return Claim(
        "relative phases",
        "none between the legs of a diagonal, half a cycle along a side",
        "so" if so else "otherwise",
        None,
        "put in, not found: no claim of ours",
    )


def at_the_limit(run: Run) -> Claim:
    """How much of the stance the heavy robot is at its limit."""
    limit = run.torques.cycle.robot.tau_max.max()
    share = float((run.g[..., THETA][run.stance] > limit - 1e-6).mean())
    return Claim(
        "τ_θ of legs in stance, if the robot is as heavy as Table 6.2 says",
        "100 N·m in two of the rows there",
        f"at the limit in {100 * share:.0f} % of the samples",
        share > 0.5,
        "two legs alone would need about 184 N·m; moments on the feet give the rest",
    )


def same_instant(smooth: Run, both: list[Run]) -> Claim:
    """Legs of a diagonal at the same instant: not reproduced (equations.md §6); both results are shown."""
    off = same_instant_difference(smooth.g)
    plain = [same_instant_difference(run.g) for run in both]
    said = "; ".join(
        f"{run.label}: {d[THETA]:.1f}, {d[KNEE]:.1f}, {d[PSI]:.1f}"
        for run, d in zip(both, plain, strict=True)
    )
    return Claim(
        "torques of the legs 1 and 4, and 2 and 3, at the same instant",
        "almost identical images of each other",
        f"apart by (τ_θ, τ_k, τ_ψ) {said} N·m; T with changes priced: within {off.max():.3f} N·m",
        None,
        "the thesis's objective leaves it open; a price of change, which it does not have, makes them so",
        {"smooth": off.tolist(), "plain": [d.tolist() for d in plain]},
    )


def time_mirror(both: list[Run]) -> Claim:
    """Legs of a diagonal, one forward and one backward in time."""
    worst = max(time_mirror_difference(run.g, run.torques.cycle) for run in both)
    return Claim(
        "torques of the legs 1 and 4 within their stance, one of them backward in time",
        "almost identical images of each other",
        f"g₁(t) = g₄(T_st − t) within {worst:.0e} N·m",
        worst < 0.01,
        "images in this sense for both robots; within 0.01 N·m",
        {"largest_difference_Nm": worst},
    )


# --- the picture -----------------------------------------------------------------------------------
def picture(both: list[Run]) -> Picture:
    """Both robots."""

    def draw(path) -> None:
        from gaitwright.reproduce.curves import Curves, draw_curves  # noqa: PLC0415 - an extra

        line = (
            r"duty factor 0.5, stride 3 m, 1/6 m/s; as in the thesis $\tau_\theta$ > 0 presses the foot down"
        )
        title = "Figure 6.6 anew: joint torques of a trotting cycle"
        cycle = both[0].torques.cycle
        curves = [Curves(run.label, run.g) for run in both]
        draw_curves(path, (title, line), cycle, curves, float(np.max(cycle.robot.tau_max)))

    return Picture("figure-6.6.png", "The twelve joint torques of T and P in trot; swing shaded.", draw)
