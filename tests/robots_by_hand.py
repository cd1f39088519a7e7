"""Two small robots as plain numbers, for tests that need no catalogue."""

from dataclasses import replace

import numpy as np

from gaitwright.model.robot import Robot

SIDE = np.array([1.0, -1.0, 1.0, -1.0])
FORE = np.array([1.0, 1.0, -1.0, -1.0])


def dog() -> Robot:
    """A quadruped with numbers that no two links share."""
    ones = np.ones((4, 3))
    spread = 1.0 + 0.01 * np.arange(12).reshape(4, 3)
    tensor = np.diag([2e-3, 3e-3, 4e-3]) + 2e-4 * (1.0 - np.eye(3))
    return Robot(
        name="dog",
        legs=("FL", "FR", "RL", "RR"),
        base_mass=7.0,
        base_com=np.array([0.02, 0.01, -0.005]),
        base_inertia=np.diag([0.03, 0.10, 0.11]),
        hip=np.stack([0.19 * FORE, 0.05 * SIDE, np.zeros(4)], axis=1),
        leg_frame=np.tile(np.eye(3), (4, 1, 1)),
        offset=np.array([[[0, 0.09 * side, 0], [0, 0, -0.21], [0, 0, -0.22]] for side in SIDE]),
        sign=np.ones(4),
        mass=spread * [0.7, 1.1, 0.2],
        com=np.tile([[0.005, 0.002, 0.0], [-0.004, 0.02, -0.03], [0.006, 0.0, -0.12]], (4, 1, 1)),
        inertia=spread[..., None, None] * tensor,
        armature=0.01 * ones,
        damping=0.1 * ones,
        friction=0.2 * ones,
        q_min=ones * [-1.0, -1.5, -2.7],
        q_max=ones * [1.0, 3.5, -0.5],
        tau_max=ones * [23.7, 23.7, 45.4],
        foot_radius=np.full(4, 0.022),
        branch=-np.ones((4, 2), dtype=int),
        nominal_feet=np.stack([0.19 * FORE, 0.14 * SIDE, np.full(4, -0.268)], axis=1),
        trunk=np.array([[0.0, 0.0, 0.0], [0.19, 0.05, 0.06]]),
    )


def insect() -> Robot:
    """The same with yaw hips, mirrored knees, and first links without mass or length."""
    robot = dog()
    offset, mass, inertia = robot.offset.copy(), robot.mass.copy(), robot.inertia.copy()
    offset[:, 0], mass[:, 0], inertia[:, 0] = 0.0, 0.0, 0.0
    frame = np.stack([np.column_stack([[0, 0, 1.0], [-s, 0, 0], [0, -s, 0]]) for s in SIDE])
    return replace(robot, leg_frame=frame, offset=offset, mass=mass, inertia=inertia, sign=-np.ones(4))
