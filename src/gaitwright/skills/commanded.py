"""What a route asks for itself: to stand, to go as a person steers, or to go on without turning (V6)."""

import math
from dataclasses import dataclass

from gaitwright.errors import WrongUse
from gaitwright.missions import Velocity
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import heading, rotation, wrap
from gaitwright.signals import Route, Sensed, SkillCall
from gaitwright.skills.chooser import DefaultChooser
from gaitwright.skills.foothold_guard import FootholdGuard
from gaitwright.skills.library import Skill, check_speed, check_turn, find_skill, gait_of, meant
from gaitwright.skills.path_following import approach_speed, heading_error, turn_rate
from gaitwright.stages import Chooser, Map, Now

SLOWER = 0.6
"""A robot that has little room and turns as fast as it can goes slower by this share."""
BESIDE, BEHIND = math.radians(60), math.radians(120)
"""A direction that is farther from straight ahead is gone sideways, and backwards."""


def guarded(chooser: Chooser, robot: Robot, sees: bool = True) -> Chooser:
    """A chooser that does what a route asks for, and stops where no foot can stand, if its feet see."""
    commanded = Commanded(chooser, robot)
    return FootholdGuard(commanded, robot) if sees else commanded


@dataclass(frozen=True)
class Commanded:
    """Another chooser's choice, unless the route asks for something itself."""

    chooser: Chooser
    robot: Robot

    def choose(self, route: Route, sensed: Sensed, now: Now = None, ground: Map = None) -> SkillCall:
        """The skill for what is asked; else the other's choice."""
        held = {} if now is None else now.memory
        if route.halt or route.pause:
            gait = gait_of(find_skill("stop", self.robot), self.robot)
            because = str(route.halt or route.pause)
            return SkillCall("stop", gait, (0.0, 0.0), 0.0, because=because, halt=route.halt, memory=held)
        if route.velocity is not None:
            velocity, because = route.velocity, "as a person steers"
        elif route.facing is not None and route.path:
            velocity, because = as_it_stands(self.robot, route, sensed), "there is no room to turn here"
        else:
            return self.chooser.choose(route, sensed, now, ground)
        skill = skill_for(self.robot, velocity)
        along = velocity.forward, velocity.left
        return SkillCall(
            skill.name, gait_of(skill, self.robot), along, velocity.turn, because=because, memory=held
        )


def as_it_stands(robot: Robot, route: Route, sensed: Sensed) -> Velocity:
    """The velocity that leads to the next point without turning to it, only to where the route says."""
    off, yaw = heading_error(route, sensed), heading(rotation(sensed.orientation_wb))
    forward, left, _ = meant(skill_towards(robot, off), robot)
    turn = turn_rate(robot, float(wrap((route.facing or 0.0) - yaw)))
    share = 1.0 - SLOWER * abs(turn) / turn_rate(robot, math.pi)
    speed = share * min(math.hypot(forward, left), approach_speed(robot, route))
    return Velocity(speed * math.cos(off), speed * math.sin(off), turn)


def skill_for(robot: Robot, velocity: Velocity) -> Skill:
    """The calmest skill that goes as fast in the direction of a velocity. `WrongUse` where none does."""
    speed, off = math.hypot(velocity.forward, velocity.left), math.atan2(velocity.left, velocity.forward)
    if speed == 0.0:
        return find_skill("turn-in-place" if velocity.turn else "stand", robot)
    if abs(off) <= BESIDE:
        return DefaultChooser(robot).gait_for(speed)
    skill = skill_towards(robot, off)
    check_speed(skill, robot, speed)
    return skill


def skill_towards(robot: Robot, off: float) -> Skill:
    """The walk that goes in a direction so far off the robot's nose [rad]."""
    name = "walk" if abs(off) <= BESIDE else "walk-sideways" if abs(off) <= BEHIND else "walk-backward"
    return find_skill(name, robot)


def check_velocity(robot: Robot, velocity: Velocity) -> None:
    """`WrongUse` for what is no velocity, or beyond what the skill for it can do on this robot."""
    if not all(math.isfinite(part) for part in velocity):
        raise WrongUse(f"a velocity is finite numbers, not {', '.join(f'{part:g}' for part in velocity)}")
    check_turn(skill_for(robot, velocity), robot, velocity.turn)
