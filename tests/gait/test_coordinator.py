"""The coordinator is a function of what it is handed: no memory of its own, no north, no left-handedness."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gaitwright.gait.command import MAX_YAW_LEAD, POSITION_LEASH, SLEW, TURN_SLEW
from gaitwright.gait.coordinator import Coordinator
from gaitwright.gait.hurry import HURRY
from gaitwright.gait.state import GaitMemory
from gaitwright.model.kinematics import angles, feet
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, heading, quaternion_of, rotation, wrap, yaw_quaternion
from gaitwright.signals import MotionTarget, Sensed, SkillCall
from gaitwright.skills.library import LIBRARY, MANY_LEGGED, gait_of
from oracles import robot_called

DT = 0.002
DOG = robot_called("dog")
COORDINATOR = Coordinator(DOG, DT)
seeds = st.integers(0, 2**32 - 1)
skills = st.sampled_from(sorted(LIBRARY))


def call_of(skill: str, velocity=(0.3, -0.1), turn: float = 0.4, robot: Robot = DOG) -> SkillCall:
    return SkillCall(skill, gait_of(LIBRARY[skill], robot), velocity, turn, "numerical", "a test asks")


def story(rng: np.random.Generator, ticks: int, robot: Robot = DOG) -> list[Sensed]:
    """What a robot might sense while it stumbles along: no physics, but nothing impossible."""
    q, _ = angles(robot, robot.nominal_feet)
    yaw, place = rng.uniform(-3.0, 3.0), np.array([*rng.uniform(-2.0, 2.0, 2), robot.height])
    load, told = np.full(robot.n, robot.total_mass * GRAVITY / robot.n), []
    for tick in range(ticks):
        velocity = np.array([0.3, 0.1, 0.0]) + rng.normal(0.0, 0.1, 3)
        place = place + DT * velocity
        tilt = rotation(np.array([1.0, *rng.normal(0.0, 0.03, 3)]))
        load = np.where(rng.random(robot.n) < 0.05, rng.choice([0.0, 1.0], robot.n) * 40.0, load)
        orientation = quaternion_of(rotation(yaw_quaternion(yaw)) @ tilt)
        sway = 0.05 * rng.normal(size=(robot.n, 3))
        told.append(
            Sensed(
                tick * DT, place, orientation, velocity, rng.normal(0.0, 0.3, 3), q + sway, 0.0 * sway, load
            )
        )
    return told


def follow(
    sensed: list[Sensed], call: SkillCall, phase: float, robot: Robot = DOG
) -> list[tuple[MotionTarget, GaitMemory]]:
    """Targets and memories, tick by tick."""
    coordinator = COORDINATOR if robot is DOG else Coordinator(robot, DT)
    state, out = coordinator.begin(sensed[0], phase), []
    for now in sensed:
        target, state = coordinator.move(state, call, now)
        out.append((target, state))
    return out


def numbers(told: list[tuple[MotionTarget, GaitMemory]]) -> dict[str, np.ndarray]:
    """All targets, field by field; the first axis is time."""
    fields = MotionTarget.__dataclass_fields__
    return {name: np.array([getattr(target, name) for target, _ in told], dtype=float) for name in fields}


def assert_same(one: dict[str, np.ndarray], two: dict[str, np.ndarray], atol: float = 0.0) -> None:
    for name, value in one.items():
        np.testing.assert_allclose(value, two[name], rtol=0, atol=atol, err_msg=name)


# --- values in, values out -----------------------------------------------------------------------
@given(seeds, skills)
@settings(max_examples=10)
def test_what_is_handed_in_is_left_as_it_was(seed: int, skill: str) -> None:
    sensed = story(np.random.default_rng(seed), 40)
    state = COORDINATOR.begin(sensed[0], 0.3)
    for now in sensed:
        before = state.row.tobytes()
        seen = [np.array(getattr(now, name)).tobytes() for name in Sensed.__dataclass_fields__]
        _, new = COORDINATOR.move(state, call_of(skill), now)
        assert state.row.tobytes() == before
        assert [np.array(getattr(now, name)).tobytes() for name in Sensed.__dataclass_fields__] == seen
        assert not np.shares_memory(state.row, new.row)
        state = new


@given(seeds, skills)
@settings(max_examples=10)
def test_the_same_input_gives_the_same_output_to_the_bit(seed: int, skill: str) -> None:
    sensed = story(np.random.default_rng(seed), 60)
    one, two = (follow(sensed, call_of(skill), 0.1) for _ in range(2))
    assert_same(numbers(one), numbers(two))
    assert [a.row.tobytes() for _, a in one] == [b.row.tobytes() for _, b in two]


def test_a_memory_can_be_taken_up_again_later() -> None:
    sensed = story(np.random.default_rng(5), 60)
    whole = follow(sensed, call_of("trot"), 0.1)
    state, again = whole[29][1], []
    for now in sensed[30:]:
        again.append(Coordinator(DOG, DT).move(state, call_of("trot"), now))
        state = again[-1][1]
    assert_same(numbers(again), numbers(whole[30:]))


# --- the phase -----------------------------------------------------------------------------------
@given(seeds, skills, st.floats(0.0, 0.999))
@settings(max_examples=15)
def test_the_phase_goes_on_by_a_tick_or_waits(seed: int, skill: str, phase: float) -> None:
    call = call_of(skill)
    sensed = story(np.random.default_rng(seed), 60)
    step, before = DT / call.gait.period, phase
    for target, state in follow(sensed, call, phase):
        gone = (target.phase - before + 0.5) % 1.0 - 0.5
        if call.gait.duty == 1.0:
            assert gone == 0.0
        else:
            assert (1.0 - 1e-9) * step <= gone <= (1.0 + HURRY + 1e-9) * step or gone == 0.0
        assert 0.0 <= target.phase < 1.0 and target.phase == state.row[0]
        before = target.phase


@pytest.mark.parametrize("skill", sorted(LIBRARY))
def test_with_feet_that_land_a_little_early_a_cycle_takes_its_period(skill: str) -> None:
    call = call_of(skill)
    gait = call.gait
    sensed = replace(story(np.random.default_rng(1), 2)[1], velocity_w=np.zeros(3))
    state = COORDINATOR.begin(sensed, 0.2)
    phase, ticks = 0.2, round(3 * gait.period / DT)
    for _ in range(ticks):
        due = (phase + 0.03 + np.array(gait.offsets)) % 1.0 < gait.duty
        target, state = COORDINATOR.move(state, call, replace(sensed, load=40.0 * due))
        phase = target.phase
    gone = 0.0 if gait.duty == 1.0 else ticks * DT / gait.period
    assert (phase - 0.2 - gone + 0.5) % 1.0 == pytest.approx(0.5, abs=1e-9)


# --- symmetry ------------------------------------------------------------------------------------
def turned(yaw: float, shift: np.ndarray, s: Sensed) -> Sensed:
    """The same, seen by someone who looks from elsewhere."""
    R = rotation(yaw_quaternion(yaw))
    return replace(
        s,
        position_w=R @ s.position_w + shift,
        orientation_wb=quaternion_of(R @ rotation(s.orientation_wb)),
        velocity_w=R @ s.velocity_w,
    )


WORLD_VECTORS = ("normal_w", "velocity_w", "acceleration_w", "angular_velocity_w", "angular_acceleration_w",
                 "feet_velocity_w", "feet_acceleration_w")  # fmt: skip


@given(seeds, skills, st.floats(-3.0, 3.0))
@settings(max_examples=8)
def test_there_is_no_north_and_no_origin(seed: int, skill: str, yaw: float) -> None:
    rng = np.random.default_rng(seed)
    sensed, shift = story(rng, 80), np.array([*rng.uniform(-5.0, 5.0, 2), rng.uniform(-1.0, 1.0)])
    R = rotation(yaw_quaternion(yaw))
    elsewhere = follow([turned(yaw, shift, s) for s in sensed], call_of(skill), 0.2)
    expected = numbers(follow(sensed, call_of(skill), 0.2))
    for name in WORLD_VECTORS:
        expected[name] = expected[name] @ R.T
    for name in ("position_w", "feet_w"):
        expected[name] = expected[name] @ R.T + shift
    expected["rotation_wb"] = R @ expected["rotation_wb"]
    assert_same(numbers(elsewhere), expected, atol=1e-7)


MIRROR = np.array([1.0, -1.0, 1.0])
AXIAL = -MIRROR
OTHER_SIDE = [1, 0, 3, 2]


def mirrored(s: Sensed) -> Sensed:
    """The same behind a mirror between left and right."""
    return replace(
        s,
        position_w=MIRROR * s.position_w,
        orientation_wb=s.orientation_wb * [1, -1, 1, -1],
        velocity_w=MIRROR * s.velocity_w,
        angular_velocity_b=AXIAL * s.angular_velocity_b,
        q=s.q[OTHER_SIDE] * [-1, 1, 1],
        qd=s.qd[OTHER_SIDE] * [-1, 1, 1],
        load=s.load[OTHER_SIDE],
    )


@given(seeds, skills)
@settings(max_examples=8)
def test_left_and_right_are_alike(seed: int, skill: str) -> None:
    sensed, call = story(np.random.default_rng(seed), 80), call_of(skill)
    swapped = tuple(call.gait.offsets[leg] for leg in OTHER_SIDE)
    other = replace(
        call,
        velocity=(call.velocity[0], -call.velocity[1]),
        turn=-call.turn,
        gait=replace(call.gait, offsets=swapped),
    )
    behind = follow([mirrored(s) for s in sensed], other, 0.2)
    expected = numbers(follow(sensed, call, 0.2))
    for name in ("normal_w", "position_w", "velocity_w", "acceleration_w"):
        expected[name] = MIRROR * expected[name]
    for name in ("angular_velocity_w", "angular_acceleration_w"):
        expected[name] = AXIAL * expected[name]
    for name in ("feet_w", "feet_velocity_w", "feet_acceleration_w"):
        expected[name] = MIRROR * expected[name][:, OTHER_SIDE]
    expected["rotation_wb"] = MIRROR[:, None] * expected["rotation_wb"] * MIRROR
    expected["q"] = expected["q"][:, OTHER_SIDE] * [-1, 1, 1]
    for name in ("stance", "load_scale", "friction"):
        expected[name] = expected[name][:, OTHER_SIDE]
    expected["command"] = expected["command"] * [1, -1, -1]
    assert_same(numbers(behind), expected, atol=1e-7)


# --- what a target is ----------------------------------------------------------------------------
@pytest.mark.parametrize("name", ["dog", "go2", "hexapod", "thesis"])
@pytest.mark.parametrize("skill", MANY_LEGGED)
def test_a_target_fits_together(name: str, skill: str) -> None:
    robot = robot_called(name)
    call = call_of(skill, velocity=(0.1 * robot.height, 0.0), turn=0.0, robot=robot)
    for target, _ in follow(story(np.random.default_rng(7), 150, robot), call, 0.4, robot):
        R = target.rotation_wb
        np.testing.assert_allclose(R @ R.T, np.eye(3), atol=1e-12)
        assert np.linalg.norm(target.normal_w) == pytest.approx(1.0)
        assert R[:, 1] @ target.normal_w == pytest.approx(0.0, abs=1e-12), "no roll against the ground"
        np.testing.assert_array_equal(target.load_scale > 0.0, target.stance)
        np.testing.assert_array_equal(target.feet_velocity_w[target.stance], 0.0)
        in_base = (target.feet_w - target.position_w) @ R
        again, reached = angles(robot, in_base)
        np.testing.assert_allclose(target.q, again, atol=1e-12)
        np.testing.assert_allclose(feet(robot, target.q)[reached], in_base[reached], atol=1e-9 * robot.height)
        assert reached.any()


def test_standing_wants_the_body_where_it_is_over_its_feet() -> None:
    sensed = story(np.random.default_rng(3), 1)[0]
    still = replace(sensed, velocity_w=np.zeros(3), load=np.full(4, 40.0), q=angles(DOG, DOG.nominal_feet)[0],
                    orientation_wb=yaw_quaternion(0.7))  # fmt: skip
    target = follow([still] * 200, call_of("stand", (0.0, 0.0), 0.0), 0.0)[-1][0]
    np.testing.assert_allclose(target.position_w[:2], still.position_w[:2], atol=1e-12)
    over = target.position_w[2] - target.feet_w[:, 2].mean()
    assert over == pytest.approx(DOG.stand, abs=1e-9)
    np.testing.assert_allclose(target.rotation_wb, rotation(still.orientation_wb), atol=1e-9)
    for name in ("velocity_w", "acceleration_w", "angular_velocity_w", "angular_acceleration_w"):
        np.testing.assert_allclose(getattr(target, name), 0.0, atol=1e-12)
    np.testing.assert_allclose(target.q, still.q, atol=1e-9)
    assert target.stance.all() and (target.load_scale == 1.0).all()


@given(st.tuples(st.floats(-1.0, 1.0), st.floats(-1.0, 1.0)), st.floats(-1.0, 1.0))
@settings(max_examples=5)
def test_the_command_comes_steadily_to_what_is_asked(velocity: tuple[float, float], turn: float) -> None:
    now = np.zeros(3)
    told = story(np.random.default_rng(2), 1)[0]
    for target, _ in follow([told] * 500, call_of("trot", velocity, turn), 0.0):
        change = target.command - now
        assert np.hypot(*change[:2]) <= SLEW * GRAVITY * DT * (1 + 1e-9)
        assert abs(change[2]) <= TURN_SLEW * GRAVITY / DOG.height * DT * (1 + 1e-9)
        now = target.command
    np.testing.assert_allclose(now, [*velocity, turn], atol=1e-12)


@given(seeds, st.floats(-2.0, 2.0))
@settings(max_examples=4)
def test_the_wanted_place_runs_ahead_only_as_far_as_its_leash(seed: int, turn: float) -> None:
    told = story(np.random.default_rng(seed), 1)[0]
    yaw = heading(rotation(told.orientation_wb))
    for _, state in follow([told] * 600, call_of("walk", (2.0, 0.5), turn), 0.0):
        away = np.hypot(*(state.state.reference_pose[:2] - told.position_w[:2]))
        assert away <= POSITION_LEASH * DOG.height * (1 + 1e-9)
        assert abs(wrap(state.state.reference_pose[2] - yaw)) <= MAX_YAW_LEAD + 1e-9
