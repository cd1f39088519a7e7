"""`gaitwright operators`: the terrain operators of a skillbook, shown, taught, ordered, taken out again."""

import json
from argparse import Namespace
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from gaitwright.cli.book_files import skillbook_of
from gaitwright.cli.console import remark, show_prose, show_table, working
from gaitwright.cli.output import check_json, settled, write_json
from gaitwright.cli.trips import find_robot, has
from gaitwright.control.learned.profile import Profile
from gaitwright.control.takeover import LEARNED, NUMERICAL
from gaitwright.errors import WrongUse, short, unknown
from gaitwright.gait.leg_cycles.files import load_cycle
from gaitwright.gait.operators import Operator
from gaitwright.learning.operator_books import notes_of, operators_in, sentence
from gaitwright.learning.operator_lessons import RAISED, SHOWN_ON, Edit, learned_from
from gaitwright.learning.operator_trials import Reached, Swung, swung
from gaitwright.learning.profile_books import in_book
from gaitwright.model.robot import Robot
from gaitwright.record.channels import OPERATOR, REACH
from gaitwright.record.recording import load
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.writer import open_for_learning
from gaitwright.skills.library import find_skill

TEACHING = ("kind", "skill", "leg", "cycle", "landing", "name")
"""Options that say what is taught."""
TRIED_ON = ("trot", "walk")
"""Skills in which a new operator is tried, on every leg."""
HEAD = ("skill", "leg", "driver", "usual height", "asked", "reached", "share")


def run(args: Namespace) -> int:
    check_json(args.json)
    check(args)
    book = skillbook_of(args.book)
    robot = find_robot(book.robot or "go2")
    known = operators_in(book, robot, short(args.book))
    figures: dict = {"book": args.book}
    if args.size is not None:
        figures |= teach(robot, book, args)
    elif args.first is not None or args.forget is not None:
        known = changed(known, args)
    elif args.recording is not None:
        figures["legs"] = tell_recorded(known, args)
    else:
        tell(known, args)
    figures["operators"] = [facts_of(one) for one in known]
    if args.out is not None:
        picture(robot, known, args)
    write_json(args.json, json.dumps(figures, indent=2, ensure_ascii=False))
    return 0


def check(args: Namespace) -> None:
    """`WrongUse` for options that do not go together."""
    loose = [f"--{name}" for name in TEACHING if getattr(args, name) is not None]
    loose += ["--accept"] * args.accept
    if args.size is None and loose:
        raise WrongUse(f"{loose[0]} says what is taught: add --size, how large the obstacle is")
    if args.at is not None and args.recording is None:
        raise WrongUse("--at is a moment of a recording: name its file with --recording")
    single = ("size", "first", "forget", "recording", "out")
    asked = [f"--{name}" for name in single if getattr(args, name) is not None]
    if len(asked) > 1:
        raise WrongUse(f"one thing at a time: {' and '.join(asked)} do not go together")


# --- showing ---------------------------------------------------------------------------------------
def tell(known: Sequence[Operator], args: Namespace) -> None:
    """The rules, in the order in which they are tried."""
    aside = args.json == "-"
    if not known:
        remark(f"{short(args.book)} has no terrain operators; {how_taught(args.book)}")
    for number, one in enumerate(known, start=1):
        show_prose(f"{number}. {one.name}: {sentence(one)}.", 2, to_stderr=aside)


def how_taught(path: str) -> str:
    return f"`gaitwright operators {short(path)} --size 0.06 --accept` teaches one"


def facts_of(one: Operator) -> dict:
    return {
        "name": one.name,
        "kinds": one.kinds,
        "largest_m": one.largest,
        "landing": one.landing,
        "strategy": one.strategy,
        "taught": one.taught,
        "sentence": sentence(one),
    }


def picture(robot: Robot, known: Sequence[Operator], args: Namespace) -> None:
    """The operators as PNG."""
    path = settled(args.out, "--out")
    if path.suffix.lower() != ".png":
        raise WrongUse(f"--out {path}: a picture ends in .png")
    if not known:
        raise WrongUse(f"there is nothing to draw: {short(args.book)} has no terrain operators")
    if has("matplotlib", "the picture", "plot"):
        with working("drawing the operators", worth_a_line=False):
            from gaitwright.pictures.operators import operators_picture  # noqa: PLC0415 - an extra

            operators_picture(robot, known, path)
        remark(f"picture: {path}")


