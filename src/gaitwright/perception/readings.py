"""Readings by themselves: do they repeat, or go where their own rates do not lead?

A sensor that is in order repeats no reading bit for bit while others move, and an angle goes where its rate
takes it. Everything else is told by forces (`suspicion`).
"""

import math

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross, dot, scale, sub, vec

FROZEN_FOR = 50
"""So many equal readings of everything are no stall any more [ticks]."""
STALL = 8
"""After a stall this long readings that go on as if nothing had been are too late [ticks]."""
REPEATS = 25
"""So many equal readings of one sensor, while others turned by `STIRS`, are no chance [ticks]."""
STIRS = 0.05
"""[rad]"""
STIRS_BODY = 0.1
"""The same of all joints together, for the body's readings [rad]."""
LEAK = 0.1
"""What went where no rate leads is forgotten within this time [s]."""
MEAN = 0.02
"""And must stay for about this time, which a single bad reading does not [s]."""
JUMPED, TURNED = 0.06, 0.08
"""So far a joint, or the body, does not get without a rate [rad]."""
CALM = 0.03
"""Rates are averaged over this time [s]."""
SLOW = 0.5
"""A joint slower than this may be stuck [rad/s]."""

STEADY, REPEAT_ALL, LATE_NOW, REPEAT_BODY, TURNED_BODY, REPEAT_JOINT, JUMPED_JOINT = range(7)
"""What `check_all`, `check_body` and `check_joint` find."""


@kernel
def is_same(one, other):
    """Whether two rows of numbers are equal bit for bit."""
    for i in range(one.size):  # noqa: SIM110 - a kernel
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
def check_body(memory, a, b, dt):
    """Whether attitude and rates of the body repeat while joints turn, or the attitude turns by itself."""
    if is_same(a.orientation_wb, b.orientation_wb) and is_same(a.angular_velocity_b, b.angular_velocity_b):
        memory.same[1] += 1.0
        for k in range(b.q.shape[0]):
            for j in range(3):
                memory.stirred[0] += abs(b.q[k, j] - a.q[k, j])
        if memory.same[1] > REPEATS and memory.stirred[0] > STIRS_BODY:
            return REPEAT_BODY
    else:
        memory.same[1] = memory.stirred[0] = 0.0
    turn, rate = turned(a.orientation_wb, b.orientation_wb), vec(b.angular_velocity_b)
    more = sub(turn, scale(0.5 * dt, add(vec(a.angular_velocity_b), rate)))
    total = 0.0
    for x in range(3):
        memory.turned[x] += more[x] - dt / LEAK * memory.turned[x]
        memory.turned[3 + x] += dt / MEAN * (memory.turned[x] - memory.turned[3 + x])
        total += memory.turned[3 + x] ** 2
    return TURNED_BODY if math.sqrt(total) > TURNED else STEADY


@kernel
def turned(before, after):
    """The small turn from one quaternion to the next, axis times angle, base axes [rad]."""
    w, v = before[0], (before[1], before[2], before[3])
    w_new, v_new = after[0], (after[1], after[2], after[3])
    side = math.copysign(2.0, w * w_new + dot(v, v_new))
    return scale(side, sub(sub(scale(w, v_new), scale(w_new, v)), cross(v, v_new)))


@kernel
def check_joints(memory, a, b, dt):
    """Whether an angle repeats while its leg turns, or goes where no rate leads; and of which joint."""
    same, others, drift, mean = memory.same_joint, memory.others, memory.drift, memory.drift_mean
    calm, still, q, before = memory.calm, memory.still, b.q, a.q
    rate, rate_before = b.qd, a.qd
    for k in range(q.shape[0]):
        stirs = abs(q[k, 0] - before[k, 0]) + abs(q[k, 1] - before[k, 1]) + abs(q[k, 2] - before[k, 2])
        for j in range(3):
            off = q[k, j] - before[k, j]
            if off == 0.0:
                same[k, j] += 1.0
                others[k, j] += stirs
                if same[k, j] > REPEATS and others[k, j] > STIRS:
                    return REPEAT_JOINT, k, j
            else:
                same[k, j] = others[k, j] = 0.0
            one, other = dt * rate_before[k, j], dt * rate[k, j]
            drift[k, j] += off - 0.5 * (one + other) - dt / LEAK * drift[k, j]
            mean[k, j] += dt / MEAN * (drift[k, j] - mean[k, j])
            size = abs(rate[k, j])
            if abs(mean[k, j]) > JUMPED + 2.0 * dt * size:
                return JUMPED_JOINT, k, j
            calm[k, j] += dt / CALM * (size - calm[k, j])
            still[k, j] = still[k, j] + dt if size < SLOW else 0.0
    return STEADY, -1, -1


@kernel
def repeats(same, k):
    """Whether a joint of a leg repeats its angle: then nothing is concluded from its motion."""
    return same[k, 0] > 2.0 or same[k, 1] > 2.0 or same[k, 2] > 2.0


@kernel
def spin(a, b, dt):
    """Angular acceleration of the base, base axes [rad/s²]."""
    return scale(1.0 / dt, sub(vec(b.angular_velocity_b), vec(a.angular_velocity_b)))
