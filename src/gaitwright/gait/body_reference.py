"""Where the body should be, how it should move and how it should lean, from a gait's own motion (row J5)."""

import math

from gaitwright.gait.command import sample
from gaitwright.gait.contact_plane import plane_height, plane_normal
from gaitwright.gait.regulation import height_over
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, scale
from gaitwright.numerics.matrices import write


@kernel
def base_reference(state, table, stand, position, yaw_d):
    """Position, velocity and acceleration of the base origin, and its pitch motion (θ, θ̇, θ̈)."""
    y, yd, ydd, z, zd, zdd, p, pd, pdd = sample(table, state.phase[0])
    c, s = math.cos(yaw_d), math.sin(yaw_d)
    vx = c * state.command[0] - s * (state.command[1] + yd)
    vy = s * state.command[0] + c * (state.command[1] + yd)
    climb = state.slope[0] * vx + state.slope[1] * vy
    at_x, at_y = state.reference_pose[0] - s * y, state.reference_pose[1] + c * y
    ground = plane_height(state.slope, position, position[0], position[1])
    height = height_over(ground, stand, plane_normal(state.slope)) + z
    return (at_x, at_y, height), (vx, vy, climb + zd), (-s * ydd, c * ydd, zdd), (p, pd, pdd)


@kernel
def write_body(target, position, velocity, acceleration, rotation_wb, omega, omega_rate):
    """Writes what the body should do into a target's fields."""
    write(target.position_w, 0, position)
    write(target.velocity_w, 0, velocity)
    write(target.acceleration_w, 0, acceleration)
    target.rotation_wb[:] = rotation_wb
    write(target.angular_velocity_w, 0, omega)
    write(target.angular_acceleration_w, 0, omega_rate)


@kernel
def pitching(level, pitch, turn):
    """Rotation, angular velocity and acceleration of a body that pitches (θ, θ̇, θ̈) and turns [rad/s]."""
    rotation_d = pitched(level, pitch[0])
    lateral = (rotation_d[0, 1], rotation_d[1, 1], rotation_d[2, 1])
    return rotation_d, add(scale(pitch[1], lateral), (0.0, 0.0, turn)), scale(pitch[2], lateral)


@kernel
def pitched(matrix, angle):
    """`matrix` turned about its own y axis by `angle` [rad]."""
    c, s = math.cos(angle), math.sin(angle)
    out = matrix.copy()
    for i in range(3):
        out[i, 0] = c * matrix[i, 0] - s * matrix[i, 2]
        out[i, 2] = s * matrix[i, 0] + c * matrix[i, 2]
    return out
