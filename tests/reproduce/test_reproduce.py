"""Tables and figures of the thesis: their axes, what is measured on curves, what the command leaves."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.optimize import linprog

from gaitwright import reproduce
from gaitwright.cli import main
from gaitwright.control.inverse_dynamics import load_of, packed_load
from gaitwright.errors import WrongUse
from gaitwright.model.kinematics import feet
from gaitwright.numerics.geometry import GRAVITY, from_thesis
from gaitwright.reproduce import table_6_1, table_6_2
from gaitwright.reproduce.claim import Claim, Grid, Reproduction
from gaitwright.reproduce.gaits import DIAGONAL, LATERAL, cycle_of, on_all_fours, trot, walk
from gaitwright.reproduce.patterns import (
    half_cycle_difference,
    reversals,
    reverses_at_lift_off,
    static_margins,
    stretches,
    time_mirror_difference,
)
from gaitwright.reproduce.report import markdown
from gaitwright.reproduce.thesis_axes import (
    angles_from_thesis,
    angles_to_thesis,
    foot_below_hip,
    torques_to_thesis,
    vertical_force,
)
from gaitwright.reproduce.torques import (
    FRICTION,
    GIVING_WAY,
    POINT_FEET,
    cycle_torques,
    even_torques,
    free_torques,
    held_feet,
)
from oracles import robot_called

POSES = arrays(float, (4, 3), elements=st.floats(-1.4, 1.4))
SAMPLES = 36


def quiet(_: str) -> None:
    """Progress that nobody reads."""


# --- the thesis's axes -----------------------------------------------------------------------------
@given(POSES)
def test_the_thesis_s_angles_put_the_foot_where_ours_do(q):
    """Eq. 3-8 in the thesis's axes against our forward kinematics in ours."""
    robot = robot_called("thesis")
    angles = angles_to_thesis(q)
    reach, depth = foot_below_hip(angles).T
    foot = np.stack([reach * np.cos(angles[:, 0]), reach * np.sin(angles[:, 0]), depth], axis=1)
    assert np.abs(from_thesis(foot) - (feet(robot, q) - robot.hip)).max() < 1e-12
    assert (angles[:, 0] >= 0.0).all() and (angles[:, 0] < 2 * np.pi).all()


@given(POSES)
def test_angles_come_back(q):
    assert np.abs(angles_from_thesis(angles_to_thesis(q)) - q).max() < 1e-14


@given(POSES, POSES, arrays(float, (4, 3), elements=st.floats(-100.0, 100.0)))
def test_torques_do_the_same_work_in_both(q, qd, tau):
    """The thesis's torque is what the motor works against: −g · θ̇ = τ · q̇."""
    step = 1e-6
    turned = angles_to_thesis(q + step * qd) - angles_to_thesis(q - step * qd)
    rates = np.arctan2(np.sin(turned), np.cos(turned)) / (2 * step)
    assert (-torques_to_thesis(tau) * rates).sum() == pytest.approx((tau * qd).sum(), abs=1e-6)


@given(st.floats(-0.5, 0.9), st.floats(-0.9, 0.5), st.floats(-40, 40), st.floats(-20, 90))
def test_the_vertical_force_of_a_leg_without_mass_is_found_again(elevation, knee, outward, up):
    """Torques by virtual work of a foot force, and back."""
    angles = np.array([np.pi / 2, elevation, knee])
    step, work = 1e-6, np.zeros(3)
    for j in (1, 2):
        there = foot_below_hip(angles + step * np.eye(3)[j]) - foot_below_hip(angles - step * np.eye(3)[j])
        work[j] = (there @ [outward, -up]) / (2 * step)  # the ground's force on the foot; depth points down
    assert vertical_force(angles, work) == pytest.approx(up, abs=1e-6)


