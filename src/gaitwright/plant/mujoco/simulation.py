"""MotorCommand → Measured: one robot, or several, in MuJoCo, with contact and friction."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import mujoco
import numpy as np

from gaitwright.ground.scene import Scene
from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import quaternion_of
from gaitwright.plant.instruments import specific_force
from gaitwright.plant.limits import check_force, check_timestep
from gaitwright.plant.mujoco.movers import Movers
from gaitwright.plant.mujoco.world import Placed, build_world
from gaitwright.plant.start import start_of
from gaitwright.signals import Measured, MotorCommand, Sensed


@dataclass(frozen=True)
class Address:
    """Where a robot's numbers stand in a world of several; found by its names."""

    base: int
    """Its body."""
    qpos: slice
    qvel: slice
    joints: slice
    rates: slice
    """Its hinges in `qpos` and `qvel`."""
    ctrl: slice
    touch: slice

    @classmethod
    def of(cls, model: mujoco.MjModel, placed: Placed) -> "Address":
        """The address of a robot in a world that `build_world` made."""
        prefix, robot = placed.prefix, placed.robot
        joint = model.joint(f"{prefix}base")
        q, v, hinges = int(joint.qposadr[0]), int(joint.dofadr[0]), 3 * robot.n
        motor = model.actuator(f"{prefix}{robot.legs[0]}_hip1").id
        touch = int(model.sensor(f"{prefix}{robot.legs[0]}_touch").adr[0])
        return cls(
            model.body(f"{prefix}base").id,
            slice(q, q + 7 + hinges),
            slice(v, v + 6 + hinges),
            slice(q + 7, q + 7 + hinges),
            slice(v + 6, v + 6 + hinges),
            slice(motor, motor + hinges),
            slice(touch, touch + robot.n),
        )


@dataclass(frozen=True)
class Views:
    """A robot's numbers in MuJoCo's own arrays, which stay where they are: taken once, read at every step."""

    qpos: np.ndarray
    qvel: np.ndarray
    velocity: np.ndarray
    """Of the base, the first three of `qvel`."""
    before: np.ndarray
    """The same when the last control period began; this one is ours."""
    joints: np.ndarray
    rates: np.ndarray
    """`(legs, 3)` of its hinges."""
    motors: np.ndarray
    """As the torques stand in a command's row."""
    touch: np.ndarray
    size: int
    """Numbers in the row of a `Sensed`."""

    @classmethod
    def of(cls, data: mujoco.MjData, at: Address) -> "Views":
        """The numbers at an address."""
        qvel = data.qvel[at.qvel]
        joints, rates = data.qpos[at.joints].reshape(-1, 3), data.qvel[at.rates].reshape(-1, 3)
        motors, touch = data.ctrl[at.ctrl], data.sensordata[at.touch]
        size = Sensed.layout.size(touch.size)
        return cls(data.qpos[at.qpos], qvel, qvel[:3], np.zeros(3), joints, rates, motors, touch, size)


