"""The moving things of a scene in MuJoCo: heavy bodies on slides that are put where their scripts say.

They are given their velocity too, so that what they meet is pushed, and rubbed against, as by things that go.
Nothing that a robot does moves them.
"""

from collections.abc import Iterator
from xml.etree.ElementTree import Element

import mujoco
import numpy as np
from jaxtyping import Float

from gaitwright.ground.scene import Scene
from gaitwright.plant.mujoco.mjcf import child
from gaitwright.plant.mujoco.terrain_geoms import Pieces, add_shape, touching

HEAVIER = 100.0
"""Mass of a thing, in those of all robots: one that meets it does not slow it down within a step."""
AWAY = 1000.0
"""What is not there waits so far below its place [m]."""
NAME = "mover"
"""What the names of their bodies begin with."""


def add_movers(root: Element, world: Element, scene: Scene, robots_mass: float) -> None:
    """Adds a body for each moving thing, its geoms where it is first, and slides along all three axes."""
    mass = HEAVIER * robots_mass
    for k, mover in enumerate(scene.movers):
        body = child(world, "body", name=f"{NAME}_{k}", gravcomp=1.0)
        child(body, "inertial", mass=mass, pos=[*mover.solid.centre, 0.0], diaginertia=[mass] * 3)
        for axis in np.eye(3):
            child(body, "joint", type="slide", axis=axis)
        into = Pieces(root, body, touching(scene, 1, 0))
        add_shape(into, f"{NAME}_{k}", mover.solid, scene.level(mover.solid))


class Movers:
    """Where a scene's moving things stand in the numbers of a world."""

    def __init__(self, model: mujoco.MjModel, scene: Scene) -> None:
        self.scene, n = scene, len(scene.movers)
        self.bodies = [model.body(f"{NAME}_{k}").id for k in range(n)]
        self.qpos = slice(model.nq - 3 * n, model.nq)
        self.qvel = slice(model.nv - 3 * n, model.nv)
        self.first = np.array([mover.path[0] for mover in scene.movers]).reshape(-1, 2)
        self.level = self.ground(self.first)

    def ground(self, places: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, "n"]:
        """Height of the ground under places [m]."""
        return np.asarray(self.scene.surface.height(places[:, 0], places[:, 1]), dtype=float)

    def follow(self, data: mujoco.MjData) -> None:
        """Puts every thing where it is now, as fast as it goes; nothing else changes."""
        time, movers = data.time, self.scene.movers
        if not movers:
            return
        there = np.array([mover.is_there(time) for mover in movers])
        places = np.array([mover.place(time) for mover in movers])
        rise = self.ground(places) - self.level
        offset = np.column_stack([places - self.first, np.where(there, rise, -AWAY)])
        speed = np.zeros_like(offset)
        speed[:, :2] = [mover.velocity(time) for mover in movers]
        data.qpos[self.qpos], data.qvel[self.qvel] = offset.ravel(), (speed * there[:, None]).ravel()

    def touching(self, model: mujoco.MjModel, data: mujoco.MjData, base: int) -> Iterator[int]:
        """Which of them the robot with that base touches now, by their numbers in the scene."""
        roots = model.body_rootid[model.geom_bodyid[data.contact.geom]]
        for one, other in roots[(roots == base).any(axis=1)].tolist():
            if (met := other if one == base else one) in self.bodies:
                yield self.bodies.index(met)
