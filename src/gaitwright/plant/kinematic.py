"""MotorCommand → Measured without mechanics: the robot is where its coordinator puts it (thesis 6.3).

So the thesis showed joint coordination before it had dynamics: the body takes the pose that is asked for, the
joints the angles, within their limits. Nothing weighs, slips, lags or falls; what this plant can show is
whether a motion fits together, not whether a robot could do it.
"""

from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np
from jaxtyping import Float

from gaitwright.errors import WrongUse
from gaitwright.ground.scene import Scene
from gaitwright.model.kinematics import angles, feet
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, quaternion_of, rotation_vector
from gaitwright.plant.instruments import specific_force
from gaitwright.plant.limits import check_force
from gaitwright.plant.start import start_of
from gaitwright.signals import Measured, MotorCommand, Posture

TOUCHING = 1e-4
"""A foot no farther over the ground than this share of the robot's height stands on it."""


@dataclass(frozen=True)
class Pose:
    """Where body and joints are."""

    position_w: Float[np.ndarray, "3"]
    rotation_wb: Float[np.ndarray, "3 3"]
    q: Float[np.ndarray, "legs 3"]


@dataclass
class KinematicPlant:
    """A robot in a scene that goes where `MotorCommand.posture` says; every `step` is one control period."""

    robot: Robot
    scene: Scene
    dt: float = 0.002
    """Control period [s]."""
    has_mechanics: ClassVar[bool] = False
    """Motors move nothing here: nobody can be lowered, and no motor be watched."""
    pose: Pose = field(init=False, repr=False)
    ground: Scene = field(init=False, repr=False)
    """The scene as it is now."""
    ticks: int = field(init=False, default=0)

    def __post_init__(self) -> None:
        self.reset(vary=False)

    def reset(self, seed: int = 0, vary: bool = True) -> Measured:
        """The robot on its feet at the scene's start, varied by `seed` where asked (`start_of`)."""
        start = start_of(self.robot, self.scene, seed, vary)
        self.ground = self.scene.at(0.0)
        self.pose, self.ticks = Pose(start.position_w, start.rotation_wb, start.q), 0
        self.velocity = np.zeros(3)
        return self.sense(self.pose)

    def step(self, command: MotorCommand) -> Measured:
        """One control period on: into the posture that goes with the command, or nowhere with motors off.

        Raises `WrongUse` for torques alone: there is nothing here that they could move.
        """
        before, asked = self.pose, command.posture
        self.ticks += 1
        self.ground = self.scene.at(self.ticks * self.dt)
        if asked is not None:
            self.pose = self.placed(asked)
        elif command.tau.any():
            raise WrongUse(
                "plant kinematic has no mechanics that torques could move; drivers kinematic and programmed "
                "say where the robot goes, other drivers need plant mujoco or armstrong"
            )
        return self.sense(before)

    def placed(self, asked: Posture) -> Pose:
        """The pose asked for: joints within their limits, the body set down on the feet that are to stand.

        Where another foot would then be in the ground, its leg is bent until it is upon it.
        """
        robot, R = self.robot, asked.rotation_wb
        q = np.clip(asked.q, robot.q_min, robot.q_max)
        hang = feet(robot, q) @ R.T
        gaps = self.gaps(asked.position_w + hang)
        drop = float(gaps[asked.stance].min()) if asked.stance.any() else 0.0
        at = asked.position_w - (0.0, 0.0, drop)
        feet_w = at + hang
        rise = -self.gaps(feet_w)
        if (rise > 0.0).any():
            feet_w[:, 2] += np.maximum(rise, 0.0)
            lifted = np.clip(angles(robot, (feet_w - at) @ R)[0], robot.q_min, robot.q_max)
            q = np.where(rise[:, None] > 0.0, lifted, q)
        return Pose(at, R.copy(), q)

    def gaps(self, feet_w: Float[np.ndarray, "legs 3"]) -> Float[np.ndarray, "legs"]:
        """How far the lowest point of each foot is over the ground below its centre [m]."""
        ground = np.asarray(self.ground.height(feet_w[:, 0], feet_w[:, 1]))
        return feet_w[:, 2] - self.robot.foot_radius - ground

    def push(self, force_w: tuple[float, float, float]) -> None:
        """Raises `WrongUse` where there is a force: nothing here has a mass."""
        check_force(force_w)
        if any(force_w):
            raise WrongUse("plant kinematic has no mechanics: a push moves nothing; plant mujoco has")

    def rearrange(self, scene: Scene) -> None:
        """Another arrangement of the world from now on; the robot stays as it is."""
        self.scene, self.ground = scene, scene.at(self.ticks * self.dt)

    def sense(self, before: Pose) -> Measured:
        """The state now; velocities are what has moved since `before`, one control period ago.

        The feet on the ground share the weight evenly, as if it were carried.
        """
        robot, pose, dt = self.robot, self.pose, self.dt
        R = pose.rotation_wb
        feet_w = pose.position_w + feet(robot, pose.q) @ R.T
        down = self.gaps(feet_w) <= TOUCHING * robot.height
        velocity, orientation = (pose.position_w - before.position_w) / dt, quaternion_of(R)
        felt = specific_force(orientation, velocity, self.velocity, dt)
        self.velocity = velocity
        return Measured(
            time=self.ticks * dt,
            position_w=pose.position_w.copy(),
            orientation_wb=orientation,
            velocity_w=velocity,
            angular_velocity_b=np.array(rotation_vector(before.rotation_wb.T @ R)) / dt,
            q=pose.q.copy(),
            qd=(pose.q - before.q) / dt,
            load=robot.total_mass * GRAVITY * down / max(int(down.sum()), 1),
            specific_force_b=felt,
        )
