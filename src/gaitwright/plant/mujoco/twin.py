"""A second world like another one, as it is now: to see what would happen without letting it."""

import copy

import mujoco

from gaitwright.ground.scene import Scene
from gaitwright.model.robot import Robot
from gaitwright.plant.mujoco.simulation import MujocoPlant, Views
from gaitwright.signals import Measured


def twin_of(plant: MujocoPlant) -> MujocoPlant:
    """A plant whose every number is that of another; under equal commands both go the same way to the bit,
    and what one does the other does not feel.

    Half a millisecond: they share what MuJoCo compiled, but for the friction of feet, which goes with the
    ground below them.
    """
    old, world = plant.world, copy.copy(plant.world)
    world.model = copy.copy(old.model) if old.scene.patches else old.model
    world.data, world.mj_step = copy.copy(old.data), mujoco.mj_step
    world.views = tuple(Views.of(world.data, at) for at in world.addresses)
    for here, there in zip(old.views, world.views, strict=True):
        there.before[:] = here.before
    out = copy.copy(plant)
    out.world = world
    return out


def placed_as(robot: Robot, scene: Scene, measured: Measured, dt: float) -> MujocoPlant:
    """A plant in which a robot is as it was measured on another one; `dt`: control period [s]."""
    plant = MujocoPlant(robot, scene, dt, min(dt, MujocoPlant.timestep))
    (view,), data = plant.world.views, plant.data
    data.time = measured.time
    view.qpos[:3], view.qpos[3:7] = measured.position_w, measured.orientation_wb
    view.joints[:], view.rates[:] = measured.q, measured.qd
    view.velocity[:] = view.before[:] = measured.velocity_w
    view.qvel[3:6] = measured.angular_velocity_b
    plant.world.movers.follow(data)
    mujoco.mj_forward(plant.model, data)
    return plant
