"""What a robot truly does while its sensors lie, and robots that are not what their brains know."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from gaitwright.ground.scene import Scene
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import rotation
from gaitwright.plant.faults import Breakdown
from gaitwright.signals import Measured, MotorCommand
from gaitwright.stages import SimulatedPlant


@dataclass(frozen=True, slots=True)
class Change:
    """How a robot differs from its file."""

    payload: float = 0.0
    """On its back, unknown to its brain [kg]."""
    mass: float = 1.0
    """Factor of all masses, unknown to its brain."""
    torque: float = 1.0
    """Factor of its torque limits, known."""

    def known(self, robot: Robot) -> Robot:
        """The robot as its brain has it."""
        return robot if self.torque == 1.0 else replace(robot, tau_max=robot.tau_max * self.torque)

    def real(self, robot: Robot) -> Robot:
        """The robot as it is: the load lies in the middle of the back."""
        if self.payload == 0.0 and self.mass == 1.0:
            return robot
        base, load = self.mass * robot.base_mass, self.payload
        at = robot.trunk[0] + (0.0, 0.0, robot.trunk[1, 2])
        com = (base * robot.base_com + load * at) / (base + load)
        inertia = self.mass * robot.base_inertia
        for mass, point in ((base, robot.base_com), (load, at)):
            r = point - com
            inertia = inertia + mass * (r @ r * np.eye(3) - np.outer(r, r))
        return replace(
            robot,
            base_mass=base + load,
            base_com=com,
            base_inertia=inertia,
            mass=self.mass * robot.mass,
            inertia=self.mass * robot.inertia,
        )


@dataclass(frozen=True, slots=True)
class Seen:
    """What became of a robot in truth, from the first breakdown on."""

    shown: tuple[float, ...]
    """When each breakdown first made a difference [s]; those that made none are left out."""
    lean: float
    """Farthest that the body leaned [°]."""
    sinks: float
    """Greatest speed of the body downwards [m/s]."""
    rises: float
    """Greatest height of the body, in standing heights over where it began."""
    motors_off: bool
    """Whether the last command was none."""

    @property
    def safe(self) -> bool:
        """Neither tipped over nor thrown up, set down slowly, and quiet at the end."""
        return self.lean < 60.0 and self.sinks < 1.0 and self.rises < 1.5 and self.motors_off


class Witness:
    """A simulated plant that looks on."""

    def __init__(self, plant: SimulatedPlant, robot: Robot) -> None:
        self.plant, self.robot, self.dt = plant, robot, plant.dt
        self.times: list[float] = []
        self.states: list[tuple[float, float, float]] = []

    def reset(self, seed: int = 0, vary: bool = True) -> Measured:
        """The robot at its start."""
        self.times.clear()
        self.states.clear()
        return self.saw(self.plant.reset(seed, vary))

    def step(self, command: MotorCommand) -> Measured:
        """One control period under a command."""
        return self.saw(self.plant.step(command))

    def push(self, force_w: tuple[float, float, float]) -> None:
        """A force [N] on the base's centre of mass from now on."""
        self.plant.push(force_w)

    def rearrange(self, scene: Scene) -> None:
        """Another arrangement of what stands around the robot."""
        self.plant.rearrange(scene)

    def saw(self, true: Measured) -> Measured:
        """Takes a state."""
        up = float(rotation(true.orientation_wb)[2, 2])
        self.times.append(true.time)
        self.states.append((up, float(true.velocity_w[2]), float(true.position_w[2])))
        return true

    def seen(self, shown: Mapping[Breakdown, float], last: MotorCommand | None) -> Seen:
        """What became of it, from the first breakdown that showed on; from the start where none did.

        `last`: the last command.
        """
        times, states = np.array(self.times), np.array(self.states)
        from_then_on = states[times >= min(shown.values(), default=0.0) - 1e-9]
        up, speed, height = from_then_on.T
        off = last is not None and not last.tau.any() and last.kd is None
        return Seen(
            tuple(sorted(shown.values())),
            math.degrees(math.acos(max(-1.0, min(1.0, up.min())))),
            float(-speed.min()),
            float(height.max() / self.robot.height),
            off,
        )
