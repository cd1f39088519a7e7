"""Our robots and trees as Pinocchio models: what the bench and the tests compare our mechanics with."""

from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np

from gaitwright.dynamics.tree import Tree, about_point
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY


def pinocchio() -> Any:
    """The module, of use to tests and benches only, and without types; `None` where it is not installed."""
    return import_module("pinocchio") if find_spec("pinocchio") else None


def hinge_model(robot: Robot) -> Any:
    """A robot joint by joint: a free flyer, then leg after leg its three hinges."""
    pin = pinocchio()
    model = pin.Model()
    model.gravity.linear = np.array([0.0, 0.0, -GRAVITY])
    base = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "base")
    trunk = pin.Inertia(robot.base_mass, robot.base_com, robot.base_inertia)
    model.appendBodyToJoint(base, trunk, pin.SE3.Identity())
    for k, leg in enumerate(robot.legs):
        parent, place = base, pin.SE3(robot.leg_frame[k], robot.hip[k])
        for i, axis in enumerate(([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, robot.sign[k], 0.0])):
            hinge = pin.JointModelRevoluteUnaligned(np.array(axis))
            parent = model.addJoint(parent, hinge, place, f"{leg}_{i}")
            link = pin.Inertia(robot.mass[k, i], robot.com[k, i], robot.inertia[k, i])
            model.appendBodyToJoint(parent, link, pin.SE3.Identity())
            place = pin.SE3(np.eye(3), robot.offset[k, i])
    model.armature[6:] = robot.armature.ravel()
    return model


def ball_model(tree: Tree, gravity: np.ndarray) -> Any:
    """A tree with a free flyer and spherical joints, in the tree's order."""
    pin = pinocchio()
    model = pin.Model()
    model.gravity.linear = gravity
    for k, p in enumerate(tree.parent):
        joint = pin.JointModelSpherical() if k else pin.JointModelFreeFlyer()
        model.addJoint(int(p) + 1, joint, pin.SE3(np.eye(3), tree.hinge[k]), f"link{k}")
        about_centre = tree.inertia[k] - about_point(tree.mass[k], tree.com[k])
        body = pin.Inertia(tree.mass[k], tree.com[k], about_centre)
        model.appendBodyToJoint(k + 1, body, pin.SE3.Identity())
    return model
