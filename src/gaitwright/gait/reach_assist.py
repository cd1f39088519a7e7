"""A leg near the end of its reach makes the body move to help it (row J6; thesis 3.4.2).

The body goes down, and where three feet always stand also aside towards the foot, as far as no other leg
folds too far and the body stays near its place over the feet.
"""

import math

from gaitwright.gait.state import STANCE, SWING
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, length, scale, sub, times, vec

STRETCHED = 0.93
"""From this share of the stretched leg on, the body helps."""
FOLDED = 0.45
"""No other leg is folded below this share of its stretched length."""
MOST_DOWN = 0.25
"""Farthest the body goes down, in body heights."""
MOST_ASIDE = 0.1
"""Farthest it goes to any side, in body heights: it stays within the support."""
DUE = 0.5
"""From this share of its swing on, a leg's foothold counts as its foot."""


@kernel
def way_to_foot(model, state, leg, rotation_d, base_p, feet_w):
    """From the hip of the wanted pose to where the foot is, or is about to be."""
    hip = add(base_p, times(rotation_d, vec(model.hip[leg])))
    if state.mode[leg] == SWING and state.progress[leg] > DUE:
        return sub(vec(state.foothold[leg]), hip)
    return sub(vec(feet_w[leg]), hip)


@kernel
def stretched(model, leg):
    """Length of thigh and shank in a line [m]."""
    thigh, shank = vec(model.offset[leg, 1]), vec(model.offset[leg, 2])
    return length(thigh) + length(shank)


@kernel
def reach_assist(model, state, rotation_d, base_p, feet_w, duty, height):
    """How far the wanted place of the base gives way to legs near the end of their reach, world [m]."""
    most = MOST_ASIDE * height if duty * feet_w.shape[0] >= 3.0 else 0.0
    x = y = z = 0.0
    for leg in range(feet_w.shape[0]):
        if state.mode[leg] != STANCE and state.mode[leg] != SWING:
            continue
        way = way_to_foot(model, state, leg, rotation_d, base_p, feet_w)
        far = length(way)
        over = far - STRETCHED * stretched(model, leg)
        if over > 0.0:
            x, y, z = x + over * way[0] / far, y + over * way[1] / far, min(z, over * way[2] / far)
    aside = math.hypot(x, y)
    k = 1.0 if aside <= most else most / aside
    shift = (k * x, k * y, max(z, -MOST_DOWN * height))
    if shift == (0.0, 0.0, 0.0):
        return shift
    return scale(room_for(model, state, rotation_d, base_p, feet_w, shift), shift)


@kernel
def room_for(model, state, rotation_d, base_p, feet_w, shift):
    """Share of a shift that leaves every leg unfolded enough."""
    share = 1.0
    for leg in range(feet_w.shape[0]):
        if state.mode[leg] != STANCE:
            continue
        way = way_to_foot(model, state, leg, rotation_d, base_p, feet_w)
        after = sub(way, shift)
        far, left = length(way), length(after)
        least = FOLDED * stretched(model, leg)
        if left < least:
            share = min(share, max(0.0, (far - least) / max(far - left, 1e-9)))
    return share
