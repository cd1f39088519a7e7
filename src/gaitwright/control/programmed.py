"""MotionTarget + Sensed → MotorCommand by joint angles played back: motion programmed in (row S1)."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.control.servo import STIFF, Gains, servo_command
from gaitwright.errors import WrongUse
from gaitwright.model.kinematics import HINGES
from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.signals import MotionTarget, MotorCommand, Posture, Sensed
from gaitwright.stages import Map, Now

Table = Float[np.ndarray, "bins legs 3"]


@kernel
def played(table, phase):
    """Rows `(legs, 3)` of a periodic table `(bins, legs, 3)` at `phase`, straight in between."""
    bins = table.shape[0]
    x = (phase % 1.0) * bins
    i = int(x) % bins
    t = x - int(x)
    return (1.0 - t) * table[i] + t * table[(i + 1) % bins]


@dataclass(frozen=True)
class ProgrammedController:
    """Plays a table of joint angles through servos, in step with the gait's phase, whatever the robot does.

    No equations, and nothing that is sensed corrects it: not a tilt, not a foot that missed the ground, not a
    speed that is off.
    """

    robot: Robot
    table: Table
    """Joint angles over the phase [rad]; row / bins is the phase."""
    rates: Table
    """Joint rates beside them [rad/s]."""
    stance: Bool[np.ndarray, "bins legs"]
    """Legs that are to stand; only a plant without mechanics is told."""
    gains: Gains = STIFF

    def __post_init__(self) -> None:
        expected = (len(self.table), self.robot.n, 3)
        shapes = self.table.shape, self.rates.shape, self.stance.shape
        if not len(self.table) or shapes != (expected, expected, expected[:2]):
            raise WrongUse(
                f"a programme of angles {shapes[0]}, rates {shapes[1]} and stance {shapes[2]} for "
                f"{self.robot.name}; expected (phases, {self.robot.n}, 3) of angles and rates and "
                f"(phases, {self.robot.n}) of stance, at least one phase"
            )
        if not (np.isfinite(self.table).all() and np.isfinite(self.rates).all()):
            raise WrongUse(f"a programme for {self.robot.name} has a number that is not finite")
        over = np.maximum(self.robot.q_min - self.table, self.table - self.robot.q_max)
        if over.max() > 1e-9:
            raise WrongUse(beyond(self.robot, self.table, over))

    def command(
        self, target: MotionTarget, sensed: Sensed, memory: None = None, call: Now = None, ground: Map = None
    ) -> tuple[MotorCommand, None]:
        """Joint torques [N·m] for this tick, within the limits; nothing is remembered."""
        q, qd = played(self.table, target.phase), played(self.rates, target.phase)
        down = self.stance[int(target.phase * len(self.stance)) % len(self.stance)]
        posture = Posture(target.position_w, target.rotation_wb, q, down)
        return servo_command(self.robot, self.gains, q, qd, sensed, posture), None


def beyond(robot: Robot, table: Table, over: Table) -> str:
    """Which leg, joint and phase of a table stands farthest beyond its limit; `over`: by how much [rad]."""
    row, leg, joint = np.unravel_index(int(np.argmax(over)), over.shape)
    angle, low, high = table[row, leg, joint], robot.q_min[leg, joint], robot.q_max[leg, joint]
    return (
        f"a programme for {robot.name} takes leg {robot.legs[leg]}, {HINGES[joint]}, to {angle:.3g} rad at "
        f"phase {row / len(table):.3f}; its limits are {low:.3g} to {high:.3g} rad"
    )
