"""Perception of a robot that nobody tells where it is: it knows its start, and goes by its own sensors."""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from gaitwright.ground.scene import Scene
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.numerics.packing import Row
from gaitwright.perception.estimator import LAYOUT, estimate, estimate_in
from gaitwright.perception.known_ground import KnownGround
from gaitwright.signals import GroundMap, Measured, Scan, Sensed

Sensing = Literal["true", "estimated"]
"""What a robot knows of its own state: the truth, or what it makes of its sensors."""


@dataclass(frozen=True)
class EstimatedState:
    """The ground is known, the state is estimated; place and heading count from the start."""

    known: KnownGround
    robot: Robot
    dt: float
    """Control period [s]."""

    @property
    def ground(self) -> GroundMap:
        return self.known.ground

    def perceive(self, measured: Measured, memory: Row | None) -> tuple[Sensed, GroundMap, Row]:
        """The state as the sensors let it be known, and the whole map."""
        memory = self.begun(measured) if memory is None else memory.copy()
        out = np.empty_like(measured.row)
        estimate(self.robot.packed, measured.row, measured.specific_force_b, self.dt, memory, out)
        return Sensed.of_row(out, time=measured.time), self.known.ground, memory

    def told(self, scene: Scene, robot: Robot) -> "EstimatedState":
        """The same of a world that was arranged anew: it is told."""
        return replace(self, known=self.known.told(scene, robot))

    def look(self, ground: GroundMap, sensed: Sensed) -> Scan | None:
        """The ground ahead, from where it believes to be."""
        return self.known.look(ground, sensed)

    def begun(self, measured: Measured) -> Row:
        """What is known at the start, of a robot that stood there for a moment: its pose."""
        memory = np.zeros(LAYOUT.size(self.robot.n))
        state = estimate_in(memory)
        state.orientation[:] = measured.orientation_wb
        state.position[:] = measured.position_w
        state.felt[2] = GRAVITY
        state.rates[:] = measured.qd
        return memory
