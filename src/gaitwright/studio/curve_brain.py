"""A brain with the edits of a snapshot: leg cycles, torque profiles, terrain operators."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from gaitwright.control.learned.controller import LearnedController
from gaitwright.control.learned.profile import Profile
from gaitwright.control.takeover import LEARNED
from gaitwright.errors import WrongUse
from gaitwright.gait.operators import Operator
from gaitwright.locomotion import Brain
from gaitwright.studio.curve_change import Parts
from gaitwright.studio.curve_history import Cell, Snapshot
from gaitwright.studio.curve_torque import TorqueEdit
from gaitwright.studio.curve_walk import Walk

Profiles = Mapping[str, Sequence[Profile]]


def edited_parts(brain: Brain, origin: Parts, snapshot: Snapshot) -> Parts:
    """The parts of a brain with all edits of a snapshot. `origin`: as they were before any."""
    out = origin.within(brain)
    for skill, cycle in snapshot.cycles.items():
        out = out.with_cycle(skill, cycle)
    if snapshot.torques:
        out = with_profiles(out, with_edits(profiles_of(origin), snapshot.torques))
    parts = Parts.of(out)
    if snapshot.operators:
        coordinator = replace(parts.coordinator, operators=operators_of(origin, snapshot))
        parts = parts._replace(coordinator=coordinator)
    return parts


def operators_of(origin: Parts, snapshot: Snapshot) -> tuple[Operator, ...]:
    """The terrain operators in the order in which they are tried: those of a person first."""
    names = {one.name for one in snapshot.operators}
    others = (one for one in origin.coordinator.operators if one.name not in names)
    return (*snapshot.operators, *others)


def profiles_of(parts: Parts) -> Profiles:
    """The profiles that a brain plays, by the skill."""
    learned = parts.controllers.get(LEARNED)
    return learned.profiles if isinstance(learned, LearnedController) else {}


def with_edits(profiles: Profiles, edits: Mapping[Cell, TorqueEdit]) -> Profiles:
    """Profiles with edited ones, which count before those at the same velocity by standing behind them."""
    out = {skill: list(cells) for skill, cells in profiles.items()}
    for (skill, _), edit in edits.items():
        out[skill] = [
            *(cell for cell in out.get(skill, []) if cell is not edit.base),
            edit.base,
            edit.profile,
        ]
    return out


def with_profiles(brain: Brain, profiles: Profiles) -> Brain:
    """A brain that plays other profiles and is trusted with them, and balances, as before."""
    grades = brain.takeover.grades if brain.takeover is not None else {}
    rules = brain.balance.rules if brain.balance is not None else None
    return brain.with_profiles(profiles, grades, brain.alarm is not None).with_balance(rules)


def torques_of(walk: Walk, origin: Parts, snapshot: Snapshot) -> tuple[Cell, TorqueEdit]:
    """The profile of a skill that is nearest to a velocity, with what a person made of it.

    Raises `WrongUse` for a skill of which the robot plays none.
    """
    cells = profiles_of(origin).get(walk.skill, ())
    if not cells:
        known = ", ".join(profiles_of(origin)) or "none"
        raise WrongUse(
            f"{walk.robot.name} plays no torque profile of {walk.skill}; there is: {known}; "
            "gaitwright teach --lesson profiles teaches them"
        )
    asked = (*walk.velocity, walk.turn)
    far = [float(np.linalg.norm(np.subtract(cell.command, asked)).round(6)) for cell in cells]
    nearest = cells[len(far) - 1 - far[::-1].index(min(far))]
    key = (walk.skill, nearest.command)
    return key, snapshot.torques.get(key, TorqueEdit(nearest, nearest, {}))
