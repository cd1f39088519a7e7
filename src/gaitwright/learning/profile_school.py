"""A whole skill learned: its profiles, and a try of the learned controller with them."""

from typing import NamedTuple

import numpy as np

from gaitwright.control.learned.profile import Profile
from gaitwright.control.takeover import LEARNED
from gaitwright.errors import WrongUse
from gaitwright.ground.scene import load_scene
from gaitwright.knowledge.trust import Experience
from gaitwright.learning.profile_books import notes_of
from gaitwright.learning.profile_cells import cells_for
from gaitwright.locomotion import Brain
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import heading, rotation
from gaitwright.plant.registry import make_plant
from gaitwright.session import DT, Session
from gaitwright.signals import Mission
from gaitwright.skillbook.profile_notes import ProfileNotes
from gaitwright.skills.chooser import fixed_skill

STARTS, HANDED_OVER, SECONDS, LOOKED_AT = 2, 1.0, 6.0, 3.0
"""Starts of a try; the teacher drives for a second, then the pupil; the last three are looked at [s]."""


class Task(NamedTuple):
    """What is to be learned."""

    robot: Robot
    skill: str
    seed: int = 0


class Try(NamedTuple):
    """How the learned controller does with the profiles of a skill, at what it is meant for."""

    kept_up: int
    """Starts without a fall, of `STARTS`."""
    held: float
    """Share of the velocity asked for; 1 where none was."""
    played: float
    """Share of the torques that is the profile's own."""


class Learned(NamedTuple):
    """What came of it: profiles and a try, or a sentence why there are none."""

    skill: str
    profiles: tuple[ProfileNotes, ...] = ()
    found: Try | None = None
    why: str = ""


def learn(task: Task) -> Learned:
    """The profiles of a skill, and a try with them."""
    try:
        cells = cells_for(*task)
    except WrongUse as error:
        return Learned(task.skill, why=str(error))
    return Learned(task.skill, tuple(map(notes_of, cells)), tried(task, cells))


def lived(learned: Learned) -> list[Experience]:
    """What the tries say of how far these profiles can be trusted."""
    if learned.found is None:
        return []
    good, seconds = learned.found.kept_up, SECONDS - HANDED_OVER
    drove = Experience(learned.skill, "drove", seconds, why="tried on the flat after it was taught")
    fell = Experience(learned.skill, "bug", why="it fell when it was tried on the flat after it was taught")
    return [Experience(learned.skill, "taught"), *[drove] * good, *[fell] * (STARTS - good)]


def tried(task: Task, cells: list[Profile]) -> Try:
    """A try: the learned controller takes over from its teacher amid the skill."""
    starts = [driven(task, cells, task.seed + 100 + k) for k in range(STARTS)]
    good = [(held, played) for kept_up, held, played in starts if kept_up]
    held, played = np.mean(good, axis=0) if good else (0.0, 0.0)
    return Try(len(good), float(held), float(played))


def driven(task: Task, cells: list[Profile], seed: int) -> tuple[bool, float, float]:
    """Whether the robot kept the skill up, and as in a `Try` what it held and what was played."""
    robot, scene = task.robot, load_scene("flat", seed)
    chooser = fixed_skill(robot, task.skill, None, 0.0, None, "")
    brain = Brain.of(robot, scene, chooser, DT, watches=False).with_profiles({task.skill: cells})
    session = Session(brain, make_plant("mujoco", robot, scene, DT), Mission(()), SECONDS, seed)
    played, places = [], []
    for lap in session:
        if lap.call.driver != LEARNED and lap.sensed.time >= HANDED_OVER:
            session.drive(LEARNED)
        if lap.sensed.time >= SECONDS - LOOKED_AT:
            played.append(float(session.mind.memories.control[-1]))
            places.append((*lap.sensed.position_w[:2], heading(rotation(lap.sensed.orientation_wb))))
    assert session.lap is not None
    if session.lap.fell:
        return False, 0.0, 0.0
    return (
        True,
        held(np.array(places), chooser.skill_call.velocity, chooser.skill_call.turn),
        float(np.mean(played)),
    )


def held(places: np.ndarray, velocity: tuple[float, float], turn: float) -> float:
    """Share of the way, or turn, that was asked for. `places`: x, y [m] and heading [rad] at each tick."""
    seconds, yaw, asked = DT * (len(places) - 1), np.unwrap(places[:, 2]), np.array(velocity)
    if asked.any():
        c, s = np.cos(yaw[:-1]), np.sin(yaw[:-1])
        dx, dy = np.diff(places[:, :2], axis=0).T
        moved = np.array([(c * dx + s * dy).sum(), (c * dy - s * dx).sum()])  # forward and left
        return float(moved @ asked / (asked @ asked)) / seconds
    return float(yaw[-1] - yaw[0]) / (turn * seconds) if turn else 1.0
