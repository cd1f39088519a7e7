"""Where a swinging foot goes, and how (rows J3, J8; control.md, "Swing")."""

import math

import numpy as np

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import GRAVITY

AIM_BELOW = 0.03
"""The touch-down is aimed this share of the body height below the ground, so that it happens."""
REACH_DOWN = 0.8
"""From this share of the swing on, the foot speeds up downwards, to the speed of lowering a late leg."""
REACH = 0.6
"""Longest step from under the hip, in body heights."""
SEARCH_DEPTH = 0.25
"""How far a late leg is lowered, in body heights."""
SEARCH_FROUDE = 0.5
"""Speed of lowering a late leg over √(g h): 0.3 m/s at h = 0.29 m."""


@kernel
def touchdown(hip_x, hip_y, arm_x, arm_y, velocity, wanted, turn, remaining, stance_time, capture, height):
    """Where a foot should land, world x, y [m].

    Under where the hip will be, half a stance ahead at the wanted velocity, plus the capture term
    √(h/g)·(v − v_wanted). `arm`: from the base to the hip; `turn`: wanted yaw rate.
    """
    spin_x, spin_y = -turn * arm_y, turn * arm_x
    error_x, error_y = capture * (velocity[0] - wanted[0]), capture * (velocity[1] - wanted[1])
    k = within(REACH * height, math.hypot(error_x, error_y))
    error_x, error_y = k * error_x, k * error_y
    along_x, along_y = (wanted[0] + spin_x) * stance_time * 0.5, (wanted[1] + spin_y) * stance_time * 0.5
    # Balance first: where the reach ends, the stride gives way to the capture step.
    k = share_within(REACH * height, error_x, error_y, along_x, along_y)
    step_x, step_y = error_x + k * along_x, error_y + k * along_y
    x = hip_x + (velocity[0] + spin_x) * remaining + step_x
    y = hip_y + (velocity[1] + spin_y) * remaining + step_y
    return x, y


@kernel
def within(limit, length):
    """Factor that brings a length down to its limit."""
    return 1.0 if length <= limit else limit / length


@kernel
def share_within(limit, x, y, along_x, along_y):
    """Largest k up to 1 for which (x, y) + k·along stays within `limit`, where (x, y) does."""
    a = along_x * along_x + along_y * along_y
    b = x * along_x + y * along_y
    c = x * x + y * y - limit * limit
    if a + 2.0 * b + c <= 0.0 or a == 0.0:
        return 1.0
    return min(1.0, max(0.0, (math.sqrt(max(b * b - a * c, 0.0)) - b) / a))


@kernel
def place_in(table, s):
    """The row of a table over the swing before share `s`, and how far it is on the way to the next."""
    x = min(max(s, 0.0), 1.0) * (table.shape[0] - 1)
    i = min(int(x), table.shape[0] - 2)
    return i, x - i


@kernel
def on_cycle(table, s):
    """Row of a leg cycle's table (`gait.leg_cycles`) at share `s` of the swing, straight in between."""
    i, t = place_in(table, s)
    k = 1.0 - t
    return (
        k * table[i, 0] + t * table[i + 1, 0],
        k * table[i, 1] + t * table[i + 1, 1],
        k * table[i, 2] + t * table[i + 1, 2],
        k * table[i, 3] + t * table[i + 1, 3],
        k * table[i, 4] + t * table[i + 1, 4],
        k * table[i, 5] + t * table[i + 1, 5],
    )


@kernel
def along_cycle(origin, end, s, duration, rise, table, out_p, out_v, out_a):
    """Writes position, velocity and acceleration of a foot at share `s` of its swing from `origin` to `end`.

    `table`: the leg cycle; `rise`: what its heights are multiplied by [m]. The one law of a swing: feet that
    are steered (`swing_reference`) and feet whose motion is worked out beforehand (`swings`) follow it.
    """
    b, db, ddb, u, du, ddu = on_cycle(table, s)
    for i in range(3):
        way = end[i] - origin[i]
        k = rise if i == 2 else 0.0
        out_p[i] = origin[i] + way * b + k * u
        out_v[i] = (way * db + k * du) / duration
        out_a[i] = (way * ddb + k * ddu) / (duration * duration)


@kernel
def swings(start, end, s, stance, duration, rise, tables):
    """Position, velocity, acceleration `(n, legs, 3)` of feet that stand at `start` or swing to `end`."""
    p, v, a = start.copy(), np.zeros(start.shape), np.zeros(start.shape)
    for i in range(start.shape[0]):
        for leg in range(start.shape[1]):
            if not stance[i, leg]:
                along_cycle(
                    start[i, leg], end[i, leg], s[i, leg], duration, rise[leg], tables[leg],
                    p[i, leg], v[i, leg], a[i, leg],
                )  # fmt: skip
    return p, v, a


@kernel
def swing_reference(origin, x, y, ground, s, duration, height, table, lift, out_p, out_v, out_a):
    """Writes position, velocity and acceleration of a foot at share `s` of its swing to `(x, y)`.

    `ground`: height of the foot centre at touch-down [m]; `table`: the leg cycle; `lift`: what its height is
    multiplied by. At the end the foot speeds up downwards, so that it meets the ground on time.
    """
    end = (x, y, ground - AIM_BELOW * height)
    along_cycle(origin, end, s, duration, lift * height, table, out_p, out_v, out_a)
    if s > REACH_DOWN:
        down = SEARCH_FROUDE * math.sqrt(GRAVITY * height)
        late, last = (s - REACH_DOWN) * duration, (1.0 - REACH_DOWN) * duration
        out_p[2] -= 0.5 * down * late * late / last
        out_v[2] -= down * late / last
        out_a[2] -= down / last


@kernel
def search_reference(origin, seconds, height, out_p, out_v, out_a):
    """Writes the reference of a late foot: straight down at a steady speed, to a limit."""
    speed = SEARCH_FROUDE * math.sqrt(GRAVITY * height)
    depth = min(speed * seconds, SEARCH_DEPTH * height)
    out_p[0], out_p[1], out_p[2] = origin[0], origin[1], origin[2] - depth
    out_v[0], out_v[1] = 0.0, 0.0
    out_v[2] = -speed if depth < SEARCH_DEPTH * height else 0.0
    out_a[:] = 0.0


@kernel
def hip_over_ground(rotation_wb, position, stance):
    """World x, y of the point over which the foot of a leg belongs, and its arm from the base."""
    arm_x = rotation_wb[0, 0] * stance[0] + rotation_wb[0, 1] * stance[1]
    arm_y = rotation_wb[1, 0] * stance[0] + rotation_wb[1, 1] * stance[1]
    return position[0] + arm_x, position[1] + arm_y, arm_x, arm_y
