"""Where a swinging foot goes, and how (rows J3, J8; control.md, "Swing")."""

import math

from gaitwright.compiled import kernel
from gaitwright.geometry import GRAVITY

AIM_BELOW = 0.10
"""The touch-down is aimed this share of the body height below the ground, so that it happens."""
CLEARANCE = 0.2
"""Height of the swing over the straight line, in body heights."""
REACH = 0.6
"""Longest step from under the hip, in body heights."""
SEARCH_DEPTH = 0.25
"""How far a late leg is lowered, in body heights."""
SEARCH_FROUDE = 0.5
"""Speed of lowering a late leg over √(g h): 0.3 m/s at h = 0.29 m."""


@kernel
def smooth(s):
    """b(s) = 10s³ − 15s⁴ + 6s⁵ with its first two derivatives."""
    return (
        s * s * s * (10.0 + s * (6.0 * s - 15.0)),
        30.0 * s * s * (1.0 + s * (s - 2.0)),
        60.0 * s * (1.0 + s * (2.0 * s - 3.0)),
    )


@kernel
def bump(s):
    """64 s³(1 − s)³, one at mid-swing, with its first two derivatives."""
    r = s * (1.0 - s)
    dr = 1.0 - 2.0 * s
    return 64.0 * r * r * r, 192.0 * r * r * dr, 384.0 * r * (dr * dr - r)


@kernel
def touchdown(hip_x, hip_y, arm_x, arm_y, velocity, wanted, turn, remaining, stance_time, capture, height):
    """Where a foot should land, world x, y [m].

    Under where the hip will be, half a stance ahead at the wanted velocity, plus the capture term
    √(h/g)·(v − v_wanted). `arm`: from the base to the hip; `turn`: wanted yaw rate.
    """
    spin_x, spin_y = -turn * arm_y, turn * arm_x
    step_x = (wanted[0] + spin_x) * stance_time * 0.5 + capture * (velocity[0] - wanted[0])
    step_y = (wanted[1] + spin_y) * stance_time * 0.5 + capture * (velocity[1] - wanted[1])
    length = math.hypot(step_x, step_y)
    if length > REACH * height:
        step_x *= REACH * height / length
        step_y *= REACH * height / length
    x = hip_x + (velocity[0] + spin_x) * remaining + step_x
    y = hip_y + (velocity[1] + spin_y) * remaining + step_y
    return x, y


@kernel
def swing_reference(origin, x, y, ground, s, duration, height, out_p, out_v, out_a):
    """Writes position, velocity and acceleration of a foot at share `s` of its swing to `(x, y)`.

    `ground`: height of the foot centre at touch-down [m].
    """
    b, db, ddb = smooth(s)
    u, du, ddu = bump(s)
    lift = CLEARANCE * height
    way = (x - origin[0], y - origin[1], ground - AIM_BELOW * height - origin[2])
    for i in range(3):
        rise = lift if i == 2 else 0.0
        out_p[i] = origin[i] + way[i] * b + rise * u
        out_v[i] = (way[i] * db + rise * du) / duration
        out_a[i] = (way[i] * ddb + rise * ddu) / (duration * duration)


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
