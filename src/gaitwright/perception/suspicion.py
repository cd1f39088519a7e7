"""What is wrong with a leg: hypotheses, each with what it leaves unexplained; the one that explains most.

A leg in order gives a force that its foot feels, within the cone of friction, and the forces of all legs move
the robot. Where that does not fit, a motor that gives nothing, a leg of such motors, a joint that is held, or
a foot's sensor that lies may fit. Suspicion adds up how much better one fits, so that a stumble, a push or a
shank on an edge, which none of them explains, leaves none.
"""

import math

from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross, dot, length, scale, sub, vec
from gaitwright.perception.foot_forces import LOAD
from gaitwright.perception.watch_memory import DEAD_LEG, HYPOTHESES, SENSOR, STUCK

MARGIN, PER_NOISE = 0.02, 0.3
"""From so much on something does not fit, in weights; and per noise of the balance."""
MOST = 0.4
"""What does not fit counts no more than this, so that no single blow decides."""
PENALTY = 2.0
"""What a hypothesis leaves unexplained counts as much against it."""
CERTAIN = 0.0015
"""A suspicion from here on is one, in weights times seconds."""
HELD = 0.03
"""A joint is stuck no sooner than it has been slow for this time [s]."""
LOOKS, DECIDES = 0.04, 0.12
"""Hypotheses are compared for so long at least; after the second the best one is taken [s]."""
JAMMED, QUIET = 0.08, 0.25
"""A foot may be caught for a moment: a joint is stuck after this time, and slower than this [s, rad/s]."""
CONE = 1.2
"""No foot pushes sideways with more than this share of its load."""
CARRIES = 0.02
"""A foot that carries this share of the weight is on the ground."""
NO_FIT = 9.0
"""Of a hypothesis that is out of the question."""
PRICES = (0.003, 0.006, 0.03)
"""What a dead leg, and a stuck joint and each rad/s of it, must explain better than a simpler hypothesis."""


@kernel
def misfit(force, up, load):
    """How far a force on the ground is from a load felt, and out of the cone of friction [N]."""
    normal = dot(force, up)
    beside = length(sub(force, scale(normal, up)))
    return abs(normal - load) + max(0.0, beside - CONE * max(normal, 0.0))


@kernel
def unexplained(force, moment, change, at, height):
    """What a change of a foot's force leaves of the lacking force and moment [N]."""
    f = sub(force, change)
    m = scale(1.0 / height, sub(moment, cross(at, change)))
    return math.sqrt(dot(f, f) + dot(m, m))


@kernel
def change_of(h, foot, now, up, lack, weight, height):
    """By how much the force of a foot is another one if a hypothesis is right [N]; none for the sensor's."""
    one, two, three = vec(foot[6:]), vec(foot[9:]), vec(foot[12:])
    if h == 0:
        return one
    if h == 1:
        return two
    if h == 2:
        return three
    if h == DEAD_LEG:
        return add(one, add(two, three))
    if h == SENSOR:
        return (0.0, 0.0, 0.0)
    # The torque that holds a joint is the one that leaves least: of force and moment, and of load.
    force, unit = vec(foot), vec(now[3 * (h - STUCK) :])
    turn, pull = scale(1.0 / height, cross(vec(now[9:]), unit)), scale(1.0 / height, lack[1])
    fits, of = dot(lack[0], unit) + dot(pull, turn), dot(unit, unit) + dot(turn, turn)
    if foot[LOAD] < CARRIES * weight:
        return scale((fits - dot(force, unit)) / (of + dot(unit, unit)), unit)
    along = dot(unit, up)
    return scale((fits + (foot[LOAD] - dot(force, up)) * along) / (of + along * along), unit)


@kernel
def sensor_misfit(foot, up, weight, pace):
    """What does not fit of a force, whatever the foot feels: feet that carry do not slide [N]."""
    force = vec(foot)
    normal = max(dot(force, up), 0.0)
    slides = max(length(vec(foot[3:])) / pace - 0.02, 0.0)
    return misfit(force, up, normal) + 2.0 * weight * slides * min(1.0, normal / (0.1 * weight))


@kernel
def miss_of(h, forces, readings, k, up, lack, weight, height, pace):
    """What a hypothesis leaves unexplained, in weights."""
    foot = forces.mean[k]
    change = change_of(h, foot, forces.now[k], up, lack, weight, height)
    if h == SENSOR:
        if readings.same_load[k] < 5.0:
            return NO_FIT
        off = sensor_misfit(foot, up, weight, pace)
    else:
        off = misfit(add(vec(foot), change), up, foot[LOAD])
    left = unexplained(lack[0], lack[1], change, vec(forces.now[k, 9:]), height)
    return min(off / weight, 0.5) + min(left / weight, 0.5)


@kernel
def price_of(h, readings, k):
    """What a hypothesis costs that can explain more than others can."""
    if h == DEAD_LEG:
        return PRICES[0]
    if STUCK <= h < SENSOR:
        return PRICES[1] + PRICES[2] * readings.calm[k, h - STUCK]
    return 0.0


@kernel
def judge_leg(forces, readings, k, up, lack, healthy, weight, height, pace, margin, now, dt):
    """Brings the suspicions of leg `k` one tick on. `healthy`: what does not fit if it is in order."""
    suspicion, worst = forces.suspicion[k], 0.0
    for h in range(HYPOTHESES):
        miss = miss_of(h, forces, readings, k, up, lack, weight, height, pace)
        gain = min(healthy, MOST) - PENALTY * miss - margin
        if STUCK <= h < SENSOR and readings.still[k, h - STUCK] < HELD:
            gain = -0.02
        if suspicion[h] <= 0.0 < gain:
            forces.since[k, h] = now
        suspicion[h] = max(0.0, suspicion[h] + max(gain, -0.2) * dt)
        worst = max(worst, suspicion[h])
        forces.amiss[k, h] += (miss + price_of(h, readings, k)) * dt
    if worst <= 0.0:
        forces.amiss[k, :] = 0.0
    forces.worst[k] = worst


@kernel
def forget(forces, k):
    """Takes all suspicion off a leg."""
    forces.suspicion[k, :] = 0.0
    forces.amiss[k, :] = 0.0
    forces.worst[k] = 0.0


@kernel
def verdict(forces, calm, k, dt):
    """The hypothesis that is certain of leg `k`, or -1."""
    if forces.worst[k] < CERTAIN:
        forces.waited[k] = 0.0
        return -1
    forces.waited[k] += dt
    best, least, second, hidden = -1, NO_FIT, NO_FIT, NO_FIT
    for h in range(HYPOTHESES):
        amiss = forces.amiss[k, h]
        if forces.suspicion[k, h] < 0.5 * CERTAIN:
            if STUCK <= h < SENSOR:
                hidden = min(hidden, amiss)  # it may yet turn out to be held
        elif amiss < least:
            best, least, second = h, amiss, least
        else:
            second = min(second, amiss)
    clear = forces.waited[k] > LOOKS and second > 2.0 * least + 0.0005 and hidden > 0.4 * least
    if STUCK <= best < SENSOR and (forces.waited[k] < JAMMED or calm[k, best - STUCK] > QUIET):
        return -1
    return best if clear or forces.waited[k] > DECIDES else -1
