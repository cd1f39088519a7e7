"""An edit of a curve is checked, seen in physics, takes effect without a leap, and can be taken back."""

import json
from dataclasses import replace

import numpy as np
import pytest

from gaitwright.control.learned.profile import Profile, as_kept
from gaitwright.errors import WrongUse
from gaitwright.gait.coordinator import Coordinator
from gaitwright.gait.operators import SHARES, Operator
from gaitwright.gait.state import SWING
from gaitwright.ground.scene import load_scene
from gaitwright.learning import operator_lessons
from gaitwright.learning.operator_lessons import imagining
from gaitwright.learning.profile_lessons import cycle_of
from gaitwright.locomotion import Brain
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import Session
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill
from gaitwright.studio.curve_change import Change, Parts
from gaitwright.studio.curve_history import Snapshot
from gaitwright.studio.curve_obstacle import Obstacle
from gaitwright.studio.curve_preview import Wish, run
from gaitwright.studio.curve_walk import Walk
from gaitwright.studio.curves import Curves
from oracles import robot_called

GO2 = robot_called("go2")
FLAT = load_scene("flat")
EDITS = {"cycle": (2, 2, 0.02), "torque": (8, 3, 2.0), "angle": (3, 3, -0.03)}
"""For each kind: which point, which of its numbers, and by how much it is moved."""
LOWER = (3, 2, -0.02)
OVER = [[0.0, -0.5, 0.0], [0.2, -0.45, 0.15], [0.5, 0.0, 0.25], [0.8, 0.45, 0.15], [1.0, 0.5, 0.0]]
"""The path of a foot over something that is up to 7 cm high."""


@pytest.fixture(scope="module")
def profile():
    """The torques of a trot, from one start."""
    held = fixed_skill(GO2, "trot", None, 0.0, None, "numerical")
    call = held.skill_call
    return Profile(call.gait, (*call.velocity, call.turn), as_kept(cycle_of(GO2, held, 0)))


def walking(skill: str = "trot", ticks: int = 120, driver: str = "", profiles=()) -> tuple[Curves, Session]:
    """A robot amid a skill, and its curves."""
    curves = Curves(GO2)
    brain = Brain.of(GO2, FLAT, fixed_skill(GO2, skill, None, 0.0, None, driver))
    if profiles:
        brain = brain.with_profiles({"trot": list(profiles)})
    session = Session(curves.fit(brain), MujocoPlant(GO2, FLAT), Mission(()), 60.0, 3)
    go(curves, session, ticks)
    return curves, session


def go(curves: Curves, session: Session, ticks: int) -> np.ndarray:
    """Steps on; the references of the feet, and which are in the air, at every tick."""
    seen = []
    for _ in range(ticks):
        lap = session.step()
        curves.after(session)
        swings = session.mind.memories.gait.state.mode == SWING
        seen.append(np.column_stack([lap.target.feet_w, swings]))
    return np.array(seen)


def moved(curves: Curves, session: Session, kind: str, where: tuple[int, int, float]) -> list[list[float]]:
    point, number, by = where
    points = curves.show(kind, "trot", "FL", session)["points"]
    points[point][number] += by
    return points


def leap(seen: np.ndarray) -> float:
    """The most that the reference of a foot in the air rises or drops in a tick [m]."""
    rises, up = np.diff(seen[..., 2], axis=0), (seen[1:, :, 3] > 0) & (seen[:-1, :, 3] > 0)
    return float(np.abs(rises)[up].max())


# --- what is shown and changed ----------------------------------------------------------------------
@pytest.mark.parametrize("kind", EDITS)
def test_undo_takes_an_edit_back_and_redo_makes_it_again(kind: str, profile) -> None:
    curves, session = walking(profiles=[profile], driver="learned" if kind == "torque" else "")
    before, cycles = curves.show(kind, "trot", "FL", session), session.brain.coordinator.cycles
    out = curves.edit(kind, "trot", "FL", moved(curves, session, kind, EDITS[kind]), True, session)
    assert out["taken"], out["because"]
    after = curves.show(kind, "trot", "FL", session)
    point, number, by = EDITS[kind]
    assert after["points"][point][number] == pytest.approx(before["points"][point][number] + by, abs=1e-6)
    assert (before["edited"], after["edited"], after["undo"], after["redo"]) == (False, True, True, False)
    go(curves, session, 200)
    curves.undo(session)
    go(curves, session, 200)
    back = curves.show(kind, "trot", "FL", session)
    for what in ("points", "line", "edited", "undo"):
        assert back[what] == before[what]
    assert back["redo"] and session.brain.coordinator.cycles == cycles
    curves.redo(session)
    again = curves.show(kind, "trot", "FL", session)
    assert again["points"] == after["points"] and again["line"] == after["line"]
    with pytest.raises(WrongUse, match="no undone edit"):
        curves.redo(session)
    assert len(json.dumps([before, out, after])) < 100_000


