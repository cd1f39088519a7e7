"""The motion that a gait gives the body: periodic, consistent, and what the feet's pushes make of it."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gaitwright.gait.command import sample
from gaitwright.gait.reference import BINS, integrate_periodic, periodic_reference
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.signals import Gait
from gaitwright.skills.library import LIBRARY, gait_of
from oracles import robot_called

DOG = robot_called("dog")
MOVING = [skill for skill in LIBRARY.values() if skill.duty < 1.0]
GAITS = pytest.mark.parametrize("gait", [gait_of(skill, DOG) for skill in MOVING], ids=lambda gait: gait.name)

gaits = st.fixed_dictionaries(
    {
        "period": st.floats(0.2, 3.0),
        "duty": st.floats(0.3, 0.95),
        "offsets": st.tuples(*[st.floats(0.0, 0.99)] * 4),
    }
)


def ramps(accelerations: np.ndarray, dt: float) -> tuple[np.ndarray, np.ndarray]:
    """Velocity and position of zero mean by summing up the ramps between samples (trapezoids)."""
    means = accelerations - accelerations.mean()
    velocity = np.cumsum(0.5 * (means + np.roll(means, 1))) * dt
    velocity -= velocity.mean()
    position = np.cumsum(0.5 * (velocity + np.roll(velocity, 1))) * dt
    return velocity, position - position.mean()


@given(gaits)
def test_it_has_no_mean_and_each_column_is_the_rate_of_the_one_before(of: dict) -> None:
    gait = Gait("any", **of)
    table = periodic_reference(DOG, gait)
    assert table.shape == (BINS, 9)
    for position, velocity, acceleration in (table[:, :3].T, table[:, 3:6].T, table[:, 6:].T):
        size = np.abs(acceleration).max() + 1e-9
        np.testing.assert_allclose(
            [position.mean(), velocity.mean(), acceleration.mean()], 0.0, atol=1e-12 * size
        )
        summed_velocity, summed_position = ramps(acceleration, gait.period / BINS)
        np.testing.assert_allclose(velocity, summed_velocity, atol=1e-3 * size * gait.period)
        np.testing.assert_allclose(position, summed_position, atol=1e-3 * size * gait.period**2)


@given(st.lists(st.tuples(st.floats(-1, 1), st.floats(-1, 1)), min_size=1, max_size=5), st.floats(0.1, 5.0))
def test_a_sum_of_waves_is_integrated_exactly(waves: list[tuple[float, float]], period: float) -> None:
    phase = 2 * np.pi * np.arange(BINS) / BINS
    a, v, p = (np.zeros(BINS) for _ in range(3))
    for n, (cosine, sine) in enumerate(waves, start=1):
        omega = 2 * np.pi * n / period
        a += cosine * np.cos(n * phase) + sine * np.sin(n * phase)
        v += (cosine * np.sin(n * phase) - sine * np.cos(n * phase)) / omega
        p -= (cosine * np.cos(n * phase) + sine * np.sin(n * phase)) / omega**2
    position, velocity, acceleration = integrate_periodic(a + 0.7, period)
    np.testing.assert_allclose(acceleration, a, atol=1e-12)
    np.testing.assert_allclose(velocity, v, atol=1e-12 * period)
    np.testing.assert_allclose(position, p, atol=1e-12 * period**2)


@GAITS
def test_the_body_bobs_as_pushes_and_weight_say(gait: Gait) -> None:
    """z̈ = ΣF/m − g with half-sine pushes that carry the weight over the cycle."""
    table = periodic_reference(DOG, gait)
    for row in range(0, BINS, 7):
        push = 0.0
        for offset in gait.offsets:
            s = ((row / BINS + offset) % 1.0) / gait.duty
            push += np.pi / (8 * gait.duty) * np.sin(np.pi * s) if s < 1.0 else 0.0
        assert table[row, 5] == pytest.approx(GRAVITY * (push - 1.0), abs=0.01 * GRAVITY)


@given(gaits, st.integers(0, BINS - 1))
@settings(max_examples=30)
def test_a_later_start_of_all_legs_shifts_it_and_no_more(of: dict, bins: int) -> None:
    gait = Gait("any", **of)
    later = replace(gait, offsets=tuple(offset + bins / BINS for offset in gait.offsets))
    expected = np.roll(periodic_reference(DOG, gait), -bins, axis=0)
    # A push that begins between two samples may fall to either side by rounding: allow one sample of it.
    np.testing.assert_allclose(
        periodic_reference(DOG, later), expected, rtol=0, atol=0.03 * np.abs(expected).max(axis=0).max()
    )


def symmetric(name: str) -> np.ndarray:
    """The table of a skill on a robot whose feet stand in a rectangle."""
    return periodic_reference(DOG, gait_of(LIBRARY[name], DOG))


def test_diagonal_pairs_neither_sway_nor_pitch() -> None:
    table = symmetric("trot")
    np.testing.assert_allclose(table[:, [0, 1, 2, 6, 7, 8]], 0.0, atol=1e-12)
    assert np.ptp(table[:, 3]) > 1e-3


def test_lateral_pairs_sway_and_do_not_pitch() -> None:
    table = symmetric("pace")
    np.testing.assert_allclose(table[:, 6:], 0.0, atol=1e-12)
    assert np.ptp(table[:, 0]) > 1e-3
    # Legs of the left side (offset 0) push around φ = β/2: the body is then pushed away to the right …
    assert table[round(0.30 * BINS), 2] < 0.0
    # … from where it leans over them: furthest to the left while it is pushed right.
    assert table[round(0.30 * BINS), 0] > 0.0


def test_front_and_rear_pairs_pitch_and_do_not_sway() -> None:
    table = symmetric("bound")
    np.testing.assert_allclose(table[:, :3], 0.0, atol=1e-12)
    # The front pair (offset 0) pushes first: that lifts the nose, and nose up is a negative pitch.
    assert table[round(0.25 * BINS), 8] < 0.0


def test_standing_moves_nothing() -> None:
    assert not symmetric("stand").any()


@given(st.floats(0.0, 0.999999), st.integers(0, 2**32 - 1))
def test_a_sample_lies_between_its_neighbours(phase: float, seed: int) -> None:
    table = np.random.default_rng(seed).normal(size=(16, 9))
    i = int(phase * 16)
    low, high = np.sort([table[i], table[(i + 1) % 16]], axis=0)
    value = np.array(sample(table, phase))
    assert (value >= low - 1e-12).all() and (value <= high + 1e-12).all()


def test_samples_meet_the_rows_and_the_cycle_closes(rng: np.random.Generator) -> None:
    table = rng.normal(size=(16, 9))
    np.testing.assert_allclose([sample(table, row / 16) for row in range(16)], table, atol=1e-14)
    np.testing.assert_allclose(sample(table, 1.0 - 1e-12), table[0], atol=1e-9)
