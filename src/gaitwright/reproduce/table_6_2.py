"""Table 6.2: the joint torques of a stretch of trotting, by inverse dynamics and the linear program."""

from typing import NamedTuple

import numpy as np

from gaitwright.description.load import load_robot
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.reproduce.claim import Claim, Grid, Reproduction, Say
from gaitwright.reproduce.gaits import on_all_fours
from gaitwright.reproduce.printed import LEGS_6_2, MISREAD_6_2, NET_TORQUE_6_2, TABLE_6_1, TABLE_6_2
from gaitwright.reproduce.thesis_axes import angles_to_thesis, torques_to_thesis, vertical_force
from gaitwright.reproduce.torques import POINT_FEET, CycleTorques, cycle_torques, even_torques

STEPS = 198
"""Samples of the cycle of 18 s: 15.15 mm apart, as the rows of Table 6.1."""
ROWS = 3
COLUMNS = (1, 2, 0)
"""τ_θ, τ_k, τ_ψ among our ψ, θ_h, θ_k."""
LIMIT = 100.0
"""Of the motors [N·m]."""
EXACT = POINT_FEET._replace(change=0.0)
LITERAL = EXACT._replace(literal=1.0)
"""The objective as the thesis prints it: signed power and the sum of the normal forces."""

ABOUT = (
    "The thesis prints no masses. Decoded with the angles of Table 6.1 and legs without mass, the torques of "
    "every row carry about 164.6 N, on all four feet: four legs carry this stretch, though a trot with a "
    "duty factor of 0.5 stands on two. T (`thesis-table`, 18.8 kg) is as heavy as that; P (`thesis`, "
    "10.0 kg) is as heavy as motors of 100 N·m can carry. Ours are the three first samples of a body carried "
    "at 1/6 m/s over four planted feet, 15 mm apart as in Table 6.1.",
    "“Even” shares the weight evenly, straight up. The linear program comes twice: with the objective as "
    "printed, and with |power| and the largest normal force. As printed the objective is the same for every "
    "force that carries the load, so any corner of the feasible set is a solution, and a corner has torques "
    "at their limits: the level of this table can be reproduced, its single entries cannot.",
)


class Ours(NamedTuple):
    """Our torques in the thesis's sense, `(rows, legs 1 … 4, 3)` as (ψ, θ_h, θ_k) [N·m]."""

    even_t: np.ndarray
    literal_t: np.ndarray
    program_t: np.ndarray
    even_p: np.ndarray
    program_p: np.ndarray


def reproduce(say: Say) -> Reproduction:
    """The table with our torques beside it."""
    t, p = load_robot("thesis-table"), load_robot("thesis")
    say("the linear program on four feet")
    literal, program = solve_cycle(t, LITERAL), solve_cycle(t, EXACT)
    ours = Ours(even(t), shown(literal), shown(program), even(p), shown(solve_cycle(p, EXACT)))
    claims = [
        weight(t, ours),
        level(t, ours),
        net_torque(literal, program),
        at_the_limit(ours),
        *misprints(),
        single_entries(ours),
        iterations(literal, program),
    ]
    return Reproduction(
        "table-6.2",
        "Table 6.2: a typical result of the NC calculations for a trotting skill",
        ABOUT,
        claims,
        [grid(ours)],
        numbers={"thesis": TABLE_6_2.tolist()}
        | {name: first.round(9).tolist() for name, first in ours._asdict().items()},
    )


def solve_cycle(robot: Robot, settings) -> CycleTorques:
    """The program's answer, every sample from nothing."""
    return cycle_torques(robot, on_all_fours(robot, STEPS), settings, laps=1, warm=False)


def shown(torques: CycleTorques) -> np.ndarray:
    """The first samples in the thesis's sense."""
    return torques_to_thesis(torques.tau[:ROWS])


def even(robot: Robot) -> np.ndarray:
    """The same with the weight shared evenly."""
    cycle = on_all_fours(robot, STEPS)
    return torques_to_thesis(np.array([even_torques(robot, cycle, i) for i in range(ROWS)]))


def thesis_torques() -> np.ndarray:
    """The torques meant in print, as (ψ, θ_h, θ_k) of the legs 1 … 4, `(rows, 4, 3)`."""
    table, out = TABLE_6_2.copy(), np.empty_like(TABLE_6_2)
    for where, meant in MISREAD_6_2.items():
        table[where] = meant
    for line, leg in enumerate(LEGS_6_2):
        out[:, leg, COLUMNS] = table[:, line]
    return out


# --- claims ----------------------------------------------------------------------------------------
def weight(robot: Robot, ours: Ours) -> Claim:
    """What the torques carry, decoded alike for both."""
    pose = np.broadcast_to(TABLE_6_1[0, 1], (ROWS, 4, 3))
    printed = vertical_force(pose, thesis_torques()).sum(axis=1)
    angles = angles_to_thesis(on_all_fours(robot, STEPS).q[:ROWS])
    mine = vertical_force(angles, ours.even_t).sum(axis=1)
    off = float(abs(mine.mean() / printed.mean() - 1.0))
    return Claim(
        "load that the torques carry, decoded with legs without mass",
        ", ".join(f"{f:.1f}" for f in printed) + " N",
        f"{mine.mean():.1f} N (T, even)",
        off < 0.02,
        f"within 2 %; T weighs {robot.total_mass * GRAVITY:.0f} N with its legs; its masses were chosen so",
        {"thesis_N": printed.tolist(), "ours_N": mine.tolist()},
    )


