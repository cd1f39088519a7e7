"""What of a scene's moving things a robot touches: told by MuJoCo's contacts, not by what it believes."""

from collections import deque
from typing import NamedTuple

import numpy as np
import shapely

from gaitwright.ground.scene import Scene
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.signals import Measured, MotorCommand

BEFORE = 0.5
"""How a robot went is told from so long before a touch [s]."""
WENT = 0.1
"""A robot that came nearer to a thing by its own going, faster than this, walked into it [m/s]."""


class Touch(NamedTuple):
    """The first touch of a thing."""

    thing: int
    """Its number among the scene's movers."""
    time: float
    """[s]"""
    walked: bool
    """Whether the robot walked into it; else it ran into the robot, which stood or went elsewhere."""


class Touches:
    """A robot in MuJoCo, with the things that it has touched."""

    def __init__(self, plant: MujocoPlant) -> None:
        self.plant, self.dt = plant, plant.dt
        self.touches: list[Touch] = []
        self.places: deque[np.ndarray] = deque(maxlen=1 + round(BEFORE / plant.dt))

    @property
    def scene(self) -> Scene:
        """Where the robot is."""
        return self.plant.scene

    def reset(self, seed: int = 0, vary: bool = True) -> Measured:
        """The robot at its start, which has touched nothing."""
        self.touches.clear()
        self.places.clear()
        return self.plant.reset(seed, vary)

    def step(self, command: MotorCommand) -> Measured:
        """One control period under a command."""
        measured, world = self.plant.step(command), self.plant.world
        self.places.append(measured.position_w[:2].copy())
        before = {touch.thing for touch in self.touches}
        for thing in set(world.movers.touching(world.model, world.data, world.addresses[0].base)) - before:
            walked = self.towards(thing, measured.time) > WENT
            self.touches.append(Touch(thing, measured.time, walked))
        return measured

    def towards(self, thing: int, time: float) -> float:
        """How fast the robot went towards a thing of late [m/s]."""
        solid = self.scene.movers[thing].at(time)
        assert solid is not None, "what is not there cannot be touched"
        began, now = self.places[0], self.places[-1]
        nearest = shapely.Polygon(solid.corners()).exterior.interpolate(
            shapely.Polygon(solid.corners()).exterior.project(shapely.Point(now))
        )
        way = np.array([nearest.x, nearest.y]) - now
        length = float(np.linalg.norm(way))
        passed = self.dt * max(len(self.places) - 1, 1)
        return float((now - began) @ way) / (passed * length) if length > 0.0 else 0.0

    def push(self, force_w: tuple[float, float, float]) -> None:
        """A force [N] on the base's centre of mass from now on."""
        self.plant.push(force_w)

    def rearrange(self, scene: Scene) -> None:
        """Another arrangement of what stands around the robot."""
        self.plant.rearrange(scene)
