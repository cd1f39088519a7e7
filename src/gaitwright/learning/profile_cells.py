"""At which velocities a skill is taught: at its ends, where it is meant for, and between where need is.

A cell is added in the middle between two where what these say of it is off by more than `NEED` (row L9).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from gaitwright.control.learned.cells import Cells
from gaitwright.control.learned.profile import Profile, torque_error
from gaitwright.errors import WrongUse
from gaitwright.learning.profile_lessons import taught
from gaitwright.model.robot import Robot
from gaitwright.skills.library import Skill, fastest, fastest_turn, find_skill, speed_scale
from gaitwright.skills.path_following import MOST_TURN

NEED, REPEATS = 0.05, 2.0
"""Torque error between cells beyond which one more is taught, half of what is allowed; and so many times what
the teacher herself is off from one start to the next."""
STEADY = 0.2
"""Where she is off by more than that, there is no cycle to be taught, but for what the skill is meant for."""
DEEP = 1
"""So often the stretch between two cells is halved."""
CALM = 0.45
"""Skills meant for no more than this are taught from standing on, others from half their speed on [m/s at
0.29 m]."""
TRIES = 3
"""Velocities that are tried for an end: it, and half-way nearer to what the skill is meant for, and so on."""

Teacher = Callable[[Robot, str, float, float, int], Profile]


@dataclass
class Lessons:
    """What a skill is taught at: speeds along its way [m/s] and yaw rates [rad/s]."""

    robot: Robot
    skill: Skill
    seed: int = 0
    teach: Teacher = taught
    known: dict[tuple[float, float], Profile | None] = field(default_factory=dict)
    """What was taught so far; `None` where the robot does not keep it up."""

    def at(self, place: tuple[float, float]) -> Profile | None:
        """The profile at a speed and a yaw rate."""
        if place not in self.known:
            try:
                self.known[place] = self.teach(self.robot, self.skill.name, *place, self.seed)
            except WrongUse:
                self.known[place] = None
        return self.known[place]

    def reach(self, home: tuple[float, float], axis: int, end: float) -> float | None:
        """How far towards an end along one axis the skill can be taught; `None`: no farther than at home."""
        for _ in range(TRIES):
            if abs(end - home[axis]) < 1e-9:
                return None
            fresh = self.at(moved(home, axis, end))
            if fresh is not None and fresh.repeat < STEADY:
                return end
            end = 0.5 * (end + home[axis])
        return None

    def refined(
        self, home: tuple[float, float], axis: int, places: list[float], deep: int = DEEP
    ) -> list[float]:
        """The places along one axis, with those in between where need is."""
        out = places[:1]
        for low, high in pairwise(places):
            middle = 0.5 * (low + high)
            fresh = self.at(moved(home, axis, middle)) if deep else None
            ends = [self.at(moved(home, axis, end)) for end in (low, high)]
            if fresh is not None and self.is_off(fresh, ends):
                out += self.refined(home, axis, [low, middle, high], deep - 1)[1:]
            else:
                out.append(high)
        return out

    def is_off(self, fresh: Profile, ends: Sequence[Profile | None]) -> bool:
        """Whether what two cells say is too far from what is taught between them."""
        known = [profile for profile in ends if profile is not None]
        error = torque_error(Cells.of(known).at(fresh.command), fresh.table, self.robot.n)
        return error > max(NEED, REPEATS * max(profile.repeat for profile in (fresh, *known)))


def moved(place: tuple[float, float], axis: int, value: float) -> tuple[float, float]:
    """A place with another value along one axis."""
    return (value, place[1]) if axis == 0 else (place[0], value)


def ends_of(robot: Robot, skill: Skill) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Slowest and fastest speed [m/s] and yaw rate [rad/s] that a skill is taught at; empty: it has one."""
    if skill.duty >= 1.0:
        return (), ()
    scale, most = speed_scale(robot), fastest(skill, robot)
    turn = min(MOST_TURN / scale, fastest_turn(skill, robot))
    speeds = (0.0 if skill.speed <= CALM else 0.5 * skill.speed * scale, most)
    return (speeds if skill.speed else ()), (-turn, turn)


def cells_for(robot: Robot, name: str, seed: int = 0, teach: Teacher = taught) -> list[Profile]:
    """The profiles of a skill. Raises `WrongUse` where the robot does not keep up what it is meant for."""
    skill = find_skill(name, robot)
    lessons = Lessons(robot, skill, seed, teach)
    scale = speed_scale(robot)
    home = (skill.speed * scale, skill.turn / scale)
    first = lessons.at(home)
    if first is None:
        raise WrongUse(f"{robot.name} does not keep {name} up at {home[0]:.2f} m/s: no profile can be taken")
    axes = []
    for axis, ends in enumerate(ends_of(robot, skill)):
        reached = [lessons.reach(home, axis, end) for end in ends]
        places = sorted({home[axis], *(end for end in reached if end is not None)})
        axes.append(lessons.refined(home, axis, places))
    grid = [lessons.at((speed, turn)) for speed in axes[0] for turn in axes[1]]
    known = [profile for profile in grid if profile is not None]
    return [profile for profile in known if profile is first or profile.repeat < STEADY]
