"""Where a camera looks from, and maps of scenes that a robot has walked through."""

import numpy as np

from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.model.camera import Camera
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import from_roll_pitch_yaw, quaternion_of
from gaitwright.perception.elevation_map import ElevationMap, fused, standing
from gaitwright.plant.eyes import Eyes
from gaitwright.signals import DepthFrame, Sensed


def posed(robot: Robot, scene: Scene, place, angles=(0.0, 0.0, 0.0), time: float = 0.0) -> Sensed:
    """A robot at its height over a place x, y; roll, pitch, yaw [rad]."""
    still, joints = np.zeros(3), np.zeros((robot.n, 3))
    position = np.array([*place, float(scene.height(*place)) + robot.height])
    turn = quaternion_of(from_roll_pitch_yaw(np.array(angles, dtype=float)))
    return Sensed(time, position, turn, still, still, joints, joints, np.ones(robot.n))


def footprints(robot: Robot, scene: Scene, sensed: Sensed) -> np.ndarray:
    """The lowest points of the feet of a robot that stands in a scene, world [m]."""
    x, y, _ = (sensed.position_w + robot.nominal_feet).T
    return np.column_stack([x, y, np.asarray(scene.height(x, y), dtype=float)])


def crowd(boxes: int, seed: int = 0, half: float = 7.0) -> Scene:
    """So many low and high blocks on level ground, none within 0.5 m of the x axis."""
    rng = np.random.default_rng(seed)
    blocks = []
    while len(blocks) < boxes:
        x, y = rng.uniform(-half, half, 2)
        if abs(y) > 0.5:
            sides = rng.uniform(0.1, 0.5, 2)
            height = float(rng.choice([0.03, 0.06, 0.3, 0.45]))
            blocks.append(Box(float(x), float(y), float(rng.uniform(-3.0, 3.0)), *map(float, sides), height))
    return Scene("crowd", Flat(), tuple(blocks), (-half, -half, half, half))


def walked(
    robot: Robot, scene: Scene, camera: Camera, xs, y: float = 0.0, seed: int = 0
) -> tuple[ElevationMap, DepthFrame, Sensed]:
    """The map after a frame at each x of a walk that sways, the last frame, and where it was taken."""
    eyes, frame = Eyes(camera, scene, seed), None
    sensed = posed(robot, scene, (xs[0], y))
    seen = standing(robot, sensed, footprints(robot, scene, sensed), noise=camera.noise)
    for k, x in enumerate(xs):
        angles = (0.02 * np.cos(2.3 * k), 0.03 * np.sin(1.7 * k), 0.1 * np.sin(0.3 * k))
        sensed = posed(robot, scene, (x, y), angles, 0.1 * k)
        frame = eyes.see(sensed, k)
        seen = fused(seen, frame, camera, sensed)
    assert frame is not None
    return seen, frame, sensed
