"""The skills: one row each, scaled to the robot's size (rows J1, J2; control.md, "Gaits")."""

from dataclasses import dataclass
from math import sqrt

from gaitwright.errors import WrongUse, unknown
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.signals import Gait

REFERENCE_HEIGHT = 0.29
"""Body height [m] at which the periods and speeds below are given."""


@dataclass(frozen=True, slots=True)
class Skill:
    """One way of moving. Periods in seconds and speeds in m/s at a body height of 0.29 m."""

    name: str
    period: float
    duty: float
    offsets: str
    """Name of the pattern of relative phases, a row of `PATTERNS`."""
    speed: float
    """The speed it is meant for [m/s]."""
    fastest: float
    """The speed beyond which it is not offered [m/s]."""
    about: str
    way: tuple[float, float] = (1.0, 0.0)
    """Where it goes: unit vector, forward and left."""
    turn: float = 0.0
    """The yaw rate it is meant for [rad/s]."""
    cruise: float = 0.0
    """The default chooser goes forward with it up to this speed [m/s]; 0: never of itself."""


PATTERNS: dict[str, tuple[float, ...]] = {
    "walk": (0.75, 0.25, 0.0, 0.5),
    "diagonal": (0.0, 0.5, 0.5, 0.0),
    "lateral": (0.0, 0.5, 0.0, 0.5),
    "single-foot": (0.25, 0.75, 0.0, 0.5),
    "together": (0.0, 0.0, 0.0, 0.0),
    "front-rear": (0.0, 0.0, 0.5, 0.5),
    "transverse": (0.0, 0.15, 0.5, 0.65),
    "rotary": (0.0, 0.15, 0.65, 0.5),
    "wave": (0.0, 0.5, 0.25, 0.75),
}
"""Relative phases of FL FR RL RR."""

LIBRARY: dict[str, Skill] = {
    skill.name: skill
    for skill in (
        Skill("stand", 0.40, 1.00, "together", 0.0, 0.0, "all feet on the ground"),
        Skill("stop", 0.40, 1.00, "together", 0.0, 0.0, "slows down in the gait it is in, then stands"),
        Skill(
            "walk", 0.60, 0.75, "walk", 0.25, 0.45, "one foot at a time; six-legged: a ripple", cruise=0.25
        ),
        Skill("walk-backward", 0.60, 0.75, "walk", 0.20, 0.35, "a walk to the rear", (-1.0, 0.0)),
        Skill("walk-sideways", 0.60, 0.75, "walk", 0.12, 0.25, "a walk to the left", (0.0, 1.0)),
        Skill("climb", 0.60, 0.75, "walk", 0.20, 0.35, "a walk up steps and slopes, feet lifted high"),
        Skill("descend", 0.60, 0.75, "walk", 0.20, 0.35, "a walk down steps and slopes"),
        Skill("trot", 0.40, 0.60, "diagonal", 0.40, 1.00, "diagonal pairs; six-legged: tripods", cruise=1.0),
        Skill("turn-left", 0.40, 0.60, "diagonal", 0.30, 0.60, "an arc to the left, in trot", turn=0.6),
        Skill("turn-right", 0.40, 0.60, "diagonal", 0.30, 0.60, "an arc to the right, in trot", turn=-0.6),
        Skill("turn-in-place", 0.40, 0.60, "diagonal", 0.0, 0.40, "turning on the spot, in trot", turn=0.8),
        Skill("run", 0.36, 0.45, "diagonal", 1.50, 2.50, "a flying trot", cruise=2.5),
        Skill("pace", 0.34, 0.60, "lateral", 0.60, 1.30, "left and right pairs"),
        Skill("rack", 0.40, 0.60, "single-foot", 0.40, 0.90, "evenly, foot by foot"),
        Skill("pronk", 0.40, 0.55, "together", 0.60, 1.30, "all feet together"),
        Skill("bound", 0.34, 0.50, "front-rear", 0.80, 1.70, "front pair, rear pair"),
        Skill("gallop", 0.34, 0.45, "transverse", 1.20, 2.00, "transverse gallop"),
        Skill("rotary-gallop", 0.34, 0.45, "rotary", 1.20, 1.50, "rotary gallop"),
        Skill("tripod", 0.40, 0.60, "diagonal", 0.40, 1.00, "every other leg: what a trot is on more legs"),
        Skill("ripple", 0.60, 0.75, "walk", 0.25, 0.45, "waves that run from rear to front on either side"),
        Skill("wave", 1.00, 0.75, "wave", 0.10, 0.18, "one leg at a time"),
    )
}

OTHER_NAMES = {"turn": "turn-in-place"}
"""Names that skills had before, and still answer to."""
FOUR_LEGGED = ("run", "pace", "rack", "pronk", "bound", "gallop", "rotary-gallop")
"""The skills of robots with four legs alone."""
MANY_LEGGED = ("tripod", "ripple", "wave")
"""The skills of robots with six or eight legs alone."""


