"""Robot + Scene → MuJoCo model: the physics world, written from plain numbers.

The model is generated as MJCF text with every number in full, so that its mass matrix is the controllers'
own to rounding. `qpos[7:]`, `qvel[6:]` and `ctrl` reshape to `(legs, 3)`; `sensordata` holds the normal
force on each foot [N].
"""

from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import mujoco
import numpy as np

from gaitwright.ground.scene import Scene
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, quaternion_of
from gaitwright.plant.mujoco import terrain_geoms as ground
from gaitwright.plant.mujoco.mjcf import child

JOINTS = ("hip1", "hip2", "knee")
"""Joint names are `FL_hip1`, `FL_hip2`, `FL_knee`, and so on for every leg."""

TOUCH = 1.25
"""Radius of the touch sensor's zone over that of the foot [-]: contact points lie just inside."""

SHANK = 0.75
"""Radius of thigh and shank over that of the foot [-]."""


def build_world(robot: Robot, scene: Scene, timestep: float = 0.002) -> mujoco.MjModel:
    """The physics of a robot in a scene; `timestep` in seconds.

    Robots collide with the ground and the boxes, not with themselves. MuJoCo's reset upon a bad state is off:
    numbers that blow up stay visible. Raises `ValueError` where MuJoCo refuses the robot's numbers.
    """
    root = Element("mujoco", model=f"{robot.name} in {scene.name}")
    child(root, "compiler", angle="radian", autolimits="true")
    _add_options(root, timestep)
    world = child(root, "worldbody")
    ground.add(root, world, scene)
    _add_robot(root, world, robot, scene)
    model = mujoco.MjModel.from_xml_string(ElementTree.tostring(root, encoding="unicode"))
    ground.fill(model, scene)
    return model


def _add_options(root: Element, timestep: float) -> None:
    option = child(root, "option", timestep=timestep, gravity=[0, 0, -GRAVITY], integrator="implicitfast")
    option.attrib |= {"cone": "elliptic", "impratio": "10"}
    child(option, "flag", autoreset="disable")


def _add_robot(root: Element, world: Element, robot: Robot, scene: Scene) -> None:
    x, y, _ = scene.start
    base = child(world, "body", name="base", pos=[x, y, float(scene.height(x, y)) + robot.height])
    child(base, "freejoint", name="base")
    _add_inertia(base, robot.base_mass, robot.base_com, robot.base_inertia)
    solid = ground.collides(scene, with_robot=False)
    child(base, "geom", solid, name="trunk", type="box", pos=robot.trunk[0], size=robot.trunk[1])
    actuator, sensor = child(root, "actuator"), child(root, "sensor")
    for k, leg in enumerate(robot.legs):
        _add_leg(base, robot, k, solid)
        for joint, limit in zip(JOINTS, robot.tau_max[k], strict=True):
            name = f"{leg}_{joint}"
            child(actuator, "motor", name=name, joint=name, ctrlrange=[-limit, limit])
        child(sensor, "touch", name=f"{leg}_touch", site=f"{leg}_foot")


def _add_leg(base: Element, robot: Robot, k: int, solid: dict[str, str]) -> None:
    """Three links, or two where the first has no mass: then its hinge moves to the second link."""
    leg, offset = robot.legs[k], robot.offset[k]
    hip = {"pos": robot.hip[k], "quat": quaternion_of(robot.leg_frame[k])}
    if robot.mass[k, 0] > 0.0:
        link = child(base, "body", name=f"{leg}_hip", **hip)
        _add_link_inertia(link, robot, k, 0)
        _add_hinge(link, robot, k, 0)
        thigh = child(link, "body", name=f"{leg}_thigh", pos=offset[0])
    else:
        hip["pos"] = robot.hip[k] + robot.leg_frame[k] @ offset[0]
        thigh = child(base, "body", name=f"{leg}_thigh", **hip)
        _add_hinge(thigh, robot, k, 0, at=-offset[0])
    _add_link_inertia(thigh, robot, k, 1)
    _add_hinge(thigh, robot, k, 1)
    shank = child(thigh, "body", name=f"{leg}_shank", pos=offset[1])
    _add_link_inertia(shank, robot, k, 2)
    _add_hinge(shank, robot, k, 2)
    _add_shapes(thigh, shank, robot, k, solid)


def _add_hinge(body: Element, robot: Robot, k: int, i: int, at: np.ndarray | None = None) -> None:
    axis = ([1, 0, 0], [0, 1, 0], [0, robot.sign[k], 0])[i]
    child(
        body,
        "joint",
        name=f"{robot.legs[k]}_{JOINTS[i]}",
        axis=axis,
        pos=np.zeros(3) if at is None else at,
        range=[robot.q_min[k, i], robot.q_max[k, i]],
        armature=robot.armature[k, i],
        damping=robot.damping[k, i],
        frictionloss=robot.friction[k, i],
    )


def _add_link_inertia(body: Element, robot: Robot, k: int, i: int) -> None:
    _add_inertia(body, robot.mass[k, i], robot.com[k, i], robot.inertia[k, i])


def _add_inertia(body: Element, mass: float, com: np.ndarray, inertia: np.ndarray) -> None:
    six = inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    child(body, "inertial", mass=mass, pos=com, fullinertia=six)


def _add_shapes(thigh: Element, shank: Element, robot: Robot, k: int, solid: dict[str, str]) -> None:
    """A sphere for the foot, capsules for the rest; the shank's ends short of the foot."""
    leg, r = robot.legs[k], robot.foot_radius[k]
    knee, foot = robot.offset[k, 1], robot.offset[k, 2]
    child(thigh, "geom", solid, name=f"{leg}_thigh", type="capsule", fromto=[0, 0, 0, *knee], size=SHANK * r)
    length = np.linalg.norm(foot)
    end = foot * max(1.0 - 2.0 * r / length, 0.1)
    child(shank, "geom", solid, name=f"{leg}_shank", type="capsule", fromto=[0, 0, 0, *end], size=SHANK * r)
    child(shank, "geom", solid, name=f"{leg}_foot", type="sphere", pos=foot, size=r)
    child(shank, "site", name=f"{leg}_foot", type="sphere", pos=foot, size=TOUCH * r)
