"""Masses and inertias that no body has are mended before MuJoCo sees them, and told."""

import math
from collections.abc import Iterator

import mujoco
import numpy as np
from jaxtyping import Float

from gaitwright.description.aside import listed
from gaitwright.description.shapes import weighs
from gaitwright.errors import BadFile

NEGLIGIBLE = 1e-3
"""A link of less than this share of the robot's mass may be a point."""
SMALLEST = 1e-12
"""No principal inertia of a moving link is smaller [kg·m²]: MuJoCo takes none below 1e-14."""
WATER = 1000.0
"""Density of the ball whose inertia a link gets that has none [kg/m³]."""
ROUNDING = 1e-12
"""A + B may be less than C by this share."""

DENSEST = 22_600.0
"""Density of osmium [kg/m³]: no body is smaller than a ball of it that weighs as much."""

POINT = "the inertia of {links} is none that a body has; being light, taken as a point of what carries it"
BALL = "no inertia is given for {links}: taken as that of a ball of water"
RAISED = "the inertia of {links} is none that a body has (A + B < C): its smaller parts raised to A + B = C"
DENSE = "the inertia of {links} is less than any matter of that mass has: taken as that of a ball of water"
WEIGHTLESS = "no mass is given for {links}, which {moves} own: taken as {mass:.2g} kg"


def mend_inertias(spec: mujoco.MjSpec) -> tuple[str, ...]:
    """Makes every inertia one that a body can have; a sentence for each kind of change, with its links.

    A link of negligible mass that does not move on its own becomes a point of the one that carries it.
    """
    if spec.compiler.inertiafromgeom == 1:
        return ()
    given = [body for body in spec.bodies[1:] if body.explicitinertial]
    total = sum(body.mass for body in given)
    told: dict[str, list[str]] = {}
    for body in given:
        if body.mass < 0.0:
            raise BadFile(f"the mass of {body.name!r} is {body.mass:g} kg; expected 0 or more")
        change = mended(body, NEGLIGIBLE * total, bool(spec.compiler.balanceinertia))
        told.setdefault(change, []).append(body.name)
    told.pop("", None)
    return tuple(change.format(links=listed(list(map(repr, names)))) for change, names in told.items())


def give_masses(spec: mujoco.MjSpec) -> list:
    """Gives a little mass to bodies that move on their own and have none, so that the model compiles.

    Raises `BadFile` where nothing has a mass.
    """
    if len(spec.bodies) > 1 and not any(has_mass(spec, body) for body in spec.bodies[1:]):
        raise BadFile("none of its links has a mass; expected masses and inertias")
    total = sum(body.mass for body in spec.bodies[1:] if body.explicitinertial)
    given = []
    for body in spec.bodies[1:] if total > 0.0 else ():
        if body.joints and not any(has_mass(spec, part) for part in rigid(body)):
            put_ball(body, NEGLIGIBLE * total)
            given.append(body)
    return given


def take_masses(spec: mujoco.MjSpec, given: list) -> tuple[str, ...]:
    """Takes the masses away from bodies that now are fixed to others; a sentence about those that are not."""
    kept = [body for body in given if not any(has_mass(spec, part) for part in fixed_to(body, given))]
    mass = max((body.mass for body in kept), default=0.0)
    for body in given:
        if body not in kept:
            body.mass, body.inertia = 0.0, np.zeros(3)
    moves = "moves on its" if len(kept) == 1 else "move on their"
    links = listed([repr(body.name) for body in kept])
    return (WEIGHTLESS.format(links=links, moves=moves, mass=mass),) if kept else ()


def fixed_to(body, given: list) -> list:
    """What moves as one with a body, but for those in `given`."""
    top = body
    while not top.joints and top.parent.parent is not None:
        top = top.parent
    return [part for part in rigid(top) if part not in given]


def mended(body, negligible: float, balanced: bool) -> str:
    """Mends the inertia that a file gives to a body of at least some mass; which kind of change it was."""
    values, axes = np.linalg.eigh(tensor_of(body))
    light = body.mass <= negligible and not body.joints
    if not values.any():
        if light or body.mass == 0.0:
            return ""
        put_ball(body, body.mass)
        return BALL
    if body.joints and values[2] < of_ball(body.mass, DENSEST):
        put_ball(body, body.mass)
        return DENSE
    short = values[2] - values[0] - values[1]
    if values[0] > SMALLEST and (short <= ROUNDING * values[2] or balanced):
        return ""
    if light:
        put_tensor(body, np.zeros((3, 3)))
        return POINT
    raised = np.maximum(values, SMALLEST)
    raised[:2] += 0.5 * max(0.0, raised[2] - raised[0] - raised[1]) * (1.0 + ROUNDING)
    put_tensor(body, axes @ np.diag(raised) @ axes.T)
    return RAISED


def tensor_of(body) -> Float[np.ndarray, "3 3"]:
    """The inertia that a file gives, in the axes of the inertial frame [kg·m²]."""
    xx, yy, zz, xy, xz, yz = body.fullinertia
    if np.isnan(xx):
        return np.diag(body.inertia)
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def put_tensor(body, tensor: Float[np.ndarray, "3 3"]) -> None:
    """Gives a body an inertia in the form in which it had one."""
    if np.isnan(body.fullinertia[0]) or not tensor.any():
        body.fullinertia = np.full(6, np.nan)
        body.inertia = np.diag(tensor)
    else:
        body.fullinertia = [*np.diag(tensor), tensor[0, 1], tensor[0, 2], tensor[1, 2]]


def put_ball(body, mass: float) -> None:
    """Gives a body a mass [kg], and the inertia of a ball of water that weighs as much."""
    if not body.explicitinertial:
        body.explicitinertial, body.ipos = True, np.zeros(3)
    body.mass = mass
    body.fullinertia = np.full(6, np.nan)
    body.inertia = np.full(3, max(SMALLEST, of_ball(mass, WATER)))


def of_ball(mass: float, density: float) -> float:
    """Inertia of a ball [kg·m²] of a mass [kg] and density [kg/m³]."""
    radius = (0.75 * mass / (math.pi * density)) ** (1.0 / 3.0)
    return 0.4 * mass * radius**2


def rigid(body) -> Iterator:
    """A body and all that is fixed to it."""
    yield body
    for child in body.bodies:
        if not child.joints:
            yield from rigid(child)


def has_mass(spec: mujoco.MjSpec, body) -> bool:
    """Whether MuJoCo will find a mass for a body, in the file or in its shapes."""
    if body.explicitinertial:
        return body.mass > 0.0
    return any(weighs(spec, geom) for geom in body.geoms)
