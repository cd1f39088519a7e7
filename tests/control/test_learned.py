"""What was taught is played back exactly where nothing differs, and is made up for where something does."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.control.forces import FORCE_WEIGHTS, MOMENT_WEIGHTS
from gaitwright.control.handover import LASTS
from gaitwright.control.learned.contact_maps import contact_maps
from gaitwright.control.learned.controller import LearnedController
from gaitwright.control.learned.law import TANGENT, note
from gaitwright.control.learned.profile import BINS, ROW, Profile, mean_cycle, row_of
from gaitwright.control.numerical import NumericalController
from gaitwright.control.programmed import played as played_row
from gaitwright.errors import WrongUse
from gaitwright.ground.scene import load_scene
from gaitwright.learning.profile_lessons import taught
from gaitwright.locomotion import Brain, Lap
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import DT, Session
from gaitwright.signals import Gait, Mission, MotorCommand
from gaitwright.skills.chooser import fixed_skill
from oracles import robot_called

DOG = robot_called("dog")
WEIGHT = DOG.total_mass * GRAVITY
SKILLS = ("trot", "walk", "pronk")


@cache
def teacher() -> NumericalController:
    return NumericalController(DOG)


@cache
def learned(skill: str) -> LearnedController:
    return LearnedController(DOG, {skill: (taught(DOG, skill),)}, teacher())


@cache
def laps(skill: str) -> tuple[Lap, ...]:
    """Some laps of a steady gait under the numerical controller."""
    session = begin(skill, seed=5)
    return tuple([lap for lap in session if lap.sensed.time > 1.0][::7])


def begin(skill: str, seed: int, seconds: float = 1.6, robot: Robot = DOG) -> Session:
    scene = load_scene("flat", seed)
    brain = Brain.of(robot, scene, fixed_skill(robot, skill, None, 0.0, None, ""), DT, watches=False)
    if robot is DOG and seed != 5:
        brain = replace(brain, controllers={**brain.controllers, "learned": learned(skill)})
    return Session(brain, MujocoPlant(robot, scene, DT), Mission(()), seconds, seed)


def profile_of(lap: Lap) -> Profile:
    """A profile that is one lap, at every phase."""
    row = np.empty(ROW.size(DOG.n))
    note(DOG.packed, lap.sensed.row, lap.target.row, lap.command.tau, lap.command.forces_w, row)
    return Profile(lap.call.gait, (0.0, 0.0, 0.0), np.tile(row, (BINS, 1)))


def played(lap: Lap, profile: Profile, **changed) -> MotorCommand:
    controller = LearnedController(DOG, {profile.skill: (profile,)}, teacher())
    seen = {name: value for name, value in changed.items() if name in ("q", "qd", "velocity_w")}
    asked = {name: value for name, value in changed.items() if name not in seen}
    target, sensed = replace(lap.target, **asked), replace(lap.sensed, **seen)
    return controller.command(target, sensed, None, lap.call)[0]


# --- the law ---------------------------------------------------------------------------------------
@pytest.mark.parametrize("skill", SKILLS)
def test_where_nothing_is_different_the_teachers_torque_comes_back(skill):
    for lap in laps(skill):
        command = played(lap, profile_of(lap))
        np.testing.assert_allclose(command.tau, lap.command.tau, atol=0.02 * DOG.tau_max.min())
        down = lap.target.stance
        np.testing.assert_allclose(command.forces_w[down], lap.command.forces_w[down], atol=0.02 * WEIGHT)
        assert not command.forces_w[~down].any()


def test_feet_that_are_down_make_up_for_one_that_is_missing():
    lap = next(lap for lap in laps("walk") if lap.target.stance.sum() == 4)
    loaded = int(np.argmax(lap.command.forces_w[:, 2]))
    stance, share = lap.target.stance.copy(), np.ones(DOG.n)
    stance[loaded], share[loaded] = False, 0.0
    before, after = lap.command, played(lap, profile_of(lap), stance=stance, load_scale=share)
    lost = WEIGHT - float((before.forces_w[:, 2] * stance).sum())
    got = float(after.forces_w[:, 2].sum()) - float((before.forces_w[:, 2] * stance).sum())
    assert lost > 0.1 * WEIGHT and got > 0.5 * lost
    assert played(lap, profile_of(lap)).residual < 0.05 < after.residual


@given(st.integers(0, 10_000), st.floats(0.0, 1.0))
def test_limits_hold_wherever_the_robot_is(seed, phase):
    rng = np.random.default_rng(seed)
    lap = laps("trot")[seed % len(laps("trot"))]
    q = rng.uniform(DOG.q_min, DOG.q_max)
    command = played(
        lap,
        profile_of(lap),
        q=q,
        qd=rng.normal(0.0, 10.0, q.shape),
        velocity_w=rng.normal(0.0, 2.0, 3),
        stance=rng.uniform(size=DOG.n) < 0.6,
        load_scale=rng.uniform(0.0, 1.0, DOG.n),
        phase=phase,
    )
    assert (np.abs(command.tau) <= DOG.tau_max + 1e-9).all()
    normal = lap.target.normal_w
    along = command.forces_w @ normal
    tangent = np.linalg.norm(command.forces_w - np.outer(along, normal), axis=1)
    assert (along >= -1e-9).all() and (tangent <= TANGENT * lap.target.friction * along + 1e-6).all()


def test_what_is_no_number_is_not_hidden():
    lap = laps("trot")[0]
    assert np.isnan(played(lap, profile_of(lap), q=np.full((DOG.n, 3), np.nan)).tau).all()


def test_feet_make_up_a_wrench_and_those_that_are_up_have_no_force():
    maps, rng = contact_maps(DOG), np.random.default_rng(0)
    arms = DOG.nominal_feet - DOG.foot_radius[:, None] * np.array([0.0, 0.0, 1.0])
    for feet in range(1, 1 << DOG.n):
        down = np.array([bool(feet >> k & 1) for k in range(DOG.n)])
        wanted = rng.normal(size=6)
        forces = (maps[feet] @ wanted).reshape(DOG.n, 3)
        assert not forces[~down].any()
        force = forces.sum(axis=0) * FORCE_WEIGHTS
        moment = np.cross(arms, forces).sum(axis=0) / DOG.height * MOMENT_WEIGHTS
        if down.sum() >= 3:
            np.testing.assert_allclose([*force, *moment], wanted, atol=0.02)


# --- tables ----------------------------------------------------------------------------------------
def test_the_mean_cycle_is_that_of_what_was_seen_and_gaps_are_bridged():
    rng = np.random.default_rng(1)
    phases = rng.uniform(0.0, 1.0, 6000)
    phases = phases[(phases < 0.42) | (phases > 0.45)]

    def wave(phase):
        return np.stack([np.sin(2 * np.pi * phase), np.cos(4 * np.pi * phase)], axis=1)

    table = mean_cycle(phases, wave(phases) + rng.normal(0.0, 0.05, (len(phases), 2)))
    np.testing.assert_allclose(table, wave(np.arange(BINS) / BINS), atol=0.08)
    with pytest.raises(WrongUse, match="phases of the cycle were seen"):
        mean_cycle(phases[phases < 0.3], wave(phases[phases < 0.3]))


def gait(name: str = "trot") -> Gait:
    return Gait(name, 0.4, 0.6, (0.0, 0.5, 0.5, 0.0))


def test_a_table_goes_round():
    table = np.arange(BINS, dtype=float)[:, None] * np.ones((1, 3))
    np.testing.assert_allclose(played_row(table, 0.5 / BINS), 0.5)
    np.testing.assert_allclose(played_row(table, 1.0 - 0.5 / BINS), (BINS - 1) / 2)
    np.testing.assert_allclose(played_row(table, -0.25), played_row(table, 0.75))


@pytest.mark.parametrize(
    ("table", "told"),
    [(np.zeros((BINS, 7)), "128 rows of"), (np.full((BINS, ROW.size(4)), np.nan), "not finite")],
)
def test_tables_that_are_none_are_refused(table, told):
    with pytest.raises(WrongUse, match=told):
        Profile(gait(), (0.0, 0.0, 0.0), table)


def test_profiles_of_other_legs_are_refused():
    six = Profile(Gait("trot", 0.4, 0.6, (0.0,) * 6), (0.0, 0.0, 0.0), np.zeros((BINS, ROW.size(6))))
    with pytest.raises(WrongUse, match="other legs than dog"):
        LearnedController(DOG, {"trot": (six,)}, teacher())


# --- in physics ------------------------------------------------------------------------------------
@pytest.mark.parametrize("skill", ["trot", "walk"])
def test_it_drives_on_where_the_teacher_stopped_and_no_torque_leaps(skill):
    for seed in (11, 12):
        session = begin(skill, seed, 4.0)
        steps, speeds, shares = [], [], []
        for lap in session:
            if lap.call.driver == "numerical" and lap.sensed.time > 1.0 + 0.07 * seed:
                last = lap.command.tau
                session.drive("learned")
            elif lap.call.driver == "learned":
                steps.append(np.abs(lap.command.tau - last).max())
                last = lap.command.tau
                speeds.append(lap.sensed.velocity_w[:2])
                shares.append(session.mind.memories.control[-1])
        asked = np.hypot(*lap.call.velocity)
        assert not lap.fell and abs(np.linalg.norm(np.mean(speeds[200:], axis=0)) - asked) < 0.05 * asked
        assert steps[0] <= 0.02 * DOG.tau_max.max() + np.median(steps)
        assert np.mean(shares[200:]) > 0.9


def test_a_change_of_driver_is_over_after_a_while_and_works_both_ways():
    session = begin("trot", 13, 3.0)
    plain, changes = None, 0
    for lap in session:
        time = lap.sensed.time
        if changes < 6 and time > 0.8 + 0.17 * changes:
            session.drive("learned" if lap.call.driver == "numerical" else "numerical")
            changes, plain = changes + 1, time + LASTS + 2 * DT
        if plain is not None and plain < time < plain + 0.02:
            assert session.mind.memories.change is None
    assert changes == 6 and not lap.fell


def test_a_skill_without_a_profile_is_driven_by_the_teacher():
    lap = laps("walk")[3]
    command, _ = learned("trot").command(lap.target, lap.sensed, None, lap.call)
    np.testing.assert_allclose(command.tau, teacher().command(lap.target, lap.sensed, None, lap.call)[0].tau)


def test_what_is_noted_is_what_was():
    lap = laps("trot")[0]
    row = row_of(profile_of(lap).table[0])
    np.testing.assert_array_equal(row.tau, lap.command.tau)
    np.testing.assert_array_equal(row.q, lap.sensed.q)
    assert 0.9 * DOG.stand < row.pose[0] < 1.1 * DOG.stand and np.abs(row.pose[1:]).max() < 0.2
    assert abs(row.velocity[0] - lap.call.velocity[0]) < 0.3
    np.testing.assert_allclose(row.force.sum(axis=0)[2], lap.command.forces_w.sum(axis=0)[2], rtol=1e-3)
