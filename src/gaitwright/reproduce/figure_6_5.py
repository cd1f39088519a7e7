"""Figure 6.5: the joint torques of a complete walking cycle."""

from dataclasses import replace

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
from gaitwright.reproduce.gaits import DIAGONAL, LATERAL, STEPS, cycle_of, walk
from gaitwright.reproduce.patterns import KNEE, PSI, static_margins
from gaitwright.reproduce.torques import POINT_FEET, cycle_torques, free_torques, held_feet

PLATE = 0.5
"""Lever of the foot moments at which the heavy robot still walks in the thesis's order [m]."""
STRONG = 200.0
"""A torque limit at which it walks on point feet [N·m]."""

HELD_SPARES = "judged by point feet; moments on a held foot spare its leg these torques"

ABOUT = (
    "Duty factor 0.8, stride 3 m, 1/6 m/s, so 18 s for a cycle; body level, feet lifted 0.5 m; a value every "
    "1/8 s, the robot moving exactly as desired. The scan of the thesis has no curves: what its text says "
    "about them is judged claim by claim. T (`thesis-table`, 18.8 kg) weighs what Table 6.2 carries; P "
    "(`thesis`, 10.0 kg) is what motors of 100 N·m can carry on three point feet.",
    "The order 3-2-4-1 that the thesis names takes the body's centre out of the polygon of the feet for most "
    "of the cycle; the order 3-1-4-2, hind foot before the fore foot of the same side, never does. With "
    "point feet only the latter can be walked statically. T walks either way with held feet: its program, as "
    "the thesis's, has six components at each foot and no limit on the moments, which come for nothing and "
    "grow to thousands of N·m. Moments that flat feet reaching 0.5 m from their middle can give are enough. "
    "The first picture has the order 3-1-4-2 for both robots, the second one the order of the thesis, for T.",
)


def reproduce(say: Say) -> Reproduction:
    """The figure, with what the thesis says about it."""
    t, p = load_robot("thesis-table"), load_robot("thesis")
    strong = replace(t, tau_max=np.full((4, 3), STRONG))
    held, points = held_feet(), POINT_FEET
    runs = []
    for label, robot, order, settings in (
        ("T, held feet, 3-1-4-2", t, LATERAL, held),
        ("P, point feet, 3-1-4-2", p, LATERAL, points),
        ("T, held feet, 3-2-4-1", t, DIAGONAL, held),
        (f"T, feet of ± {PLATE:g} m, 3-2-4-1", t, DIAGONAL, held_feet(PLATE)),
        ("P, point feet, 3-2-4-1", p, DIAGONAL, points),
        ("T, point feet, 3-1-4-2", t, LATERAL, points),
        (f"T, point feet, 3-1-4-2, limit {STRONG:g}", strong, LATERAL, points),
    ):
        say(f"{label}: {STEPS} samples")
        runs.append(Run(label, cycle_torques(robot, cycle_of(robot, walk(order)), settings)))
    say("swings at higher speeds")
    both, thesis = runs[:2], runs[2]
    claims = [
        *posture(both[0]),
        rhythm(both[0]),
        swing_share(both[0]),
        order_of_lifting(runs),
        hip_in_stance([*both, thesis], "mainly remains in flexion", 0.8),
        lift_off([*both, thesis]),
        hip_in_swing(t, lambda v: walk(LATERAL, v), "alternates between flexion and extension"),
        knee_in_swing(both),
        azimuth_in_swing(both[0], "from flexion to extension"),
        alternation(KNEE, both, both[1].label, HELD_SPARES),
        alternation(PSI, both, both[1].label, HELD_SPARES),
        symmetry(
            [*both, thesis],
            "each leg is half a cycle out of phase with its fellow on the other side",
            "so are its torques",
            "g₁(t) = g₂(t + T/2), g₃(t) = g₄(t + T/2)",
        ),
        speed(both[1]),
    ]
    return Reproduction(
        "figure-6.5",
        "Figure 6.5: the 12 joint torques for a complete walking cycle",
        ABOUT,
        claims,
        [run_grid(runs)],
        pictures(both, thesis),
        {"runs": [run.plain() for run in runs]},
    )