def test_the_ghost_is_what_was_measured() -> None:
    curves, session = walking(ticks=420)
    cycle, angle = (np.array(curves.show(k, "trot", "FL", session)["measured"]) for k in ("cycle", "angle"))
    assert (np.diff(cycle[:, 0]) >= 0.0).all(), "from touch-down on"
    line = np.array(curves.show("cycle", "trot", "FL", session)["line"])
    usual = np.interp(cycle[:, 0], line[:, 0], line[:, 2])
    assert np.abs(cycle[:, 2] - usual).max() < 0.06, "the foot goes nearly as it should [body heights]"
    q = session.lap.sensed.q[0]
    assert np.abs(angle[:, 1:] - q).max(axis=1).min() < 0.1


def test_a_mirrored_edit_is_the_same_seen_from_every_leg(profile) -> None:
    curves, session = walking(profiles=[profile], driver="learned")
    points = moved(curves, session, "torque", EDITS["torque"])
    points[2][1] += 1.5
    assert curves.edit("torque", "trot", "FL", points, True, session)["taken"]
    there = curves.show("torque", "trot", "FR", session)["points"]
    plain = Curves(GO2).show("torque", "trot", "FR", walking(ticks=1, profiles=[profile])[1])["points"]
    assert there[8][3] - plain[8][3] == pytest.approx(2.0, abs=1e-3)
    assert there[2][1] - plain[2][1] == pytest.approx(-1.5, abs=1e-3), "hip 1 of the other side, mirrored"
    again = curves.edit("torque", "trot", "FR", there, True, session)
    assert not again["taken"] and again["because"] == "no torque of trot was changed"


def test_without_a_mirror_only_these_legs_are_changed(profile) -> None:
    curves, session = walking(profiles=[profile], driver="learned")
    front, hind = (curves.show("cycle", "trot", leg, session)["points"] for leg in ("FR", "RL"))
    assert curves.edit("cycle", "trot", "FL", moved(curves, session, "cycle", LOWER), False, session)["taken"]
    assert curves.show("cycle", "trot", "FR", session)["points"][3][2] == pytest.approx(front[3][2] - 0.02)
    assert curves.show("cycle", "trot", "RL", session)["points"] == hind
    other = curves.show("torque", "trot", "RR", session)["line"]
    assert curves.edit(
        "torque", "trot", "FL", moved(curves, session, "torque", EDITS["torque"]), False, session
    )["taken"]
    assert curves.show("torque", "trot", "RR", session)["line"] == other


# --- when it takes effect ---------------------------------------------------------------------------
@pytest.mark.parametrize("skill", ["trot", "gallop"])
def test_it_takes_effect_at_the_next_cycle_and_no_foot_leaps(skill: str) -> None:
    curves, session = walking(skill, ticks=250)
    usual = leap(go(curves, session, 200))
    points = curves.show("cycle", skill, "FL", session)["points"]
    for point in points[1:-1]:
        point[2] *= 0.6
    before = session.brain
    assert curves.edit("cycle", skill, "FL", points, True, session)["taken"]
    assert session.brain is before and curves.show("cycle", skill, "FL", session)["pending"]
    seen, waited = [], 0
    while session.brain is before:
        was = session.lap.target.phase
        seen.append(go(curves, session, 1))
        waited += 1
    assert session.lap.target.phase < was, "a cycle begins"
    assert waited < 1.1 * session.lap.call.gait.period / 0.002
    seen.append(go(curves, session, 200))
    assert leap(np.concatenate(seen)) < 1.2 * usual
    assert type(session.brain.coordinator) is Coordinator and not curves.change.is_pending


def test_changed_at_once_a_foot_in_the_air_would_leap() -> None:
    curves, session = walking("gallop", ticks=250)
    usual = leap(go(curves, session, 200))
    cycle = curves.curve("cycle", "gallop", "FL", session, curves.history.now).cycle
    low = replace(cycle, points=tuple((s, x, 0.6 * z) for s, x, z in cycle.points))
    while session.lap.target.phase > 0.01:
        before = go(curves, session, 1)
    session.brain = session.brain.with_cycle("gallop", low)
    assert leap(np.concatenate([before, go(curves, session, 2)])) > 2.0 * usual


