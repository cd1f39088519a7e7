"""A known scene whose things move: at every look the robot is told where they are and how they go.

What stands is in its map like all that is known, and walked around; what moves is told beside it.
"""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Solid
from gaitwright.model.robot import Robot
from gaitwright.perception.estimated_state import EstimatedState
from gaitwright.perception.known_ground import KnownGround, map_of
from gaitwright.signals import GroundMap, Measured, Moving, Scan, Sensed
from gaitwright.stages import Memory, Perception

EVERY = 0.1
"""From look to look [s]."""
STANDS = 0.1
"""What goes slower is told as standing where it is [m/s]: it would be waited for too long."""


class Told(NamedTuple):
    """What was told last."""

    ground: GroundMap
    stands: tuple[Solid, ...]
    """Things that are in the map."""
    time: float
    known: Memory = None
    """Of who perceives all else."""


@dataclass(frozen=True)
class ToldThings:
    """A perception of a known scene, with its moving things."""

    known: KnownGround | EstimatedState
    scene: Scene
    robot: Robot
    apart: bool = True
    """Whether what moves is told as moving; else as standing where it is."""

    @property
    def ground(self) -> GroundMap:
        """The map at the start."""
        return self.told_at(0.0, None).ground

    def perceive(self, measured: Measured, memory: Told | None) -> tuple[Sensed, GroundMap, Told]:
        """The state, and the map with things where they were at the last look."""
        sensed, _, known = self.known.perceive(measured, memory and memory.known)
        if memory is None or measured.time - memory.time >= EVERY - 1e-9:
            memory = self.told_at(measured.time, memory)
        return sensed, memory.ground, memory if known is None else memory._replace(known=known)

    def told_at(self, time: float, before: Told | None) -> Told:
        """What is told at a time [s]. The map is another one only where something else stands."""
        stands, moving = [], []
        for mover in self.scene.movers:
            thing, velocity = mover.at(time), mover.velocity(time)
            if thing is None:
                continue
            if self.apart and math.hypot(*velocity) >= STANDS:
                moving.append(Moving(thing.corners(), velocity, time))
            else:
                stands.append(thing)
        things = tuple(stands)
        if before is not None and before.stands == things:
            ground = before.ground
        else:
            sees = self.known.ground.elevation is not None
            ground = map_of(self.scene.with_things(things), self.robot, sees)
        return Told(replace(ground, moving=tuple(moving)), things, time)

    def look(self, ground: GroundMap, sensed: Sensed) -> Scan | None:
        """The ground ahead of the robot."""
        return self.known.look(ground, sensed)

    def told(self, scene: Scene, robot: Robot) -> Perception:
        """The same of a world that was arranged anew."""
        return with_things(self.known.told(scene, robot), scene, robot, self.apart)


def with_things(perception: Perception, scene: Scene, robot: Robot, apart: bool = True) -> Perception:
    """A perception with what moves in a scene told to it, where it is told of the scene at all."""
    if scene.movers and isinstance(perception, KnownGround | EstimatedState):
        return ToldThings(perception, scene, robot, apart)
    return perception
