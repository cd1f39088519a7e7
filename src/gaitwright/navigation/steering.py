"""A person steers: which velocity is asked for now, and whether there is room for it (V6)."""

import math

from gaitwright.missions import Steering, Velocity
from gaitwright.model.stopping import stopping_time
from gaitwright.navigation.footprint import Footprint, drives, near
from gaitwright.navigation.known_field import is_within
from gaitwright.navigation.travel import Moment, Travel
from gaitwright.signals import Route

REACTS = 0.3
"""A command goes on for so long before the robot slows down [s]."""
SIDES = ("ahead", "to the left", "behind", "to the right")


def steered(steering: Steering, travel: Travel, now: Moment, body: Footprint) -> Route:
    """The route of a robot that goes as it is told, unless it comes too near to something, or leaves the
    field: then it stands, and where its commands were written beforehand, it goes no farther."""
    velocity = steering.at(now.time - travel.begun)
    refusal = refused(velocity, travel, now, body)
    attended = steering.ends is None
    if refusal is None:
        return Route((), 0.0, None, velocity=velocity, attended=attended)
    if attended:
        return Route((), 0.0, None, velocity=Velocity(0.0), pause=refusal, attended=True)
    return Route((), 0.0, None, halt=refusal)


def refused(velocity: Velocity, travel: Travel, now: Moment, body: Footprint) -> str | None:
    """Why there is no room for a velocity, as a sentence; `None`: there is."""
    speed = math.hypot(velocity.forward, velocity.left)
    if speed == 0.0 and velocity.turn == 0.0:
        return None
    seconds = REACTS + stopping_time(speed)
    pieces = near(travel.known.pieces, now.place, body.radius + speed * seconds)
    lasts = drives(pieces, (*now.place, now.yaw), velocity, seconds, body)
    towards = math.atan2(velocity.left, velocity.forward)
    where = SIDES[round(towards / (math.pi / 2.0)) % 4]
    if lasts < seconds and speed == 0.0:
        return f"there is no room to turn to the {'left' if velocity.turn > 0.0 else 'right'}"
    if lasts < seconds:
        return f"something stands {where}: there is room for {lasts * speed:.2f} m"
    x, y = now.place
    c, s = math.cos(now.yaw + towards), math.sin(now.yaw + towards)
    if not is_within(now.ground.bounds, (x + c * speed * seconds, y + s * speed * seconds)):
        return f"the scene ends {where}"
    return None
