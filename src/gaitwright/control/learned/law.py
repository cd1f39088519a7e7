"""One tick of the learned controller: the profile's torque, its forces through the legs as they are now, and
what is regulated beside it. Nothing is solved.

The feet that are down give their taught forces, and the smallest change that makes up the wrench of the
taught cycle: for feet that are missing, for the weight along a slope, and for what the body is off its
course beyond what the teacher left it. The joints are pulled as the numerical controller pulls them
(`control.impedance`), less where it left them at this phase: in the taught cycle nothing is regulated.
"""

import math
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.control.forces import FORCE_WEIGHTS, MOMENT_WEIGHTS, MOST_NORMAL
from gaitwright.control.impedance import pull, stretch
from gaitwright.control.inverse_dynamics import MOST_ACCELERATION, MOST_SPIN, base_feedback, clipped
from gaitwright.control.learned.profile import row_of
from gaitwright.control.moments import moment_between
from gaitwright.model.leg import hinge_axes, leg_at, posed
from gaitwright.model.robot import scales
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import (
    GRAVITY,
    add,
    cross,
    dot,
    heading,
    rotation,
    scale,
    sub,
    times,
    times_t,
    upright_rotation,
    vec,
)
from gaitwright.numerics.matrices import apply, apply_t, write
from gaitwright.numerics.packing import Layout
from gaitwright.signals import MotionTarget

TANGENT = 0.75
"""Share of the friction cone that feet use."""


class Played(NamedTuple):
    """What a tick of the learned controller comes to."""

    tau: Float[np.ndarray, "legs 3"]
    forces_w: Float[np.ndarray, "legs 3"]
    residual: Float[np.ndarray, "1"]
    """These three are the row of a `MotorCommand`."""
    share: Float[np.ndarray, "1"]
    """Share of the torque that is the profile's own: 1 − Σ|τ − τ_taught| / Σ|τ|."""


extra_force_of = MotionTarget.layout.field("extra_force_w")
LAYOUT = Layout.of(Played)
played_of = LAYOUT.views(Played)
"""The `Played` in a row, as views; for kernels too."""


class Foot(NamedTuple):
    """One leg as it stands in a tick; world axes."""

    arm: tuple
    """Base origin → contact point [m]."""
    columns: tuple
    """The three columns of the Jacobian of the contact point."""
    centre: tuple
    """Base origin → foot centre [m]."""


@kernel
def foot_now(posed_leg, moment, R):
    """The `Foot` of a `Posed` leg; `R`: orientation of the base."""
    leg, turns, foot, (c1, c2, c3) = posed_leg
    axes = hinge_axes(turns, leg.sign)
    below_w = scale(-leg.foot_radius, vec(moment.normal))
    below = apply_t(leg.frame, times_t(R, below_w))
    first = times(R, apply(leg.frame, add(c1, cross(axes[0], below))))
    second = times(R, apply(leg.frame, add(c2, cross(axes[1], below))))
    third = times(R, apply(leg.frame, add(c3, cross(axes[2], below))))
    centre = times(R, add(leg.hip, apply(leg.frame, foot)))
    return Foot(add(centre, below_w), (first, second, third), centre)


@kernel
def ground_frame(moment, R):
    """The ground frame `(3, 3)`: z along the ground's normal, x along the robot's heading."""
    return upright_rotation(vec(moment.normal), heading(R))


