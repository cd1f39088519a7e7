"""Measured with a camera's frames → Sensed, and a GroundMap that grows with every look.

Nothing of the scene is known but the field's bounds: the ground under the feet at the start is felt, all
else is seen or felt on the way (rows V2, V3).
"""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

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
from gaitwright.signals import DepthFrame, GroundMap, Measured, Scan, Sensed, Sight
from gaitwright.stages import Memory


class Looked(NamedTuple):
    """What is remembered from tick to tick."""

    seen: ElevationMap
    ground: GroundMap
    state: Memory = None
    """Of who estimates the state."""
    watched: Watched = Watched()
    """What tells that something moves."""


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
        """The state, and the ground as far as it was seen; between two frames the same map."""
        sensed: Sensed = measured
        state = memory and memory.state
        if self.state is not None:
            sensed, _, state = self.state.perceive(measured, state)
        if memory is not None and measured.frame is None:
            return sensed, memory.ground, memory._replace(state=state)
        seen = self.before(sensed) if memory is None else memory.seen
        sight, watched = None, Watched() if memory is None else memory.watched
        if measured.frame is not None:
            seen, sight = self.looked(seen, sensed, measured.frame)
            if self.apart:
                time, height = measured.frame.time, self.robot.height
                sight, watched = told_apart(sight, time, watched, height, self.noise)
                for one in watched.moving:
                    seen = without(seen, one.edge, self.ground.step, time) if one.time == time else seen
        footholds, moving = footholds_of(seen), watched.moving
        ground = replace(
            self.ground, elevation=SeenElevation(seen), footholds=footholds, sight=sight, moving=moving
        )
        return sensed, ground, Looked(seen, ground, state, watched)

    def before(self, sensed: Sensed) -> ElevationMap:
        """The map of a robot that has not looked yet: it stands."""
        noise = self.camera.noise + self.camera.noise_growth * self.robot.height**2
        return standing(self.robot, sensed, lowest_points(self.robot, sensed), noise=noise)

    def looked(self, seen: ElevationMap, sensed: Sensed, frame: DepthFrame) -> tuple[ElevationMap, Sight]:
        """The map after a frame and what the feet feel meanwhile, and the sight of the frame."""
        seen = fused(seen, frame, self.camera, sensed)
        down = carrying(self.robot, sensed)
        if down.any():
            soles = lowest_points(self.robot, sensed)[down]
            seen = felt(seen, soles, float(self.robot.foot_radius.max()), sensed.time)
        return seen, sight_of(seen, frame, self.camera, sensed, self.ground.step)

    def look(self, ground: GroundMap, sensed: Sensed) -> Scan | None:
        """The ground ahead, as far as it was seen."""
        return self.scanner.look(ground, sensed.position_w, heading(rotation(sensed.orientation_wb)))
