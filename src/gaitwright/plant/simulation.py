"""Torques → Sensed: the robot in MuJoCo, with contact and friction."""

from dataclasses import dataclass, field

import mujoco
import numpy as np

from gaitwright.geometry import GRAVITY, quaternion_of, upright_rotation
from gaitwright.model.kinematics import angles
from gaitwright.model.robot import Robot
from gaitwright.model.scene import Scene
from gaitwright.plant.world import build_world
from gaitwright.signals import Sensed, Torques


@dataclass
class MujocoPlant:
    """A robot standing in a scene; every `step` advances one control period."""

    robot: Robot
    scene: Scene
    dt: float = 0.002
    """Control period [s], an integer multiple of `timestep`."""
    timestep: float = 0.002
    """Step of the physics [s]."""
    model: mujoco.MjModel = field(init=False, repr=False)
    data: mujoco.MjData = field(init=False, repr=False)

    def __post_init__(self) -> None:
        self.model = build_world(self.robot, self.scene, self.timestep)
        self.data = mujoco.MjData(self.model)
        self.substeps = max(1, round(self.dt / self.timestep))

    def reset(self, seed: int = 0, vary: bool = True) -> Sensed:
        """The robot on its feet at the scene's start; `vary` draws the start's small differences from `seed`.

        Varied: joint angles by ±0.05 rad, velocity by ±5 % of √(g h), yaw by ±0.1 rad.
        """
        random = np.random.default_rng(seed)
        spread = (
            random.uniform(-1.0, 1.0, size=4 + 3 * self.robot.n) if vary else np.zeros(4 + 3 * self.robot.n)
        )
        mujoco.mj_resetData(self.model, self.data)
        x, y, yaw = self.scene.start
        ground = upright_rotation(tuple(np.asarray(self.scene.normal(x, y)).ravel()), yaw + 0.1 * spread[0])
        q, _ = angles(self.robot, self.robot.stance)
        self.data.qpos[3:7] = quaternion_of(ground)
        self.data.qpos[7:] = np.clip(
            q + 0.05 * spread[4:].reshape(-1, 3), self.robot.q_min, self.robot.q_max
        ).ravel()
        self.data.qpos[:3] = x, y, self._standing_height(x, y)
        self.data.qvel[:3] = 0.05 * np.sqrt(GRAVITY * self.robot.height) * spread[1:4] * (1.0, 1.0, 0.0)
        mujoco.mj_forward(self.model, self.data)
        return self.sense()

    def _standing_height(self, x: float, y: float) -> float:
        """Height of the base [m] at which the lowest foot just touches the ground below it."""
        self.data.qpos[:3] = x, y, 0.0
        mujoco.mj_kinematics(self.model, self.data)
        feet = self.data.site_xpos[: self.robot.n]
        ground = np.asarray(self.scene.height(feet[:, 0], feet[:, 1]))
        return float(np.max(ground + self.robot.foot_radius - feet[:, 2]))

    def step(self, torques: Torques) -> Sensed:
        """One control period under constant torques [N·m]."""
        self.data.ctrl[:] = torques.tau.ravel()
        for _ in range(self.substeps):
            mujoco.mj_step(self.model, self.data)
        return self.sense()

    def push(self, force_w: tuple[float, float, float]) -> None:
        """A force [N] on the base's centre of mass from now on, world axes."""
        self.data.xfrc_applied[1, :3] = force_w

    def sense(self) -> Sensed:
        """The true state, copied."""
        d, n = self.data, self.robot.n
        qpos, qvel = d.qpos.copy(), d.qvel.copy()
        return Sensed(
            time=d.time,
            position_w=qpos[:3],
            orientation_wb=qpos[3:7],
            velocity_w=qvel[:3],
            angular_velocity_b=qvel[3:6],
            q=qpos[7:].reshape(n, 3),
            qd=qvel[6:].reshape(n, 3),
            load=d.sensordata[:n].copy(),
        )
