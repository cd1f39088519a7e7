"""`gaitwright skill`: one skill for a time, with a push where asked for."""

import math
from argparse import Namespace
from dataclasses import dataclass

from gaitwright.cli import trips
from gaitwright.errors import WrongUse
from gaitwright.geometry import heading, rotation
from gaitwright.locomotion import Lap
from gaitwright.model.robot import Robot
from gaitwright.plant.choose import SimulatedPlant
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill
from gaitwright.skills.library import check_speed, fastest, find_skill, speed_scale

PUSH_LASTS = 0.1
"""[s]"""
TURN = 0.8
"""Yaw rate of skill `turn` where none is asked for [rad/s], at a body height of 0.29 m."""


def run(args: Namespace) -> int:
    trips.check_outputs(args)
    robot = trips.find_robot(args.robot)
    turn = args.turn
    if turn is None:
        turn = TURN / speed_scale(robot) if args.skill == "turn" else 0.0
    check_velocity(robot, args.skill, args.speed, args.lateral, turn)
    chooser = fixed_skill(robot, args.skill, args.speed, args.lateral, turn, args.driver)
    push = Push.of(robot, *args.push, at=args.seconds / 2) if args.push else None
    scene = trips.find_scene(args.scene, args.seed, robot)
    setting = trips.set_up(robot, scene, chooser, args.distribution)
    return trips.run(setting, Mission((), args.speed, args.driver), args, on_lap=push)


def check_velocity(robot: Robot, name: str, speed: float | None, lateral: float, turn: float) -> None:
    """`WrongUse` for a velocity or yaw rate beyond what the skill can do on this robot."""
    skill = find_skill(name, robot)
    if speed is not None:
        check_speed(skill, robot, math.hypot(speed, lateral))
    reach = float((robot.stance[:, 0] ** 2 + robot.stance[:, 1] ** 2).max()) ** 0.5
    most = fastest(skill, robot) / reach
    if abs(turn) > most * (1 + 1e-9):
        raise WrongUse(
            f"{name} at a yaw rate of {turn:g} rad/s is beyond the reach of {robot.name}, whose feet are up "
            f"to {reach:.2f} m from its middle: at most {most:.2f} rad/s"
        )


@dataclass
class Push:
    """A force on the body for a moment."""

    force: float
    """[N]"""
    direction: float
    """From straight ahead, counter-clockwise [rad]."""
    begins: float
    ends: float
    """[s]"""
    pushing: bool = False

    @classmethod
    def of(cls, robot: Robot, impulse: float, direction: float, at: float) -> "Push":
        """From an impulse per mass [N·s/kg] and a direction in degrees."""
        if impulse < 0.0:
            raise WrongUse(
                f"the impulse of a push is not negative, as {impulse:g} is; turn its direction instead"
            )
        force = impulse * robot.total_mass / PUSH_LASTS
        return cls(force, math.radians(direction), at, at + PUSH_LASTS)

    def __call__(self, plant: SimulatedPlant, lap: Lap) -> None:
        """Begins and ends the push when its time has come."""
        due = self.begins - 1e-9 <= lap.sensed.time < self.ends - 1e-9
        if due and not self.pushing:
            towards = heading(rotation(lap.sensed.orientation_wb)) + self.direction
            plant.push((self.force * math.cos(towards), self.force * math.sin(towards), 0.0))
        elif self.pushing and not due:
            plant.push((0.0, 0.0, 0.0))
        self.pushing = due
