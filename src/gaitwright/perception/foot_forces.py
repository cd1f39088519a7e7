"""Which force at each foot a leg's torques stand for: J⁻ᵀ (τ needed for its motion − τ).

The motion of a leg is known, its inertia too: what its torques do beyond moving it, they do on the ground.
That is compared with what the foot feels and with what moves the whole robot. The same comes out per motor:
by how much the force changes where that motor gives nothing.
"""

import math

from gaitwright.dynamics.newton_euler import NO_LOAD, leg_load, link_load, links_motion
from gaitwright.model.leg import (
    base_at,
    bounded_volume,
    combined,
    foot_and_columns,
    hinge_axes,
    leg_turns,
)
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross, dot, scale, sub, times_t, vec
from gaitwright.numerics.matrices import apply, apply_t, write

SLIDES = 0.05
"""Below this rate dry friction fades [rad/s]."""
LOAD = 15
"""Where the load felt stands among the means of a foot."""


@kernel
def per_torque(leg, c1, c2, c3):
    """Force on the ground, base axes, per torque of each joint [1/m]; bounded where singular."""
    n1 = cross(c2, c3)
    k = 1.0 / bounded_volume(c1, c2, c3, n1)
    return (
        apply(leg.frame, scale(k, n1)),
        apply(leg.frame, scale(k, cross(c3, c1))),
        apply(leg.frame, scale(k, cross(c1, c2))),
    )


@kernel
def leg_forces(leg, damping, friction, q, rates, new, dt, motion, told, load, share, mean, now, need):
    """Brings the means of a leg one tick on; its wrench on the base less that of its force on the ground.

    `damping`, `friction`: of its joints; `q`, `rates`, `new`: its angles and rates a tick ago, and its rates
    now, `dt` later; `motion`: angular velocity and acceleration of the base, acceleration less gravity of its
    origin, its velocity and the ground's normal, all base axes; `told`: the leg's torques; `load`: felt by
    the foot; `share`: of a new value in a mean.
    Writes the torques that the motion needs into `need`; hands back the load by torques, too.
    """
    w, wd, pull, velocity, up = motion
    turns = leg_turns(q, leg.sign)
    qdd = scale(1.0 / dt, sub(new, rates))
    links = links_motion(leg, turns, w, wd, pull, rates, qdd)
    force, moment, tau = leg_load(turns, qdd, leg, links, NO_LOAD)
    need[0] = tau[0] + resistance(damping[0], friction[0], new[0])
    need[1] = tau[1] + resistance(damping[1], friction[1], new[1])
    need[2] = tau[2] + resistance(damping[2], friction[2], new[2])
    foot, c1, c2, c3 = foot_and_columns(turns, leg.offset, leg.sign)
    below = scale(-leg.foot_radius, apply_t(leg.frame, up))
    x1, x2, x3 = hinge_axes(turns, leg.sign)
    c1, c2, c3 = add(c1, cross(x1, below)), add(c2, cross(x2, below)), add(c3, cross(x3, below))
    u1, u2, u3 = per_torque(leg, c1, c2, c3)
    ground = add(scale(need[0] - told[0], u1), scale(need[1] - told[1], u2))
    ground = add(ground, scale(need[2] - told[2], u3))
    at = add(leg.hip, apply(leg.frame, add(foot, below)))
    slides = add(add(apply(leg.frame, combined(rates, (c1, c2, c3))), cross(w, at)), velocity)
    approach(mean, 0, ground, share)
    approach(mean, 3, slides, share)
    approach(mean, 6, scale(told[0], u1), share)
    approach(mean, 9, scale(told[1], u2), share)
    approach(mean, 12, scale(told[2], u3), share)
    mean[LOAD] += share * (load - mean[LOAD])
    write(now, 0, u1)
    write(now, 3, u2)
    write(now, 6, u3)
    write(now, 9, at)
    return sub(force, ground), sub(moment, cross(at, ground)), max(dot(ground, up), 0.0)


@kernel
def resistance(damping, friction, rate):
    """Torque that a joint's damping and dry friction take [N·m]."""
    return damping * rate + friction * rate / (abs(rate) + SLIDES)


@kernel
def approach(mean, at, value, share):
    """Brings three means towards a new value."""
    mean[at] += share * (value[0] - mean[at])
    mean[at + 1] += share * (value[1] - mean[at + 1])
    mean[at + 2] += share * (value[2] - mean[at + 2])


@kernel
def base_pull(packed, w, wd, pull):
    """Force and moment that the motion of the base alone asks for, base axes."""
    mass, com, inertia = base_at(packed)
    return link_load((w, wd, pull), mass, com, inertia)


@kernel
def base_motion(a, spin, pull, before, normal):
    """The `motion` of `leg_forces`."""
    w, velocity, up = vec(a.angular_velocity_b), times_t(before, vec(a.velocity_w)), times_t(before, normal)
    return w, spin, pull, velocity, up


@kernel
def balance(memory, force, moment, weight, height, share, dt, calm):
    """Brings what moves the robot and is in no foot one tick on; how far it is from usual.

    While all legs are trusted (`calm`) it learns what is usual, and how much it jumps about.
    """
    jump, gap = 0.0, 0.0
    for x in range(3):
        f, m = force[x] / weight, moment[x] / (weight * height)
        jump += abs(f - memory.lack[x]) + abs(m - memory.lack[3 + x])
        memory.lack[x] += share * (f - memory.lack[x])
        memory.lack[3 + x] += share * (m - memory.lack[3 + x])
    if calm:
        memory.noise[0] += dt / 0.5 * (min(jump, 1.0) - memory.noise[0])
        for x in range(6):
            memory.usual[x] += dt * (memory.lack[x] - memory.usual[x])
    for x in range(6):
        gap += (memory.lack[x] - memory.usual[x]) ** 2
    return math.sqrt(gap)