# --- playing ---------------------------------------------------------------------------------------
@kernel
def play(packed, inertia, maps, taught, seen, target, out):
    """One tick: writes the row of a `Played`.

    `inertia`: that of the whole robot about its centre of mass in the nominal stance `(3, 3)`, base axes;
    `maps`: `contact_maps`; `taught`: the row of a `ProfileRow` at this phase; `seen`, `target`: the rows of a
    `Sensed` and a `MotionTarget`.
    """
    moment, profile, result = moment_between(seen, target), row_of(taught), played_of(out)
    extra = extra_force_of(target)
    R = rotation(moment.orientation)
    G = ground_frame(moment, R)
    wanted = wanted_wrench(packed, inertia, profile, moment, R, G)
    n = moment.stance.size
    arms, columns, rates = np.empty((n, 3)), np.empty((n, 3, 3)), np.empty(3)
    for k in range(n):
        now = posed(packed, moment.q[k], k)
        foot = foot_now(now, moment, R)
        write(arms[k], 0, foot.arm)
        for j in range(3):
            write(columns[k, j], 0, foot.columns[j])
        lag, lag_rate = vec(profile.lag[k]), vec(profile.lag_rate[k])
        pull(packed, now, moment, k, R, lag, lag_rate, result.tau[k], rates)
    share_forces(packed, maps, profile, moment, wanted, arms, G, result)
    tau_max, _, _ = scales(packed)
    off, whole, total = 0.0, 0.0, 0.0
    for k in range(n):
        force, moved = vec(result.forces_w[k]), vec(extra[k])
        for j in range(3):
            more = dot(vec(columns[k, j]), moved)
            asked = profile.free[k, j] + more - dot(vec(columns[k, j]), force) + result.tau[k, j]
            total += asked
            tau = min(max(asked, -tau_max[k, j]), tau_max[k, j])
            result.tau[k, j] = tau
            off += abs(tau - profile.tau[k, j] - more)
            whole += abs(tau)
    result.share[0] = 1.0 - off / max(whole, 1e-9)
    if not math.isfinite(total):
        result.tau[:] = np.nan  # plainly: whoever watches stops the motors


@kernel
def wanted_wrench(packed, inertia, profile, moment, R, G):
    """Force and moment about the base origin that the feet should give, world axes.

    That of the taught cycle over all its feet, the weight along a slope, and what brings the body back from
    where it is farther off its course than the teacher left it.
    """
    _, weight, _ = scales(packed)
    w0, radius = packed[-1], leg_at(packed, 0).foot_radius
    linear, angular = base_feedback(w0, R, times(R, vec(moment.omega_b)), moment)
    linear = sub(linear, times(G, vec(profile.feedback[:3])))
    angular = sub(angular, times(G, vec(profile.feedback[3:])))
    linear, angular = clipped(linear, MOST_ACCELERATION), clipped(angular, MOST_SPIN * w0)
    force, turn = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    for k in range(moment.stance.size):
        f = vec(profile.force[k])
        force = add(force, f)
        turn = add(turn, cross(sub(vec(profile.tip[k]), (0.0, 0.0, radius)), f))
    normal = vec(moment.normal)
    along = scale(weight, sub((0.0, 0.0, 1.0), normal))
    mass = weight / GRAVITY
    force = add(add(times(G, force), along), scale(mass, linear))
    spin = times_t(R, angular)
    about = (dot(vec(inertia[0]), spin), dot(vec(inertia[1]), spin), dot(vec(inertia[2]), spin))
    return force, add(times(G, turn), times(R, about))


@kernel
def share_forces(packed, maps, profile, moment, wanted, arms, G, result):
    """Writes the forces of the feet that are down: what was taught, and the smallest change to the wrench
    that is wanted, within friction and load. `arms`: base origin → contact points, world axes."""
    _, weight, height = scales(packed)
    n, feet = moment.stance.size, 0
    force, turn = wanted
    for k in range(n):
        write(result.forces_w[k], 0, (0.0, 0.0, 0.0))
        if moment.stance[k]:
            feet += 1 << k
            f = times(G, vec(profile.force[k]))
            write(result.forces_w[k], 0, f)
            force = sub(force, f)
            turn = sub(turn, cross(vec(arms[k]), f))
    rest_f, rest_m = times_t(G, force), times_t(G, turn)
    b = np.empty(6)
    for i in range(3):
        b[i] = FORCE_WEIGHTS[i] * rest_f[i] / weight
        b[3 + i] = MOMENT_WEIGHTS[i] * rest_m[i] / (weight * height)
    for k in range(n):
        if moment.stance[k]:
            change, size = mapped(maps[feet], 3 * k, b), moment.load_scale[k] * weight
            change_w = times(G, scale(size, change))
            before, arm = vec(result.forces_w[k]), vec(arms[k])
            f = within_cone(add(before, change_w), moment, k, weight)
            write(result.forces_w[k], 0, f)
            force, turn = sub(force, sub(f, before)), sub(turn, cross(arm, sub(f, before)))
    lacks = 0.0
    for i in range(3):
        x, y = FORCE_WEIGHTS[i] * force[i] / weight, MOMENT_WEIGHTS[i] * turn[i] / (weight * height)
        lacks += x * x + y * y
    result.residual[0] = math.sqrt(lacks) if moment.stance.any() else 0.0