# --- what was done -----------------------------------------------------------------------------------
def tell_recorded(known: Sequence[Operator], args: Namespace) -> list[dict]:
    """Which legs were under which operator, at a moment or in the whole trip."""
    recording = load(args.recording).of_trip()
    numbers, reach = recording[OPERATOR], recording[REACH]
    if np.isnan(numbers).all():
        raise WrongUse(f"{short(args.recording)} was made before there were terrain operators")
    if args.at is not None:
        time = recording["time"]
        if not time[0] <= args.at <= time[-1]:
            raise WrongUse(f"--at {args.at:g}: the recording goes from {time[0]:g} to {time[-1]:g} s")
        tick = int(np.abs(time - args.at).argmin())
        numbers, reach = numbers[tick : tick + 1], reach[tick : tick + 1]
    found = [
        {"leg": leg, "operator": name_of(number, known), "ticks": int(here.sum()), "reach_m": float(far)}
        for k, leg in enumerate(recording.robot.legs)
        for number in np.unique(numbers[:, k][numbers[:, k] != 0.0])
        for here in [numbers[:, k] == number]
        for far in [reach[here, k].max()]
    ]
    if args.json != "-":
        rows = [(f["leg"], f["operator"], str(f["ticks"]), f"{100.0 * f['reach_m']:.1f} cm") for f in found]
        remark("no leg was under an operator" if not rows else f"legs under an operator in {args.recording}:")
        show_table(("leg", "operator", "ticks", "at most"), rows, right=("ticks", "at most"))
    return found


def name_of(number: float, known: Sequence[Operator]) -> str:
    """What an operator is called that a recording knows by its number."""
    if number < 0.0:
        return "none is for it: left to the numerical controller's law"
    return (
        known[int(number) - 1].name if number <= len(known) else f"number {int(number)}, no more in the book"
    )


# --- changing --------------------------------------------------------------------------------------
def changed(known: Sequence[Operator], args: Namespace) -> tuple[Operator, ...]:
    """The operators in their new order, or without one, once the book holds them so."""
    name = args.first if args.first is not None else args.forget
    if name not in [one.name for one in known]:
        raise unknown(f"operator in {short(args.book)}", name, [one.name for one in known])
    others = [one for one in known if one.name != name]
    moved = [one for one in known if one.name == name] if args.first is not None else []
    keep(args.book, [*moved, *others])
    remark(f"{name} is tried before all others" if moved else f"{name} is out of {short(args.book)}")
    return (*moved, *others)


def keep(path: str, operators: Sequence[Operator]) -> None:
    """Writes operators into a book, in place of those that were in it."""
    with open_for_learning(path) as ledger:
        ledger.keep_operators([notes_of(one) for one in operators])


def teach(robot: Robot, book: Skillbook, args: Namespace) -> dict:
    """What an edit teaches, shown in physics, and taken in where that is asked for."""
    edit = edit_of(robot, args)
    known = operators_in(book, robot, short(args.book))
    with working(f"the edit on {edit.leg or robot.legs[0]} in {edit.skill}, in physics", worth_a_line=None):
        new = learned_from(edit, args.name or "", args.seed)
    rows, fallen = [], []
    with working("the operator on every leg", worth_a_line=None):
        for skill in dict.fromkeys((edit.skill, *TRIED_ON)):
            profiles = tuple(in_book(book, robot, short(args.book)).get(skill, ()))
            found = tried(robot, edit, skill, new, profiles)
            rows += [row_of(robot, skill, LEARNED if profiles else NUMERICAL, one) for one in found]
            fallen += [skill] if any(over.fell for _, _, over in found) else []
    aside = args.json == "-"
    show_prose(f"{new.name}: {sentence(new)}.", 0, to_stderr=aside)
    if not aside:
        show_table(HEAD, rows, right=HEAD[3:])
    figures = {
        "taught": facts_of(new),
        "kept": args.accept,
        "tried": [dict(zip(HEAD, row, strict=True)) for row in rows],
    }
    if fallen:
        raise WrongUse(f"{robot.name} falls with it in {' and '.join(fallen)}: it is not taken in")
    if not args.accept:
        remark("nothing is changed yet: add --accept to take it in")
        return figures
    keep(args.book, [*(one for one in known if one.name != new.name), new])
    out = f"gaitwright operators {short(args.book)} --forget {new.name!r}"
    remark(f"{args.book} has it from now on; {out} takes it out again")
    return figures


def edit_of(robot: Robot, args: Namespace) -> Edit:
    """What is shown."""
    skill = find_skill(args.skill or SHOWN_ON, robot).name
    cycle = load_cycle(args.cycle) if args.cycle else None
    kinds = tuple(args.kind or RAISED)
    return Edit(robot, args.size, skill, args.leg or "", kinds, cycle, args.landing or 0.0)


def tried(
    robot: Robot, edit: Edit, skill: str, new: Operator, profiles: tuple[Profile, ...]
) -> list[tuple[int, Reached, Reached]]:
    """Each leg in a skill, as it swings usually and where it takes the obstacle for seen."""
    usual = [Swung(robot, skill, leg, 0.0, (), profiles) for leg in range(robot.n)]
    over = [replace(one, size=edit.size, operators=(new,)) for one in usual]
    return [(one.leg, swung(one), swung(other)) for one, other in zip(usual, over, strict=True)]


def row_of(robot: Robot, skill: str, driver: str, found: tuple[int, Reached, Reached]) -> tuple[str, ...]:
    leg, usual, over = found
    heights = (f"{100.0 * height:.1f} cm" for height in (usual.reached, over.asked, over.reached))
    return skill, robot.legs[leg], driver, *heights, "fell" if over.fell else f"{over.share:.2f}"
