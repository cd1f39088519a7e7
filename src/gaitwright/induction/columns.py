"""What a condition may be about: measured numbers, their sizes, comparisons of two, and names.

A fact is a number with a unit or a name out of a few. From these come the columns that rules bound: each
number as it is, the size of a signed one, of two numbers of one unit the larger and the difference, the time
that a way takes at a speed, and for each name (or group of names) whether it is that.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.errors import WrongUse

Fact = str | float
WAY, SPEED = "way", "speed"
"""Kinds of numbers whose ratio is a time."""
SIZE_BITS, PAIR_BITS = 1.0, 2.0
"""Bits that a size and a comparison of two numbers cost beside their name."""
LEAST_SPEED = 0.02
"""Slower counts as so slow where a way is divided by a speed."""


@dataclass(frozen=True, slots=True)
class Quantity:
    """A measured number.

    `kind` says which others it may be compared with (none where it is empty); `signed` that its size alone
    may matter; `known` are bounds that have a name; `said` is how a sentence speaks of it (by its name).
    """

    name: str
    unit: str = ""
    kind: str = ""
    signed: bool = False
    known: tuple[float, ...] = ()
    said: str = ""


@dataclass(frozen=True, slots=True)
class Names:
    """A fact that is one of a few names; `groups` are sets of them that a rule may ask for at once."""

    name: str
    values: tuple[str, ...]
    groups: Mapping[str, tuple[str, ...]] = field(default_factory=dict, hash=False)


@dataclass(frozen=True, slots=True)
class Column:
    """One thing that can be bounded: a number read from one or two facts.

    `form` is "is" (the number itself), "size", "larger", "difference", "time", or the name or group that a
    fact is asked for.
    """

    name: str
    form: str
    sources: tuple[str, ...]
    price: float = 0.0
    known: tuple[float, ...] = ()
    unit: str = ""
    values: tuple[str, ...] = ()
    """The names for which the column is 1, of a fact that is a name."""
    said: str = ""
    """How a sentence speaks of it."""

    def read(self, facts: Mapping[str, Fact]) -> float:
        """The column's number; NaN where a fact was not measured."""
        given = [facts.get(source) for source in self.sources]
        if self.values:
            return float("nan") if given[0] is None else float(given[0] in self.values)
        numbers = [float("nan") if fact is None or isinstance(fact, str) else float(fact) for fact in given]
        return FORMS[self.form](*numbers)


FORMS: dict[str, Callable[..., float]] = {
    "is": lambda x: x,
    "size": lambda x: abs(x) + 0.0,
    "larger": lambda x, y: float(np.maximum(x, y)),
    "difference": lambda x, y: x - y,
    "time": lambda way, speed: way / max(speed, LEAST_SPEED),
}


@dataclass(frozen=True)
class Vocabulary:
    """All columns of some facts, in order; kernels know them by their places."""

    facts: tuple[Quantity | Names, ...]
    columns: tuple[Column, ...] = field(init=False)
    reads: Bool[np.ndarray, "columns facts"] = field(init=False, repr=False, compare=False)
    price: Float[np.ndarray, " columns"] = field(init=False, repr=False, compare=False)
    plain: np.ndarray = field(init=False, repr=False, compare=False)
    """Places of the columns that are one measured number each."""
    known: tuple[tuple[float, ...], ...] = field(init=False, repr=False, compare=False)
    places: Mapping[str, int] = field(init=False, repr=False, compare=False)
    """The place of each column by its name: names are what files and people know."""

    def __post_init__(self) -> None:
        """Derives the columns. Raises `WrongUse` for two facts of one name."""
        names = [fact.name for fact in self.facts]
        if len(set(names)) < len(names):
            raise WrongUse(f"two facts have one name, of {', '.join(names)}")
        columns = columns_of(self.facts)
        derive = object.__setattr__
        derive(self, "columns", columns)
        derive(self, "reads", np.array([[name in c.sources for name in names] for c in columns]))
        derive(self, "price", np.array([c.price for c in columns]))
        derive(self, "plain", np.flatnonzero([c.form == "is" and not c.values for c in columns]))
        derive(self, "known", tuple(c.known for c in columns))
        derive(self, "places", {c.name: k for k, c in enumerate(columns)})

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the facts."""
        return tuple(fact.name for fact in self.facts)

    def row(self, facts: Mapping[str, Fact]) -> Float[np.ndarray, " columns"]:
        """Every column's number for what was measured; NaN where something was not."""
        return np.array([column.read(facts) for column in self.columns])

    def place_of(self, fact: str) -> int:
        """The place of a fact by its name. Raises `WrongUse` naming the facts there are."""
        try:
            return self.names.index(fact)
        except ValueError:
            raise WrongUse(f"no fact {fact!r}; there are: {', '.join(self.names)}") from None


def columns_of(facts: Sequence[Quantity | Names]) -> tuple[Column, ...]:
    """The columns of facts: plain ones first, then sizes, comparisons of two, and names.

    Names come last, so that a further fact with names moves no column from its place.
    """
    numbers = [fact for fact in facts if isinstance(fact, Quantity)]
    plain = [Column(q.name, "is", (q.name,), 0.0, q.known, q.unit, said=spoken_of(q)) for q in numbers]
    sizes = [size_of(q) for q in numbers if q.signed]
    named = [column for fact in facts if isinstance(fact, Names) for column in named_columns(fact)]
    pairs = [column for a, b in combinations(numbers, 2) for column in compared(a, b)]
    return (*plain, *sizes, *pairs, *named)


def spoken_of(q: Quantity) -> str:
    """How a sentence speaks of a number."""
    return q.said or q.name


def size_of(q: Quantity) -> Column:
    """How large a signed number is, whichever its sign."""
    known = tuple(sorted({abs(bound) for bound in q.known} - {0.0}))
    said = f"the size of {spoken_of(q)}"
    return Column(f"size of {q.name}", "size", (q.name,), SIZE_BITS, known, q.unit, said=said)


def named_columns(fact: Names) -> list[Column]:
    """A column for each name and each group of names."""
    asked = {value: (value,) for value in fact.values} | dict(fact.groups)
    return [
        Column(f"{fact.name} is {name}", name, (fact.name,), values=values) for name, values in asked.items()
    ]


def compared(a: Quantity, b: Quantity) -> list[Column]:
    """The comparisons of two numbers that make sense."""
    if a.kind and a.kind == b.kind and a.unit == b.unit:
        pair, unit, said = (a.name, b.name), a.unit, (spoken_of(a), spoken_of(b))
        names = f"larger of {a.name} and {b.name}", f"{a.name} less {b.name}"
        return [
            Column(names[0], "larger", pair, PAIR_BITS, (), unit, said=f"the larger of {' and '.join(said)}"),
            Column(names[1], "difference", pair, PAIR_BITS, (), unit, said=" less ".join(said)),
        ]
    for way, speed in ((a, b), (b, a)):
        if (way.kind, speed.kind) == (WAY, SPEED):
            said = f"{spoken_of(way)} over {spoken_of(speed)}"
            pair = (way.name, speed.name)
            return [Column(f"{way.name} over {speed.name}", "time", pair, PAIR_BITS, said=said)]
    return []
