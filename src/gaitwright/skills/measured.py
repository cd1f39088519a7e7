"""Route + Sensed → plain numbers that rules and teachers go by.

Their units suit any robot: lengths of road in body heights, ways in body lengths, speeds as of a robot 0.29 m
tall, angles in degrees.
"""

import math

import numpy as np

from gaitwright.model.leg_motion import columns_of
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, dot, heading, roll_pitch_yaw, rotation, times_t, vec, wrap
from gaitwright.numerics.matrices import rows
from gaitwright.signals import Route, Scan, Sensed, SkillCall
from gaitwright.skills.library import speed_scale
from gaitwright.skills.path_following import approach_speed, bearing, heading_error, wished_speed
from gaitwright.skills.situation import doing_of

LOADED = 0.02
"""A foot that carries this share of the weight is down."""
OUT_OF_SIGHT = 20.0
"""Obstacles farther than this count as being this far [body lengths]."""


def measured(robot: Robot, route: Route, sensed: Sensed, call: SkillCall | None = None) -> dict[str, float]:
    """What rules and teachers go by, as plain numbers (see the module for their units).

    With no scan the road is what the body's lean says. `possible` is the wished speed as far as it leaves
    time to stop; `arrived` is −1 where there is nowhere to go.
    """
    scan = route.ahead or felt(sensed)
    h, unit, scale = robot.height, robot.body_length, speed_scale(robot)
    down = sensed.load > LOADED * robot.total_mass * GRAVITY
    going = bool(route.path) and not route.arrived
    off, way = (heading_error(route, sensed), bearing(route, sensed)) if going else (0.0, scan.course)
    numbers = {
        "feet down": float(np.mean(down)),
        **{name: float(np.mean(down[where])) for name, where in sides(robot).items()},
        "slope": math.degrees(scan.slope),
        "roughness": scan.roughness / h,
        "step up": scan.step_up / h,
        "step down": scan.step_down / h,
        "gap": scan.gap / h,
        "remaining": route.remaining / unit,
        "points left": float(len(route.path)),
        "arrived": 1.0 if route.arrived else 0.0 if route.path else -1.0,
        "off the path": math.degrees(off),
        "wished": wished_speed(robot, route) / scale,
        "possible": approach_speed(robot, route) / scale,
        "sway": sway(robot, sensed, scan),
        "obstacle": min(OUT_OF_SIGHT, scan.obstacle / unit),
        "effort": torque_utilisation(robot, sensed),
        "direction": math.degrees(float(wrap(way))),
        "direction at the start": math.degrees(float(wrap(way if route.begins is None else route.begins))),
        "direction at the end": math.degrees(float(wrap(way if route.ends is None else route.ends))),
        "familiar": float(scan.familiar),
        "turning": float(doing_of(call) == "turning"),
        "grip": scan.friction,
        "speed": math.hypot(float(sensed.velocity_w[0]), float(sensed.velocity_w[1])) / scale,
    }
    return numbers


def sides(robot: Robot) -> dict[str, np.ndarray]:
    """Which legs are in front, behind, on the left and on the right."""
    x, y = robot.hip[:, 0], robot.hip[:, 1]
    return {"front feet": x > 0.0, "hind feet": x < 0.0, "left feet": y > 0.0, "right feet": y < 0.0}


def felt(sensed: Sensed) -> Scan:
    """The ground as the body's lean tells it, where nobody looked ahead."""
    roll, pitch, yaw = roll_pitch_yaw(rotation(sensed.orientation_wb))
    return Scan(slope=-float(pitch), cross=float(roll), course=float(yaw))


def sway(robot: Robot, sensed: Sensed, scan: Scan) -> float:
    """How far the body is from steady: roll off the ground [rad], roll rate and sideways speed.

    Rates are taken over √(h/g) and speeds as shares of √(g h), so that one scale fits all robots.
    """
    pose = rotation(sensed.orientation_wb)
    roll = float(roll_pitch_yaw(pose)[0]) - scan.cross
    yaw = heading(pose)
    sideways = float(math.cos(yaw) * sensed.velocity_w[1] - math.sin(yaw) * sensed.velocity_w[0])
    rate = float(sensed.angular_velocity_b[0])
    w = robot.natural_frequency
    return math.hypot(roll, rate / w, sideways / (w * robot.height))


def torque_utilisation(robot: Robot, sensed: Sensed) -> float:
    """Largest share of a motor's torque that the loads on the feet ask for by themselves: |Jᵀ f| / τ_max."""
    up_b = times_t(rotation(sensed.orientation_wb), (0.0, 0.0, 1.0))
    most = 0.0
    for i in range(robot.n):
        up = times_t(robot.leg_frame[i], up_b)
        columns = columns_of(vec(sensed.q[i]), rows(robot.offset[i]), robot.sign[i])
        load = float(sensed.load[i])
        for column, limit in zip(columns, vec(robot.tau_max[i]), strict=True):
            most = max(most, abs(dot(column, up)) * load / limit)
    return most
