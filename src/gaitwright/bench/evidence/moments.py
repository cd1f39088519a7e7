"""Moments of a real trot: the inputs of a control tick, recorded, for us and for the peers alike."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gaitwright.bench.trial import Trial, brain_for, robot_named
from gaitwright.control.forces import FRICTION
from gaitwright.gait.state import GaitMemory
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain, Lap, Mind, think
from gaitwright.numerics.geometry import quaternion_of
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.signals import GroundMap, Mission, MotionTarget, Sensed, SkillCall
from gaitwright.stages import Memory

TROT = Trial("go2", "flat", 60.0, 0, speed=0.4)
SETTLES = 1000
"""Ticks until the trot is steady."""


@dataclass(frozen=True, slots=True)
class Moment:
    """What a tick starts from, and the target it led to."""

    gait: GaitMemory
    call: SkillCall
    sensed: Sensed
    memory: Memory
    """Of the controller."""
    target: MotionTarget
    ground: GroundMap


class LiveTrot:
    """Go2 trotting in its world, tick by tick; it walks on for as long as it is asked to."""

    def __init__(self) -> None:
        robot, scene = robot_named(TROT.robot), load_scene(TROT.scene)
        self.brain: Brain = brain_for(TROT, robot, scene)
        self.plant = MujocoPlant(robot, scene)
        self.sensed = self.plant.reset(TROT.seed)
        self.mind: Mind = self.brain.begin(Mission(()), self.sensed)
        for _ in range(SETTLES):
            self.advance()

    def advance(self) -> Lap:
        """One tick of brain and world."""
        lap = self.think()
        self.sensed = self.plant.step(lap.command)
        return lap

    def think(self) -> Lap:
        """The brain's part of a tick."""
        lap, self.mind = think(self.brain, self.mind, self.sensed)
        return lap

    def moments(self, number: int) -> list[Moment]:
        """The next ticks, recorded."""
        found = []
        for _ in range(number):
            memories = self.mind.memories
            lap = self.advance()
            found.append(
                Moment(memories.gait, lap.call, lap.sensed, memories.control, lap.target, self.mind.ground)
            )
        return found


def arrays(moments: Sequence[Moment]) -> dict[str, np.ndarray]:
    """The moments as the peers read them (`peers.tick_protocol.States`)."""
    sensed, targets = [m.sensed for m in moments], [m.target for m in moments]

    def own(name: str) -> np.ndarray:
        return np.array([getattr(s, name) for s in sensed])

    def wanted(name: str) -> np.ndarray:
        return np.array([getattr(t, name) for t in targets])

    turn = wanted("rotation_wb")
    return {
        "position": own("position_w"),
        "quat": own("orientation_wb"),
        "velocity_w": own("velocity_w"),
        "angular_velocity_b": own("angular_velocity_b"),
        "q": own("q"),
        "qd": own("qd"),
        "stance": wanted("stance"),
        "foot_position_w": wanted("feet_w"),
        "foot_velocity_w": wanted("feet_velocity_w"),
        "foot_acceleration_w": wanted("feet_acceleration_w"),
        "target_position": wanted("position_w"),
        "target_quat": np.array([quaternion_of(matrix) for matrix in turn]),
        "target_velocity_w": wanted("velocity_w"),
        "target_angular_velocity_b": np.einsum("tji,tj->ti", turn, wanted("angular_velocity_w")),
        "target_acceleration_w": wanted("acceleration_w"),
        "target_angular_acceleration_b": np.einsum("tji,tj->ti", turn, wanted("angular_acceleration_w")),
        "friction": np.array(FRICTION),
    }
