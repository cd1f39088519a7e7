"""What the words after an option mean: text → value, or one sentence about what is wrong with it."""

import argparse
import math
import re
from collections.abc import Callable, Collection
from pathlib import Path

from gaitwright.errors import WrongUse, short, unknown
from gaitwright.files import is_there
from gaitwright.plant.names import FAULTS, INTEGRATORS, PLANTS, SENSORS

DRIVERS = {
    "numerical": "solves the robot's dynamics 500 times a second",
    "hybrid": "chooses skills by the rules of --skillbook, plays its profiles where they know the case",
    "learned": "plays the torque profiles of --skillbook",
    "kinematic": "holds the joints to the angles that the motion needs, without forces",
    "programmed": "plays the joint angles of the gait back, whatever happens",
}
"""Who can compute the torques now."""
SENSINGS = {
    "true": "the truth, as a simulator has it",
    "estimated": "what it makes of its encoders, inertial unit and feet",
}
LESSONS = {
    "skills": "which skill to use where",
    "profiles": "the torques of each skill, from the numerical controller",
    "operators": "how a leg gets over an obstacle, from the numerical controller",
    "all": "all of these",
    "practice": "trips in physics by what the book holds: trust grows or falls, own mistakes teach",
}
BOOK_TASKS = {
    "merge": "two books to one",
    "export": "a book as text",
    "import": "a book from text",
    "confirm": "BOOK takes in a SKILL that is proposed by analogy",
    "edit": "BOOK takes in what a person changed in a profile's TABLE",
    "undo": "BOOK forgets the last lesson that counts",
    "forget": "BOOK forgets a LESSON by its name",
    "trust": "how far the learned controller is trusted with the skills of BOOK; with a SKILL: its history; "
    "with a GRADE: now it is apprentice, assistant, partner or skilled",
    "map": "what BOOK knows of places, or of one PLACE; --out FILE.png draws it",
}
"""What `gaitwright books` can do."""
LONGEST = 3600.0
"""Longest time to simulate in one go [s]; a recording takes 0.5 MB of memory per second."""


def finite(text: str) -> float:
    """A number that is neither infinite nor not one."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text.strip()!r} is not a finite number")
    return value


def positive(text: str) -> float:
    value = finite(text)
    if value <= 0.0:
        raise argparse.ArgumentTypeError(f"{text.strip()} is not greater than 0")
    return value


def duration(text: str) -> float:
    value = positive(text)
    if value > LONGEST:
        raise argparse.ArgumentTypeError(f"{text.strip()} s is longer than the limit of {LONGEST:g} s")
    return value


def seed(text: str) -> int:
    if not re.fullmatch(r"\d{1,18}", text):
        raise argparse.ArgumentTypeError(f"{text.strip()!r} is not a whole number from 0 to 10^18")
    return int(text)


def count(text: str) -> int:
    if not re.fullmatch(r"0*[1-9]\d{0,8}", text):
        raise argparse.ArgumentTypeError(f"{text.strip()!r} is not a whole number from 1 to 10^9")
    return int(text)


def point(text: str) -> tuple[float, float]:
    parts = text.split(",")
    if len(parts) != 2:
        raise argparse.ArgumentTypeError(
            f"{text.strip()!r} is not a point; write X,Y without a space, e.g. 2,-1.5"
        )
    return finite(parts[0]), finite(parts[1])


def package(text: str) -> tuple[str, str]:
    name, _, folder = text.partition("=")
    if not name or not folder:
        raise argparse.ArgumentTypeError(f"{text.strip()!r} is not a package; write NAME=FOLDER")
    return name, folder


def folder(text: str) -> Path:
    path = Path(text)
    if not is_there(path) or not path.is_dir():
        raise WrongUse(f"{short(text)}: no such folder")
    return path


def one_of(what: str, offers: Collection[str]) -> Callable[[str], str]:
    """What takes one of some names, and says which there are where it is none of them."""

    def chosen(text: str) -> str:
        if text not in offers:
            raise unknown(what, text, offers)
        return text

    return chosen


driver = one_of("driver", DRIVERS)
sensing = one_of("sensing", SENSINGS)
sensors = one_of("sensors", SENSORS)
lesson_named = one_of("lesson", LESSONS)
distribution = one_of("distribution", ("qp", "lp"))
plant = one_of("plant", PLANTS)
book_task = one_of("task of books", BOOK_TASKS)


def delay_of(text: str) -> float:
    value = finite(text)
    if not 0.0 <= value <= 40.0:
        raise argparse.ArgumentTypeError(f"{text.strip()!r} is not a delay from 0 to 40 ms")
    return value


def fault(text: str) -> tuple[str, str, str, float]:
    """Kind, leg, joint (empty where none is named) and time of KIND[:LEG[:JOINT]]@T."""
    parts, at, time = text.rpartition("@")
    kind, leg, joint, *more = [*parts.split(":"), "", ""]
    if not at or any(more):
        raise argparse.ArgumentTypeError(
            f"{text.strip()!r} is not a fault; write KIND[:LEG[:JOINT]]@T, e.g. motor-dead:FL:knee@2"
        )
    if kind not in FAULTS:
        raise unknown("fault", kind, FAULTS)
    seconds = finite(time)
    if seconds < 0.0:
        raise argparse.ArgumentTypeError(f"a fault begins at a time that is not negative, not {seconds:g}")
    return kind, leg, joint, seconds


def integrator(text: str) -> str:
    if text not in INTEGRATORS:
        raise unknown("integrator", text, INTEGRATORS)
    return text
