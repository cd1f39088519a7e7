"""Whether the numbers of a robot make sense: if not, a sentence with the leg, the joint and the number."""

from collections.abc import Iterator
from itertools import product

import numpy as np

from gaitwright.errors import BadFile
from gaitwright.model.kinematics import HINGES
from gaitwright.model.robot import Robot

ABSURD = 1e6
"""No number of a robot is as large as this, in SI units."""
LIGHTEST = 1.5e-3
"""A thigh or shank of less than this share of the mass has none; a link without one is given less."""
PER_JOINT = (
    "mass",
    "com",
    "inertia",
    "armature",
    "damping",
    "friction",
    "q_min",
    "q_max",
    "tau_max",
    "rate_max",
)
"""Fields of a `Robot` with a row per leg and joint."""
PER_LEG = ("hip", "leg_frame", "offset", "sign", "foot_radius", "branch", "nominal_feet")
"""Fields with a row per leg."""
NOT_NEGATIVE = ("armature", "damping", "friction", "rate_max")
"""Fields whose numbers are zero or more."""

WORDS = {
    "base_mass": "mass of the body",
    "base_com": "centre of mass of the body",
    "base_inertia": "inertia of the body",
    "com": "centre of mass",
    "q_min": "lower joint limit",
    "q_max": "upper joint limit",
    "tau_max": "torque limit",
    "rate_max": "speed limit",
    "hip": "place of the first hinge",
    "leg_frame": "direction of the hinges",
    "offset": "lengths of the links",
    "foot_radius": "radius of the foot",
    "nominal_feet": "stance",
    "trunk": "box of the body",
}
"""What a person calls a field, where that is not its name."""


def check(robot: Robot) -> None:
    """Raises `BadFile` for a number not finite, absurd or negative that cannot be, and a missing mass."""
    for what, value in named_numbers(robot):
        check_finite(what, value)
        if what.startswith(tuple(WORDS.get(field, field) for field in NOT_NEGATIVE)) and value.min() < 0.0:
            raise BadFile(f"{what} is {value:g}; expected 0 or more")
    if robot.base_mass <= 0.0:
        raise BadFile("the floating body has no mass")
    for name, masses in zip(robot.legs, robot.mass, strict=True):
        if masses[1:].min() <= LIGHTEST * robot.total_mass:
            raise BadFile(f"leg {name} has a thigh or shank without mass: {masses.round(6).tolist()} kg")


def named_numbers(robot: Robot) -> Iterator[tuple[str, np.ndarray]]:
    """The numbers of a robot in small pieces, each with its name: field, leg and joint."""
    for field, value in vars(robot).items():
        if value is None:
            continue
        if field in PER_JOINT:
            for (i, leg), (j, joint) in product(enumerate(robot.legs), enumerate(HINGES)):
                yield f"{WORDS.get(field, field)} of leg {leg}, {joint}", np.asarray(value[i, j])
        elif field in PER_LEG:
            yield from (
                (f"{WORDS.get(field, field)} of leg {leg}", np.asarray(value[i]))
                for i, leg in enumerate(robot.legs)
            )
        elif isinstance(value, np.ndarray | float):
            yield WORDS.get(field, field), np.asarray(value)


def check_finite(what: str, value: np.ndarray) -> None:
    """Raises `BadFile` with the first number of `what` that is not finite, or absurd."""
    wrong = np.extract(~(np.abs(value) < ABSURD), value)
    if wrong.size:
        raise BadFile(f"{what} is not finite or not below {ABSURD:g} (SI units): {wrong[0]:g}")
