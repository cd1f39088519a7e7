"""Measured with a camera's frames → Sensed, and a GroundMap that grows with every look.

Nothing of the scene is known but the field's bounds: the ground under the feet at the start is felt, all
else is seen or felt on the way (rows V2, V3). What a frame takes is done in as many ticks as there are
`STEPS`, so that none of them is much longer than the others.
"""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

from gaitwright.errors import WrongUse
from gaitwright.ground.elevation import BLIND, SPACING
from gaitwright.ground.scene import Scene
from gaitwright.model.camera import Camera
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import heading, rotation
from gaitwright.perception.elevation_map import (
    ElevationMap,
    carrying,
    felt,
    fused,
    lowest_points,
    standing,
    without,
)
from gaitwright.perception.estimated_state import EstimatedState
from gaitwright.perception.known_ground import KnownGround
from gaitwright.perception.scanner import Scanner
from gaitwright.perception.seen_ground import SeenElevation, footholds_of
from gaitwright.perception.seen_moving import Watched, told_apart
from gaitwright.perception.walls import sight_of
from gaitwright.signals import DepthFrame, ElevationGrid, GroundMap, Measured, Scan, Sensed, Sight
from gaitwright.stages import Memory


class Looking(NamedTuple):
    """A frame on its way into the map."""

    frame: DepthFrame
    sensed: Sensed
    """Where the robot was."""
    sight: Sight | None = None
    footholds: ElevationGrid | None = None
    steps: int = 0
    """That are done."""


class Looked(NamedTuple):
    """What is remembered from tick to tick."""

    seen: ElevationMap
    ground: GroundMap
    state: Memory = None
    """Of who estimates the state."""
    watched: Watched = Watched()
    """What tells that something moves."""
    looking: Looking | None = None
    """The frame that is not in the ground yet; `None`: all are."""


@dataclass(frozen=True)
class SeeingGround:
    """Perception of a robot that sees the ground with a camera."""

    robot: Robot
    camera: Camera
    ground: GroundMap
    """What is known before the first look: the bounds of the field."""
    scanner: Scanner
    state: EstimatedState | None = None
    """Who estimates the state; `None`: it is as measured."""
    apart: bool = True
    """Whether what moves is told from what stands; else all that is seen stands where it is."""

    @classmethod
    def of(
        cls, bounds: tuple[float, float, float, float], robot: Robot, camera: Camera, dt: float | None = None
    ) -> "SeeingGround":
        """In a field of which only the bounds [m] are known. `dt`: control period [s] of one that estimates
        its state; `None`: it is told."""
        ground, scanner = GroundMap(bounds, (), None, BLIND, robot.step_limit), Scanner.of(robot)
        state = None if dt is None else EstimatedState(KnownGround(ground, scanner), robot, dt)
        return cls(robot, camera, ground, scanner, state)

    def told(self, scene: Scene, robot: Robot) -> "SeeingGround":
        """The same: of a world that was arranged anew it is told nothing, it will see."""
        return self

    @property
    def noise(self) -> float:
        """Standard deviation of where edges of obstacles are seen [m]: of ranges, and half a cell."""
        return math.hypot(self.camera.noise, 0.5 * SPACING * self.robot.height)

    def perceive(self, measured: Measured, memory: Looked | None) -> tuple[Sensed, GroundMap, Looked]:
        """The state, and the ground as far as it was seen; another map some ticks after each frame."""
        sensed: Sensed = measured
        state = memory and memory.state
        if self.state is not None:
            sensed, _, state = self.state.perceive(measured, state)
        if memory is None:
            memory = self.begun(sensed)
            if measured.frame is not None:  # the first way is planned by what the first look shows
                memory = self.finished(self.begins(memory, measured.frame, sensed))
        elif measured.frame is not None:
            memory = self.begins(self.finished(memory), measured.frame, sensed)
        if memory.looking is not None:
            memory = STEPS[memory.looking.steps](self, memory, memory.looking)
        return sensed, memory.ground, memory._replace(state=state)

    def begun(self, sensed: Sensed) -> Looked:
        """What a robot knows that has not looked yet: it stands."""
        noise = self.camera.noise + self.camera.noise_growth * self.robot.height**2
        seen = standing(self.robot, sensed, lowest_points(self.robot, sensed), noise=noise)
        ground = replace(self.ground, elevation=SeenElevation(seen), footholds=footholds_of(seen))
        return Looked(seen, ground)

    def begins(self, memory: Looked, frame: DepthFrame, sensed: Sensed) -> Looked:
        """With a frame whose steps are still to be done. Raises `WrongUse` for one of another camera."""
        pixels = self.camera.pixels
        if frame.ranges.shape != pixels:
            raise WrongUse(
                f"a frame has {frame.ranges.shape} ranges, and this camera {pixels}: rows, columns"
            )
        return memory._replace(looking=Looking(frame, sensed))

    # --- a frame, step by step --------------------------------------------------------------------------
    def finished(self, memory: Looked) -> Looked:
        """With all that was seen in the ground."""
        while memory.looking is not None:
            memory = STEPS[memory.looking.steps](self, memory, memory.looking)
        return memory

    def fuse(self, memory: Looked, looking: Looking) -> Looked:
        """The map after the frame, and after what the feet felt when it was taken."""
        sensed = looking.sensed
        seen = fused(memory.seen, looking.frame, self.camera, sensed)
        down = carrying(self.robot, sensed)
        if down.any():
            soles = lowest_points(self.robot, sensed)[down]
            seen = felt(seen, soles, float(self.robot.foot_radius.max()), sensed.time)
        return memory._replace(seen=seen, looking=looking._replace(steps=1))

    def tell_apart(self, memory: Looked, looking: Looking) -> Looked:
        """The sight of what stands, and a map without what moves."""
        frame, seen, watched = looking.frame, memory.seen, memory.watched
        sight = sight_of(seen, frame, self.camera, looking.sensed, self.ground.step)
        if self.apart:
            sight, watched = told_apart(sight, frame.time, watched, self.robot.height, self.noise)
            for one in watched.moving:
                seen = (
                    without(seen, one.edge, self.ground.step, frame.time) if one.time == frame.time else seen
                )
        return memory._replace(seen=seen, watched=watched, looking=looking._replace(sight=sight, steps=2))

    def level(self, memory: Looked, looking: Looking) -> Looked:
        """The ground for feet."""
        return memory._replace(looking=looking._replace(footholds=footholds_of(memory.seen), steps=3))

    def tell(self, memory: Looked, looking: Looking) -> Looked:
        """The ground as it is now known: who plans a way does so in this tick."""
        assert looking.footholds is not None, "feet come before"
        ground = replace(
            self.ground,
            elevation=SeenElevation(memory.seen),
            footholds=looking.footholds,
            sight=looking.sight,
            moving=memory.watched.moving,
        )
        return memory._replace(ground=ground, looking=None)

    def look(self, ground: GroundMap, sensed: Sensed) -> Scan | None:
        """The ground ahead, as far as it was seen."""
        return self.scanner.look(ground, sensed.position_w, heading(rotation(sensed.orientation_wb)))


STEPS = (SeeingGround.fuse, SeeingGround.tell_apart, SeeingGround.level, SeeingGround.tell)
"""What a frame takes, a step in each tick."""
