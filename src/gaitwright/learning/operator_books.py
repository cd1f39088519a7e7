"""Terrain operators ↔ skillbook, and how one reads as a rule of type III."""

import numpy as np

from gaitwright.errors import BadFile, WrongUse
from gaitwright.gait.operators import SHARES, Operator
from gaitwright.model.robot import Robot
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.operator_notes import OperatorNotes


def notes_of(operator: Operator) -> OperatorNotes:
    """An operator as a book holds it."""
    shift, height = (tuple(map(float, column)) for column in operator.path.T)
    x, y, z = (tuple(map(float, column)) for column in operator.force.T)
    own = (operator.duration, operator.landing, operator.taught)
    return OperatorNotes(operator.name, operator.kinds, operator.largest, (shift, height), (x, y, z), *own)


def operator_of(notes: OperatorNotes, source: str) -> Operator:
    """The operator that a book holds. Raises `BadFile` where it is none."""
    if {len(column) for column in (*notes.path, *notes.force)} != {SHARES}:
        raise BadFile(f"{source}: operator {notes.name!r} has not the {SHARES} rows of a swing")
    try:
        path, force = (np.array(columns).T for columns in (notes.path, notes.force))
        own = (notes.duration, notes.landing, notes.taught)
        return Operator(notes.name, notes.kinds, notes.largest, path, force, *own)
    except WrongUse as error:
        raise BadFile(f"{source}: {error}") from None


def operators_in(book: Skillbook, robot: Robot, source: str) -> tuple[Operator, ...]:
    """The operators of a book, in the order in which they are tried; none for another robot than it was
    taught on. Raises `BadFile`."""
    if book.robot != robot.name:
        return ()
    return tuple(operator_of(notes, source) for notes in book.operators)


def sentence(operator: Operator) -> str:
    """The rule, as it reads."""
    kinds = [f"a {kind}" for kind in operator.kinds]
    listed = kinds[0] if len(kinds) == 1 else f"{', '.join(kinds[:-1])} or {kinds[-1]}"
    size = f"{operator.largest:.2f}" if operator.kinds == ("slope",) else f"{100 * operator.largest:.1f} cm"
    return (
        f"if {listed} of up to {size} is ahead of a leg, it {operator.strategy}: {done(operator)}; "
        f"taught {operator.taught}"
    )


def done(operator: Operator) -> str:
    """What an operator does, per centimetre of the obstacle."""
    parts = []
    peak = float(operator.path[:, 1][np.abs(operator.path[:, 1]).argmax()])
    if abs(peak) > 0.005:
        parts.append(f"the foot is {'raised' if peak > 0.0 else 'lowered'} by {abs(peak):.2f} cm")
    if abs(operator.landing) > 0.005:
        way = "farther" if operator.landing > 0.0 else "nearer"
        parts.append(f"lands {abs(operator.landing):.2f} cm {way}")
    force = float(np.linalg.norm(operator.force, axis=1).max()) / 100.0
    more = f"takes up to {force:.1f} N more"
    return f"per cm that it reaches into the way of the foot {' and '.join([*parts, more])}"
