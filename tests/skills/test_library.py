"""The rows of the library: scaled by the robot's size, phased for its legs, kept within its reach."""

from dataclasses import replace
from math import sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.errors import WrongUse
from gaitwright.model.robot import Robot
from gaitwright.skills.library import (
    FOUR_LEGGED,
    LIBRARY,
    MANY_LEGGED,
    PATTERNS,
    check_speed,
    fastest,
    find_skill,
    gait_of,
    relative_phases,
    skill_names,
    speed_scale,
)
from oracles import robot_called

ROBOTS = ["go2", "thesis", "hexapod", "dog"]
SKILLS = pytest.mark.parametrize("skill", LIBRARY.values(), ids=lambda skill: skill.name)


def grown(robot: Robot, k: float) -> Robot:
    """The same robot with all lengths `k` times as long."""
    lengths = {
        name: k * getattr(robot, name)
        for name in ("base_com", "hip", "offset", "com", "foot_radius", "nominal_feet")
    }
    return replace(robot, **lengths, trunk=k * robot.trunk)


def in_stance(gait, samples: int = 400) -> np.ndarray:
    """Which legs the schedule has on the ground, over one cycle `(samples, legs)`."""
    phase = (np.arange(samples) + 0.5) / samples
    return (phase[:, None] + np.array(gait.offsets)) % 1.0 < gait.duty


# --- size ----------------------------------------------------------------------------------------
@given(st.floats(0.1, 20.0), st.sampled_from(sorted(LIBRARY)))
def test_a_larger_robot_does_the_same_at_equal_froude_numbers(k: float, name: str) -> None:
    skill, small = LIBRARY[name], robot_called("dog")
    large = grown(small, k)
    assert large.height == pytest.approx(k * small.height)
    assert gait_of(skill, large).period == pytest.approx(sqrt(k) * gait_of(skill, small).period)
    assert gait_of(skill, large).duty == skill.duty
    assert speed_scale(large) == pytest.approx(sqrt(k) * speed_scale(small))
    assert fastest(skill, large) == pytest.approx(sqrt(k) * fastest(skill, small))


@SKILLS
@pytest.mark.parametrize("name", ROBOTS)
def test_a_skill_can_be_done_at_the_speed_it_is_meant_for(skill, name: str) -> None:
    robot = robot_called(name)
    check_speed(skill, robot, skill.speed * speed_scale(robot))


@SKILLS
def test_a_row_makes_sense(skill) -> None:
    assert skill.period > 0.0 and 0.0 < skill.duty <= 1.0
    assert 0.0 <= skill.speed <= skill.fastest
    assert skill.offsets in PATTERNS and skill.about


# --- phases --------------------------------------------------------------------------------------
@pytest.mark.parametrize("legs", [4, 6, 8])
@pytest.mark.parametrize("name", MANY_LEGGED)
def test_every_leg_has_a_phase(legs: int, name: str) -> None:
    phases = relative_phases(LIBRARY[name].offsets, legs)
    assert len(phases) == legs
    assert all(0.0 <= phase < 1.0 for phase in phases)


@pytest.mark.parametrize("legs", [4, 6, 8])
def test_in_trot_every_neighbour_is_opposite(legs: int) -> None:
    """Legs come in pairs from front to rear, left first: neighbours stand beside, before or behind."""
    phases = np.array(relative_phases("diagonal", legs)).reshape(-1, 2)
    np.testing.assert_array_equal(np.abs(phases[:, 0] - phases[:, 1]), 0.5)
    np.testing.assert_array_equal(np.abs(np.diff(phases, axis=0)), 0.5)


def test_the_trot_of_six_legs_is_alternate_tripods() -> None:
    """FL FR ML MR RL RR: one tripod is front left, middle right, rear left."""
    assert relative_phases("diagonal", 6) == (0.0, 0.5, 0.5, 0.0, 0.0, 0.5)


