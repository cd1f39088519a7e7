"""How the base moves where the feet cannot give the wrench that its wanted motion asks for.

A swinging foot hangs on the base as it really moves. Where friction, motors or the number of feet leave part
of the wanted wrench unmet, the base accelerates less than wanted, and torques worked out for the wanted
acceleration throw the swinging feet off their way: in a gallop by 3 cm, enough to lose the touch-down.
"""

from gaitwright.control.inverse_dynamics import load_of
from gaitwright.model.leg import base_at, leg_at, leg_turns
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross, rotation, scale, sub, times, times_t, turn_x, turn_y, vec
from gaitwright.numerics.matrices import apply, inverse, minus, plus, product_t, skew


@kernel
def point_inertia(mass, at):
    """Inertia of a point about the origin: −m ~a ~a."""
    a = skew(at)
    X = product_t(a, a)
    return (scale(mass, X[0]), scale(mass, X[1]), scale(mass, X[2]))


@kernel
def link_places(leg, q):
    """Centres of mass of the three links, base frame."""
    (c1, s1), (c2, s2), (c3, s3) = leg_turns(q, leg.sign)
    past3 = turn_y(c3, s3, leg.com[2])
    third = add(leg.offset[0], turn_y(c2, s2, add(leg.offset[1], past3)))
    second = add(leg.offset[0], turn_y(c2, s2, leg.com[1]))
    first = turn_x(c1, s1, leg.com[0])
    hip, frame = leg.hip, leg.frame
    return (
        add(hip, apply(frame, first)),
        add(hip, apply(frame, turn_x(c1, s1, second))),
        add(hip, apply(frame, turn_x(c1, s1, third))),
    )


@kernel
def lumped(packed, q):
    """Mass, centre of mass and inertia about it of a robot whose joints are locked, its links as points."""
    mass, com, inertia = base_at(packed)
    total, moment, about = mass, scale(mass, com), plus(inertia, point_inertia(mass, com))
    for k in range(q.shape[0]):
        leg = leg_at(packed, k)
        places = link_places(leg, q[k])
        for i in range(3):
            total += leg.mass[i]
            moment = add(moment, scale(leg.mass[i], places[i]))
            about = plus(about, point_inertia(leg.mass[i], places[i]))
    centre = scale(1.0 / total, moment)
    return total, centre, minus(about, point_inertia(total, centre))


@kernel
def unmet_acceleration(packed, moment, load_numbers, forces):
    """What the base's acceleration falls short of the wanted one by: linear and angular, world axes.

    `load_numbers`: the packed `Load` of the wanted motion; `forces`: what the feet give, world `(legs, 3)`.
    """
    load = load_of(load_numbers)
    force = (-load.wrench[0], -load.wrench[1], -load.wrench[2])
    torque = (-load.wrench[3], -load.wrench[4], -load.wrench[5])
    for leg in range(forces.shape[0]):
        f = vec(forces[leg])
        force = add(force, f)
        torque = add(torque, cross(vec(load.arm[leg]), f))
    R = rotation(moment.orientation)
    mass, com, inertia = lumped(packed, moment.q)
    force, torque = times_t(R, force), times_t(R, torque)
    angular = apply(inverse(inertia), sub(torque, cross(com, force)))
    linear = sub(scale(1.0 / mass, force), cross(angular, com))
    return times(R, linear), times(R, angular)