# --- claims ----------------------------------------------------------------------------------------
def rhythm(run: Run) -> Claim:
    """The relative phases."""
    offsets = np.array(run.torques.cycle.gait.offsets)
    apart = (np.diff(np.sort(offsets)), (offsets[[1, 3]] - offsets[[0, 2]]) % 1.0)
    return Claim(
        "relative phases",
        "a quarter of a cycle between successive legs, half a cycle between the legs of a pair",
        "so in either order" if np.allclose(apart[0], 0.25) and np.allclose(apart[1], 0.5) else "otherwise",
        None,
        "put in, not found: no claim of ours",
    )


def swing_share(run: Run) -> Claim:
    """How much of the cycle a leg swings."""
    return Claim(
        "share of the cycle in which a leg swings",
        "about one fourth",
        f"{(~run.stance).mean():.2f}",
        None,
        "a duty factor of 0.8, which the thesis gives, leaves one fifth",
    )


def order_of_lifting(runs: list[Run]) -> Claim:
    """Whether the order of the thesis can be walked."""
    by_label = {run.label: run for run in runs}
    held, points = by_label["T, held feet, 3-2-4-1"], by_label["P, point feet, 3-2-4-1"]
    plate = by_label[f"T, feet of ± {PLATE:g} m, 3-2-4-1"]
    margin = {
        order: static_margins(cycle_of(load_robot("thesis"), walk(order))) for order in (LATERAL, DIAGONAL)
    }
    worst, other = margin[DIAGONAL], margin[LATERAL]
    return Claim(
        "legs lifted in the order 3-2-4-1",
        "within the limits",
        f"T: solved in {100 * held.torques.solved.mean():.0f} % of the samples with held feet, in "
        f"{100 * plate.torques.solved.mean():.0f} % with feet of ± {PLATE:g} m; P: in "
        f"{100 * points.torques.solved.mean():.0f} % with point feet",
        bool(held.torques.solved.all()),
        f"judged by held feet; the body's centre is up to {-worst.min():.2f} m outside its feet, "
        f"{100 * (worst < 0).mean():.0f} % of the cycle (3-1-4-2: always {other.min():.2f} m or more inside)",
        {"margin_3241_m": float(worst.min()), "margin_3142_m": float(other.min())},
    )


def speed(run: Run) -> Claim:
    """Whether the torques tell 1/6 from 1/8 m/s."""
    robot = run.torques.cycle.robot
    slow = cycle_of(robot, walk(LATERAL, 1 / 8), STEPS)
    off = float(np.abs(free_torques(robot, slow) - free_torques(robot, run.torques.cycle)).max())
    return Claim(
        "speed",
        "1/6 m/s, in the scan also 1/8 m/s",
        f"torques of the motion without load differ by up to {off:.2f} N·m",
        None,
        "both are so slow that the curves do not tell which one is meant",
        {"largest_difference_Nm": off},
    )


# --- the pictures ----------------------------------------------------------------------------------
def pictures(both: list[Run], thesis: Run) -> list[Picture]:
    """Both robots in the order that point feet can walk, and T in the order of the thesis."""
    line = r"duty factor 0.8, stride 3 m, 1/6 m/s; as in the thesis $\tau_\theta$ > 0 presses the foot down"
    title = "Figure 6.5 anew: joint torques of a walking cycle, legs lifted in the order "

    def picture(name: str, order: str, runs: list[Run]) -> Picture:
        def draw(path) -> None:
            from gaitwright.reproduce.curves import Curves, draw_curves  # noqa: PLC0415 - an extra

            cycle = runs[0].torques.cycle
            named = [Curves(run.label.removesuffix(f", {order}"), run.g) for run in runs]
            draw_curves(path, (title + order, line), cycle, named, float(cycle.robot.tau_max.max()))

        who = " and ".join(run.label.partition(",")[0] for run in runs)
        return Picture(name, f"The twelve joint torques of {who}, order {order}; swing shaded.", draw)

    return [
        picture("figure-6.5.png", "3-1-4-2", both),
        picture("figure-6.5-order-3-2-4-1.png", "3-2-4-1", [thesis]),
    ]
