"""The joint torques of a cycle of desired motion, by inverse dynamics and the thesis's linear program.

The one place here that knows how the feet share the load (`control.linear`).
"""

import math
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from gaitwright.control.inverse_dynamics import load_of, packed_load
from gaitwright.control.linear import distribute_linear
from gaitwright.control.thesis_program import LinearSettings
from gaitwright.gait.desired_cycle import DesiredCycle
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY

FRICTION = 0.42
"""μ′ of the friction pyramid: inside the cone of μ = 0.6 (equations.md §5)."""
TIE = 1e-4
"""Price of a change of force: decides only between solutions that the thesis's objective holds equal."""
ANY_LEVER = 100.0
"""Lever of the foot moments that never binds [m]."""

POINT_FEET = LinearSettings(unmet=math.inf, change=TIE, friction=FRICTION)
"""Three force components at each foot; the balance must hold."""
GIVING_WAY = POINT_FEET._replace(unmet=LinearSettings().unmet)
"""The same, but what two feet cannot balance stays unbalanced."""


def held_feet(lever: float = ANY_LEVER) -> LinearSettings:
    """Six components at each foot, as in the thesis; moments up to the normal force times a lever [m]."""
    return POINT_FEET._replace(components=6.0, roll_lever=lever, pitch_lever=lever, twist_lever=lever)


@dataclass(frozen=True)
class CycleTorques:
    """Torques and foot loads over a cycle; not-a-number where the program has no solution."""

    cycle: DesiredCycle
    tau: Float[np.ndarray, "steps legs 3"]
    """Motor torques [N·m]."""
    forces_w: Float[np.ndarray, "steps legs 3"]
    """Ground forces on the feet [N]."""
    moments_w: Float[np.ndarray, "steps legs 3"]
    """Ground moments on the feet about the contact points [N·m]."""
    missing: Float[np.ndarray, "steps 6"]
    """Force [N] and moment about the base origin [N·m] that the motion asks for and the feet do not give."""
    solved: Bool[np.ndarray, "steps"]
    iterations: Int[np.ndarray, "steps"]
    """Steps of the simplex method."""


def cycle_torques(
    robot: Robot, cycle: DesiredCycle, settings: LinearSettings, laps: int = 2, warm: bool = True
) -> CycleTorques:
    """The torques of the last of some laps through a cycle, sample by sample, the robot moving as desired.

    Each sample starts from the solution of the one before; with `warm` false every one from nothing.
    """
    steps, legs = cycle.stance.shape
    weight, height, numbers = robot.total_mass * GRAVITY, robot.height, np.array(settings)
    components = 6 if settings.components > 3.0 else 3
    nothing = np.full(components * legs + 1, -1)
    hints, before = nothing, np.zeros((legs, 3))
    loads = np.zeros((3, steps, legs, 3))
    missing, solved, iterations = np.zeros((steps, 6)), np.zeros(steps, bool), np.zeros(steps, int)
    for i in list(range(steps)) * laps:
        sensed, target = cycle.sensed(i), cycle.target(i)
        packed = packed_load(robot, target, sensed)
        shared = distribute_linear(
            packed, target.stance, target.load_scale, target.friction, target.normal_w, before,
            robot.tau_max, weight, height, sensed.qd, numbers, hints if warm else nothing,
        )  # fmt: skip
        hints, solved[i], iterations[i] = shared.basis, shared.code == 0, shared.steps
        x = np.zeros((legs, components))
        x[target.stance] = shared.x.reshape(-1, components)
        loads[:, i], missing[i] = foot_loads(load_of(packed), weight * x, height)
        before = loads[1, i]
    loads[:, ~solved], missing[~solved] = np.nan, np.nan
    return CycleTorques(cycle, loads[0], loads[1], loads[2], missing, solved, iterations)


def even_torques(robot: Robot, cycle: DesiredCycle, i: int) -> Float[np.ndarray, "legs 3"]:
    """Motor torques [N·m] at a sample with the weight shared evenly, straight up."""
    load = load_of(packed_load(robot, cycle.target(i), cycle.sensed(i)))
    down = cycle.stance[i][:, None]
    each = robot.total_mass * GRAVITY / down.sum()
    return foot_loads(load, down * np.array([0.0, 0.0, each]), 1.0)[0][0]


def free_torques(robot: Robot, cycle: DesiredCycle) -> Float[np.ndarray, "steps legs 3"]:
    """Motor torques [N·m] with unloaded feet: those of the legs in the air."""
    loads = [packed_load(robot, cycle.target(i), cycle.sensed(i)) for i in range(cycle.steps)]
    return np.array([load_of(load).free for load in loads])


def foot_loads(load, x: np.ndarray, height: float) -> tuple[np.ndarray, np.ndarray]:
    """Torques, forces, moments `(3, legs, 3)`, and the wrench missing `(6,)`, for foot loads.

    `x`: per leg the force [N] and, with six components, the moment over the height [N], on level ground.
    """
    forces = x[:, :3]
    moments = x[:, 3:] * height if x.shape[1] == 6 else np.zeros_like(forces)
    tau = load.free - np.einsum("lji,li->lj", load.push, forces) - np.einsum("lji,li->lj", load.turn, moments)
    given = np.concatenate([forces.sum(axis=0), (np.cross(load.arm, forces) + moments).sum(axis=0)])
    return np.stack([tau, forces, moments]), load.wrench - given
