"""At another pace the legs' weight stays what it is, and the rest of the torques goes with its square."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gaitwright.control.learned.controller import LearnedController
from gaitwright.control.learned.profile import ROW, Profile, row_of, torque_error
from gaitwright.control.learned.warp import warped, weight_torques
from gaitwright.control.numerical import NumericalController
from gaitwright.errors import WrongUse
from gaitwright.gait.desired_cycle import desired_cycle
from gaitwright.learning.profile_lessons import cycle_of, taught
from gaitwright.signals import Gait, SkillCall
from gaitwright.skills.chooser import HeldSkill, fixed_skill
from oracles import robot_called

DOG = robot_called("dog")
WHERE = ROW.slices(DOG.n)
STRONGEST = float(DOG.tau_max.max())


@cache
def profile(skill: str = "trot") -> Profile:
    return taught(DOG, skill)


@cache
def controller() -> LearnedController:
    return LearnedController(DOG, {"trot": (profile(),)}, NumericalController(DOG))


def gait_at(ratio: float) -> Gait:
    return replace(profile().gait, period=profile().gait.period * ratio)


def test_at_its_own_pace_nothing_changes():
    same = warped(DOG, profile(), 1.0)
    np.testing.assert_allclose(same.table, profile().table, atol=1e-12)
    assert (same.gait, same.command) == (profile().gait, profile().command)


@given(st.floats(0.9, 1.09), st.floats(0.9, 1.09))
@settings(max_examples=8)
def test_two_warps_are_one(first, then):
    twice, once = warped(DOG, warped(DOG, profile(), first), then), warped(DOG, profile(), first * then)
    np.testing.assert_allclose(twice.table, once.table, atol=1e-9)
    np.testing.assert_allclose(twice.command, once.command)
    assert twice.gait.period == pytest.approx(once.gait.period)


@given(st.floats(0.8, 1.2))
@settings(max_examples=8)
def test_the_path_and_the_forces_stay_and_what_is_not_weight_goes_with_the_square_of_the_pace(ratio):
    before, after = profile().table, warped(DOG, profile(), ratio).table
    held = weight_torques(DOG, before).reshape(len(before), -1)
    for name in ("force", "tip", "lag", "q", "stance", "pose", "feedback"):
        np.testing.assert_array_equal(after[:, WHERE[name]], before[:, WHERE[name]])
    for name in ("qd", "velocity", "omega", "lag_rate"):
        np.testing.assert_allclose(after[:, WHERE[name]] * ratio, before[:, WHERE[name]])
    free = before[:, WHERE["free"]]
    np.testing.assert_allclose((after[:, WHERE["free"]] - held) * ratio**2, free - held, atol=1e-9)
    moved = after[:, WHERE["tau"]] - after[:, WHERE["free"]]
    np.testing.assert_allclose(moved, before[:, WHERE["tau"]] - free, atol=1e-9)


def test_a_standing_leg_takes_its_weight_alone_and_so_the_same_at_any_pace():
    stand = profile("stand")
    np.testing.assert_allclose(
        row_of(stand.table[0]).free, weight_torques(DOG, stand.table)[0], atol=0.01 * STRONGEST
    )
    for ratio in (0.8, 1.2):
        off = warped(DOG, stand, ratio).table - stand.table
        assert np.abs(off[:, WHERE["tau"]]).max() < 0.005 * STRONGEST


@pytest.mark.parametrize("ratio", [0.79, 1.21, 3.0])
def test_beyond_a_fifth_it_is_refused(ratio):
    with pytest.raises(WrongUse, match=r"trot can be played at 0\.8 to 1\.2 times its period"):
        warped(DOG, profile(), ratio)


def test_a_gait_at_another_pace_has_cells_of_its_own_and_one_far_from_it_has_none():
    slow = controller().cells_of(gait_at(1.1))
    assert slow is not None and slow is controller().cells_of(gait_at(1.1))
    assert slow.period == pytest.approx(1.1 * profile().gait.period)
    np.testing.assert_allclose(slow.speeds, profile().command[0] / 1.1)
    np.testing.assert_allclose(slow.tables[0, 0], warped(DOG, profile(), 1.1).table)
    own = controller().cells_of(profile().gait)
    np.testing.assert_array_equal(own.tables[0, 0], profile().table)
    assert controller().cells_of(gait_at(1.25)) is None


def test_far_from_its_pace_the_teacher_drives():
    for ratio, is_played in ((1.1, True), (1.25, False)):
        gait, speed = gait_at(ratio), profile().command[0] / ratio
        cycle = desired_cycle(DOG, gait, (speed, 0.0))
        target, sensed, call = cycle.target(20), cycle.sensed(20), SkillCall("trot", gait, (speed, 0.0), 0.0)
        tau = controller().command(target, sensed, None, call)[0].tau
        teachers = controller().teacher.command(target, sensed, None, call)[0].tau
        assert controller().covers(gait, target) == is_played
        assert np.array_equal(tau, teachers) != is_played


@pytest.mark.parametrize("ratio", [0.85, 1.15])
def test_what_is_taught_at_another_pace_is_what_the_warp_says(ratio):
    speed = profile().command[0] / ratio
    call = fixed_skill(DOG, "trot", speed, 0.0, 0.0, "numerical").skill_call
    fresh = cycle_of(DOG, HeldSkill(replace(call, gait=gait_at(ratio))), 0)
    assert torque_error(warped(DOG, profile(), ratio).table, fresh, DOG.n) < 0.1