def test_a_positive_hip_torque_presses_the_foot_down():
    robot = robot_called("thesis-table")
    torques = torques_to_thesis(even_torques(robot, on_all_fours(robot, 198), 0))
    assert torques[:, 1] == pytest.approx(82.9, abs=0.05)  # equations.md §6
    assert torques[:, 2] == pytest.approx(6.5, abs=0.05)
    assert torques[:, 0] == pytest.approx(0.0, abs=1e-9)


# --- what is measured on curves --------------------------------------------------------------------
def test_signs_are_counted_within_a_stretch_only():
    curve = np.array([-1.0, 2.0, -3.0, 0.0, 4.0, 5.0])
    where = np.array([True, True, False, False, True, True])
    assert [part.tolist() for part in stretches(where)] == [[4, 5, 0, 1]]
    assert reversals(curve, where) == 2  # 4 5 | −1 | 2
    stance = np.array([True, True, False, False, True, True])
    assert reverses_at_lift_off(curve, stance)
    assert not reverses_at_lift_off(-curve, stance)


def test_symmetries_hold_for_curves_made_so_and_fail_for_others(rng):
    cycle = cycle_of(robot_called("thesis"), trot(), SAMPLES)
    right = rng.normal(size=(SAMPLES, 2, 3))
    left = np.roll(right, SAMPLES // 2, axis=0) * [-1.0, 1.0, 1.0]
    curves = np.stack([left[:, 0], right[:, 0], left[:, 1], right[:, 1]], axis=1)
    assert half_cycle_difference(curves) == 0.0
    assert half_cycle_difference(curves[:, [0, 2, 1, 3]]) > 0.1
    down = np.flatnonzero(cycle.stance[:, 0])[1:]
    curves[down, 3] = curves[down[::-1], 0]
    assert time_mirror_difference(curves, cycle) == 0.0
    curves[down[0], 3] += 0.5
    assert time_mirror_difference(curves, cycle) == pytest.approx(0.5)


def test_only_the_lateral_sequence_keeps_the_body_over_its_feet():
    robot = robot_called("thesis")
    lateral, diagonal = (static_margins(cycle_of(robot, walk(order))) for order in (LATERAL, DIAGONAL))
    assert lateral.min() == pytest.approx(0.06, abs=0.01)  # equations.md §6
    assert diagonal.min() == pytest.approx(-0.48, abs=0.02)
    assert (diagonal < 0.0).mean() == pytest.approx(0.80, abs=0.02)


@given(st.permutations([1, 2, 3, 4]))
def test_a_walk_lifts_its_legs_in_the_order_asked_for(order):
    cycle = cycle_of(robot_called("thesis"), walk(tuple(order)), 40)
    lifts = np.argmax(np.roll(cycle.stance, 1, axis=0) & ~cycle.stance, axis=0)
    assert (np.argsort(lifts) + 1).tolist() == list(order)
    assert sorted(lifts.tolist()) == [0, 10, 20, 30]


# --- torques ---------------------------------------------------------------------------------------
def possible(robot, cycle, i: int, components: int, lever: float) -> bool:
    """Whether any foot loads carry a sample within the limits: by HiGHS, from the balance itself."""
    load = load_of(packed_load(robot, cycle.target(i), cycle.sensed(i)))
    legs, c = np.flatnonzero(cycle.stance[i]), components
    balance, rows, most = np.zeros((6, c * len(legs))), [], []
    for k, leg in enumerate(legs):
        own = slice(c * k, c * k + c)
        balance[:3, c * k : c * k + 3] = np.eye(3)
        balance[3:, c * k : c * k + 3] = np.cross(load.arm[leg], np.eye(3)).T
        acts = np.hstack([load.push[leg], load.turn[leg]])[:, :c]
        if c == 6:
            balance[3:, c * k + 3 : c * k + 6] = np.eye(3)
        for j in range(3):
            row = np.zeros(balance.shape[1])
            row[own] = acts[j]
            rows += [row, -row]
            most += [robot.tau_max[leg, j] + load.free[leg, j], robot.tau_max[leg, j] - load.free[leg, j]]
        for j in [0, 1, 3, 4, 5][: c - 1]:
            for sign in (1.0, -1.0):
                row = np.zeros(balance.shape[1])
                row[c * k + j], row[c * k + 2] = sign, -(FRICTION if j < 2 else lever)
                rows.append(row)
                most.append(0.0)
    up = (0.0, 1.5 * robot.total_mass * GRAVITY)
    bounds = [up if j % c == 2 else (None, None) for j in range(balance.shape[1])]
    cost = np.zeros(balance.shape[1])
    return linprog(cost, np.array(rows), most, balance, load.wrench, bounds, method="highs").status == 0


@pytest.mark.parametrize(
    ("name", "gait", "components", "lever"),
    [
        ("thesis", walk(LATERAL), 3, 0.0),
        ("thesis", walk(DIAGONAL), 3, 0.0),
        ("thesis-table", walk(LATERAL), 3, 0.0),
        ("thesis-table", walk(DIAGONAL), 6, 0.3),
        ("thesis-table", trot(), 6, 0.3),
    ],
)
def test_a_sample_is_solved_where_a_solution_exists_and_keeps_its_limits(name, gait, components, lever):
    robot = robot_called(name)
    cycle = cycle_of(robot, gait, SAMPLES)
    settings = POINT_FEET if components == 3 else held_feet(lever)
    torques = cycle_torques(robot, cycle, settings, laps=1)
    exists = [possible(robot, cycle, i, components, lever) for i in range(cycle.steps)]
    assert torques.solved.tolist() == exists
    assert any(exists)
    good = torques.solved
    assert np.abs(torques.missing[good]).max() < 1e-9 * robot.total_mass * GRAVITY
    assert np.abs(torques.tau[good]).max() < 100.0 + 1e-6
    normal = torques.forces_w[good][..., 2:]
    assert normal.min() > -1e-9
    assert (np.abs(torques.forces_w[good][..., :2]) <= FRICTION * normal + 1e-6).all()
    assert (np.abs(torques.moments_w[good]) <= lever * normal + 1e-6).all()
    assert np.isnan(torques.tau[~good]).all()


def test_legs_in_the_air_have_the_torques_of_unloaded_feet():
    robot = robot_called("thesis")
    cycle = cycle_of(robot, trot(), SAMPLES)
    torques = cycle_torques(robot, cycle, GIVING_WAY, laps=1)
    free = free_torques(robot, cycle)
    assert np.abs(torques.tau - free)[~cycle.stance].max() < 1e-12
    assert not torques.forces_w[~cycle.stance].any()


# --- the tables ------------------------------------------------------------------------------------
def test_table_6_1_agrees_but_for_its_misprints():
    result = table_6_1.reproduce(quiet)
    assert result.agrees
    off = np.abs(np.array(result.numbers["ours"]) - result.numbers["thesis"])
    assert sorted(zip(*(where.tolist() for where in np.nonzero(off > 2e-4)), strict=True)) == [
        (0, 0, 0),
        (0, 2, 0),
        (0, 3, 0),
        (2, 0, 2),
    ]


def test_table_6_2_agrees_in_level_and_load():
    result = table_6_2.reproduce(quiet)
    assert result.agrees
    numbers = {claim.what: claim.numbers for claim in result.claims}
    carried = numbers["load that the torques carry, decoded with legs without mass"]
    assert carried["thesis_N"] == pytest.approx([164.3, 165.1, 164.3], abs=0.05)
    assert carried["ours_N"] == pytest.approx([165.1] * 3, abs=0.1)
    # A printed entry that is read otherwise is marked where it is shown.
    assert sum(cell.endswith("misprint") for row in result.grids[0].rows for cell in row) == 2


# --- the command -----------------------------------------------------------------------------------
def test_an_unknown_name_is_told_with_what_there_is(capsys):
    with pytest.raises(
        WrongUse, match=r"no table or figure 'table-6.3'; there is: table-6.1, table-6.2, figure"
    ):
        reproduce.run(["table-6.3"])
    assert main(["reproduce", "tabel-6.1"]) == 2
    assert "did you mean 'table-6.1'?" in capsys.readouterr().err


def test_names_are_done_once_and_in_order():
    assert reproduce.chosen(["figure-6.5", "table-6.1", "figure-6.5"]) == ["table-6.1", "figure-6.5"]
    assert reproduce.chosen([]) == list(reproduce.NAMES)


def test_a_table_is_printed_and_left_as_a_page(tmp_path: Path, capsys):
    out = tmp_path / "here"
    assert main(["reproduce", "table-6.1", "--out", str(out), "--json", "-"]) == 0
    told, shown = capsys.readouterr()
    result = json.loads(told)
    assert result["agrees"] is True
    (table,) = result["reproduced"]
    assert {claim["verdict"] for claim in table["claims"]} == {"agrees", "cannot"}
    assert "4.763295" in shown and "table-6.1: 5 of 5 claims agree; 5 cannot" in shown
    page = (out / "table-6.1.md").read_text(encoding="utf-8")
    assert page.startswith("# Table 6.1: ")
    assert "| 4.763295 | 4.704890 | -0.058405 misprint |" in page
    assert main(["reproduce", "table-6.1", "--out", str(out)]) == 0  # over those of an earlier run


def test_figure_6_6_is_drawn_and_shows_what_can_be_shown(tmp_path: Path):
    assert reproduce.run(["figure-6.6"], str(tmp_path), str(tmp_path / "all.json")) == 0
    assert (tmp_path / "figure-6.6.png").read_bytes().startswith(b"\x89PNG")
    assert "![The twelve joint torques" in (tmp_path / "figure-6.6.md").read_text(encoding="utf-8")
    (figure,) = json.loads((tmp_path / "all.json").read_text(encoding="utf-8"))["reproduced"]
    heavy, light = figure["numbers"]["runs"][:2]
    stance = np.array(heavy["stance"])
    hip = np.array(heavy["psi_theta_knee_Nm"])[..., 1][stance]
    assert hip == pytest.approx(100.0, abs=1e-5)  # saturated throughout (equations.md §6)
    hip = np.array(light["psi_theta_knee_Nm"])[..., 1]
    assert (hip[stance] > 70.0).all() and (hip[stance] < 100.0).all()
    assert (hip[~stance] > -10.0).all() and (hip[~stance] < -8.0).all()
    speeds = next(c["numbers"] for c in figure["claims"] if c["what"] == "τ_θ during the swing")
    assert speeds["1.5_mps"] == pytest.approx([-17.0, 1.0], abs=0.6)  # equations.md §6
    assert speeds["3_mps"] == pytest.approx([-39.0, 29.0], abs=0.6)


def test_a_claim_that_differs_is_told_by_the_exit_code(monkeypatch, tmp_path: Path, capsys):
    wrong = Claim("the sum", "4", "5", False)
    result = Reproduction("table-6.1", "A table", (), [wrong, Claim("a misprint", "x", "y", None, "blot")])
    monkeypatch.setattr(table_6_1, "reproduce", lambda say: result)
    assert reproduce.run(["table-6.1"], str(tmp_path)) == 1
    assert "DIFFERS" in capsys.readouterr().out
    assert "table-6.1: 0 of 1 claims agree; 1 cannot" in (tmp_path / "table-6.1.md").read_text(
        encoding="utf-8"
    )


def test_a_file_is_no_folder_for_the_results(tmp_path: Path):
    (tmp_path / "file").write_text("mine")
    with pytest.raises(WrongUse, match="is a file; name a folder"):
        reproduce.run(["table-6.1"], str(tmp_path / "file"))
    assert (tmp_path / "file").read_text() == "mine"


def test_a_bar_in_a_cell_does_not_break_the_page():
    grid = Grid("numbers", ("a", "|x|"), [("1", "2|3")])
    lines = markdown(Reproduction("n", "T", (), (), [grid]), ()).splitlines()
    assert "| a | \\|x\\| |" in lines and "| 1 | 2\\|3 |" in lines
