"""An action from what a person says: a skill, and whatever else she cares to say of it."""

from collections.abc import Sequence

from gaitwright.errors import WrongUse, unknown
from gaitwright.knowledge.memory import Action
from gaitwright.model.robot import Robot
from gaitwright.skills.library import LIBRARY, OTHER_NAMES, Skill, skill_names
from gaitwright.skills.rule_chooser import check_until
from gaitwright.skills.situation import FOREST

SLOWEST, FASTEST = 0.4, 1.25
"""What share of the speed that it is meant for a skill goes down to and up to, where nobody says a speed."""
UNTIL = {"turn-in-place": "turn is straight on"}
"""Until when skills go on that would otherwise end at once."""


def said_action(
    skill: str,
    robot: Robot,
    speed: Sequence[float] | None = None,
    until: str = "",
    known: Sequence[Action] = (),
) -> Action:
    """The action of a skill on a robot; `speed` is its slowest and fastest [m/s, of a robot 0.29 m tall].

    Where neither that nor `until` is said: the last of the `known` actions of the skill, else what it is
    meant for. Raises `WrongUse` for a skill that the robot has not, or a speed beyond it.
    """
    name = OTHER_NAMES.get(skill, skill)
    if name not in skill_names(robot.n):
        raise unknown("skill", skill, skill_names(robot.n))
    taught = [action for action in known if action.skill == name]
    if taught and speed is None and not until:
        return taught[-1]
    row = LIBRARY[name]
    slowest, fastest = speed_range(row) if speed is None else speed
    if not 0.0 <= slowest <= fastest <= row.fastest:
        raise WrongUse(
            f"{name} goes at 0 to {row.fastest:g} m/s (of a robot 0.29 m tall), not from {slowest:g} to "
            f"{fastest:g}"
        )
    action = Action(name, float(slowest), float(fastest), until or UNTIL.get(name, ""))
    check_until(FOREST, action)
    return action


def speed_range(skill: Skill) -> tuple[float, float]:
    """From how slow to how fast a skill is used, where nobody says otherwise."""
    most = skill.cruise or min(skill.fastest, FASTEST * skill.speed)
    return round(SLOWEST * skill.speed, 3), round(most, 3)
