"""Robots + Scene → MuJoCo model: the physics world, written from plain numbers.

The model is generated as MJCF text with every number in full, so that its mass matrix is the controllers'
own to rounding. A robot's hinges, motors and touch sensors stand together, leg by leg; `simulation.Address`
says where.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import mujoco
import numpy as np

from gaitwright.errors import BadFile, WrongUse
from gaitwright.ground.scene import Scene
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, quaternion_of
from gaitwright.plant.mujoco import terrain_geoms as ground
from gaitwright.plant.mujoco.mjcf import child
from gaitwright.plant.mujoco.movers import add_movers

JOINTS = ("hip1", "hip2", "knee")
"""Joint names are `FL_hip1`, `FL_hip2`, `FL_knee`, and so on for every leg."""

TOUCH = 1.25
"""Radius of the touch sensor's zone over that of the foot [-]: contact points lie just inside."""

SHANK = 0.75
"""Radius of thigh and shank over that of the foot [-]."""


@dataclass(frozen=True)
class Placed:
    """A robot in a world."""

    robot: Robot
    prefix: str = ""
    """What the names of its bodies, joints, motors and sensors begin with: one for each robot of several."""
    start: tuple[float, float, float] | None = None
    """x, y [m], yaw [rad]; `None`: the scene's."""


def build_world(robots: Sequence[Placed], scene: Scene, timestep: float = 0.002) -> mujoco.MjModel:
    """The physics of robots in a scene; `timestep` in seconds.

    Robots collide with the ground, what stands and moves on it and each other, not with themselves. MuJoCo's
    reset upon a bad state is off: numbers that blow up stay visible. Raises `BadFile` if MuJoCo refuses it.
    """
    if len(robots) > MOST_ROBOTS:
        raise WrongUse(f"{len(robots)} robots in one world; there can be {MOST_ROBOTS}")
    root = Element("mujoco", model=" and ".join(placed.robot.name for placed in robots) + f" in {scene.name}")
    child(root, "compiler", angle="radian", autolimits="true")
    _add_options(root, timestep)
    world, actuator, sensor = child(root, "worldbody"), child(root, "actuator"), child(root, "sensor")
    ground.add(root, world, scene)
    for number, placed in enumerate(robots):
        _add_robot(Into(world, actuator, sensor), placed, scene, number, len(robots))
    add_movers(root, world, scene, sum(placed.robot.total_mass for placed in robots))
    try:
        model = mujoco.MjModel.from_xml_string(ElementTree.tostring(root, encoding="unicode"))
    except ValueError as error:
        reason = " ".join(str(error).split())
        raise BadFile(f"MuJoCo makes no world of {root.get('model')}: {reason}") from None
    ground.fill(model, scene)
    return model


def _add_options(root: Element, timestep: float) -> None:
    option = child(root, "option", timestep=timestep, gravity=[0, 0, -GRAVITY], integrator="implicitfast")
    option.attrib |= {"cone": "elliptic", "impratio": "10"}
    child(option, "flag", autoreset="disable")


class Into(NamedTuple):
    """The parts of a model that a robot is added to."""

    world: Element
    actuator: Element
    sensor: Element


MOST_ROBOTS = 30
"""MuJoCo has a bit for each to tell it from the others."""


def _add_robot(into: Into, placed: Placed, scene: Scene, number: int, of: int) -> None:
    robot, prefix = placed.robot, placed.prefix
    x, y, _ = placed.start or scene.start
    base = child(
        into.world, "body", name=f"{prefix}base", pos=[x, y, float(scene.height(x, y)) + robot.height]
    )
    child(base, "freejoint", name=f"{prefix}base")
    _add_inertia(base, robot.base_mass, robot.base_com, robot.base_inertia)
    solid = ground.robot_touches(scene, number, of)
    child(base, "geom", solid, name=f"{prefix}trunk", type="box", pos=robot.trunk[0], size=robot.trunk[1])
    for k, leg in enumerate(robot.legs):
        _add_leg(base, placed, k, solid)
        for joint, limit in zip(JOINTS, robot.tau_max[k], strict=True):
            name = f"{prefix}{leg}_{joint}"
            child(into.actuator, "motor", name=name, joint=name, ctrlrange=[-limit, limit])
        child(into.sensor, "touch", name=f"{prefix}{leg}_touch", site=f"{prefix}{leg}_foot")


def _add_leg(base: Element, placed: Placed, k: int, solid: dict[str, str]) -> None:
    """Three links, or two where the first has no mass: then its hinge moves to the second link."""
    robot = placed.robot
    name, offset = placed.prefix + robot.legs[k], robot.offset[k]
    hip = {"pos": robot.hip[k], "quat": quaternion_of(robot.leg_frame[k])}
    if robot.mass[k, 0] > 0.0:
        link = child(base, "body", name=f"{name}_hip", **hip)
        _add_link_inertia(link, robot, k, 0)
        _add_hinge(link, placed, k, 0)
        thigh = child(link, "body", name=f"{name}_thigh", pos=offset[0])
    else:
        hip["pos"] = robot.hip[k] + robot.leg_frame[k] @ offset[0]
        thigh = child(base, "body", name=f"{name}_thigh", **hip)
        _add_hinge(thigh, placed, k, 0, at=-offset[0])
    _add_link_inertia(thigh, robot, k, 1)
    _add_hinge(thigh, placed, k, 1)
    shank = child(thigh, "body", name=f"{name}_shank", pos=offset[1])
    _add_link_inertia(shank, robot, k, 2)
    _add_hinge(shank, placed, k, 2)
    _add_shapes(thigh, shank, placed, k, solid)


def _add_hinge(body: Element, placed: Placed, k: int, i: int, at: np.ndarray | None = None) -> None:
    robot = placed.robot
    axis = ([1, 0, 0], [0, 1, 0], [0, robot.sign[k], 0])[i]
    child(
        body,
        "joint",
        name=f"{placed.prefix}{robot.legs[k]}_{JOINTS[i]}",
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


def _add_shapes(thigh: Element, shank: Element, placed: Placed, k: int, solid: dict[str, str]) -> None:
    """A sphere for the foot, capsules for the rest; the shank's ends short of the foot."""
    robot = placed.robot
    leg, r = placed.prefix + robot.legs[k], robot.foot_radius[k]
    knee, foot = robot.offset[k, 1], robot.offset[k, 2]
    child(thigh, "geom", solid, name=f"{leg}_thigh", type="capsule", fromto=[0, 0, 0, *knee], size=SHANK * r)
    length = np.linalg.norm(foot)
    end = foot * max(1.0 - 2.0 * r / length, 0.1)
    child(shank, "geom", solid, name=f"{leg}_shank", type="capsule", fromto=[0, 0, 0, *end], size=SHANK * r)
    feels = solid | {"priority": "1"}  # where the ground's friction differs, a foot has that of its place
    child(shank, "geom", feels, name=f"{leg}_foot", type="sphere", pos=foot, size=r)
    child(shank, "site", name=f"{leg}_foot", type="sphere", pos=foot, size=TOUCH * r)