def level(robot: Robot, ours: Ours) -> Claim:
    """The level of the hip torque."""
    printed = thesis_torques()[:2, :, 1]
    mine, small = float(ours.even_t[0, :, 1].mean()), float(ours.even_p[0, :, 1].mean())
    return Claim(
        "level of the hip torque τ_θ, rows 1 and 2",
        f"{printed.min():.1f} … {printed.max():.1f} N·m, mean {printed.mean():.1f}",
        f"T {mine:.1f} N·m, P {small:.1f} N·m (even)",
        bool(printed.min() <= mine <= printed.max()),
        "T within the printed range; P is lighter by design",
        {"thesis_mean": float(printed.mean()), "T": mine, "P": small},
    )


def net_torque(*runs: CycleTorques) -> Claim:
    """Whether the feet balance the body."""
    mine = max(float(np.abs(run.missing[:ROWS, 3:]).max()) for run in runs)
    return Claim(
        "net torque on the body (Trq_x, Trq_y, Trq_z)",
        f"up to {np.abs(NET_TORQUE_6_2).max():.3f} N·m",
        f"up to {mine:.0e} N·m",
        mine < 0.05,
        "less than a thousandth of a joint torque in both",
        {"ours_largest": mine},
    )


def at_the_limit(ours: Ours) -> Claim:
    """Torques exactly at the limit."""
    printed = np.count_nonzero(np.abs(TABLE_6_2[2, :, 0] - LIMIT) < 1e-4)
    mine = np.count_nonzero(np.abs(ours.literal_t[..., 1] - LIMIT) < 1e-6, axis=1)
    return Claim(
        "τ_θ exactly at the limit of the motors, 100 N·m",
        f"{printed} legs in row 3",
        f"{', '.join(map(str, mine))} legs in rows 1, 2, 3 (T, objective as printed)",
        bool((mine > 0).any()),
        "the mark of a corner solution",
        {"legs_at_limit": mine.tolist()},
    )


def misprints() -> list[Claim]:
    """The two entries of row 1 that cannot be meant."""
    names = ("τ_θ", "τ_k", "τ_ψ")
    return [
        Claim(
            f"row {row + 1}, leg {LEGS_6_2[line] + 1}: {names[column]}",
            f"{TABLE_6_2[row, line, column]:.6f}",
            f"{meant:.6f} is meant",
            None,
            "misprint of one digit (our reading): the legs 1, 4 and 2, 3 agree to 0.002 N·m in all other "
            "entries of rows 1 and 2, and only so does row 1 carry as much as the others",
        )
        for (row, line, column), meant in MISREAD_6_2.items()
    ]


def single_entries(ours: Ours) -> Claim:
    """How far apart equally good solutions are."""
    apart = np.abs(ours.literal_t - ours.program_t).max(axis=(0, 1))
    off = np.abs(ours.program_t - thesis_torques()).max(axis=(0, 1))
    return Claim(
        "single entries",
        "36 torques",
        f"differ by up to {off[1]:.0f}, {off[2]:.0f}, {off[0]:.0f} N·m (τ_θ, τ_k, τ_ψ)",
        None,
        "the masses are not printed, and solutions that the printed objective holds equal differ as much: "
        f"by up to {apart[1]:.0f}, {apart[2]:.0f}, {apart[0]:.0f} N·m between our two",
        {"ours_to_thesis": off.tolist(), "between_solutions": apart.tolist()},
    )


def iterations(*runs: CycleTorques) -> Claim:
    """How many steps the simplex method takes."""
    mine = np.concatenate([run.iterations[:ROWS] for run in runs])
    return Claim(
        "iterations of the linear program (section 6.3)",
        "usually 15 to 30",
        f"{mine.min()} to {mine.max()} from nothing",
        None,
        "another simplex method: ours changes limits without an exchange, theirs had artificial variables",
        {"iterations": mine.tolist()},
    )


# --- the table -------------------------------------------------------------------------------------
def grid(ours: Ours) -> Grid:
    """Printed and computed torques, leg by leg."""
    sources = (
        ("thesis", thesis_torques()),
        ("T, even", ours.even_t),
        ("T, printed objective", ours.literal_t),
        ("T, |power|", ours.program_t),
        ("P, |power|", ours.program_p),
    )
    head = ["row", "leg"] + [f"{name} {source}" for source, _ in sources for name in ("τ_θ", "τ_k", "τ_ψ")]
    rows = []
    for row in range(ROWS):
        for leg in LEGS_6_2:
            cells = [str(row + 1) if leg == LEGS_6_2[0] else "", str(leg + 1)]
            for _, torques in sources:
                cells += [digits(torques[row, leg, column]) for column in COLUMNS]
            for (at, line, column), _ in MISREAD_6_2.items():
                if (at, LEGS_6_2[line]) == (row, leg):
                    cells[2 + column] = f"{digits(TABLE_6_2[at, line, column])} misprint"
            rows.append(cells)
    return Grid("joint torques [N·m], in the thesis's sense", head, rows, left=2, together=3)


def digits(torque: float) -> str:
    """Three decimals, without a sign for nothing."""
    return f"{round(torque, 3) + 0.0:.3f}"
