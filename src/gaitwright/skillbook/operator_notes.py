"""A terrain operator as a skillbook holds it: a rule of type III, with its numbers per metre of obstacle."""

from collections.abc import Sequence
from typing import Annotated

from msgspec import Meta

from gaitwright.knowledge.json_form import Label, Strict, Text

MOST = 256
"""Operators in a book."""
Number = Annotated[float, Meta(ge=-1e4, le=1e4)]
Share = Annotated[tuple[Number, ...], Meta(min_length=1, max_length=256)]
"""A number for each of some even shares of the swing."""


class OperatorNotes(Strict, frozen=True, omit_defaults=True):
    """Rows as `gait.operators.Operator` has them, column by column."""

    name: Label
    kinds: Annotated[tuple[Label, ...], Meta(min_length=1, max_length=16)]
    largest: Annotated[float, Meta(gt=0.0, le=100.0)]
    path: tuple[Share, Share]
    force: tuple[Share, Share, Share]
    duration: Annotated[float, Meta(gt=0.0, le=100.0)]
    landing: Number = 0.0
    taught: Text = ""


def fault_in(operators: Sequence[OperatorNotes]) -> str:
    """Why a book cannot hold these, as a sentence; empty: it can."""
    if len(operators) > MOST:
        return f"it holds {len(operators)} terrain operators; {MOST} is the most"
    names = [operator.name for operator in operators]
    if len(set(names)) < len(names):
        return "it holds two terrain operators of one name"
    return ""
