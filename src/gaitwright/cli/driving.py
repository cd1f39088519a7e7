"""The torque profiles of a book for the drivers that play them, and a sentence for what is not played."""

from argparse import Namespace
from collections.abc import Mapping, Sequence

from gaitwright.cli.book_files import is_skillbook, skillbook_of
from gaitwright.cli.console import remark, working
from gaitwright.control.balance_file import load_balance
from gaitwright.control.balance_rules import BalanceRules
from gaitwright.control.learned.profile import Profile
from gaitwright.control.takeover import HYBRID, LEARNED
from gaitwright.errors import WrongUse, short
from gaitwright.learning.equipped import equipped
from gaitwright.learning.profile_books import Playable, playable
from gaitwright.locomotion import Brain
from gaitwright.model.robot import Robot
from gaitwright.skillbook.book import Skillbook

BY_BOOK = (HYBRID, LEARNED)
"""Drivers that go by a skillbook."""


def profiles_for(robot: Robot, path: str) -> dict[str, list[Profile]]:
    """The profiles of a book that this robot may play; says which are out of date. Nothing in a file with
    rules alone."""
    found = looked_up(robot, path)
    for sentence in found.outdated.values():
        remark(f"{sentence}, and goes on to; {again(robot, path)}")
    return found.profiles


def profiles_to_play(robot: Robot, path: str) -> dict[str, list[Profile]]:
    """The same for a driver that plays nothing else. Raises `BadFile` for a file with rules alone, and
    `WrongUse` for a book without any."""
    found = profiles_for(robot, path)
    if not found:
        skillbook_of(path)
        raise WrongUse(f"{short(path)} has no profiles to play; {again(robot, path)}")
    return found


def profiles_of_skill(robot: Robot, path: str, skill: str) -> dict[str, list[Profile]]:
    """The profiles of one skill. Raises `WrongUse` where there are none, or they are out of date."""
    found = looked_up(robot, path, skill)
    if skill in found.outdated:
        raise WrongUse(f"{found.outdated[skill]}; {again(robot, path)}")
    if skill not in found.profiles:
        known = ", ".join(sorted({notes.skill for notes in skillbook_of(path).profiles})) or "none"
        raise WrongUse(f"{short(path)} has no profiles of {skill}; it has: {known}; {again(robot, path)}")
    return found.profiles


def by_book(brain: Brain, path: str, profiles: Mapping[str, Sequence[Profile]]) -> Brain:
    """The same brain with the terrain operators of a book and with profiles of it, as far as it is trusted
    with them; a file with rules alone has neither."""
    return equipped(brain, Skillbook.load(path), profiles, short(path)) if is_skillbook(path) else brain


def looked_up(robot: Robot, path: str, *skills: str) -> Playable:
    """The profiles of a book, of the skills named or of all."""
    if not is_skillbook(path):
        return Playable({}, {})
    book = Skillbook.load(path)
    if book.profiles and book.robot != robot.name:
        told = f"the profiles of {short(path)} were taken from {book.robot}, not from {robot.name}"
        if skills:
            raise WrongUse(told)
        remark(f"{told}: its rules alone drive")
        return Playable({}, {})
    with working("looking whether the profiles are up to date", worth_a_line=None):
        return playable(book, robot, short(path), skills or None)


def balance_for(args: Namespace) -> BalanceRules | None:
    """The rules of balance asked for. Raises `BadFile`, and `WrongUse` where nobody plays profiles."""
    if args.balance is None:
        return None
    if args.skillbook is None or args.driver not in BY_BOOK:
        raise WrongUse("--balance answers while profiles are played: add --skillbook FILE and its driver")
    return load_balance(args.balance)


def again(robot: Robot, path: str) -> str:
    """How profiles are taught."""
    return f"teach them by `gaitwright teach --lesson profiles --robot {robot.name} --out {short(path)}`"
