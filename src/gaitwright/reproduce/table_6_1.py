"""Table 6.1: the joint angles of a stretch of walking, by inverse kinematics (eq. 3-8 … 3-18)."""

import numpy as np
from jaxtyping import Float

from gaitwright.description.load import load_robot
from gaitwright.model.kinematics import angles
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import from_thesis
from gaitwright.reproduce.claim import Claim, Grid, Reproduction, Say
from gaitwright.reproduce.printed import MISPRINTS_6_1, TABLE_6_1, X_6_1, Z_6_1
from gaitwright.reproduce.thesis_axes import angles_to_thesis, foot_below_hip

CLOSE = 2e-4
"""Angles within this agree [rad]: 0.4 mm at the foot."""
ANGLES = ("ψ", "θ_h", "θ_k")
LEG, ROW = 1, 0
"""The leg (number 2) and row from whose ψ the footholds are taken."""

ABOUT = (
    "The robot of the thesis stands on four feet, each 2 m beside its hip, and its body is carried to the "
    "places that the table prints. One number is taken from the table, ψ of leg 2 in row 1, which says how "
    "far behind their hips the feet are; every other angle follows by our inverse kinematics.",
    "The heads of the columns are the wrong way round: what is headed θ_k, θ_h, ψ is ψ, θ_h, θ_k. All four "
    "feet are equally far behind their hips, so this stretch begins from standing, before a walk has "
    "brought the legs apart. θ_h and θ_k hardly change over 3 cm: of them the table checks the level only.",
)


def reproduce(say: Say) -> Reproduction:
    """The table with our angles beside it."""
    say("inverse kinematics")
    robot = load_robot("thesis")
    behind = footholds_behind(robot)
    ours = np.array([angles_at(robot, x, behind) for x in X_6_1])
    off = ours - TABLE_6_1
    claims = [*column_claims(off), *misprint_claims(ours), heads(), height(), one_step_ahead(robot, behind)]
    return Reproduction(
        "table-6.1",
        "Table 6.1: a typical result of the JCC calculations for a walking skill",
        ABOUT,
        claims,
        [grid(ours, off)],
        numbers={"thesis": TABLE_6_1.tolist(), "ours": ours.round(9).tolist(), "feet_behind_m": behind},
    )


def angles_at(robot: Robot, x: float, behind: float) -> Float[np.ndarray, "4 3"]:
    """(ψ, θ_h, θ_k) of the legs with the body at x, the feet standing as at the first row."""
    feet_w = from_thesis(np.array([X_6_1[0], 0.0, 0.0])) + robot.nominal_feet
    feet_w[:, 0] -= behind
    feet_w[:, 2] = 0.0
    q, reached = angles(robot, feet_w - from_thesis(np.array([x, 0.0, Z_6_1])))
    assert reached.all()
    return angles_to_thesis(q)


def footholds_behind(robot: Robot) -> float:
    """How far [m] behind their hips the feet are in the first row, by ψ of leg 2 there."""
    reach = abs(robot.nominal_feet[LEG, 1] - robot.hip[LEG, 1])
    return float(reach * np.tan(TABLE_6_1[ROW, LEG, 0] - np.pi / 2))


# --- claims ----------------------------------------------------------------------------------------
def column_claims(off: np.ndarray) -> list[Claim]:
    """The entries that can agree, column by column."""
    out = []
    for column, name in enumerate(ANGLES):
        wrong = [where for where in MISPRINTS_6_1 if where[2] == column]
        fair = np.ones(off.shape[:2], dtype=bool)
        for row, leg, _ in wrong:
            fair[row, leg] = False
        worst, good = np.abs(off[..., column][fair]).max(), np.abs(off[..., column][fair]) < CLOSE
        because = f"within {CLOSE:g} rad" + (f"; misprints left out: {len(wrong)}" if wrong else "")
        out.append(
            Claim(
                f"{name} of the four legs in three rows",
                f"{fair.sum()} entries",
                f"{good.sum()} agree, largest difference {worst:.1e} rad",
                bool(good.all()),
                because,
                {"largest_difference_rad": float(worst)},
            )
        )
    return out


def misprint_claims(ours: np.ndarray) -> list[Claim]:
    """The entries that cannot be meant."""
    return [
        Claim(
            f"row {row + 1}, leg {leg + 1}: {ANGLES[column]}",
            f"{TABLE_6_1[row, leg, column]:.6f}",
            f"{ours[row, leg, column]:.6f}",
            None,
            f"misprint: {because}",
        )
        for (row, leg, column), because in MISPRINTS_6_1.items()
    ]


def heads() -> Claim:
    """The column heads, judged by where they put the foot."""
    entry = TABLE_6_1[0, 1]
    printed, turned = foot_below_hip(entry[::-1]), foot_below_hip(entry)
    return Claim(
        "heads of the columns",
        "θ_k, θ_h, ψ",
        "ψ, θ_h, θ_k",
        None,
        f"as printed the foot would be {printed[0]:.2f} m aside and {-printed[1]:.2f} m above its hip; the "
        f"other way round it is {turned[0]:.4f} m aside and {turned[1]:.4f} m below, on the ground",
    )


def height() -> Claim:
    """Whether the angles put the feet on the ground under a body at the printed height."""
    depth = foot_below_hip(TABLE_6_1)[..., 1]
    fair = np.ones(depth.shape, dtype=bool)
    fair[2, 0] = False
    worst = float(np.abs(depth[fair] + 0.25 + Z_6_1).max())
    return Claim(
        "z of the body: the printed angles put the feet on the ground",
        f"{Z_6_1}",
        f"within {1e3 * worst:.2f} mm",
        worst < 1e-3,
        "hip 0.25 m below the centre, depth by eq. 3-8; row 3, leg 1 left out as a misprint",
        {"largest_distance_m": worst},
    )


def one_step_ahead(robot: Robot, behind: float) -> Claim:
    """ψ against the place of the row after it."""
    ahead = angles_at(robot, X_6_1[0] + (X_6_1[2] - X_6_1[1]), behind)[LEG, 0]
    printed = TABLE_6_1[1, LEG, 0]
    return Claim(
        "row 2, leg 2: ψ if the angles are a step ahead of the place",
        f"{printed:.6f}",
        f"{ahead:.6f}",
        bool(abs(ahead - printed) < 2e-6),
        "the body moves 15.224 mm from row 2 to 3; ψ turns by that much from row 1 to 2 (our reading)",
        {"difference_rad": float(ahead - printed)},
    )


# --- the table -------------------------------------------------------------------------------------
def grid(ours: np.ndarray, off: np.ndarray) -> Grid:
    """Printed and computed angles, and their differences."""
    head = ["x [m]", "leg"]
    for name in ANGLES:
        head += [f"{name} thesis", "ours", "difference"]
    rows = []
    for row, x in enumerate(X_6_1):
        for leg in range(4):
            cells = [f"{x:.6f}" if leg == 0 else "", str(leg + 1)]
            for column in range(3):
                wrong = " misprint" if (row, leg, column) in MISPRINTS_6_1 else ""
                cells += [
                    f"{TABLE_6_1[row, leg, column]:.6f}",
                    f"{ours[row, leg, column]:.6f}",
                    f"{off[row, leg, column]:+.6f}{wrong}",
                ]
            rows.append(cells)
    return Grid("joint angles [rad]", head, rows, left=2, together=3)
