"""What the feet should do: where each is to land, how it gets there, and what it must clear (rows J3, J8)."""

import math

import numpy as np
from jaxtyping import Float

from gaitwright.gait.clearance import lift_needed
from gaitwright.gait.contact_plane import plane_height
from gaitwright.gait.contacts import swing_time
from gaitwright.gait.obstacle import (
    BLOCK,
    DURATION,
    EVEN,
    HOLE,
    LANDING,
    NOTHING,
    SLOPE,
    UNTAUGHT,
    ahead_of,
    enhance,
    obstacle_over,
    operator_for,
    reach_needed,
)
from gaitwright.gait.state import SEARCH, SWING
from gaitwright.gait.swing import hip_over_ground, search_reference, swing_reference, touchdown
from gaitwright.ground.elevation import height_at, is_known
from gaitwright.ground.footholds import OFF_PLANE, FootholdRequest, choose_foothold
from gaitwright.model.kinematics import all_feet, angles, feet, knees
from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import GRAVITY, sub, times, times_t, vec

STILL_RISING = 0.4
"""Up to this share of a swing its height is fitted to the ground."""


@kernel
def feet_in_world(model, rotation_wb, position, q):
    """Foot centres `(legs, 3)` in the world [m]."""
    out = all_feet(model.hip, model.leg_frame, model.offset, model.sign, q)
    for leg in range(out.shape[0]):
        p = times(rotation_wb, vec(out[leg]))
        for i in range(3):
            out[leg, i] = position[i] + p[i]
    return out


@kernel
def feet_in_base(rotation_wb, position, feet_w):
    """World foot centres `(legs, 3)` seen from a base at `position` with `rotation_wb` [m]."""
    out = np.empty(feet_w.shape)
    for leg in range(feet_w.shape[0]):
        p = times_t(rotation_wb, sub(vec(feet_w[leg]), position))
        out[leg, 0], out[leg, 1], out[leg, 2] = p
    return out


@kernel
def feet_reference(
    model,
    state,
    clock,
    cycles,
    operators,
    imagined,
    leans,
    ground,
    step,
    rotation_d,
    position,
    velocity,
    wanted,
    feet_w,
    height,
    p,
    v,
    a,
    extra,
):
    """Writes the references `(legs, 3)` of the foot centres: position, velocity, acceleration.

    `operators`: terrain operators (`operators.Packed`); `imagined`: obstacles that legs are to take for seen
    [m]; `step`: the most that the ground may rise or drop at once [m]. Footholds, lifts and operators of
    `state` are brought up to date with it, and the forces of operators `(legs, 3)` are written to `extra`.
    """
    period, duty = clock
    p[:], v[:], a[:], extra[:] = feet_w, 0.0, 0.0, 0.0
    duration = swing_time(period, duty)
    capture = math.sqrt(height / GRAVITY)
    for leg in range(feet_w.shape[0]):
        if state.mode[leg] == SWING:
            s = min(state.progress[leg], 1.0)
            hip_x, hip_y, arm_x, arm_y = hip_over_ground(rotation_d, position, model.nominal_feet[leg])
            x, y = touchdown(
                hip_x,
                hip_y,
                arm_x,
                arm_y,
                velocity,
                wanted,
                state.command[2],
                (1.0 - s) * duration,
                period * min(duty, 0.75),
                capture,
                height,
            )
            radius = model.foot_radius[leg]
            kind, x, y = meet(state, leg, operators, imagined[leg], ground, s, x, y, radius, height)
            lean = turned(rotation_d, leans[leg])
            plane = plane_height(state.slope, position, x, y)
            aim(state, leg, ground, step, x, y, plane, radius, lean, height)
            raise_over(state, leg, kind, ground, operators, imagined[leg], s, radius, cycles[leg], height)
            x, y, z = state.foothold[leg]
            table, lift = cycles[leg], state.lift[leg]
            swing_reference(
                state.origin[leg], x, y, z, s, duration, height, table, lift, p[leg], v[leg], a[leg]
            )
            if state.operator[leg] > 0.0:
                side = 1.0 if model.nominal_feet[leg, 1] >= 0.0 else -1.0
                apply_operator(
                    state, leg, operators, s, duration, side, rotation_d, p[leg], v[leg], a[leg], extra
                )
        else:
            state.operator[leg], state.reach[leg] = 0.0, 0.0
            if state.mode[leg] == SEARCH:
                search_reference(state.origin[leg], state.progress[leg], height, p[leg], v[leg], a[leg])
                if is_known(ground):
                    p[leg, 0], p[leg, 1] = state.foothold[leg, 0], state.foothold[leg, 1]