def test_another_brain_gets_the_edits_that_count() -> None:
    curves, session = walking()
    assert curves.edit("cycle", "trot", "FL", moved(curves, session, "cycle", LOWER), True, session)["taken"]
    fresh = curves.fit(Brain.of(GO2, FLAT))
    assert fresh.coordinator.cycles["trot"].points[3][2] == pytest.approx(0.18)
    curves.history.undo()
    assert "trot" not in curves.fit(Brain.of(GO2, FLAT)).coordinator.cycles


# --- the preview ------------------------------------------------------------------------------------
def test_a_preview_leaves_the_session_alone() -> None:
    (curves, watched), (_, alone) = walking(), walking()
    points = moved(curves, watched, "cycle", EDITS["cycle"])
    points[3][2] = 0.95
    assert not curves.edit("cycle", "trot", "FL", points, True, watched)["taken"]
    parts = curves.parts(watched.brain, curves.history.now)
    run(watched, Wish(Walk.of(GO2, "gallop", watched), 0, parts))
    for _ in range(60):
        watched.step()
        alone.step()
        np.testing.assert_array_equal(watched.measured.row, alone.measured.row)
        np.testing.assert_array_equal(watched.lap.command.row, alone.lap.command.row)


def test_the_preview_of_no_edit_is_what_then_happens() -> None:
    _, session = walking(ticks=133)
    laps, first = run(session, Wish(Walk.of(GO2, "trot", session), 0, Parts.of(session.brain)))
    assert pytest.approx((len(laps) - first) * 0.002, abs=0.003) == 2.0
    for lap in laps[:500]:
        then = session.step()
        assert then is not None
        np.testing.assert_array_equal(lap.sensed.row, then.sensed.row)


def test_an_edit_with_which_the_robot_falls_is_refused_with_the_time(profile) -> None:
    curves, session = walking(profiles=[profile], driver="learned")
    points = curves.show("torque", "trot", "FL", session)["points"]
    for point in points:
        point[3] -= 8.0
    out = curves.edit("torque", "trot", "FL", points, True, session)
    assert not out["taken"] and out["preview"]["fell"] and out["preview"]["seconds"] < 1.0
    assert "s after it takes effect: fell: the body" in out["because"]
    assert not curves.change.is_pending and not curves.history.before
    go(curves, session, 200)
    assert not session.is_over


def test_a_skill_that_is_not_in_use_is_taken_up_for_the_preview() -> None:
    curves, session = walking("trot")
    points = curves.show("cycle", "pace", "FL", session)["points"]
    points[3][2] -= 0.02
    out = curves.edit("cycle", "pace", "FL", points, True, session)
    assert out["taken"] and len(out["preview"]["path"]) > 50 and 0.0 < out["preview"]["torque_share"] <= 1.0
    assert session.mind.call.skill == "trot"


def test_a_robot_that_lies_there_is_previewed_from_its_start() -> None:
    curves, session = walking()
    session.plant.data.qpos[3:7] = (0.7, 0.7, 0.0, 0.0)
    session.measured = session.plant.sense()
    go(curves, session, 1)
    assert session.is_over
    out = curves.edit("cycle", "trot", "FL", moved(curves, session, "cycle", LOWER), True, session)
    assert out["taken"] and out["preview"]["seconds"] > 1.9


# --- at an obstacle ---------------------------------------------------------------------------------
def test_a_path_over_an_obstacle_becomes_an_operator(monkeypatch) -> None:
    for name, less in (("SETTLING", 0.5), ("SHOWN", 2.5), ("STARTS", 1)):
        monkeypatch.setattr(operator_lessons, name, less)
    curves, session = walking()
    out = curves.edit_at(Obstacle("block", 0.06), "trot", "FL", OVER, session)
    assert out["taken"], out["because"]
    go(curves, session, 200)
    (operator,) = session.brain.coordinator.operators
    assert operator.kinds == ("block",) and operator.largest == pytest.approx(0.099)
    assert "on FL in trot at 0.060 m, by the leg cycle of a person" in operator.taught
    curves.undo(session)
    go(curves, session, 200)
    assert session.brain.coordinator.operators == ()


