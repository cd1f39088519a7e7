"""Torque profiles for people: `gaitwright skills --profile` shows one, `books edit` takes it back edited."""

import json
import re
from argparse import Namespace

import numpy as np

from gaitwright.cli.book_files import skillbook_of
from gaitwright.cli.console import remark, show_table, working
from gaitwright.cli.output import settled, write_json, write_whole
from gaitwright.cli.trips import find_robot, has
from gaitwright.control.learned.profile import Profile
from gaitwright.errors import WrongUse, short, unknown
from gaitwright.files import content_of, text_of
from gaitwright.learning.profile_books import in_book, notes_of
from gaitwright.learning.profile_csv import asked_in, edited, written
from gaitwright.learning.profile_school import STARTS, Task, Try, tried
from gaitwright.model.robot import Robot
from gaitwright.skillbook.profile_notes import name_of
from gaitwright.skillbook.writer import open_for_learning
from gaitwright.skills.library import find_skill, meant

MAX_CSV = 1_000_000
HEAD = ("", "stayed up", "held", "played")


# --- showing ---------------------------------------------------------------------------------------
def show(robot: Robot, args: Namespace) -> None:
    """Draws a profile, or writes its table, where `--out` says."""
    if args.skillbook is None:
        raise WrongUse("--profile SKILL and --skillbook BOOK go together: the profiles are in a book")
    skill = find_skill(args.profile, robot).name
    cells = cells_of(robot, args.skillbook, skill)
    forward, left, turn = meant(find_skill(skill, robot), robot)
    way = find_skill(skill, robot).way
    if args.speed is not None:
        forward, left = args.speed * way[0], args.speed * way[1]
    wanted = (forward, left, turn if args.turn is None else args.turn)
    profile = nearest(cells, wanted)
    plain = nearest([cell for cell in cells if not cell.edited], wanted)
    name = re.sub(r"[^A-Za-z0-9_-]+", "-", f"{robot.name}-{skill}")
    path = settled(args.out or f"runs/profile-{name}.png", "--out")
    if path.suffix.lower() == ".csv":
        write_whole(path, written(robot, profile))
        remark(f"table: {path}; edit its torques, then: gaitwright books edit {args.skillbook} {path}")
    elif path.suffix.lower() != ".png":
        raise WrongUse(f"--out {path}: a picture ends in .png, a table in .csv")
    elif has("matplotlib", "the picture", "plot"):
        with working("drawing the profile", worth_a_line=False):
            from gaitwright.pictures.profile import profile_picture  # noqa: PLC0415 - an extra

            profile_picture(robot, profile, path, plain if profile.edited else None)
        remark(f"picture: {path}")


def cells_of(robot: Robot, path: str, skill: str) -> list[Profile]:
    """The profiles of a skill in a book. Raises `WrongUse` naming those that there are."""
    found = in_book(skillbook_of(path), robot, short(path))
    if skill not in found:
        raise unknown(f"profile in {short(path)}", skill, found)
    return found[skill]


def nearest(cells: list[Profile], command: tuple[float, float, float]) -> Profile:
    """The profile nearest to a velocity; of two at one place the edited one, which comes later."""
    far = [float(np.linalg.norm(np.subtract(cell.command, command)).round(6)) for cell in cells]
    return cells[len(far) - 1 - far[::-1].index(min(far))]


# --- editing ---------------------------------------------------------------------------------------
def edit(args: Namespace) -> None:
    """Takes what a person changed in a profile's table into the book, once it was seen in physics."""
    path, table = args.files
    book, content = skillbook_of(path), text_of(content_of(table, "profile", MAX_CSV), short(table))
    robot = find_robot(book.robot or "go2")
    skill, command = asked_in(content, short(table))
    cells = cells_of(robot, path, skill)
    plain = nearest([cell for cell in cells if not cell.edited], command)
    new = edited(robot, plain, content, short(table))
    with working(f"{skill} in physics, as it was and as it is now", worth_a_line=None):
        before, after = (tried(Task(robot, skill), [cell]) for cell in (plain, new))
    if args.json != "-":
        remark(f"{skill}: {new.edited}")
        show_table(HEAD, [row_of("as it was", before), row_of("edited", after)], right=HEAD[1:])
    notes = notes_of(new)
    figures = {"profile": name_of(notes), "changed": new.edited, "before": before._asdict()}
    write_json(args.json, json.dumps(figures | {"after": after._asdict(), "kept": args.accept}, indent=2))
    if after.kept_up < before.kept_up:
        raise WrongUse(f"{skill} falls with the edited profile where it did not before: it is not taken in")
    if not args.accept:
        remark("nothing is changed yet: add --accept to take it in")
        return
    with open_for_learning(path) as ledger:
        others = [known for known in ledger.book.profiles if name_of(known) != name_of(notes)]
        ledger.keep_profiles([*others, notes])
    remark(f"{path} plays it from now on; gaitwright books forget {path} '{name_of(notes)}' takes it back")


def row_of(what: str, found: Try) -> tuple[str, ...]:
    return what, f"{found.kept_up} of {STARTS}", f"{found.held:.1%}", f"{found.played:.0%}"


def forget(path: str, name: str) -> bool:
    """Takes an edited profile out of a book again; whether there was one of that name."""
    if name not in {name_of(known) for known in skillbook_of(path).profiles if known.edited}:
        return False
    with open_for_learning(path) as ledger:
        ledger.keep_profiles([known for known in ledger.book.profiles if name_of(known) != name])
    remark(f"{path} plays {name.removesuffix(' edited')} as it was taught")
    return True
