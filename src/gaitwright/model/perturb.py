"""A robot like another one, but not quite: masses, lengths and sizes drawn anew within a share (row R2).

What is drawn stays a robot that could be built: left and right are alike, all thighs are of one length and
all shanks of another (feet of unequal legs would not stand on one level), inertias go with mass × length².
Motors, joint limits and feet stay as they are; the stance is derived again, as from a file.
"""

from dataclasses import replace

import numpy as np
from jaxtyping import Float

from gaitwright.errors import WrongUse
from gaitwright.model.nominal_pose import LegShape, best_branch, branch_angles, nominal_foot
from gaitwright.model.robot import Robot

MOST_CHANGE = 0.5
"""Beyond this share a thigh and a shank may no longer make a leg that stands."""


def perturbed(robot: Robot, seed: int, most: float = 0.2) -> Robot:
    """A robot whose masses, leg lengths, hip spacing and trunk differ from those of `robot` by up to `most`.

    Each factor is drawn evenly from 1 ± `most`, all independently, the same ones for the same `seed`.
    Raises `WrongUse` for a seed below 0, and where `most` is not within 0 … 0.5.
    """
    if seed < 0:
        raise WrongUse(f"seed {seed} is asked; seeds are 0 or greater")
    if not 0.0 <= most <= MOST_CHANGE:
        raise WrongUse(
            f"a robot that differs by up to {most:g} of each number is asked; from 0 to {MOST_CHANGE:g} is"
        )
    random = np.random.default_rng(seed)

    def factors(*shape: int) -> np.ndarray:
        return random.uniform(1.0 - most, 1.0 + most, size=shape)

    heavier, thigh, shank = float(factors()), float(factors()), float(factors())
    spread, box, links = np.append(factors(2), 1.0), factors(3), factors(robot.n // 2, 3)
    body = with_trunk(robot, heavier, box)
    legs = with_legs(body, np.array([1.0, thigh, shank]), np.repeat(links, 2, axis=0))
    middle = robot.hip.mean(axis=0)
    return restood(replace(legs, name=f"{robot.name}~{seed}", hip=middle + (robot.hip - middle) * spread))


def with_trunk(robot: Robot, heavier: float, box: Float[np.ndarray, "3"]) -> Robot:
    """The trunk stretched by `box` along its axes about the middle of the hips, its mass times `heavier`."""
    middle = robot.hip.mean(axis=0)
    return replace(
        robot,
        base_mass=robot.base_mass * heavier,
        base_com=middle + (robot.base_com - middle) * box,
        base_inertia=stretched(robot.base_inertia, box) * heavier,
        trunk=np.stack([middle + (robot.trunk[0] - middle) * box, robot.trunk[1] * box]),
    )


def stretched(inertia: Float[np.ndarray, "3 3"], factors: Float[np.ndarray, "3"]) -> Float[np.ndarray, "3 3"]:
    """Inertia of a body of the same mass whose every point is `factors` times as far out along each axis.

    By the second moments S = ½ tr(I) 1 − I, which go with length²; so I stays that of a body.
    """
    one = np.eye(3)
    moments = (0.5 * np.trace(inertia) * one - inertia) * np.outer(factors, factors)
    return np.trace(moments) * one - moments


def with_legs(robot: Robot, longer: Float[np.ndarray, "3"], heavier: Float[np.ndarray, "legs 3"]) -> Robot:
    """Links grown evenly in all directions by `longer` (hip, thigh, shank), their masses times `heavier`."""
    along = longer[:, None]
    return replace(
        robot,
        offset=robot.offset * along,
        com=robot.com * along,
        mass=robot.mass * heavier,
        inertia=robot.inertia * (heavier * longer**2)[..., None, None],
    )


def restood(robot: Robot) -> Robot:
    """The robot in the nominal stance of its lengths; each leg keeps its branch where that reaches it."""
    shapes = [leg_shape(robot, i) for i in range(robot.n)]
    feet = np.array([nominal_foot(shape) for shape in shapes])
    branch = robot.branch.copy()
    for i, shape in enumerate(shapes):
        choices = branch_angles(shape, feet[i])
        if not choices:
            raise WrongUse(f"leg {robot.legs[i]} of {robot.name} cannot stand with links so changed")
        if tuple(robot.branch[i]) not in choices:
            branch[i] = best_branch(shape, choices)
    return replace(robot, stance=feet, branch=branch)


def leg_shape(robot: Robot, i: int) -> LegShape:
    """Leg `i`, as far as standing goes."""
    fields = (robot.hip, robot.leg_frame, robot.offset, robot.sign, robot.q_min, robot.q_max)
    hip, frame, offset, sign, low, high = (field[i] for field in fields)
    return LegShape(hip, frame, offset, float(sign), low, high)