class MujocoWorld:
    """Robots in a scene, each an obstacle to the others."""

    def __init__(self, robots: Sequence[Placed], scene: Scene, timestep: float) -> None:
        self.robots, self.scene, self.timestep = tuple(robots), scene, timestep
        self.model = build_world(robots, scene, timestep)
        self.data = mujoco.MjData(self.model)
        self.mj_step = mujoco.mj_step
        """The physics; a stopwatch may stand before it."""
        self.addresses = tuple(Address.of(self.model, placed) for placed in robots)
        self.views = tuple(Views.of(self.data, at) for at in self.addresses)
        self.movers = Movers(self.model, scene)
        self.feet = [self.model.geom(f"{p.prefix}{leg}_foot").id for p in self.robots for leg in p.robot.legs]

    def place(self, i: int, seed: int, vary: bool) -> None:
        """Puts robot `i` on its feet at its start, varied by `seed` where asked (`start_of`)."""
        at, placed = self.addresses[i], self.robots[i]
        start = start_of(placed.robot, self.scene, seed, vary, placed.start)
        quaternion = quaternion_of(start.rotation_wb)
        self.data.qpos[at.qpos] = np.concatenate([start.position_w, quaternion, start.q.ravel()])
        self.data.qvel[at.qvel] = 0.0
        self.views[i].velocity[:] = self.views[i].before[:] = start.velocity_w

    def tell(self, i: int, command: MotorCommand) -> None:
        """Sets the motors of robot `i`, as its joints are now."""
        view = self.views[i]
        if command.kp is None and command.kd is None:
            view.motors[:] = command.row[: view.motors.size]
        else:
            view.motors[:] = command.torques(view.joints, view.rates).ravel()

    def advance(self, commands: Sequence[MotorCommand], steps: int) -> None:
        """So many steps of the physics under a command for each robot."""
        for view in self.views:
            view.before[:] = view.velocity
        if self.scene.patches:
            self.grip()
        for _ in range(steps):
            if self.scene.movers:
                self.movers.follow(self.data)
            for i, command in enumerate(commands):
                self.tell(i, command)
            self.mj_step(self.model, self.data)

    def grip(self) -> None:
        """Gives the feet the friction of the ground below them; a foot's counts in its contacts with it."""
        centre, radius = self.data.geom_xpos[self.feet], self.model.geom_size[self.feet, :1]
        touched = centre - radius * self.scene.normal(centre[:, 0], centre[:, 1])
        self.model.geom_friction[self.feet, 0] = self.scene.friction_at(touched[:, 0], touched[:, 1])

    def sense(self, i: int, dt: float) -> Measured:
        """The true state of robot `i`, copied."""
        view, time = self.views[i], self.data.time
        row = np.empty(view.size)
        felt = write_state(row, time, view.qpos, view.qvel, view.touch, view.before, dt)
        return Measured.of_row(row, time=time, specific_force_b=felt)

    def push(self, i: int, force_w: tuple[float, float, float]) -> None:
        """A force [N] on the centre of mass of robot `i`'s base from now on, world axes."""
        check_force(force_w)
        self.data.xfrc_applied[self.addresses[i].base, :3] = force_w

    def rearranged(self, scene: Scene) -> "MujocoWorld":
        """The same robots as they are now in another scene."""
        new, old = MujocoWorld(self.robots, scene, self.timestep), self.data
        new.data.time, new.data.ctrl[:] = old.time, old.ctrl
        for at in self.addresses:  # robots come first in every world
            new.data.qpos[at.qpos], new.data.qvel[at.qvel] = old.qpos[at.qpos], old.qvel[at.qvel]
            new.data.qacc_warmstart[at.qvel] = old.qacc_warmstart[at.qvel]
            new.data.xfrc_applied[at.base] = old.xfrc_applied[at.base]
        for here, there in zip(self.views, new.views, strict=True):
            there.before[:] = here.before
        return new


@dataclass
class MujocoPlant:
    """A robot standing in a scene; every `step` advances one control period."""

    robot: Robot
    scene: Scene
    dt: float = 0.002
    """Control period [s], an integer multiple of `timestep`."""
    timestep: float = 0.002
    """Step of the physics [s]."""
    world: MujocoWorld = field(init=False, repr=False)

    def __post_init__(self) -> None:
        check_timestep(self.timestep, self.dt)
        self.world = MujocoWorld([Placed(self.robot)], self.scene, self.timestep)
        self.substeps = max(1, round(self.dt / self.timestep))

    @property
    def model(self) -> mujoco.MjModel:
        """MuJoCo's model of the world."""
        return self.world.model

    @property
    def data(self) -> mujoco.MjData:
        """MuJoCo's state of the world."""
        return self.world.data

    def reset(self, seed: int = 0, vary: bool = True) -> Measured:
        """The robot on its feet at the scene's start, varied by `seed` where asked (`start_of`)."""
        mujoco.mj_resetData(self.model, self.data)
        self.world.place(0, seed, vary)
        self.world.movers.follow(self.data)
        mujoco.mj_forward(self.model, self.data)
        return self.sense()

    def step(self, command: MotorCommand) -> Measured:
        """One control period under a command; torques [N·m] stay within the robot's limits."""
        self.world.advance((command,), self.substeps)
        return self.sense()

    def push(self, force_w: tuple[float, float, float]) -> None:
        """A force [N] on the base's centre of mass from now on, world axes."""
        self.world.push(0, force_w)

    def rearrange(self, scene: Scene) -> None:
        """Another arrangement of the world from now on; the robot stays as it is."""
        self.scene, self.world = scene, self.world.rearranged(scene)

    def sense(self) -> Measured:
        """The true state, copied."""
        return self.world.sense(0, self.dt)


state_fields = Sensed.layout.views(raw=True)


@kernel
def write_state(row, time, qpos, qvel, touch, before, dt):
    """Writes the row of a `Sensed`; the specific force. `before`: velocity one control period ago."""
    state = state_fields(row)
    state.time[0], state.load[:] = time, touch
    state.position_w[:], state.orientation_wb[:] = qpos[:3], qpos[3:7]
    state.velocity_w[:], state.angular_velocity_b[:] = qvel[:3], qvel[3:6]
    state.q[:], state.qd[:] = qpos[7:].reshape(state.q.shape), qvel[6:].reshape(state.qd.shape)
    return specific_force(qpos[3:7], qvel, before, dt)