@pytest.mark.parametrize("legs", [4, 6, 8])
def test_a_walk_lifts_few_legs_at_a_time_and_never_both_of_a_pair(legs: int) -> None:
    pattern, duty = LIBRARY["walk"].offsets, LIBRARY["walk"].duty
    phase = (np.arange(400) + 0.5) / 400
    down = (phase[:, None] + np.array(relative_phases(pattern, legs))) % 1.0 < duty
    assert (~down).sum(axis=1).max() <= legs / 3 if legs > 4 else (~down).sum(axis=1).max() == 1
    pairs = down.reshape(-1, legs // 2, 2)
    assert pairs.any(axis=2).all(), "one of each pair is always down"


@pytest.mark.parametrize("legs", [4, 6, 8])
def test_in_a_walk_each_leg_follows_the_one_behind_it(legs: int) -> None:
    """The wave of lift-offs runs forward along each side: the lateral sequence, which is the stable one."""
    phases = np.array(relative_phases("walk", legs)).reshape(-1, 2)
    delays = (phases[1:] - phases[:-1]) % 1.0  # how much later a leg lifts than the one behind it
    np.testing.assert_allclose((phases[:, 1] - phases[:, 0]) % 1.0, 0.5)
    np.testing.assert_allclose(delays, 0.25 if legs == 4 else 2.0 / legs)


FL, FR, RL, RR = range(4)
TOGETHER = {
    "trot": [{FL, RR}, {FR, RL}],
    "pace": [{FL, RL}, {FR, RR}],
    "bound": [{FL, FR}, {RL, RR}],
    "pronk": [{FL, FR, RL, RR}],
    "rack": [{FL}, {FR}, {RL}, {RR}],
}


@pytest.mark.parametrize("name", TOGETHER)
def test_the_symmetric_gaits_of_four_legs_are_what_their_names_say(name: str) -> None:
    phases = relative_phases(LIBRARY[name].offsets, 4)
    steps = np.unique(phases)
    groups = [{leg for leg in range(4) if phases[leg] == step} for step in steps]
    assert sorted(map(sorted, groups)) == sorted(map(sorted, TOGETHER[name]))
    np.testing.assert_allclose(np.diff([*steps, steps[0] + 1.0]), 1.0 / len(steps))


@pytest.mark.parametrize("name", sorted(LIBRARY))
def test_only_flying_gaits_leave_the_ground(name: str) -> None:
    gait = gait_of(LIBRARY[name], robot_called("dog"))
    flies = not in_stance(gait).any(axis=1).all()
    assert flies == (name in {"run", "pronk"})


# --- limits --------------------------------------------------------------------------------------
def test_a_speed_beyond_reach_is_refused_with_numbers() -> None:
    robot = robot_called("thesis")
    with pytest.raises(WrongUse) as refused:
        check_speed(LIBRARY["trot"], robot, 50.0)
    sentence = str(refused.value)
    limit = fastest(LIBRARY["trot"], robot)
    for part in ("trot", "50 m/s", "thesis", "98 N", "5.00 m", f"at most {limit:.2f} m/s"):
        assert part in sentence


@pytest.mark.parametrize("name", sorted(LIBRARY))
def test_the_limit_itself_is_allowed(name: str) -> None:
    robot = robot_called("dog")
    limit = fastest(LIBRARY[name], robot)
    check_speed(LIBRARY[name], robot, limit)
    with pytest.raises(WrongUse):
        check_speed(LIBRARY[name], robot, 1.001 * limit + 1e-6)


def test_a_speed_that_is_no_number_is_refused() -> None:
    with pytest.raises(WrongUse):
        check_speed(LIBRARY["trot"], robot_called("dog"), float("nan"))


def test_an_unknown_skill_names_those_that_exist() -> None:
    with pytest.raises(WrongUse) as refused:
        find_skill("moonwalk", robot_called("dog"))
    assert "'moonwalk'" in str(refused.value)
    assert all(name in str(refused.value) for name in skill_names(4))


def test_six_legs_do_not_gallop() -> None:
    robot = robot_called("hexapod")
    with pytest.raises(WrongUse) as refused:
        find_skill("gallop", robot)
    assert str(refused.value).endswith(", ".join(MANY_LEGGED))
    assert [find_skill(name, robot).name for name in skill_names(6)] == list(skill_names(6))
    assert not set(FOUR_LEGGED) & set(skill_names(6)) and not set(MANY_LEGGED) & set(skill_names(4))
