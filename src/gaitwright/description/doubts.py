"""Numbers that can be read but hardly be true: a sentence with the links that they are of."""

import math
from copy import copy

import mujoco
import numpy as np

from gaitwright.description.aside import listed
from gaitwright.description.leg_shape import ROUNDED, crooked
from gaitwright.description.legs import BASE, ELSEWHERE, Legs, limbs, number_of_joints, three_hinges
from gaitwright.model.kinematics import angles
from gaitwright.model.nominal_pose import LegShape
from gaitwright.model.robot import Robot
from gaitwright.numerics.polygon import hull, margins

WEIGHTY = 1e-3
"""A link of less than this share of the mass is taken to weigh so much, where its inertia is doubted."""

MOST_LIMBS = 6
"""So many limbs that are no legs are told of."""


def possible(m: mujoco.MjModel, legs: Legs, shapes: list[LegShape]) -> tuple[mujoco.MjModel, tuple[str, ...]]:
    """The model with inertias that its links can have, and a sentence about those that no body could.

    No body has a radius of gyration larger than itself: that of a link of a leg is at most half a leg, that
    of what is fixed to the base its hips' distance from their middle more. One beyond that, common in files
    for simulators that take no notice of it, becomes that of a rod or plate of that size.
    """
    half_leg = 0.5 * float(np.mean([shape.stretched for shape in shapes]))
    hips = np.array([shape.hip for shape in shapes])
    wide = float(np.linalg.norm(hips - hips.mean(axis=0), axis=1).max())
    bodies = np.flatnonzero((legs.owner != ELSEWHERE) & (m.body_mass > 0.0))
    size = np.where(legs.owner[bodies] == BASE, wide + half_leg, half_leg)
    mass = m.body_mass[bodies]
    largest = m.body_inertia[bodies].max(axis=1)
    wrong = largest > np.maximum(mass, WEIGHTY * mass.sum()) * size**2
    if not wrong.any():
        return m, ()
    gyration = np.sqrt(largest / mass)
    worst = int(np.argmax(np.where(wrong, gyration, 0.0)))
    mended = copy(m)
    uniform = np.where(legs.owner[bodies] == BASE, wide**2 / 3.0, half_leg**2 / 12.0)
    mended.body_inertia[bodies[wrong]] *= (mass * uniform / largest)[wrong, None]
    names = listed([repr(m.body(int(body)).name) for body in bodies[wrong]])
    return mended, (
        f"the inertia of {names} is impossible for links of that mass on a robot of this size "
        f"({m.body(int(bodies[worst])).name!r} would have its mass {gyration[worst]:.3g} m from its middle): "
        "taken as that of a rod of half a leg or a plate between the hips",
    )


def unbalanced(m: mujoco.MjModel, legs: Legs, robot: Robot) -> tuple[str, ...]:
    """A sentence where the centre of mass, in the nominal stance, is not above the feet."""
    q, _ = angles(robot, robot.nominal_feet)
    d = mujoco.MjData(m)
    d.qpos[:] = legs.data.qpos
    d.qpos[m.jnt_qposadr[legs.joints]] = q
    mujoco.mj_kinematics(m, d)
    mine = np.flatnonzero(legs.owner != ELSEWHERE)
    centres = legs.frame.points(d.xipos[mine])
    masses = m.body_mass[mine]
    com = masses @ centres / masses.sum()
    outside = -float(margins(hull(robot.nominal_feet[:, :2]), com[None, :2])[0])
    if outside <= 0.0:
        return ()
    aside = masses * np.linalg.norm(centres[:, :2] - robot.nominal_feet[:, :2].mean(axis=0), axis=1)
    worst = int(np.argmax(aside))
    x, y, z = centres[worst]
    return (
        f"the centre of mass is {outside:.2f} m outside the feet: {m.body(int(mine[worst])).name!r} "
        f"({masses[worst]:.3g} of {masses.sum():.3g} kg) has its own at ({x:.2f}, {y:.2f}, {z:.2f}) m",
    )


def left_out(m: mujoco.MjModel, legs: Legs) -> tuple[str, ...]:
    """Sentences about limbs that are no legs, and about crooked hinges and springs at the joints of legs."""
    others = [
        f"the limb of {number_of_joints(chain.joints)} from {m.joint(chain.joints[0]).name!r}"
        for chain in limbs(m, legs.base)
        if not set(chain.joints) & set(legs.joints.ravel().tolist()) and not three_hinges(m, [chain])
    ]
    springs = [repr(m.joint(int(j)).name) for j in legs.joints.ravel() if m.jnt_stiffness[j] > 0.0]
    off = max(max(crooked(legs.data.xaxis[joints])) for joints in legs.joints)
    nearly = f"hinges are up to {math.degrees(off):.2f}° from square and parallel: taken as if they were not"
    return (
        *((nearly,) if off > ROUNDED else ()),
        *(f"{other} is no leg: its joints are locked" for other in others[:MOST_LIMBS]),
        *((f"the springs at the joints {listed(springs)} are left out",) if springs else ()),
    )
