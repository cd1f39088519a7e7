"""Joint torques beside the inverse dynamics: what holds the legs on their way, and what friction takes.

A leg in the air is stiff, by the inertia at each of its joints, so that its foot is where the capture step
wants it; a leg that is down is soft, so that it does not hold the body up against the forces that are to
bring it back. Stiff stance legs fight the force distribution, soft swing legs come too late. What the joints
resist by themselves is fed forward, at the rates that are asked for: at the measured ones it would push
whatever moves already.
"""

from typing import NamedTuple

import numpy as np

from gaitwright.control.joint_stops import braking, fastest, room
from gaitwright.dynamics.joint_inertia import joint_inertias
from gaitwright.model.leg import combined, posed, solve_columns
from gaitwright.model.robot import LAYOUT, damping_of, friction_of, scales
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross, rotation, scale, sub, times, times_t, vec
from gaitwright.numerics.matrices import apply, apply_t

SWING = (30.0, 11.2)
"""Stiffness and damping of a joint in the air, times w0² I and w0 I; I: the inertia at the joint."""
STANCE = (0.15, 0.08)
"""The same of a leg that is down, times m g h and m g h / w0."""
MOST = 0.8
"""An angle counts as off by no more than this [rad]."""
FAST = 40.0
"""No joint is asked for a higher rate than this [rad/s]."""
CREEP = 0.5
"""Dry friction counts in full from this rate on, and grows with the rate below it [rad/s]: a joint at rest
does not chatter."""

NO_LAG = (0.0, 0.0, 0.0)
"""Nothing may be off."""

q_min_of, q_max_of = LAYOUT.field("q_min"), LAYOUT.field("q_max")


class Stretch(NamedTuple):
    """What a leg's joints lack, each a tuple of three."""

    angle: tuple
    """To where the foot should be [rad]."""
    rate: tuple
    """To how it should move [rad/s]."""
    inertia: tuple
    """At the joints [kg·m²]."""


@kernel
def steering(packed, moment):
    """Torques `(legs, 3)` that pull the joints to where the feet should be and make up for friction [N·m]."""
    damping, friction, rates = damping_of(packed), friction_of(packed), np.empty(3)
    out, R = np.empty(moment.q.shape), rotation(moment.orientation)
    for k in range(out.shape[0]):
        now = posed(packed, moment.q[k], k)
        pull(packed, now, moment, k, R, NO_LAG, NO_LAG, out[k], rates)
        for j in range(3):
            out[k, j] += damping[k, j] * rates[j]
            out[k, j] += friction[k, j] * min(max(rates[j] / CREEP, -1.0), 1.0)
    return out


@kernel
def pull(packed, posed_leg, moment, k, R, lag, lag_rate, torques, rates):
    """Writes the torques that pull the joints of leg k to where its foot should be [N·m], and the rates that
    are asked of them.

    In the air: to the foot's reference, from the base as it is. On the ground: from the foot where it is, to
    the base as it should be. `posed_leg`: the `Posed` of the leg, `lag`, `lag_rate`: how far off it may be,
    `R`: orientation of the base.
    """
    tau_max, weight, height = scales(packed)
    w0, q_min, q_max = packed[-1], q_min_of(packed), q_max_of(packed)
    lacks = stretch(posed_leg, moment, k, R)
    for j in range(3):
        q, now, inertia = moment.q[k, j], moment.qd[k, j], lacks.inertia[j]
        low, high = room(q_min[k, j], q_max[k, j])
        down = fastest(q - low, tau_max[k, j], inertia)
        up = fastest(high - q, tau_max[k, j], inertia)
        angle = min(max(q + lacks.angle[j] - lag[j], low), high) - q
        rate = min(max(now + lacks.rate[j] - lag_rate[j], -down, -FAST), up, FAST)
        if moment.stance[k]:
            gains = STANCE[0] * weight * height, STANCE[1] * weight * height / w0
        else:
            gains = SWING[0] * w0 * w0 * inertia, SWING[1] * w0 * inertia
        rates[j] = rate
        torques[j] = (
            gains[0] * min(max(angle, -MOST), MOST)
            + gains[1] * (rate - now)
            + braking(now, down, up, inertia, w0)
        )


@kernel
def stretch(posed_leg, moment, k, R):
    """The `Stretch` of leg k, which is `posed_leg`; `R`: orientation of the base."""
    leg, turns, foot, (c1, c2, c3) = posed_leg
    rates = vec(moment.qd[k])
    at, position = add(leg.hip, apply(leg.frame, foot)), vec(moment.position)
    if moment.stance[k]:
        held = add(position, times(R, at))
        off = sub(times_t(moment.rotation_d, sub(held, vec(moment.position_d))), at)
        ahead, spin = times_t(R, vec(moment.velocity_d)), times_t(R, vec(moment.omega_d))
        moving = scale(-1.0, add(ahead, cross(spin, at)))
    else:
        off = sub(times_t(R, sub(vec(moment.feet_p[k]), position)), at)
        moving = times_t(R, sub(vec(moment.feet_v[k]), vec(moment.velocity)))
        moving = sub(moving, cross(vec(moment.omega_b), at))
    late = sub(apply_t(leg.frame, moving), combined(rates, (c1, c2, c3)))
    angle = solve_columns(c1, c2, c3, apply_t(leg.frame, off))
    return Stretch(angle, solve_columns(c1, c2, c3, late), joint_inertias(leg, turns))
