"""A tick of a recording → the values on the arrows that it was made of."""

import math
from dataclasses import fields
from typing import Any

import numpy as np

from gaitwright.record.channels import MEMORY, SCAN
from gaitwright.record.recording import Recording
from gaitwright.signals import GRIP, Gait, Route, Scan, Sensed, SkillCall


def sensed_at(r: Recording, tick: int) -> Sensed:
    """What was sensed."""
    legs = r.robot.n
    return Sensed(
        number(r, "time", tick),
        r.at("position_w", tick),
        r.at("orientation_wb", tick),
        r.at("velocity_w", tick),
        r.at("angular_velocity_b", tick),
        r.at("q", tick).reshape(legs, 3),
        r.at("qd", tick).reshape(legs, 3),
        r.at("load", tick),
    )


def scan_at(r: Recording, tick: int) -> Scan | None:
    """The ground ahead; `None` where nobody looked, or where an older recording does not tell."""
    values: dict[str, Any] = {
        field.name: number(r, name, tick) for field, name in zip(fields(Scan), SCAN, strict=True)
    }
    if math.isnan(values["friction"]):  # older recordings do not tell it
        values["friction"] = GRIP
    if np.isnan(list(values.values())).any():
        return None
    return Scan(**values | {"familiar": bool(values["familiar"])})


def route_at(r: Recording, tick: int) -> Route | None:
    """What was left of the way, with as many points as there were, of which the next is known; `None` where
    an older recording does not tell."""
    points, speed = number(r, "route_points", tick), number(r, "route_speed", tick)
    if np.isnan(points):
        return None
    x, y = r.at("route_next", tick).tolist()
    begins, ends = (None if math.isnan(way) else way for way in r.at("route_directions", tick).tolist())
    return Route(
        path=((x, y),) * int(points),
        remaining=number(r, "route_remaining", tick),
        speed=None if np.isnan(speed) else speed,
        arrived=bool(number(r, "route_arrived", tick)),
        ahead=scan_at(r, tick),
        begins=begins,
        ends=ends,
    )


def call_at(r: Recording, tick: int) -> SkillCall:
    """The skill and its velocity; of the gait only the period was recorded, and why it was chosen was not."""
    skill, driver = r.skills[int(number(r, "skill", tick))], r.drivers[int(number(r, "driver", tick))]
    forward, left, turn = r.at("command", tick).tolist()
    gait = Gait(skill, number(r, "period", tick), float("nan"), ())
    held = number(r, MEMORY, tick)
    memory = {} if math.isnan(held) else dict(r.memories[int(held)])
    return SkillCall(skill, gait, (forward, left), turn, driver, "", memory=memory)


def number(r: Recording, channel: str, tick: int) -> float:
    """What a channel of one number was."""
    return float(r.at(channel, tick))
