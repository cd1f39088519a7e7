"""Readings by themselves: do they repeat, or go where their own rates do not lead?

A sensor that is in order repeats no reading bit for bit while others move, and an angle goes where its rate
takes it. Everything else is told by forces (`suspicion`).
"""

import math

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import between, dot, rotation_vector, scale, sub, times_t, vec

FROZEN_FOR = 50
"""So many equal readings of everything are no stall any more [ticks]."""
STALL = 8
"""A stall this long makes the readings that follow too late, where they go on as if nothing had been [ticks]."""
REPEATS = 25
"""So many equal readings of one sensor, while others turned by `STIRS`, are no chance [ticks]."""
STIRS = 0.05
"""[rad]"""
STIRS_BODY = 0.1
"""The same of all joints together, for the body's readings [rad]."""
LEAK = 0.5
"""What went where no rate leads is forgotten within this time [s]."""
MEAN = 0.02
"""And must stay for about this time, which a single bad reading does not [s]."""
JUMPED, TURNED = 0.06, 0.08
"""So far a joint, or the body, does not get without a rate [rad]."""
SLOW = 0.5
"""A joint slower than this may be stuck [rad/s]."""

STEADY, REPEAT_ALL, LATE_NOW, REPEAT_BODY, TURNED_BODY, REPEAT_JOINT, JUMPED_JOINT = range(7)
"""What `check_all`, `check_body` and `check_joint` find."""


@kernel
def is_same(one, other):
    """Whether two rows of numbers are equal bit for bit."""
    for i in range(one.size):
        if one[i] != other[i]:
            return False
    return True


@kernel
def check_all(memory, a, b, dt):
    """Whether everything repeats, or has stalled and goes on late: what it is, and for how many ticks.

    `a`, `b`: fields of the reading before and of this one. A robot at rest may repeat itself: rates must say
    that it moves.
    """
    moving, skipped, same = 0.0, 0.0, is_same(a.orientation_wb, b.orientation_wb)
    for k in range(b.q.shape[0]):
        same = same and is_same(a.q[k], b.q[k]) and is_same(a.qd[k], b.qd[k])
        for j in range(3):
            moving = max(moving, abs(b.qd[k, j]))
            skipped = max(skipped, abs(b.q[k, j] - a.q[k, j]))
    stall = memory.same[0]
    if same and moving * dt > 1e-7:
        memory.same[0] += 1.0
        return (REPEAT_ALL, stall + 1.0) if stall >= FROZEN_FOR else (STEADY, stall + 1.0)
    memory.same[0] = 0.0
    missed = moving * dt * stall
    if stall > STALL and missed > 0.02 and skipped < 0.3 * missed:
        return LATE_NOW, stall
    return STEADY, 0.0


@kernel
def check_body(memory, a, b, before, after, dt):
    """Whether attitude and rates of the body repeat while joints turn, or the attitude turns by itself.

    `before`, `after`: rotations of the base.
    """
    if is_same(a.orientation_wb, b.orientation_wb) and is_same(a.angular_velocity_b, b.angular_velocity_b):
        memory.same[1] += 1.0
        for k in range(b.q.shape[0]):
            for j in range(3):
                memory.stirred[0] += abs(b.q[k, j] - a.q[k, j])
        if memory.same[1] > REPEATS and memory.stirred[0] > STIRS_BODY:
            return REPEAT_BODY
    else:
        memory.same[1] = memory.stirred[0] = 0.0
    turn = times_t(before, rotation_vector(between(before, after)))
    rate = scale(0.5 * dt, (
        a.angular_velocity_b[0] + b.angular_velocity_b[0],
        a.angular_velocity_b[1] + b.angular_velocity_b[1],
        a.angular_velocity_b[2] + b.angular_velocity_b[2],
    ))  # fmt: skip
    more, total = sub(turn, rate), 0.0
    for x in range(3):
        memory.turned[x] += more[x] - dt / LEAK * memory.turned[x]
        memory.turned[3 + x] += dt / MEAN * (memory.turned[x] - memory.turned[3 + x])
        total += memory.turned[3 + x] ** 2
    return TURNED_BODY if math.sqrt(total) > TURNED else STEADY


@kernel
def check_joint(memory, a, b, k, j, dt):
    """Whether an angle repeats while the leg's other joints turn, or goes where no rate leads."""
    off = b.q[k, j] - a.q[k, j]
    if off == 0.0:
        memory.same_joint[k, j] += 1.0
        for other in range(3):
            memory.others[k, j] += abs(b.q[k, other] - a.q[k, other])
        if memory.same_joint[k, j] > REPEATS and memory.others[k, j] > STIRS:
            return REPEAT_JOINT
    else:
        memory.same_joint[k, j] = memory.others[k, j] = 0.0
    one, other = dt * a.qd[k, j], dt * b.qd[k, j]
    more = off - min(max(off, min(one, other)), max(one, other))
    memory.drift[k, j] += more - dt / LEAK * memory.drift[k, j]
    memory.drift_mean[k, j] += dt / MEAN * (memory.drift[k, j] - memory.drift_mean[k, j])
    size = abs(b.qd[k, j])
    memory.calm[k, j] += dt / 0.03 * (size - memory.calm[k, j])
    memory.still[k, j] = memory.still[k, j] + dt if size < SLOW else 0.0
    return JUMPED_JOINT if abs(memory.drift_mean[k, j]) > JUMPED else STEADY


@kernel
def repeats(memory, k):
    """Whether a joint of a leg repeats its angle: then nothing is concluded from its motion."""
    same = memory.same_joint
    return same[k, 0] > 2.0 or same[k, 1] > 2.0 or same[k, 2] > 2.0


@kernel
def spin(a, b, dt):
    """Angular acceleration of the base, base axes [rad/s²]."""
    return scale(1.0 / dt, sub(vec(b.angular_velocity_b), vec(a.angular_velocity_b)))


@kernel
def length(a):
    """Of a 3-vector."""
    return math.sqrt(dot(a, a))
