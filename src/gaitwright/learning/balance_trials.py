"""Pushed runs for balance: one run again and again, each time with another answer to what is off (row E5)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from gaitwright.control.balance_rules import BalanceRules
from gaitwright.control.comparator import QUANTITIES, Comparator, Pattern
from gaitwright.control.learned.controller import LearnedController
from gaitwright.control.learned.profile import Profile
from gaitwright.control.takeover import LEARNED
from gaitwright.locomotion import Brain
from gaitwright.model.robot import Robot
from gaitwright.plant.registry import make_plant
from gaitwright.session import DT, Push, Session, scene_for
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill

SKILLS = ("trot", "walk", "run", "gallop")
"""Skills that are pushed, in turn."""
LEAST, MOST = 1.0, 2.6
"""Impulses [N·s/kg]; walk gets `WALKS` of it."""
WALKS = 0.6
ROUGH, LOWEST, HIGHEST = 1.0 / 3.0, 0.05, 0.09
"""So large a share is on rough ground, so high in all [m]."""
PUSHED_AT, SECONDS = 2.2, 5.2
"""[s]"""
LOOKED_AT = 5
"""Ticks from one look to the next at what is off without a push."""


@dataclass(frozen=True, eq=False)
class Trial:
    """A run to be made; what is drawn is drawn from its number."""

    robot: Robot
    profiles: Mapping[str, Sequence[Profile]]
    number: int
    rules: BalanceRules | None
    """What is off is answered by these; `None`: nobody looks."""
    skill: str
    is_pushed: bool = True


@dataclass(frozen=True)
class Run:
    """What came of it."""

    skill: str
    fell: bool
    pattern: Pattern
    """What was off when it was first decided what to do; none: it never had to be."""
    answered: int
    """Ticks in which a rule was followed."""
    farthest: tuple[float, ...]
    """How far each quantity was off at most, in the robot's own units; looked at without a push alone."""
    ticks: int


def trial(
    robot: Robot,
    profiles: Mapping[str, Sequence[Profile]],
    number: int,
    rules: BalanceRules | None,
    is_pushed: bool = True,
) -> Trial:
    """A run, its skill by its number among those that there are profiles of. It has only the profiles that it
    needs: it is sent to another process."""
    skill = list(profiles)[number % len(profiles)]
    mine = {name: cells for name, cells in profiles.items() if name in (skill, "trot")}
    return Trial(robot, mine, number, rules, skill, is_pushed)


def drawn(rng: np.random.Generator, skill: str, least: float, at: float) -> tuple[str, Push]:
    """The ground of a run, and its push at a time [s], of `least` [N·s/kg] or more, any way, at any phase."""
    terrain = f"rough:{rng.uniform(LOWEST, HIGHEST):.3f}" if rng.uniform() < ROUGH else "flat"
    impulse = rng.uniform(least, MOST) * (WALKS if skill == "walk" else 1.0)
    return terrain, Push(float(impulse), float(rng.uniform(-180.0, 180.0)), at, float(rng.uniform()))


def pushed(trial: Trial) -> Run:
    """Makes a run."""
    terrain, push = drawn(np.random.default_rng([trial.number, 2505]), trial.skill, LEAST, PUSHED_AT)
    robot, scene = trial.robot, scene_for(trial.robot, terrain if trial.is_pushed else "flat", trial.number)
    chooser = fixed_skill(robot, trial.skill, None, 0.0, None, LEARNED)
    brain = Brain.of(robot, scene, chooser, DT, watches=False).with_profiles(trial.profiles)
    plant = make_plant("mujoco", robot, scene, DT)
    brain = brain.with_balance(trial.rules)
    session = Session(brain, plant, Mission((), driver=LEARNED), SECONDS, trial.number)
    if trial.is_pushed:
        session.push(push)
    return followed(session, trial)


def followed(session: Session, trial: Trial) -> Run:
    """Steps a run to its end and keeps what balance did."""
    pattern, answered, farthest, tick = (), 0, np.zeros(len(QUANTITIES)), 0
    learned = session.brain.controllers[LEARNED]
    assert isinstance(learned, LearnedController)
    comparator = Comparator(trial.robot, learned)
    for tick, lap in enumerate(session, start=1):
        now = session.mind.memories.balance
        pattern, answered = pattern or now.pattern, answered + (now.rule is not None)
        if not trial.is_pushed and tick % LOOKED_AT == 0:
            off = comparator.off(lap.call.gait, lap.target, lap.sensed)
            farthest = farthest if off is None else np.maximum(farthest, np.abs(off))
    fell = session.lap is not None and session.lap.fell
    return Run(trial.skill, fell, pattern, answered, tuple(farthest.tolist()), tick)
