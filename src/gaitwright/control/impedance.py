"""Joint torques beside the inverse dynamics: what holds the legs on their way.

A leg in the air is stiff, by the inertia at each of its joints, so that its foot is where the capture step
wants it; a leg that is down is soft, so that it does not hold the body up against the forces that are to
bring it back. Stiff stance legs fight the force distribution, soft swing legs come too late.
"""

import numpy as np

from gaitwright.dynamics.joint_inertia import joint_inertias
from gaitwright.model.leg import combined, foot_and_columns, leg_at, leg_turns, solve_columns
from gaitwright.model.robot import scales
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross, rotation, scale, sub, times, times_t, vec
from gaitwright.numerics.matrices import apply, apply_t

SWING = (30.0, 11.2)
"""Stiffness and damping of a joint in the air, times w0² I and w0 I; I: the inertia at the joint."""
STANCE = (0.1, 0.03)
"""The same of a leg that is down, times m g h and m g h / w0."""
MOST = 0.8
"""An angle counts as off by no more than this [rad]."""


@kernel
def steering(packed, moment):
    """Torques `(legs, 3)` that pull the joints to where the feet should be [N·m].

    In the air: to the foot's reference, from the base as it is. On the ground: from the foot where it is, to
    the base as it should be.
    """
    _, weight, height = scales(packed)
    w0 = packed[-1]
    out = np.empty(moment.q.shape)
    R, Rd, w = rotation(moment.orientation), moment.rotation_d, vec(moment.omega_b)
    position, velocity = vec(moment.position), vec(moment.velocity)
    ahead, spin = times_t(R, vec(moment.velocity_d)), times_t(R, vec(moment.omega_d))
    for k in range(out.shape[0]):
        leg = leg_at(packed, k)
        turns, rates = leg_turns(moment.q[k], leg.sign), vec(moment.qd[k])
        foot, c1, c2, c3 = foot_and_columns(turns, leg.offset, leg.sign)
        at = add(leg.hip, apply(leg.frame, foot))
        if moment.stance[k]:
            held = add(position, times(R, at))
            off = sub(times_t(Rd, sub(held, vec(moment.position_d))), at)
            moving = scale(-1.0, add(ahead, cross(spin, at)))
        else:
            off = sub(times_t(R, sub(vec(moment.feet_p[k]), position)), at)
            moving = sub(times_t(R, sub(vec(moment.feet_v[k]), velocity)), cross(w, at))
        late = sub(apply_t(leg.frame, moving), combined(rates, (c1, c2, c3)))
        angle = solve_columns(c1, c2, c3, apply_t(leg.frame, off))
        rate = solve_columns(c1, c2, c3, late)
        inertia = joint_inertias(leg, turns)
        for j in range(3):
            if moment.stance[k]:
                stiffness, damping = STANCE[0] * weight * height, STANCE[1] * weight * height / w0
            else:
                stiffness, damping = SWING[0] * w0 * w0 * inertia[j], SWING[1] * w0 * inertia[j]
            out[k, j] = stiffness * min(max(angle[j], -MOST), MOST) + damping * rate[j]
    return out
