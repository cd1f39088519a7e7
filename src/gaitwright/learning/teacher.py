"""Whoever knows which skill is right: what the school asks of a teacher, and one who is written down."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Protocol, runtime_checkable

from gaitwright.knowledge.memory import Action
from gaitwright.model.robot import Robot
from gaitwright.skills.library import skill_names

Raw = Mapping[str, float]
"""What the teacher sees: the measured numbers of `skills.situation.measured`."""


@dataclass(frozen=True, slots=True)
class Shown:
    """What a teacher does, and why.

    `rule` is what she calls the rule: one skill may have several uses. `about` names the number that decided
    it; a teacher who gives no reason leaves it empty. Where it is not `clear`, on the border between two
    skills, nothing is to be learned from it.
    """

    rule: str
    action: Action
    because: str = ""
    about: str = ""
    clear: bool = True


@dataclass(frozen=True, slots=True)
class Correction:
    """What would have been right, and the number that speaks against what was done."""

    right: Shown
    about: str = ""


@runtime_checkable
class Teacher(Protocol):
    """A scripted teacher, or a person at the screen."""

    def ideal(self, raw: Raw) -> Shown:
        """What the teacher would do."""
        ...

    def judge(self, done: Action | None, raw: Raw) -> Correction | None:
        """What is wrong with what was done (`None`: nothing was decided); `None` where nothing is."""
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
        Action("turn-in-place", until="turn is straight on"),
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


LOOKED_AT = (
    "off the path",
    "sway",
    "slope",
    "step up",
    "step down",
    "gap",
    "roughness",
    "obstacle",
    "possible",
)
"""The numbers that the policy goes by, but for those that are yes or no."""
BORDER = 0.15
"""Where a number this share larger or smaller would change what she does, she says nothing."""


@dataclass(frozen=True, slots=True)
class ScriptedTeacher:
    """Follows a policy, and gives the reason for each correction where `gives_reasons`."""

    policy: tuple[Clause, ...] = POLICY
    gives_reasons: bool = True
    border: float = BORDER

    def ideal(self, raw: Raw) -> Shown:
        """The action of the first line of the policy that holds."""
        clause = self.line(raw)
        about = clause.about if self.gives_reasons else ""
        return Shown(clause.rule, clause.action, clause.because, about, self.is_clear(raw, clause))

    def is_clear(self, raw: Raw, clause: Clause) -> bool:
        """Whether she would do the same if one of the numbers were a little different."""
        return all(
            self.line({**raw, name: number * share}) is clause
            for name in LOOKED_AT
            if (number := raw[name])
            for share in (1.0 - self.border, 1.0 + self.border)
        )

    def judge(self, done: Action | None, raw: Raw) -> Correction | None:
        """What would have been right, and the number that speaks against what was done.

        What stands in the policy before the line that holds was wrong because its own line does not hold;
        anything else because of what the right line looks at.
        """
        right, shown = self.line(raw), self.ideal(raw)
        if right.action == done or not shown.clear:
            return None
        passed_over = [clause for clause in self.policy[: self.policy.index(right)] if clause.action == done]
        reason = passed_over[0] if passed_over else right
        return Correction(shown, reason.about if self.gives_reasons else "")

    def line(self, raw: Raw) -> Clause:
        """The first line of the policy that holds."""
        return next(clause for clause in self.policy if clause.holds(raw))


def teacher_for(robot: Robot) -> ScriptedTeacher:
    """Who teaches a robot: her policy asks for the skills that it has, and the last line holds anyhow."""
    has = skill_names(robot.n)
    *lines, last = (clause for clause in POLICY if clause.action.skill in has)
    return ScriptedTeacher((*lines, replace(last, holds=_anyhow)))
