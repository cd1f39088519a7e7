"""MotorCommand → Measured: the robot in MuJoCo, with contact and friction."""

from dataclasses import dataclass, field

import mujoco
import numpy as np

from gaitwright.ground.scene import Scene
from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import quaternion_of
from gaitwright.plant.instruments import specific_force
from gaitwright.plant.limits import check_force, check_timestep
from gaitwright.plant.mujoco.world import build_world
from gaitwright.plant.start import start_of
from gaitwright.signals import Measured, MotorCommand


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

    def reset(self, seed: int = 0, vary: bool = True) -> Measured:
        """The robot on its feet at the scene's start, varied by `seed` where asked (`start_of`)."""
        start = start_of(self.robot, self.scene, seed, vary)
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[:3] = start.position_w
        self.data.qpos[3:7] = quaternion_of(start.rotation_wb)
        self.data.qpos[7:] = start.q.ravel()
        self.data.qvel[:3] = self.velocity = start.velocity_w
        mujoco.mj_forward(self.model, self.data)
        return self.sense()

    def step(self, command: MotorCommand) -> Measured:
        """One control period under a command; torques [N·m] stay within the robot's limits."""
        data, n = self.data, self.robot.n
        self.velocity = data.qvel[:3].copy()
        data.ctrl[:] = command.tau.ravel()
        for _ in range(self.substeps):
            if command.kp is not None or command.kd is not None:
                data.ctrl[:] = command.torques(
                    data.qpos[7:].reshape(n, 3), data.qvel[6:].reshape(n, 3)
                ).ravel()
            mujoco.mj_step(self.model, data)
        return self.sense()

    def push(self, force_w: tuple[float, float, float]) -> None:
        """A force [N] on the base's centre of mass from now on, world axes."""
        check_force(force_w)
        self.data.xfrc_applied[1, :3] = force_w

    def rearrange(self, scene: Scene) -> None:
        """Another arrangement of the world from now on; the robot stays as it is."""
        model, old = build_world(self.robot, scene, self.timestep), self.data
        data = mujoco.MjData(model)
        data.time, data.qpos[:], data.qvel[:] = old.time, old.qpos, old.qvel
        data.ctrl[:], data.xfrc_applied[1], data.qacc_warmstart[:] = (
            old.ctrl,
            old.xfrc_applied[1],
            old.qacc_warmstart,
        )
        self.scene, self.model, self.data = scene, model, data

    def sense(self) -> Measured:
        """The true state, copied."""
        data = self.data
        row, felt = state_row(data.time, data.qpos, data.qvel, data.sensordata, self.velocity, self.dt)
        return Measured.of_row(row, specific_force_b=felt)


@kernel
def state_row(time, qpos, qvel, touch, before, dt):
    """The row of a `Sensed`, and the specific force; `before`: velocity one control period ago."""
    joints = qpos.size - 7
    legs = joints // 3
    row = np.empty(14 + 7 * legs)
    row[0] = time
    row[1:8] = qpos[:7]
    row[8:14] = qvel[:6]
    row[14 : 14 + joints] = qpos[7:]
    row[14 + joints : 14 + 2 * joints] = qvel[6:]
    row[14 + 2 * joints :] = touch[:legs]
    return row, specific_force(qpos[3:7], qvel, before, dt)
