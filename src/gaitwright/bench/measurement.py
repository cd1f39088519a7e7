"""A figure: what was measured, what is wanted of it, and whether it is reached."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True, slots=True)
class Wanted:
    """A bound on a figure."""

    sign: str
    """≤ or ≥."""
    bound: float

    def holds(self, measured: float) -> bool:
        return measured <= self.bound if self.sign == "≤" else measured >= self.bound


def at_most(bound: float) -> Wanted:
    return Wanted("≤", bound)


def at_least(bound: float) -> Wanted:
    return Wanted("≥", bound)


@dataclass(frozen=True)
class Figure:
    """One line of the table."""

    what: str
    measured: float
    """NaN where it could not be measured; `note` says why."""
    unit: str = ""
    """A unit, or `of 20` for a count."""
    wanted: Wanted | None = None
    """`None` for a figure that is only shown."""
    starts: int = 1
    """How many starts, rounds or runs are behind it."""
    note: str = ""
    """What stands beside it: the spread, the first failure, or why it was not measured."""
    numbers: Mapping[str, Any] = field(default_factory=dict)
    """Every number behind it, as plain JSON values."""

    @property
    def reached(self) -> bool | None:
        """Whether it is as wanted; `None` where nothing is wanted. What was not measured is not reached."""
        if self.wanted is None:
            return None
        return math.isfinite(self.measured) and self.wanted.holds(self.measured)

    @property
    def measured_text(self) -> str:
        """The measured value with its unit."""
        if math.isnan(self.measured):
            return "not measured"
        return f"{shown(self.measured)} {self.unit}".strip()

    @property
    def wanted_text(self) -> str:
        """The bound with its unit."""
        if self.wanted is None:
            return ""
        return f"{self.wanted.sign} {self.wanted.bound:g} {self.unit}".strip()

    @property
    def reached_text(self) -> str:
        """yes, no, or nothing where nothing is wanted."""
        return "" if self.reached is None else "yes" if self.reached else "NO"

    def plain(self) -> dict[str, Any]:
        """As plain JSON values."""
        return {
            "what": self.what,
            "measured": self.measured if math.isfinite(self.measured) else None,
            "unit": self.unit,
            "wanted": self.wanted and {"sign": self.wanted.sign, "bound": self.wanted.bound},
            "reached": self.reached,
            "starts": self.starts,
            "note": self.note,
            "numbers": dict(self.numbers),
        }


def count(
    what: str, good: int, starts: int, least: float | None, note: str, numbers: Mapping[str, Any]
) -> Figure:
    """So many of the starts were good; `least` is the share that is wanted."""
    wanted = None if least is None else at_least(float(math.ceil(least * starts - 1e-9)))
    return Figure(what, float(good), f"of {starts}", wanted, starts, note, numbers)


def shown(value: float) -> str:
    """A number with about three digits."""
    if value == int(value) and abs(value) < 1e6:
        return str(int(value))
    return f"{value:.3g}" if abs(value) < 100 else f"{value:.0f}"
