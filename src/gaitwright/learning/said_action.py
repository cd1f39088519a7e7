"""An action from what a person says: a skill, and whatever else she cares to say of it."""

from collections.abc import Sequence
from dataclasses import dataclass

from gaitwright.errors import WrongUse, unknown
from gaitwright.knowledge.memory import Action, noting
from gaitwright.model.robot import Robot
from gaitwright.skills.library import LIBRARY, OTHER_NAMES, Skill, skill_names
from gaitwright.skills.rule_chooser import check_until
from gaitwright.skills.situation import FOREST
from gaitwright.skills.vocabulary import check_note

SLOWEST, FASTEST = 0.4, 1.25
"""What share of the speed that it is meant for a skill goes down to and up to, where nobody says a speed."""
UNTIL = {"turn-in-place": "turn is straight on"}
"""Until when skills go on that would otherwise end at once."""


@dataclass(frozen=True, slots=True)
class Words:
    """What a person says: a skill, its slowest and fastest speed [m/s, of a robot 0.29 m tall], until when,
    and which notes in working memory it makes or wipes out."""

    skill: str
    speed: Sequence[float] | None = None
    until: str = ""
    notes: Sequence[str] = ()
    drops: Sequence[str] = ()


def said_action(words: Words, robot: Robot, known: Sequence[Action] = ()) -> Action:
    """The action that a person means.

    Where she says neither speed nor `until`: the last of the `known` actions of the skill, else what it is
    meant for. Raises `WrongUse` for a skill that the robot has not, a speed beyond it, or a note that cannot
    be called so.
    """
    skill, speed, until = words.skill, words.speed, words.until
    name = OTHER_NAMES.get(skill, skill)
    if name not in skill_names(robot.n):
        raise unknown("skill", skill, skill_names(robot.n))
    for note in (*words.notes, *words.drops):
        check_note(note)
    memory = noting(words.notes), tuple(words.drops)
    taught = [a for a in known if a.skill == name and (a.adds, a.deletes) == memory]
    if taught and speed is None and not until:
        return taught[-1]
    row = LIBRARY[name]
    slowest, fastest = speed_range(row) if speed is None else speed
    if not 0.0 <= slowest <= fastest <= row.fastest:
        raise WrongUse(
            f"{name} goes at 0 to {row.fastest:g} m/s (of a robot 0.29 m tall), not from {slowest:g} to "
            f"{fastest:g}"
        )
    action = Action(name, float(slowest), float(fastest), until or UNTIL.get(name, ""), *memory)
    check_until(FOREST, action)
    return action


def speed_range(skill: Skill) -> tuple[float, float]:
    """From how slow to how fast a skill is used, where nobody says otherwise."""
    most = skill.cruise or min(skill.fastest, FASTEST * skill.speed)
    return round(SLOWEST * skill.speed, 3), round(most, 3)
