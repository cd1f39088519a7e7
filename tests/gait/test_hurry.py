"""Pushed off its velocity, a gait steps sooner: no sooner than twice as soon, and not for its own sway."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.gait.hurry import CALM, HURRY, hurried
from gaitwright.numerics.geometry import GRAVITY

HEIGHT, PERIOD = 0.3, 0.4
PACE = math.sqrt(GRAVITY * HEIGHT)
angles = st.floats(-3.0, 3.0)


def period(off: float, towards: float, yaw: float, forward: float = 0.5, left: float = -0.1) -> float:
    """The period of a robot that is off the velocity asked for by a share of √(g h)."""
    c, s = math.cos(yaw), math.sin(yaw)
    x = c * forward - s * left + off * PACE * math.cos(towards)
    y = s * forward + c * left + off * PACE * math.sin(towards)
    return hurried(PERIOD, (x, y, 0.3), (forward, left, 0.0), yaw, HEIGHT)


@given(st.floats(0.0, 0.99 * CALM), angles, angles)
def test_a_calm_gait_keeps_its_period(off: float, towards: float, yaw: float) -> None:
    assert period(off, towards, yaw) == PERIOD


@given(st.floats(CALM, 5.0), angles, angles)
def test_it_shrinks_with_what_is_off_whatever_the_direction(off: float, towards: float, yaw: float) -> None:
    expected = PERIOD / (1.0 + HURRY * min(off - CALM, 1.0))
    assert period(off, towards, yaw) == pytest.approx(expected)
