"""What `--check` looks at while a robot moves, in words and in numbers (row N8)."""

import math
from dataclasses import dataclass, field

import numpy as np

from gaitwright.control.certificate import Felt, felt_limits
from gaitwright.dynamics.articulated import Accelerations
from gaitwright.dynamics.checks import recursion_check
from gaitwright.locomotion import Lap
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.plant.closure import Closure
from gaitwright.plant.registry import SimulatedPlant

EVERY = 50
"""Ticks from one comparison of the controller's recursion to the next: the closed form takes milliseconds."""


@dataclass
class RecursionWatch:
    """The controller's inverse dynamics against the closed form, in states of the run.

    The accelerations are drawn, of the size of g: those of the run itself vanish with the loads in flight
    and in a symmetric stance, where a share of them says nothing.
    """

    robot: Robot
    ticks: int = 0
    compared: int = 0
    worst: float = 0.0
    """Largest difference, as a share of the load of its kind; no number where one of them was none."""

    def __post_init__(self) -> None:
        self.random = np.random.default_rng(0)

    def add(self, lap: Lap) -> None:
        """Takes a lap; compares at every `EVERY`-th, beginning with the first."""
        if self.ticks % EVERY == 0:
            check = recursion_check(self.robot, lap.sensed, self.any_motion())
            self.worst = float(np.maximum(self.worst, check.worst))  # max() would hide a NaN
            self.compared += 1
        self.ticks += 1

    def any_motion(self) -> Accelerations:
        """Accelerations of the size of g, and of g per height of the robot."""
        natural = GRAVITY / self.robot.height
        draw = self.random.uniform
        return Accelerations(
            draw(-0.5, 0.5, 3) * GRAVITY,
            draw(-1.0, 1.0, 3) * natural,
            draw(-1.0, 1.0, self.robot.q_min.shape) * natural,
        )


@dataclass
class Checks:
    """All that `--check` compares in one run."""

    robot: Robot
    plant: SimulatedPlant
    recursion: RecursionWatch
    closure: Closure
    dearest: Felt | None = None
    felt_at: float = field(default=0.0)
    """When the dearest limit was felt [s]."""

    @classmethod
    def of(cls, robot: Robot, plant: SimulatedPlant) -> "Checks":
        """Before the first lap."""
        return cls(robot, plant, RecursionWatch(robot), Closure(robot, plant.dt))

    def add(self, lap: Lap) -> None:
        """Takes a lap."""
        self.recursion.add(lap)
        self.closure.add(lap.sensed, lap.command)
        felt = felt_limits(self.robot, lap.command)
        if felt and (self.dearest is None or felt[0].price > self.dearest.price):
            self.dearest, self.felt_at = felt[0], lap.sensed.time

    @property
    def plant_recursion(self) -> float | None:
        """What plant `armstrong` found about its own recursion."""
        return getattr(self.plant, "worst_residual", None)

    def table(self) -> list[tuple[str, str]]:
        """For people."""
        residual = self.plant_recursion
        of_plant = (
            [] if residual is None else [("recursion", f"off the closed form by {residual:.0e} (worst)")]
        )
        worst, n = self.recursion.worst, self.recursion.compared
        return [
            *of_plant,
            ("recursion of the controller", f"off the closed form by {worst:.0e} (worst of {n})"),
            ("motion", self.closure.sentence()),
            ("dearest limit", self.limit_sentence()),
        ]

    def limit_sentence(self) -> str:
        """The limit that cost most."""
        if self.dearest is None:
            return "none was felt"
        return f"{self.dearest.sentence} (after {self.felt_at:.2f} s)"

    def numbers(self) -> dict[str, float | int | None]:
        """For programs; null where there is no number."""
        off = self.closure.differences()
        found = {
            "plant_recursion_worst": self.plant_recursion,
            "recursion_worst": self.recursion.worst,
            "recursion_compared": self.recursion.compared,
            "motion_off_median_mps2": float(np.median(off)) if len(off) else None,
            "motion_off_worst_mps2": float(off.max()) if len(off) else None,
            "dearest_limit_price": self.dearest.price if self.dearest else None,
            "dearest_limit_s": self.felt_at if self.dearest else None,
        }
        return {name: x if x is not None and math.isfinite(x) else None for name, x in found.items()}