@kernel
def meet(state, leg, operators, imagined, ground, s, x, y, radius, height):
    """What kind of obstacle is ahead of a swinging leg, and the wished foothold with what an operator says of
    the landing.

    A hole or a slope is answered as it is seen, early in the swing and once; how far other obstacles reach
    into the way of the foot is seen when it is raised. What a leg imagines is answered by the first operator.
    """
    kind = NOTHING
    if operators.terms.shape[0] > 0 and s < STILL_RISING and state.operator[leg] <= 0.0:
        if imagined > 0.0:
            state.operator[leg], state.reach[leg] = 1.0, imagined
        else:
            kind, size = ahead_of(ground, state.origin[leg], x, y, radius, height)
            found = operator_for(operators.terms, kind, size) if kind in (HOLE, SLOPE) else -1
            if found >= 0:
                state.operator[leg], state.reach[leg] = found + 1.0, size
    if state.operator[leg] > 0.0:
        farther = operators.terms[int(state.operator[leg]) - 1, LANDING] * state.reach[leg]
        way_x, way_y = x - state.origin[leg, 0], y - state.origin[leg, 1]
        length = math.hypot(way_x, way_y)
        if farther != 0.0 and length > 0.0:
            x, y = x + farther * way_x / length, y + farther * way_y / length
    return kind, x, y


@kernel
def apply_operator(state, leg, operators, s, duration, side, rotation_d, p, v, a, extra):
    """Adds the operator of a leg to the reference of its foot, and writes its force, world axes."""
    number, origin, hold = int(state.operator[leg]) - 1, state.origin[leg], state.foothold[leg]
    taught_in = operators.terms[number, DURATION]
    way_x, way_y = hold[0] - origin[0], hold[1] - origin[1]
    f_x, f_y, f_z = enhance(
        operators.tables[number], state.reach[leg], s, duration, taught_in, way_x, way_y, p, v, a
    )
    c, d = rotation_d[0, 0], rotation_d[1, 0]
    k = 1.0 / math.hypot(c, d)
    c, d, f_y = k * c, k * d, side * f_y
    extra[leg, 0], extra[leg, 1], extra[leg, 2] = c * f_x - d * f_y, d * f_x + c * f_y, f_z


@kernel
def aim(state, leg, ground, step, x, y, plane, radius, lean, height):
    """Sets the foothold of a swinging leg: the wished `(x, y)`, or its best neighbour on known ground.

    `plane`: height of the foot's centre on the plane through the last footholds.
    """
    hold = state.foothold[leg]
    if is_known(ground):
        off = OFF_PLANE * step
        swung = state.progress[leg]
        wish = FootholdRequest(x, y, hold[0], hold[1], plane - radius, off, lean, height, swung)
        _, x, y = choose_foothold(ground, wish)
        known = height_at(ground, x, y) + radius
        if abs(known - plane) < off:
            plane = known
    hold[0], hold[1], hold[2] = x, y, plane


@kernel
def raise_over(state, leg, kind, ground, operators, imagined, s, radius, table, height):
    """Raises the swing of a leg as far as the ground on its way asks for; never lowers it again.

    By an operator where one is for the `kind` of obstacle and for how far it reaches into the way, else by a
    higher leg cycle.
    """
    if s <= 0.0:
        state.lift[leg] = 1.0
    if s >= STILL_RISING:
        return
    x, y, z = state.foothold[leg]
    origin = state.origin[leg]
    if state.operator[leg] == 0.0 and operators.terms.shape[0] > 0:
        over = obstacle_over(ground, origin, x, y, z, radius)
        if over > EVEN * height:
            as_seen = BLOCK if kind in (NOTHING, HOLE, SLOPE) else kind
            found = operator_for(operators.terms, as_seen, over)
            state.operator[leg] = found + 1.0 if found >= 0 else UNTAUGHT
    number = int(state.operator[leg]) - 1
    if number >= 0:
        lift, over = state.lift[leg], operators.tables[number]
        needed = reach_needed(ground, origin, x, y, z, radius, lift, table, over, height)
        state.reach[leg] = max(state.reach[leg], needed)
    else:
        needed = lift_needed(ground, origin, x, y, z, radius, table, height)
        if imagined > 0.0:
            needed = 1.0 + imagined / (table[:, 3].max() * height)
        state.lift[leg] = max(state.lift[leg], needed)


@kernel
def turned(rotation_wb, lean):
    """A horizontal direction of the base, in the world."""
    c, s = rotation_wb[0, 0], rotation_wb[1, 0]
    k = 1.0 / math.hypot(c, s)
    return k * (c * lean[0] - s * lean[1]), k * (s * lean[0] + c * lean[1])


def shank_leans(robot: Robot) -> Float[np.ndarray, "legs 2"]:
    """How far each shank leans out over the ground per height in the nominal stance, base axes x, y."""
    q, _ = angles(robot, robot.nominal_feet)
    bone = feet(robot, q) - knees(robot, q)
    return bone[:, :2] / bone[:, 2:]
