"""Route + Sensed → SkillCall: which skill, at which speed, and why (row L2 will put learned rules here)."""

import math
from dataclasses import dataclass

from gaitwright.geometry import heading, rotation, wrap
from gaitwright.model.robot import Robot
from gaitwright.signals import Route, Sensed, SkillCall
from gaitwright.skills.library import (
    LIBRARY,
    Skill,
    check_speed,
    fastest,
    find_skill,
    gait_of,
    meant,
    skill_names,
    speed_scale,
)

TURN_FIRST = math.radians(40)
"""Farther off the path than this, the robot turns on the spot before it goes on."""
KEEP_TURNING = math.radians(15)
"""A turn on the spot goes on until the path is this near."""
CREEP = 0.1
"""Slowest approach [m/s], at h = 0.29 m."""
TURN_GAIN = 2.0
"""Yaw rate per heading error [1/s]."""
BRAKING = 0.6
"""Speed allowed per metre that is left [1/s], at h = 0.29 m."""


@dataclass(frozen=True)
class PlainChooser:
    """Chooses among the skills of one robot by a few plain rules."""

    robot: Robot

    def choose(self, route: Route, sensed: Sensed, now: SkillCall | None = None) -> SkillCall:
        """The skill for what lies ahead; `now` is the one in use."""
        if route.arrived or not route.path:
            return self.call("stand", route, because=route.no_way or "at the goal")
        yaw = heading(rotation(sensed.orientation_wb))
        dx = route.path[0][0] - float(sensed.position_w[0])
        dy = route.path[0][1] - float(sensed.position_w[1])
        error = float(wrap(math.atan2(dy, dx) - yaw))
        turn = self.turn_rate(error)
        turning = now is not None and now.skill == "turn-in-place"
        if abs(error) > (KEEP_TURNING if turning else TURN_FIRST):
            return self.call(
                "turn-in-place", route, turn=turn, because=f"the path is {math.degrees(error):.0f}° off"
            )
        scale = speed_scale(self.robot)
        wished = route.speed if route.speed is not None else LIBRARY["trot"].speed * scale
        self.gait_for(wished)
        slowed = min(wished, max(CREEP * scale, BRAKING / scale * route.remaining))
        skill = self.gait_for(slowed)
        because = f"{route.remaining:.1f} m to go" + (", slowing down" if slowed < wished else "")
        return self.call(skill.name, route, forward=slowed * math.cos(error), turn=turn, because=because)

    def gait_for(self, speed: float) -> Skill:
        """The calmest skill for a speed [m/s]: walk, trot or run.

        Raises `WrongUse` where even the fastest of them cannot go so fast.
        """
        names = [name for name in ("walk", "trot", "run") if name in skill_names(self.robot.n)]
        walk, *faster = (find_skill(name, self.robot) for name in names)
        if speed <= walk.speed * speed_scale(self.robot):
            return walk
        for skill in faster:
            if speed <= fastest(skill, self.robot):
                return skill
        check_speed(faster[-1], self.robot, speed)
        return faster[-1]

    def turn_rate(self, error: float) -> float:
        """Yaw rate [rad/s] that takes away a heading error [rad], within what the feet can step."""
        most = 0.8 / speed_scale(self.robot)
        return max(-most, min(most, TURN_GAIN / speed_scale(self.robot) * error))

    def call(
        self, name: str, route: Route, forward: float = 0.0, turn: float = 0.0, because: str = ""
    ) -> SkillCall:
        gait = gait_of(find_skill(name, self.robot), self.robot)
        return SkillCall(name, gait, (forward, 0.0), turn, route.driver, because)


@dataclass(frozen=True)
class Fixed:
    """A chooser that holds one skill: what `gaitwright skill` runs."""

    skill_call: SkillCall

    def choose(self, route: Route, sensed: Sensed, now: SkillCall | None = None) -> SkillCall:
        return self.skill_call


def fixed_skill(
    robot: Robot, name: str, speed: float | None, lateral: float, turn: float | None, driver: str
) -> Fixed:
    """One skill at one velocity [m/s, rad/s]; `None` takes what the skill is meant for.

    `speed` is along the skill's own way; `lateral`, to the left, comes on top.
    """
    skill = find_skill(name, robot)
    forward, left, rate = meant(skill, robot)
    if speed is not None:
        forward, left = speed * skill.way[0], speed * skill.way[1]
    velocity = (forward, left + lateral)
    check_speed(skill, robot, math.hypot(*velocity))
    turn = rate if turn is None else turn
    return Fixed(SkillCall(skill.name, gait_of(skill, robot), velocity, turn, driver, "asked for"))
