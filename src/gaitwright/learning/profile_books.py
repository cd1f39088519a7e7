"""Profiles ↔ skillbook: which ones a book holds, and which of them may be played."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from gaitwright.control.learned.profile import BINS, ROW, Profile
from gaitwright.errors import BadFile, WrongUse
from gaitwright.learning.profile_lessons import OUT_OF_DATE, changed_by
from gaitwright.model.robot import Robot
from gaitwright.signals import Gait
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.profile_notes import ProfileNotes, name_of

FLOAT = "<f4"


def notes_of(profile: Profile) -> ProfileNotes:
    """A profile as a book holds it."""
    gait = profile.gait
    return ProfileNotes(
        gait.name,
        profile.command,
        gait.period,
        gait.duty,
        tuple(map(float, gait.offsets)),
        profile.table.astype(FLOAT).tobytes(),
        profile.answers.astype(FLOAT).tobytes(),
        profile.repeat,
        profile.edited,
    )


def profile_of(notes: ProfileNotes, robot: Robot, source: str) -> Profile:
    """The profile that a book holds. Raises `BadFile` where it is none of this robot."""
    gait = Gait(notes.skill, notes.period, notes.duty, notes.offsets)
    table, answers = (
        np.frombuffer(numbers, FLOAT).astype(np.float64) for numbers in (notes.table, notes.answers)
    )
    width = ROW.size(robot.n)
    if table.size != BINS * width or answers.size % (3 * robot.n) or len(notes.offsets) != robot.n:
        raise BadFile(
            f"{source}: its profile {name_of(notes)} is of another robot than {robot.name} or version"
        )
    try:
        return Profile(
            gait,
            notes.command,
            table.reshape(BINS, width),
            notes.repeat,
            answers.reshape(-1, 3 * robot.n),
            notes.edited,
        )
    except WrongUse as error:
        raise BadFile(f"{source}: {error}") from None


@dataclass(frozen=True)
class Playable:
    """The profiles of a book that may be played, and a sentence for every skill whose may not."""

    profiles: dict[str, list[Profile]]
    outdated: dict[str, str]


def in_book(book: Skillbook, robot: Robot, source: str) -> dict[str, list[Profile]]:
    """All profiles of a book by the skill, edited ones behind what they were. Raises `BadFile`."""
    found: dict[str, list[Profile]] = {}
    for notes in sorted(book.profiles, key=lambda notes: bool(notes.edited)):
        found.setdefault(notes.skill, []).append(profile_of(notes, robot, source))
    return found


def playable(book: Skillbook, robot: Robot, source: str, skills: Iterable[str] | None = None) -> Playable:
    """The profiles that a robot may play, of the skills named or of all.

    A skill whose teacher has changed since is left out: other gains or another coordination make its profiles
    wrong, and a sentence says so. Raises `BadFile` for the profiles of another robot.
    """
    profiles, outdated = {}, {}
    for skill, cells in in_book(book, robot, source).items():
        if skills is not None and skill not in skills:
            continue
        changed = changed_by(robot, cells[0])  # the others were taught by the same teacher
        if changed > OUT_OF_DATE:
            outdated[skill] = (
                f"the profiles of {skill} in {source} are out of date: the numerical controller drives "
                f"{robot.name} otherwise by {changed:.0%} today"
            )
        else:
            profiles[skill] = cells
    return Playable(profiles, outdated)
