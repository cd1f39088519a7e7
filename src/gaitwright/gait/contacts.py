"""When a leg carries, swings or searches for the ground (control.md, "Contact logic").

The schedule lifts legs; contact puts them down. A leg that meets the ground late in its swing carries
from then on; one that finds none is lowered, unloaded, until it does.
"""

import numpy as np

from gaitwright.gait.state import SEARCH, STANCE, SWING
from gaitwright.numerics.compiled import kernel

EARLY = 0.6
"""Share of the swing after which a touch counts as touch-down."""
LATCH = 0.15
"""Contact once felt is believed for this share of the period."""
RAMP = 0.1
"""The normal-force bound ramps over this share of the period at both ends of stance."""
PATIENCE = 0.5
"""The phase waits for a missing leg for this share of the period at most: over a hole there is no ground."""
LEAST_SHARE = 0.02
"""Share of the force bound that a leg in stance always has."""


@kernel
def advance_legs(state, old_phase, phase, period, duty, offsets, felt, feet_w, dt):
    """Brings the modes, ages and contact points of `state` (changed in place) one tick on."""
    for leg in range(felt.size):
        before = (old_phase + offsets[leg]) % 1.0
        now = (phase + offsets[leg]) % 1.0
        lifts = duty < 1.0 and before < duty <= now
        state.unfelt[leg] = 0.0 if felt[leg] else state.unfelt[leg] + dt
        state.age[leg] += dt
        if state.mode[leg] == SWING:
            state.progress[leg] += dt / swing_time(period, duty)
            touches = felt[leg] and state.progress[leg] > EARLY
            if touches:
                land(state, leg)
            elif state.progress[leg] >= 1.0:
                start(state, leg, SEARCH, feet_w[leg])
        elif lifts:
            start(state, leg, SWING, feet_w[leg])
        elif state.mode[leg] == SEARCH:
            state.progress[leg] += dt
            if felt[leg]:
                land(state, leg)
        elif state.unfelt[leg] > LATCH * period:
            start(state, leg, SEARCH, feet_w[leg])
        if state.mode[leg] == STANCE and felt[leg]:
            state.contact[leg] = feet_w[leg]


@kernel
def is_missing(state, phase, step, duty, offsets):
    """Whether a leg that is due on the ground has not found it.

    `step`: what the phase advances by in a tick. Flying gaits (duty below a half) miss no leg: their
    feet are not needed to stand on.
    """
    if duty < 0.5 or duty >= 1.0:
        return False
    for leg in range(offsets.size):
        # One tick of grace, for gaits in which one foot lands just as the next one lifts.
        if state.mode[leg] != STANCE and (phase + 2.0 * step + offsets[leg]) % 1.0 < duty:
            return True
    return False


@kernel
def is_waited_for(state, phase, step, duty, offsets, period, dt):
    """`is_missing`, for as long as it pays to wait; keeps the time in `state` (changed in place)."""
    if not is_missing(state, phase, step, duty, offsets):
        state.waited[0] = 0.0
        return False
    state.waited[0] += dt
    return state.waited[0] < PATIENCE * period


@kernel
def is_lifting(state, phase, step, duty, offsets):
    """Whether a leg in stance is due to lift within the next tick."""
    for leg in range(offsets.size):
        before, after = (phase + offsets[leg]) % 1.0, (phase + step + offsets[leg]) % 1.0
        if state.mode[leg] == STANCE and before < duty <= after:
            return True
    return False


@kernel
def swing_time(period, duty):
    """Time a leg is in the air [s]; a gait that never lifts lends a leg still in the air a short one."""
    return period * max(1.0 - duty, 0.2)


@kernel
def land(state, leg):
    state.mode[leg] = STANCE
    state.age[leg] = 0.0


@kernel
def start(state, leg, mode, foot):
    state.mode[leg] = mode
    state.progress[leg] = 0.0
    state.origin[leg] = foot


@kernel
def force_share(mode, age, phase, period, duty, offset, missing):
    """Share of the normal-force bound that a leg may use, in (0, 1], 0 for a leg in the air.

    It fades before lift-off unless a leg that should take over is `missing`.
    """
    if mode != STANCE:
        return 0.0
    ramp = RAMP * period
    share = min(1.0, age / ramp)
    if duty < 1.0 and not missing:
        until_lift = ((duty - (phase + offset)) % 1.0) * period
        share = min(share, until_lift / ramp)
    return max(share, LEAST_SHARE)


@kernel
def shares(state, phase, period, duty, offsets, missing):
    """`force_share` of every leg."""
    out = np.empty(offsets.size)
    for leg in range(offsets.size):
        out[leg] = force_share(state.mode[leg], state.age[leg], phase, period, duty, offsets[leg], missing)
    return out
