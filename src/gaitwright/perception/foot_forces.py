"""Which force at each foot the torques of a leg stand for, as the leg moves: J⁻ᵀ (τ needed for the motion − τ).

The motion of a leg is known, its inertia too: what its torques do beyond moving it, they do on the ground. That
is compared with what the foot feels and with what moves the whole robot. The same comes out per motor: by how
much the force changes where that motor gives nothing.
"""

import math

from gaitwright.dynamics.newton_euler import NO_LOAD, leg_load, link_load, links_motion
from gaitwright.model.leg import (
    base_at,
    combined,
    foot_and_columns,
    hinge_axes,
    least_volume,
    leg_at,
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
def per_torque(leg, columns):
    """Force on the ground, base axes, per torque of each of the three joints [1/m]; bounded where singular."""
    c1, c2, c3 = columns
    n1 = cross(c2, c3)
    volume, least = dot(c1, n1), least_volume(c1, c2, c3)
    if abs(volume) < least:
        volume = math.copysign(least, volume)
    k = 1.0 / volume
    return (
        apply(leg.frame, scale(k, n1)),
        apply(leg.frame, scale(k, cross(c3, c1))),
        apply(leg.frame, scale(k, cross(c1, c2))),
    )


@kernel
def leg_forces(packed, settings, k, a, b, motion, told, memory, share, need):
    """Brings the means of leg `k` one tick on; its wrench on the base less that of its force on the ground.

    `motion`: angular velocity and acceleration of the base, acceleration less gravity of its origin, its
    velocity and the ground's normal, all base axes; `told`: the leg's torques; `share`: of a new value in a
    mean. Writes the torques that the motion needs into `need`.
    """
    w, wd, pull, velocity, up = motion
    damping, friction, _, _, _, dt = settings
    leg = leg_at(packed, k)
    turns, rates, new = leg_turns(a.q[k], leg.sign), vec(a.qd[k]), vec(b.qd[k])
    qdd = scale(1.0 / dt, sub(new, rates))
    links = links_motion(leg, turns, w, wd, pull, rates, qdd)
    force, moment, tau = leg_load(turns, qdd, leg, links, NO_LOAD)
    for j in range(3):
        dry = friction[k, j] * new[j] / (abs(new[j]) + SLIDES)
        need[j] = tau[j] + damping[k, j] * new[j] + dry
    foot, c1, c2, c3 = foot_and_columns(turns, leg.offset, leg.sign)
    below = scale(-leg.foot_radius, apply_t(leg.frame, up))
    x1, x2, x3 = hinge_axes(turns, leg.sign)
    columns = (add(c1, cross(x1, below)), add(c2, cross(x2, below)), add(c3, cross(x3, below)))
    units = per_torque(leg, columns)
    ground = (0.0, 0.0, 0.0)
    for j in range(3):
        ground = add(ground, scale(need[j] - told[j], units[j]))
    at = add(leg.hip, apply(leg.frame, add(foot, below)))
    slides = add(add(apply(leg.frame, combined(rates, columns)), cross(w, at)), velocity)
    mean, now = memory.mean[k], memory.now[k]
    for x in range(3):
        mean[x] += share * (ground[x] - mean[x])
        mean[3 + x] += share * (slides[x] - mean[3 + x])
        for j in range(3):
            mean[6 + 3 * j + x] += share * (told[j] * units[j][x] - mean[6 + 3 * j + x])
            now[3 * j + x] = units[j][x]
    mean[LOAD] += share * (b.load[k] - mean[LOAD])
    write(now, 9, at)
    memory.believed[k] += 0.5 * (max(dot(ground, up), 0.0) - memory.believed[k])
    return sub(force, ground), sub(moment, cross(at, ground))


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
