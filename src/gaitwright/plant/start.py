"""How a robot starts on any plant: on its feet, with small differences drawn from a seed."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from gaitwright.ground.scene import Scene
from gaitwright.model.kinematics import angles, feet
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, upright_rotation


@dataclass(frozen=True)
class Start:
    """Pose and velocity of a robot that does not turn."""

    position_w: Float[np.ndarray, "3"]
    rotation_wb: Float[np.ndarray, "3 3"]
    velocity_w: Float[np.ndarray, "3"]
    q: Float[np.ndarray, "legs 3"]


def start_of(
    robot: Robot,
    scene: Scene,
    seed: int = 0,
    vary: bool = True,
    place: tuple[float, float, float] | None = None,
) -> Start:
    """The robot on its feet at a place (x, y, yaw), the scene's start where none is given.

    `vary` draws small differences from `seed`: joint angles by ±0.05 rad, velocity by ±5 % of √(g h), yaw by
    ±0.1 rad.
    """
    random = np.random.default_rng(seed)
    spread = random.uniform(-1.0, 1.0, size=4 + 3 * robot.n) if vary else np.zeros(4 + 3 * robot.n)
    x, y, yaw = place or scene.start
    R = upright_rotation(tuple(np.asarray(scene.normal(x, y)).ravel()), yaw + 0.1 * spread[0])
    q, _ = angles(robot, robot.nominal_feet)
    q = np.clip(q + 0.05 * spread[4:].reshape(-1, 3), robot.q_min, robot.q_max)
    velocity = 0.05 * np.sqrt(GRAVITY * robot.height) * spread[1:4] * (1.0, 1.0, 0.0)
    return Start(np.array([x, y, standing_height(robot, scene, R, q, (x, y))]), R, velocity, q)


def standing_height(
    robot: Robot,
    scene: Scene,
    R: Float[np.ndarray, "3 3"],
    q: Float[np.ndarray, "legs 3"],
    place: tuple[float, float],
) -> float:
    """Height of the base [m] at which the lowest foot just touches the ground below it."""
    centres = feet(robot, q) @ R.T + (*place, 0.0)
    ground = np.asarray(scene.height(centres[:, 0], centres[:, 1]))
    return float(np.max(ground + robot.foot_radius - centres[:, 2]))
