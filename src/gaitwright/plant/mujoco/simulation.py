"""Torques → Sensed: the robot in MuJoCo, with contact and friction."""

from dataclasses import dataclass, field

import mujoco

from gaitwright.ground.scene import Scene
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import quaternion_of
from gaitwright.plant.limits import check_force, check_timestep
from gaitwright.plant.mujoco.world import build_world
from gaitwright.plant.start import start_of
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
        check_timestep(self.timestep, self.dt)
        self.model = build_world(self.robot, self.scene, self.timestep)
        self.data = mujoco.MjData(self.model)
        self.substeps = max(1, round(self.dt / self.timestep))

    def reset(self, seed: int = 0, vary: bool = True) -> Sensed:
        """The robot on its feet at the scene's start, varied by `seed` where asked (`start_of`)."""
        start = start_of(self.robot, self.scene, seed, vary)
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[:3] = start.position_w
        self.data.qpos[3:7] = quaternion_of(start.rotation_wb)
        self.data.qpos[7:] = start.q.ravel()
        self.data.qvel[:3] = start.velocity_w
        mujoco.mj_forward(self.model, self.data)
        return self.sense()

    def step(self, torques: Torques) -> Sensed:
        """One control period under constant torques [N·m]."""
        self.data.ctrl[:] = torques.tau.ravel()
        for _ in range(self.substeps):
            mujoco.mj_step(self.model, self.data)
        return self.sense()

    def push(self, force_w: tuple[float, float, float]) -> None:
        """A force [N] on the base's centre of mass from now on, world axes."""
        check_force(force_w)
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
