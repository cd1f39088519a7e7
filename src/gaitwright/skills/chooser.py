"""Route + Sensed → SkillCall: which skill, at which speed, and why (row L2 will put learned rules here)."""

import math
from dataclasses import dataclass

from gaitwright.ground.elevation import is_known
from gaitwright.model.robot import Robot
from gaitwright.signals import SHARP, GroundMap, Route, Sensed, SkillCall
from gaitwright.skills.library import (
    Skill,
    check_speed,
    cruising,
    find_skill,
    gait_of,
    meant,
)
from gaitwright.skills.path_following import approach_speed, heading_error, turn_rate, wished_speed
from gaitwright.skills.tracks import WIDEST, Track, feet_from
from gaitwright.stages import Map, Now

TURN_FIRST = SHARP
"""Farther off the path than this, the robot turns on the spot before it goes on."""
KEEP_TURNING = math.radians(15)
"""A turn on the spot goes on until the path is this near."""
CAREFUL, AHEAD = 0.9, 1.5
"""Over a longer stretch without a foothold it goes by its calmest skill, so far before it, in body heights:
in a trot most fall that step over 1."""


@dataclass(frozen=True)
class DefaultChooser:
    """Chooses among the skills of one robot by a few plain rules."""

    robot: Robot

    def choose(self, route: Route, sensed: Sensed, now: Now = None, ground: Map = None) -> SkillCall:
        """The skill for what lies ahead; `now` is the one in use."""
        if route.arrived or not route.path:
            return self.call("stand", route, because=route.no_way or "at the goal")
        error = heading_error(route, sensed)
        turn = turn_rate(self.robot, error)
        turning = now is not None and now.skill == "turn-in-place"
        if abs(error) > (KEEP_TURNING if turning else TURN_FIRST):
            return self.call(
                "turn-in-place", route, turn=turn, because=f"the path is {math.degrees(error):.0f}° off"
            )
        wished = wished_speed(self.robot, route)
        self.gait_for(wished)
        slowed = approach_speed(self.robot, route)
        because = f"{route.remaining:.1f} m to go" + (", slowing down" if slowed < wished else "")
        stretch = 0.0 if ground is None else self.stretch_ahead(ground, sensed)
        if stretch > CAREFUL * self.robot.height:
            slowed = min(slowed, cruising(self.robot)[0][0])
            because = f"foot by foot over {stretch:.2f} m without a foothold"
        skill = self.gait_for(slowed)
        return self.call(skill.name, route, forward=slowed * math.cos(error), turn=turn, because=because)

    def stretch_ahead(self, ground: GroundMap, sensed: Sensed) -> float:
        """The longest stretch without a foothold that a foot steps over now, or before long [m]."""
        if not is_known(ground.footholds):
            return 0.0
        height = self.robot.height
        track = Track.of(ground, self.robot, sensed, (1.0, 0.0))
        begins = feet_from(self.robot, sensed) - WIDEST * height * track.ahead
        return max(track.followed(begin, (WIDEST + AHEAD) * height)[3] for begin in begins)

    def gait_for(self, speed: float) -> Skill:
        """The calmest skill for a speed [m/s], of those that a robot cruises with.

        Raises `WrongUse` where even the fastest of them cannot go so fast.
        """
        rows = cruising(self.robot)
        for most, skill in rows:
            if speed <= most:
                return skill
        check_speed(rows[-1][1], self.robot, speed)
        return rows[-1][1]

    def call(
        self, name: str, route: Route, forward: float = 0.0, turn: float = 0.0, because: str = ""
    ) -> SkillCall:
        gait = gait_of(find_skill(name, self.robot), self.robot)
        return SkillCall(name, gait, (forward, 0.0), turn, because=because)


@dataclass(frozen=True)
class HeldSkill:
    """A chooser that holds one skill: what `gaitwright skill` runs."""

    skill_call: SkillCall

    def choose(self, route: Route, sensed: Sensed, now: Now = None, ground: Map = None) -> SkillCall:
        return self.skill_call


def fixed_skill(
    robot: Robot, name: str, speed: float | None, lateral: float, turn: float | None, driver: str
) -> HeldSkill:
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
    return HeldSkill(SkillCall(skill.name, gait_of(skill, robot), velocity, turn, driver, "asked for"))
