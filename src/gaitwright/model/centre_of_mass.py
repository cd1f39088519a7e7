"""Where points of the links are, and the centre of mass of the whole robot, by its joint angles."""

import numpy as np
from jaxtyping import Float

from gaitwright.model.kinematics import feet_over_time
from gaitwright.model.robot import Robot


def on_link(
    robot: Robot, q: Float[np.ndarray, "n legs 3"], points: Float[np.ndarray, "legs 3"], link: int
) -> Float[np.ndarray, "n legs 3"]:
    """Points of a link of every leg, given from its hinge in its axes, in the base frame [m], for joint
    angles [rad]."""
    of = robot.arrays
    offset = of.offset.copy()
    offset[:, link], offset[:, link + 1 :] = points, 0.0
    return feet_over_time(of.hip, of.leg_frame, offset, of.sign, q)


def centres_of_mass(robot: Robot, q: Float[np.ndarray, "n legs 3"]) -> Float[np.ndarray, "n 3"]:
    """Centre of mass of the whole robot in the base frame [m], for joint angles [rad]."""
    moment = robot.base_mass * robot.base_com + sum(
        (robot.mass[:, link, None] * on_link(robot, q, robot.com[:, link], link)).sum(axis=1)
        for link in range(3)
    )
    return moment / robot.total_mass
