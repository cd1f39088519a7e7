"""Produced motion against desired motion, while it runs (row N8): for any plant, and a real robot too."""

import numpy as np
from jaxtyping import Float

from gaitwright.dynamics.tree import ball_rotations, ball_tree
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, rotation
from gaitwright.signals import MotorCommand, Sensed


class Closure:
    """Compares how the centre of mass accelerates with how the controller's foot forces should move it.

    Desired is what the intended forces and the weight give; what differs is what the controller cannot
    know: contact, friction, limits of torque. Produced is the second difference of places, `dt` [s]
    apart, so it is the mean over two control periods, and so is what is desired.
    """

    def __init__(self, robot: Robot, dt: float) -> None:
        self.robot, self.dt = robot, dt
        self.tree, _ = ball_tree(robot)
        self.places: list[np.ndarray] = []
        self.wanted: list[np.ndarray] = []

    def add(self, sensed: Sensed, command: MotorCommand) -> None:
        """Takes a sensed state and the command that was then given."""
        self.places.append(self.centre_of_mass(sensed))
        weight = np.array([0.0, 0.0, -GRAVITY])
        self.wanted.append(command.forces_w.sum(axis=0) / self.robot.total_mass + weight)

    def centre_of_mass(self, sensed: Sensed) -> Float[np.ndarray, "3"]:
        """Of the whole robot, world [m]."""
        tree = self.tree
        R = ball_rotations(self.robot, rotation(sensed.orientation_wb), sensed.q)
        hinge = [sensed.position_w]
        for k in range(1, len(tree.mass)):
            hinge.append(hinge[tree.parent[k]] + R[tree.parent[k]] @ tree.hinge[k])
        centres = np.array(hinge) + np.einsum("kij,kj->ki", R, tree.com)
        return tree.mass @ centres / tree.mass.sum()

    def differences(self) -> Float[np.ndarray, "periods"]:
        """Size of produced less desired acceleration, period by period [m/s²]."""
        if len(self.places) < 3:
            return np.zeros(0)
        produced = np.diff(np.array(self.places), 2, axis=0) / self.dt**2
        wanted = np.array(self.wanted)
        return np.linalg.norm(produced - 0.5 * (wanted[:-2] + wanted[1:-1]), axis=1)

    def sentence(self) -> str:
        """Median and worst of the differences."""
        off = self.differences()
        if not len(off):
            return "too short to compare"
        return f"centre of mass off by {np.median(off):.2g} m/s² (median), {off.max():.2g} m/s² (worst)"