def test_legs_that_are_amid_an_operator_stay_with_it() -> None:
    path = np.zeros((SHARES, 2))
    path[8:25, 1] = 1.0
    old, new = (Operator(name, ("block",), 0.1, path, np.zeros((SHARES, 3)), 0.16) for name in ("old", "new"))
    curves, session = walking("walk", ticks=150)
    brain = imagining(session.brain.with_operators([old]), (old,), 0, 0.05)
    session.brain = curves.fit(brain)
    while session.mind.memories.gait.state.operator[0] < 1.0:
        go(curves, session, 1)
    curves.history.add(Snapshot(operators=(new,)))
    curves.change.phase = 1.0
    curves.change.ask(curves.parts(session.brain, curves.history.now))
    curves.change.after(session)
    assert session.brain.coordinator.operators == (new, old)
    assert session.mind.memories.gait.state.operator[0] == 2.0
    curves.change.ask(with_operators(session, (new,)))
    curves.change.phase = 1.0
    curves.change.after(session)
    assert session.brain.coordinator.operators == (new, old), "the one in use may not go yet"
    while session.brain.coordinator.operators != (new,):
        go(curves, session, 1)
    assert session.mind.memories.gait.state.operator[0] <= 1.0


def with_operators(session: Session, operators: tuple[Operator, ...]) -> Parts:
    parts = Parts.of(session.brain)
    return parts._replace(coordinator=replace(parts.coordinator, operators=operators, imagined=()))


def test_one_that_is_lower_than_the_obstacle_is_none() -> None:
    curves, session = walking(ticks=1)
    out = curves.edit_at(Obstacle("step up", 0.09), "trot", "FL", OVER, session)
    assert (out["taken"], out["point"]) == (False, 3)
    assert "point 3, the highest, is 0.075 m over the ground; the step up is 0.090 m" in out["because"]
    with pytest.raises(WrongUse, match="no kind of obstacle 'wall'"):
        curves.edit_at(Obstacle("wall", 0.05), "trot", "FL", OVER, session)


# --- what is asked for wrongly ----------------------------------------------------------------------
@pytest.mark.parametrize(
    ("kind", "point", "number", "value", "told"),
    [
        ("cycle", 3, 2, 0.95, "knee would stand at"),
        ("cycle", 2, 2, float("nan"), "has not 3 finite numbers"),
        ("cycle", 3, 0, 0.2, "shares ascend"),
        ("cycle", 0, 2, 0.1, "lift-off is always"),
        ("angle", 3, 3, -3.0, "its limits are -2.72 to -0.838 rad"),
        ("angle", 3, 1, 0.3, "out of the plane of its path"),
        ("angle", 6, 2, 1.2, "where the foot meets the ground"),
        ("torque", 4, 3, 60.0, "its limit is 45.4 N·m"),
        ("torque", 4, 0, 0.26, "phases ascend"),
        ("torque", 4, 0, 1.2, "a phase is 0 or more and below 1"),
    ],
)
def test_a_wrong_point_is_refused_by_its_number(
    kind: str, point: int, number: int, value: float, told: str, profile
) -> None:
    curves, session = walking(ticks=1, profiles=[profile])
    points = curves.show(kind, "trot", "FL", session)["points"]
    points[point][number] = value
    out = curves.edit(kind, "trot", "FL", points, True, session)
    assert not out["taken"] and told in out["because"]
    assert out["point"] == point + 1 and f"point {point + 1}" in out["because"]


def test_a_torque_that_leaps_is_refused_by_the_point_that_was_moved(profile) -> None:
    curves, session = walking(ticks=1, profiles=[profile])
    points = curves.show("torque", "trot", "FL", session)["points"]
    points[3] = [points[2][0] + 0.03, *points[3][1:]]
    points[3][3] += 15.0
    out = curves.edit("torque", "trot", "FL", points, True, session)
    assert out["point"] == 4 and "the torque of knee leaps" in out["because"]


@pytest.mark.parametrize(
    ("kind", "skill", "leg", "told"),
    [
        ("speed", "trot", "FL", "no kind of curve 'speed'; there is: cycle, torque, angle"),
        ("cycle", "hop", "FL", "no skill 'hop'"),
        ("cycle", "trot", "XX", "no leg of go2 'XX'"),
        ("cycle", "stand", "FL", "stand lifts no foot"),
        ("torque", "walk", "FL", "go2 plays no torque profile of walk; there is: none"),
    ],
)
def test_a_curve_that_there_is_not_is_told(kind: str, skill: str, leg: str, told: str) -> None:
    curves, session = walking(ticks=1)
    with pytest.raises(WrongUse, match=told):
        curves.show(kind, skill, leg, session)


def test_points_that_are_not_moved_are_no_edit() -> None:
    curves, session = walking(ticks=1)
    for kind in ("cycle", "angle"):
        points = curves.show(kind, "trot", "FL", session)["points"]
        out = curves.edit(kind, "trot", "FL", points, True, session)
        assert out["because"] == "no point of trot was moved" and out["point"] is None
    assert not Change().is_pending
