"""A skill as a robot walks it at one velocity: where legs are in their cycles, and what joints do there."""

import math
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from gaitwright.errors import unknown
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle, is_hind, sampled, seen_from_hip
from gaitwright.model.kinematics import feet_over_time
from gaitwright.model.leg_motion import joints_of
from gaitwright.model.robot import Robot
from gaitwright.session import Session
from gaitwright.signals import Gait
from gaitwright.skills.library import find_skill, gait_of, meant

FORWARD = (1.0, 0.0)
SHORT = 0.02
"""A stride below this, in body heights, is none: a foot goes up and down on the spot."""

Shares = Float[np.ndarray, " n"]
Angles = Float[np.ndarray, "n 3"]


@dataclass(frozen=True)
class Walk:
    """A gait at a velocity. A leg's own phase is 0 where it touches down, and `gait.duty` where it lifts."""

    robot: Robot
    gait: Gait
    velocity: tuple[float, float]
    """Forward, left [m/s]."""
    turn: float
    """[rad/s]"""

    @classmethod
    def of(cls, robot: Robot, name: str, session: Session | None = None) -> "Walk":
        """A skill as it is walked now; one that is not, as it is meant. Raises `WrongUse` for none."""
        skill = find_skill(name, robot)
        call = None if session is None else session.mind.call
        if call is not None and call.gait.name == skill.name:
            return cls(robot, call.gait, call.velocity, call.turn)
        forward, left, turn = meant(skill, robot)
        return cls(robot, gait_of(skill, robot), (forward, left), turn)

    @property
    def skill(self) -> str:
        return self.gait.name

    @property
    def speed(self) -> float:
        """[m/s]"""
        return math.hypot(*self.velocity)

    @property
    def stride(self) -> float:
        """What a cycle takes the body on by [m]; 0 where that is next to nothing."""
        stride = self.speed * self.gait.period
        return stride if stride > SHORT * self.robot.height else 0.0

    @property
    def way(self) -> Float[np.ndarray, "2"]:
        """Where it goes: unit vector, forward and left."""
        return np.array(self.velocity) / self.speed if self.stride else np.array(FORWARD)

    @property
    def fastest(self) -> float:
        """The speed that a cycle must serve: that of now, or the one that the skill is meant for [m/s]."""
        return max(self.speed, math.hypot(*meant(find_skill(self.skill, self.robot), self.robot)[:2]))

    def leg(self, name: str) -> int:
        """The number of a leg. Raises `WrongUse` for one that there is not."""
        if name not in self.robot.legs:
            raise unknown(f"leg of {self.robot.name}", name, self.robot.legs)
        return self.robot.legs.index(name)

    def own(self, phase: np.ndarray | float, leg: int) -> np.ndarray:
        """A leg's own phase at a phase of the gait."""
        return np.mod(np.asarray(phase) + self.gait.offsets[leg], 1.0)

    # --- the path of a foot --------------------------------------------------------------------------
    def path(self, cycle: LegCycle, leg: int, own: Shares) -> Float[np.ndarray, "n 2"]:
        """Forward [strides] and height [body heights] of a foot as its hip sees it, at phases of its own."""
        duty = self.gait.duty
        out = np.stack([0.5 * duty - own, np.zeros_like(own)], axis=1)
        up = own > duty
        if up.any():
            share = (own[up] - duty) / (1.0 - duty)
            table = sampled(cycle, share, is_hind(leg, self.robot.n))
            out[up] = seen_from_hip(table, share, duty)[:, [0, 3]]
        return out

    def angles(self, leg: int, path: Float[np.ndarray, "n 2"]) -> Angles:
        """The joints of a leg whose foot is at places of a path [rad]."""
        feet = np.tile(self.robot.nominal_feet, (len(path), 1, 1))
        feet[:, leg, :2] += np.outer(self.stride * path[:, 0], self.way)
        feet[:, leg, 2] += self.robot.height * path[:, 1]
        still = np.zeros(feet.shape)
        return joints_of(self.robot.packed, feet, still, still)[0][:, leg]

    def feet(self, leg: int, angles: Angles) -> Float[np.ndarray, "n 3"]:
        """Where joints [rad] bring the foot of a leg: from its nominal place, base axes [m]."""
        a = self.robot.arrays
        q = np.zeros((len(angles), self.robot.n, 3))
        q[:, leg] = angles
        found = feet_over_time(a.hip, a.leg_frame, a.offset, a.sign, q)
        return found[:, leg] - self.robot.nominal_feet[leg]
