"""Whoever knows which skill is right: what the school asks of a teacher, and one who is written down."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Protocol, runtime_checkable

from gaitwright.knowledge.memory import Action
from gaitwright.model.robot import Robot
from gaitwright.skills.library import skill_names

Raw = Mapping[str, Any]
"""What the teacher sees: the measured numbers of `skills.measured`, and what working memory holds."""


@dataclass(frozen=True, slots=True)
class Shown:
    """What a teacher does, and why.

    `rule` is what she calls the rule: one skill may have several uses. `about` names the number that decided
    it; a teacher who gives no reason leaves it empty.
    """

    rule: str
    action: Action
    because: str = ""
    about: str = ""


@runtime_checkable
class Teacher(Protocol):
    """A scripted teacher, or a person at the screen."""

    def ideal(self, raw: Raw) -> Shown:
        """What the teacher would do."""
        ...


@dataclass(frozen=True, slots=True)
class Clause:
    """One line of a policy: do this where that holds. `about` names the number it looks at most."""

    rule: str
    action: Action
    holds: Callable[[Raw], bool]
    about: str
    because: str


def _stop(raw: Raw) -> bool:
    return raw["arrived"] != 0.0


def _face_the_way(raw: Raw) -> bool:
    return abs(raw["off the path"]) > (15.0 if raw["turning"] else 42.0)


def _stumbling(raw: Raw) -> bool:
    return raw["sway"] > 0.3


def _steps(raw: Raw) -> bool:
    return max(raw["step up"], raw["step down"]) > 0.15


def _up(raw: Raw) -> bool:
    rising = raw["step up"] >= raw["step down"] if _steps(raw) else raw["slope"] > 9.0
    return raw["gap"] < 0.09 and rising


def _down(raw: Raw) -> bool:
    falling = raw["step up"] < raw["step down"] if _steps(raw) else raw["slope"] < -9.0
    return raw["gap"] < 0.09 and falling


def _broken(raw: Raw) -> bool:
    small_steps = max(raw["step up"], raw["step down"]) > 0.07
    return raw["gap"] > 0.09 or raw["roughness"] > 0.033 or small_steps


def _to_the_left(raw: Raw) -> bool:
    return raw["off the path"] > 14.0


def _to_the_right(raw: Raw) -> bool:
    return raw["off the path"] < -14.0


def _blocked(raw: Raw) -> bool:
    return raw["obstacle"] < 1.0


def _slowly(raw: Raw) -> bool:
    return raw["possible"] < 0.3


def _briskly(raw: Raw) -> bool:
    return raw["possible"] < 1.0


def _fast(raw: Raw) -> bool:
    return raw["possible"] < 1.6


def _anyhow(raw: Raw) -> bool:
    return bool(raw)


POLICY: tuple[Clause, ...] = (
    Clause("stop", Action("stop"), _stop, "arrived", "the robot is where it should be"),
    Clause(
        "turn-in-place",
        Action("turn-in-place"),
        _face_the_way,
        "off the path",
        "the way is far off its nose",
    ),
    Clause("walk to recover", Action("walk", 0.05, 0.15), _stumbling, "sway", "it stumbles"),
    Clause("climb", Action("climb", 0.1, 0.3), _up, "slope", "the road goes up"),
    Clause("descend", Action("descend", 0.1, 0.25), _down, "slope", "the road goes down"),
    Clause("walk on broken ground", Action("walk", 0.1, 0.25), _broken, "roughness", "the road is broken"),
    Clause(
        "walk up to things", Action("walk", 0.1, 0.2), _blocked, "obstacle", "something stands in the way"
    ),
    Clause("walk", Action("walk", 0.1, 0.3), _slowly, "possible", "there is no hurry"),
    Clause("turn-left", Action("turn-left", 0.1, 0.5), _to_the_left, "off the path", "it bends to the left"),
    Clause(
        "turn-right", Action("turn-right", 0.1, 0.5), _to_the_right, "off the path", "it bends to the right"
    ),
    Clause("trot", Action("trot", 0.2, 1.0), _briskly, "possible", "a trot is fast enough"),
    Clause("run", Action("run", 0.8, 1.7), _fast, "possible", "it is in a hurry"),
    Clause("gallop", Action("gallop", 1.4, 2.0), _anyhow, "possible", "it is in a great hurry"),
)
"""What a good driver of a dog-sized robot does: the first line that holds."""


@dataclass(frozen=True, slots=True)
class ScriptedTeacher:
    """Follows a policy, and says which number decided her where she `gives_reasons`."""

    policy: tuple[Clause, ...] = POLICY
    gives_reasons: bool = True

    def ideal(self, raw: Raw) -> Shown:
        """The action of the first line of the policy that holds."""
        clause = next(clause for clause in self.policy if clause.holds(raw))
        return Shown(clause.rule, clause.action, clause.because, clause.about if self.gives_reasons else "")


def teacher_for(robot: Robot) -> ScriptedTeacher:
    """Who teaches a robot: her policy asks for the skills that it has, and the last line holds anyhow."""
    has = skill_names(robot.n)
    *lines, last = (clause for clause in POLICY if clause.action.skill in has)
    return ScriptedTeacher((*lines, replace(last, holds=_anyhow)))