@kernel
def mapped(map_of_set, first, b):
    """Three rows of a map, from the `first` on, times a wrench."""
    x, y, z = 0.0, 0.0, 0.0
    for i in range(6):
        x += map_of_set[first, i] * b[i]
        y += map_of_set[first + 1, i] * b[i]
        z += map_of_set[first + 2, i] * b[i]
    return x, y, z


@kernel
def within_cone(force, moment, k, weight):
    """A foot's force within what its load and friction allow."""
    normal = vec(moment.normal)
    along = dot(force, normal)
    most = min(max(along, 0.0), MOST_NORMAL * weight * moment.load_scale[k])
    tangent = sub(force, scale(along, normal))
    size, limit = math.sqrt(dot(tangent, tangent)), TANGENT * moment.friction[k] * most
    shrink = limit / size if size > limit else 1.0
    return add(scale(most, normal), scale(shrink, tangent))


# --- noting ----------------------------------------------------------------------------------------
@kernel
def note(packed, seen, asked, tau, forces_w, out):
    """Writes the row of a `ProfileRow`: what a teacher did in a tick, and how far off it was.

    `tau`, `forces_w`: torques and forces on the feet that it commanded `(legs, 3)`.
    """
    moment, row = moment_between(seen, asked), row_of(out)
    R = rotation(moment.orientation)
    G = ground_frame(moment, R)
    omega_w = times(R, vec(moment.omega_b))
    linear, angular = base_feedback(packed[-1], R, omega_w, moment)
    write(row.feedback, 0, times_t(G, linear))
    write(row.feedback, 3, times_t(G, angular))
    height, down = 0.0, 0
    for k in range(moment.stance.size):
        now = posed(packed, moment.q[k], k)
        foot, lacks = foot_now(now, moment, R), stretch(now, moment, k, R)
        force = vec(forces_w[k])
        for j in range(3):
            row.free[k, j] = tau[k, j] + dot(foot.columns[j], force)
            row.lag[k, j], row.lag_rate[k, j] = lacks.angle[j], lacks.rate[j]
        write(row.force[k], 0, times_t(G, force))
        tip = times_t(G, foot.centre)
        write(row.tip[k], 0, tip)
        row.stance[k] = 1.0 if moment.stance[k] else 0.0
        if moment.stance[k] or not moment.stance.any():
            height, down = height - tip[2], down + 1
    row.tau[:], row.q[:], row.qd[:] = tau, moment.q, moment.qd
    up, forward = times_t(R, (G[0, 2], G[1, 2], G[2, 2])), (R[0, 0], R[1, 0], R[2, 0])
    pitch = math.asin(min(max(-dot(vec(moment.normal), forward), -1.0), 1.0))
    row.pose[0], row.pose[1], row.pose[2] = height / down, math.atan2(up[1], up[2]), pitch
    write(row.velocity, 0, times_t(G, vec(moment.velocity)))
    write(row.omega, 0, times_t(G, omega_w))


@kernel
def columns_in_ground(packed, seen, asked, leg):
    """Columns of the Jacobian of a leg's contact point, one a row `(3, 3)`, ground frame [m]."""
    moment, out = moment_between(seen, asked), np.empty((3, 3))
    R = rotation(moment.orientation)
    G = ground_frame(moment, R)
    foot = foot_now(posed(packed, moment.q[leg], leg), moment, R)
    for j in range(3):
        write(out[j], 0, times_t(G, foot.columns[j]))
    return out