def skill_names(legs: int = 4) -> tuple[str, ...]:
    """Names of the skills a robot of so many legs has."""
    others = MANY_LEGGED if legs == 4 else FOUR_LEGGED
    return tuple(name for name in LIBRARY if name not in others)


def find_skill(name: str, robot: Robot) -> Skill:
    """The row `name`; `WrongUse` naming what exists where the robot has no such skill."""
    name = OTHER_NAMES.get(name, name)
    if name not in skill_names(robot.n):
        raise unknown("skill", name, skill_names(robot.n))
    return LIBRARY[name]


def gait_of(skill: Skill, robot: Robot) -> Gait:
    """The gait of a skill on a robot: its period grows with √h, its phases with the number of legs."""
    period = skill.period * sqrt(robot.height / REFERENCE_HEIGHT)
    duty = max(skill.duty, (robot.n - 1) / robot.n) if skill.offsets == "wave" else skill.duty
    return Gait(skill.name, period, duty, relative_phases(skill.offsets, robot.n))


def relative_phases(pattern: str, legs: int) -> tuple[float, ...]:
    """Phases of `legs` legs in the order front to rear, left first.

    Beyond four legs, pairs alternate (tripods), and the walk is a ripple: along each side the
    lift-offs run from rear to front, evenly over the cycle. In a wave one side follows the other.
    """
    if pattern == "wave":
        return tuple(((i // 2) / legs + 0.5 * (i % 2)) % 1.0 for i in range(legs))
    if legs == 4 or pattern == "together":
        return PATTERNS[pattern][:1] * legs if pattern == "together" else PATTERNS[pattern]
    pairs = legs // 2
    if pattern == "diagonal":
        return tuple(0.5 * ((i // 2 + i % 2) % 2) for i in range(legs))
    return tuple(((i // 2 + 1) / pairs + 0.5 * (i % 2)) % 1.0 for i in range(legs))


def speed_scale(robot: Robot) -> float:
    """How much faster than a robot of 0.29 m height this one is meant to go: equal Froude numbers."""
    return sqrt(robot.height / REFERENCE_HEIGHT)


def fastest(skill: Skill, robot: Robot) -> float:
    """Fastest speed at which the skill is offered [m/s]; a step must stay within the leg's reach."""
    gait = gait_of(skill, robot)
    step = 2.0 * 0.6 * robot.height
    by_reach = step / (gait.period * gait.duty)
    return min(skill.fastest * speed_scale(robot), by_reach)


def fastest_turn(skill: Skill, robot: Robot) -> float:
    """Fastest yaw rate of a skill [rad/s]: the foot farthest from the middle goes at its fastest speed."""
    return fastest(skill, robot) / feet_reach(robot)


def feet_reach(robot: Robot) -> float:
    """How far the feet are from the robot's middle, the farthest one, seen from above [m]."""
    return float((robot.nominal_feet[:, 0] ** 2 + robot.nominal_feet[:, 1] ** 2).max()) ** 0.5


def meant(skill: Skill, robot: Robot) -> tuple[float, float, float]:
    """The velocity a skill is meant for on a robot: forward, left [m/s], yaw rate [rad/s]."""
    k = speed_scale(robot)
    return skill.speed * k * skill.way[0], skill.speed * k * skill.way[1], skill.turn / k


def cruising(robot: Robot) -> list[tuple[float, Skill]]:
    """The skills that a robot goes forward with, the calmest first, and up to what speed [m/s] with each."""
    rows = (LIBRARY[name] for name in skill_names(robot.n))
    found = [(min(row.cruise * speed_scale(robot), fastest(row, robot)), row) for row in rows if row.cruise]
    return sorted(found, key=lambda pair: pair[0])


def check_speed(skill: Skill, robot: Robot, speed: float) -> None:
    """`WrongUse` where `speed` [m/s] is beyond what the skill can do on this robot."""
    most = fastest(skill, robot)
    if not speed <= most * (1 + 1e-9):
        weight = robot.total_mass * GRAVITY
        raise WrongUse(
            f"{skill.name} at {speed:g} m/s is beyond the reach of {robot.name} ({weight:.0f} N on legs of "
            f"{robot.leg_length:.2f} m): at most {most:.2f} m/s"
        )


def check_turn(skill: Skill, robot: Robot, turn: float) -> None:
    """`WrongUse` where a yaw rate [rad/s] is beyond what the skill can do on this robot."""
    most = fastest_turn(skill, robot)
    if not abs(turn) <= most * (1 + 1e-9):
        raise WrongUse(
            f"{skill.name} at a yaw rate of {turn:g} rad/s is beyond the reach of {robot.name}, whose "
            f"feet are up to {feet_reach(robot):.2f} m from its middle: at most {most:.2f} rad/s"
        )
