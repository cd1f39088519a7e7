"""A scene that is known: a map that is full from the start, and a state that is sensed as it is."""

from dataclasses import dataclass

import numpy as np

from gaitwright.ground.elevation import BLIND, elevation_grid
from gaitwright.ground.scene import Scene
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import heading, rotation
from gaitwright.perception.scanner import Scanner
from gaitwright.signals import GroundMap, Measured, Scan, Sensed

BLIND_SHARE = 0.55
"""A robot that does not see the ground steps over this share of its step limit."""


@dataclass(frozen=True)
class KnownGround:
    """Perception of a robot that is told where it is and what the ground is like."""

    ground: GroundMap
    scanner: Scanner

    @classmethod
    def of(cls, scene: Scene, robot: Robot, sees: bool = True) -> "KnownGround":
        """`sees`: whether feet know the ground ahead, so that it is scanned and higher steps are climbed."""
        return cls(map_of(scene, robot, sees), Scanner.of(robot))

    def told(self, scene: Scene, robot: Robot) -> "KnownGround":
        """The same of a world that was arranged anew: it is told."""
        return KnownGround.of(scene, robot, self.ground.elevation is not None)

    def perceive(self, measured: Measured, memory: None) -> tuple[Sensed, GroundMap, None]:
        """The state as the plant has it, and the whole map."""
        return measured, self.ground, None

    def look(self, ground: GroundMap, sensed: Sensed) -> Scan | None:
        """The ground ahead of the robot; `None` for one that does not see."""
        return self.scanner.look(ground, sensed.position_w, heading(rotation(sensed.orientation_wb)))


def map_of(scene: Scene, robot: Robot, sees: bool = True) -> GroundMap:
    """Everything that a robot may know of a scene; one that does not see knows what it must walk around."""
    step = robot.step_limit if sees else BLIND_SHARE * robot.step_limit
    return GroundMap(
        scene.bounds,
        tuple(np.array(box.corners()) for box in scene.obstacles(step)),
        scene if sees else None,
        elevation_grid(scene, robot) if sees else BLIND,
        step,
        scene.friction,
    )
