"""From one gait to another without a stop (row J7).

The new gait begins at the phase at which its leg tips are nearest to where they are. A gait that cannot step
as fast as the robot still moves waits: the old one goes on, slowing down, until the new one can take over.
"""

import math

import numpy as np

from gaitwright.gait.state import STANCE
from gaitwright.gait.swing import REACH, hip_over_ground, on_cycle
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.signals import Gait

PHASES = 64
"""Phases of the new gait that are looked at."""
MISFIT = 0.1
"""What a leg counts that is down where it should be up or up where it should be down, in h² of distance."""


REACH_SHARE = 0.8
"""A gait takes over when half its step at the present speed is within this share of the reach."""
STANDING = 0.12
"""A robot slower than this share of √(g h) may stop stepping."""


def may_start(gait: Gait, speed: float, height: float) -> bool:
    """Whether a gait can begin at a speed [m/s]; `height`: of the body [m]."""
    if gait.duty >= 1.0:
        return speed < STANDING * math.sqrt(GRAVITY * height)
    return 0.5 * speed * gait.period * gait.duty < REACH_SHARE * REACH * height


def has_rhythm_of(gait: Gait, other: Gait) -> bool:
    """Whether two gaits have the same period, duty factor and phases."""
    return (gait.period, gait.duty, gait.offsets) == (other.period, other.duty, other.offsets)


@kernel
def is_new(state, clock, offsets):
    """Whether a gait is another one than the one in use."""
    return (
        state.clock[0] != clock[0] or state.clock[1] != clock[1] or np.abs(state.offset - offsets).max() > 0.0
    )


@kernel
def start_gait(state, clock, offsets, cycles, asked, model, rotation_wb, position, feet_w, height):
    """Begins a gait: sets the clock and the closest phase in `state`, and returns that phase."""
    if state.clock[0] > 0.0 and clock[1] < 1.0:
        state.phase[0] = closest_phase(
            state, clock, offsets, cycles, asked, model, rotation_wb, position, feet_w, height
        )
    state.clock[0], state.clock[1] = clock
    state.offset[:] = offsets
    return state.phase[0]


@kernel
def closest_phase(state, clock, offsets, cycles, asked, model, rotation_wb, position, feet_w, height):
    """The phase of a gait at which its leg tips are nearest to where they are."""
    period, duty = clock
    least, best = math.inf, 0.0
    for i in range(PHASES):
        phase, cost = i / PHASES, 0.0
        for leg in range(offsets.size):
            hip_x, hip_y, arm_x, arm_y = hip_over_ground(rotation_wb, position, model.nominal_feet[leg])
            c, s = rotation_wb[0, 0], rotation_wb[1, 0]
            vx = c * asked[0] - s * asked[1] - asked[2] * arm_y
            vy = s * asked[0] + c * asked[1] + asked[2] * arm_x
            at, up, down = tip(cycles[leg], (phase + offsets[leg]) % 1.0, duty)
            stride = period * duty * at
            dx = feet_w[leg, 0] - hip_x - stride * vx
            dy = feet_w[leg, 1] - hip_y - stride * vy
            lifted = feet_w[leg, 2] - state.contact[leg, 2]
            dz = lifted - up * height
            cost += (dx * dx + dy * dy + dz * dz) / (height * height)
            cost += MISFIT if down != (state.mode[leg] == STANCE) else 0.0
        if cost < least:
            least, best = cost, phase
    return best


@kernel
def tip(table, phase, duty):
    """Where a foot is at a phase of its own: along its support, from +½ to −½, height [h], whether down."""
    if phase < duty:
        return 0.5 - phase / duty, 0.0, True
    s = (phase - duty) / (1.0 - duty)
    row = on_cycle(table, s)
    return row[0] - 0.5, row[3], False
