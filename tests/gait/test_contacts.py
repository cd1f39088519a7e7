"""The mode of a leg: the schedule lifts it, contact puts it down, and it carries only in between."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gaitwright.gait.contacts import (
    EARLY,
    LATCH,
    LEAST_SHARE,
    RAMP,
    advance_legs,
    force_share,
    is_lifting,
    is_missing,
    shares,
    swing_time,
)
from gaitwright.gait.state import LAYOUT, SEARCH, STANCE, SWING, GaitState, standing, state_of
from gaitwright.signals import Gait
from gaitwright.skills.library import LIBRARY, gait_of
from oracles import robot_called

DT = 0.002
FEET = np.array([[0.2, 0.1, 0.0], [0.2, -0.1, 0.0], [-0.2, 0.1, 0.0], [-0.2, -0.1, 0.0]])
GAITS = [gait_of(skill, robot_called("dog")) for skill in LIBRARY.values()]
MOVING = [gait for gait in GAITS if gait.duty < 1.0]

phases = st.floats(0.0, 0.999)
seeds = st.integers(0, 2**32 - 1)


def at(phase: float) -> GaitState:
    """Four feet on the ground."""
    return standing(FEET, np.zeros(3), 0.0, phase).state


def tick(
    state: GaitState, gait: Gait, felt: np.ndarray, feet: np.ndarray = FEET
) -> tuple[np.ndarray, float, float]:
    """One tick in place; the modes before, and the phases before and after."""
    old, modes = float(state.phase[0]), state.mode.copy()
    new = (old + DT / gait.period) % 1.0 if gait.duty < 1.0 else old
    advance_legs(state, old, new, gait.period, gait.duty, np.array(gait.offsets), felt, feet, DT)
    state.phase[0] = new
    return modes, old, new


def leg_phases(gait: Gait, phase: float) -> np.ndarray:
    return (phase + np.array(gait.offsets)) % 1.0


@given(seeds, st.sampled_from([4, 6, 8]))
def test_a_packed_memory_is_unpacked_whole(seed: int, legs: int) -> None:
    rng = np.random.default_rng(seed)
    blank = standing(np.zeros((legs, 3)), np.zeros(3), 0.0, 0.0).state
    state = GaitState(*(rng.normal(size=field.shape) for field in blank))
    for field, same in zip(state, state_of(LAYOUT.pack(state)), strict=True):
        np.testing.assert_array_equal(field, same)


# --- modes ---------------------------------------------------------------------------------------
@given(st.sampled_from(GAITS), phases, seeds, st.floats(0.0, 1.0))
@settings(max_examples=25)
def test_modes_change_only_for_their_reasons(gait: Gait, phase: float, seed: int, touchy: float) -> None:
    rng, state = np.random.default_rng(seed), at(phase)
    for _ in range(300):
        felt = rng.random(4) < touchy
        progress, unfelt = state.progress.copy(), state.unfelt.copy()
        was, old, new = tick(state, gait, felt)
        crossed = (
            (leg_phases(gait, old) < gait.duty) & (gait.duty <= leg_phases(gait, new)) & (gait.duty < 1.0)
        )
        for leg in range(4):
            step = (int(was[leg]), int(state.mode[leg]))
            if step in {(STANCE, SWING), (SEARCH, SWING)}:
                assert crossed[leg]
            elif step == (SWING, STANCE):
                assert felt[leg] and progress[leg] + DT / swing_time(gait.period, gait.duty) > EARLY
            elif step == (SWING, SEARCH):
                assert progress[leg] + DT / swing_time(gait.period, gait.duty) >= 1.0
            elif step == (SEARCH, STANCE):
                assert felt[leg]
            elif step == (STANCE, SEARCH):
                assert not felt[leg] and unfelt[leg] + DT > LATCH * gait.period
            else:
                assert was[leg] == state.mode[leg]
                assert not (crossed[leg] and was[leg] != SWING), "the schedule always lifts"


@given(st.sampled_from(MOVING), phases)
@settings(max_examples=25)
def test_on_perfect_ground_every_leg_keeps_its_duty_and_lifts_once_a_cycle(gait: Gait, phase: float) -> None:
    state, ticks = at(phase), round(gait.period / DT)
    down, lifts = np.zeros(4), np.zeros(4)
    for i in range(6 * ticks):
        was, _, _ = tick(state, gait, leg_phases(gait, state.phase[0] + DT / gait.period) < gait.duty)
        if i >= 2 * ticks:
            down += state.mode == STANCE
            lifts += (was == STANCE) & (state.mode == SWING)
        assert not (state.mode == SEARCH).any() or i < ticks
    np.testing.assert_allclose(down / (4 * ticks), gait.duty, atol=3.0 / ticks)
    assert (np.abs(lifts - 4) <= 1).all()


def test_a_leg_that_never_touches_searches_until_it_is_lifted_again() -> None:
    gait = MOVING[1]
    state, seen = at(0.0), set()
    for _ in range(round(3 * gait.period / DT)):
        tick(state, gait, np.array([False, True, True, True]))
        seen.add(int(state.mode[0]))
        if state.phase[0] > 0.5:
            assert state.mode[0] != STANCE
    assert seen == {STANCE, SWING, SEARCH}


@given(phases, seeds)
@settings(max_examples=25)
def test_standing_never_lifts_a_foot(phase: float, seed: int) -> None:
    gait, rng, state = GAITS[0], np.random.default_rng(seed), at(phase)
    assert gait.duty == 1.0
    for _ in range(300):
        tick(state, gait, rng.random(4) < 0.5)
        assert state.phase[0] == phase
        assert not (state.mode == SWING).any()


@given(st.sampled_from(GAITS), phases, seeds)
@settings(max_examples=25)
def test_contact_points_are_where_feet_in_stance_were_last_felt(gait: Gait, phase: float, seed: int) -> None:
    rng, state = np.random.default_rng(seed), at(phase)
    expected = FEET.copy()
    for _ in range(200):
        felt, feet = rng.random(4) < 0.7, FEET + rng.normal(0.0, 0.1, (4, 3))
        tick(state, gait, felt, feet)
        here = felt & (state.mode == STANCE)
        expected[here] = feet[here]
        np.testing.assert_array_equal(state.contact, expected)


@given(st.sampled_from(MOVING), phases, seeds)
@settings(max_examples=25)
def test_a_swing_or_search_begins_where_the_foot_is(gait: Gait, phase: float, seed: int) -> None:
    rng, state, lifted = np.random.default_rng(seed), at(phase), np.zeros(4, dtype=bool)
    for _ in range(round(1.1 * gait.period / DT)):
        feet = FEET + rng.normal(0.0, 0.1, (4, 3))
        was, _, _ = tick(state, gait, rng.random(4) < 0.7, feet)
        began = (state.mode != was) & (state.mode != STANCE)
        np.testing.assert_array_equal(state.origin[began], feet[began])
        assert (state.progress[began] == 0.0).all()
        lifted |= began
    assert lifted.all()


# --- how much a leg carries ----------------------------------------------------------------------
@given(
    st.sampled_from([STANCE, SWING, SEARCH]),
    st.floats(0.0, 5.0),
    phases,
    st.sampled_from(GAITS),
    phases,
    st.booleans(),
)
def test_only_a_leg_in_stance_has_a_share(mode, age, phase, gait, offset, missing) -> None:
    share = force_share(mode, age, phase, gait.period, gait.duty, offset, missing)
    if mode == STANCE:
        assert LEAST_SHARE <= share <= 1.0
    else:
        assert share == 0.0


@pytest.mark.parametrize("gait", MOVING, ids=lambda gait: gait.name)
def test_the_share_ramps_at_both_ends_of_stance(gait: Gait) -> None:
    """Full in the middle of stance, and never a step larger than the ramp allows."""
    through = np.arange(0.0, gait.duty, DT / gait.period)
    share = np.array(
        [force_share(STANCE, p * gait.period, p, gait.period, gait.duty, 0.0, False) for p in through]
    )
    step = DT / (RAMP * gait.period)
    assert share[0] == LEAST_SHARE and share[-1] <= max(step, LEAST_SHARE) + 1e-9
    inside = (through > RAMP) & (through < gait.duty - RAMP)
    np.testing.assert_array_equal(share[inside], 1.0)
    assert np.abs(np.diff(share)).max() <= step + 1e-9


def test_before_lift_off_a_leg_keeps_carrying_for_one_that_is_missing() -> None:
    gait = MOVING[0]
    last = gait.duty - 1e-6
    assert force_share(STANCE, 10.0, last, gait.period, gait.duty, 0.0, False) == LEAST_SHARE
    assert force_share(STANCE, 10.0, last, gait.period, gait.duty, 0.0, True) == 1.0


def test_shares_are_those_of_the_legs() -> None:
    gait, state = MOVING[1], at(0.2)
    state.mode[:], state.age[:] = [STANCE, SWING, SEARCH, STANCE], [0.01, 1.0, 1.0, 9.0]
    one_by_one = [
        force_share(state.mode[i], state.age[i], 0.2, gait.period, gait.duty, gait.offsets[i], False)
        for i in range(4)
    ]
    np.testing.assert_array_equal(
        shares(state, 0.2, gait.period, gait.duty, np.array(gait.offsets), False), one_by_one
    )


# --- waiting for a leg ---------------------------------------------------------------------------
@given(st.sampled_from(GAITS), phases)
def test_nobody_waits_while_all_feet_are_down(gait: Gait, phase: float) -> None:
    assert not is_missing(at(phase), phase, DT / gait.period, gait.duty, np.array(gait.offsets))


@given(
    st.sampled_from(MOVING),
    phases,
    st.lists(st.sampled_from([STANCE, SWING, SEARCH]), min_size=4, max_size=4),
)
def test_a_leg_is_missed_where_the_schedule_wants_it_down(gait: Gait, phase: float, modes: list[int]) -> None:
    state, step = at(phase), DT / gait.period
    state.mode[:] = modes
    due = leg_phases(gait, phase + 2 * step) < gait.duty
    expected = bool((due & (state.mode != STANCE)).any()) and gait.duty >= 0.5
    assert is_missing(state, phase, step, gait.duty, np.array(gait.offsets)) == expected


@given(st.sampled_from(MOVING), phases)
def test_lifting_is_foreseen(gait: Gait, phase: float) -> None:
    state = at(phase)
    foreseen = is_lifting(state, phase, DT / gait.period, gait.duty, np.array(gait.offsets))
    tick(state, gait, np.ones(4, dtype=bool))
    assert foreseen == bool((state.mode == SWING).any())
