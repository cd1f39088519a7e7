"""Many small arrays in one row of numbers: one table says which, and packs, views and names its columns.

Why rows: a kernel called from Python costs per argument and per array handed back, 0.2 to 1 µs each, and a
tick hands forty arrays to and fro; one row costs what one array does. The table is a `NamedTuple` or a frozen
dataclass whose annotations say the shapes; the number of legs is the one length that differs from robot to
robot, and follows from the length of a row.
"""

from collections import namedtuple
from collections.abc import Callable, Iterable
from dataclasses import dataclass, fields, is_dataclass
from functools import cached_property
from math import prod
from typing import Any, ClassVar, TypeVar

import numpy as np
from jaxtyping import Float
from numba.extending import register_jitable

from gaitwright.numerics.parts import lent

Row = Float[np.ndarray, "numbers"]


@dataclass(frozen=True)
class Column:
    """One field of a row; `start` and `size` as (constant, per leg)."""

    name: str
    shape: tuple[str, ...]
    """Lengths, numbers or terms in "legs"; none: a single number."""
    is_bool: bool
    start: tuple[int, int]
    size: tuple[int, int]

    def code(self, raw: bool = False) -> str:
        """The field out of `row` for `n` legs, as source.

        A view, but for single numbers and truths; all are views where `raw`.
        """
        start = f"{self.start[0]} + {self.start[1]} * n"
        if not self.shape and not raw:
            return f"float(row[{start}])"
        shape = ", ".join(self.shape or ("1",)).replace("legs", "n")
        view = f"lent(row, {start}, ({shape},))"
        return f"({view} > 0.5)" if self.is_bool and not raw else view


@dataclass(frozen=True)
class Layout:
    """The columns of a packed row."""

    columns: tuple[Column, ...]

    @classmethod
    def of(cls, table: type, **lengths: int) -> "Layout":
        """The layout of a `NamedTuple` or dataclass; fields without a numeric annotation are left out.

        `lengths`: what other words than "legs" in its shapes stand for.
        """
        columns: list[Column] = []
        start = (0, 0)
        for name, annotation in numeric_fields(table):
            words = getattr(annotation, "dim_str", "").split()
            shape = tuple(str(lengths.get(word, word)) for word in words)
            size = linear(shape)
            is_bool = "bool" in getattr(annotation, "dtypes", ())
            columns.append(Column(name, shape, is_bool, start, size))
            start = (start[0] + size[0], start[1] + size[1])
        return cls(tuple(columns))

    @cached_property
    def length(self) -> tuple[int, int]:
        """Numbers in a row: (constant, per leg)."""
        last = self.columns[-1]
        return last.start[0] + last.size[0], last.start[1] + last.size[1]

    def size(self, legs: int) -> int:
        """Numbers in a row of a robot with so many legs."""
        return self.length[0] + self.length[1] * legs

    def slices(self, legs: int) -> dict[str, slice]:
        """Where each field stands in a row of a robot with so many legs."""
        out = {}
        for column in self.columns:
            start = column.start[0] + column.start[1] * legs
            out[column.name] = slice(start, start + column.size[0] + column.size[1] * legs)
        return out

    def views(self, build: Callable[..., Any] | None = None, raw: bool = False) -> Callable[[Row], Any]:
        """A function row → all fields, by name, or as `build` makes of them; kernels can call it, with rows
        that they were handed (`numerics.parts.lent`).

        `raw`: all of them views that can be written to, truths as 1 and 0, single numbers as arrays of one.
        """
        build = build or namedtuple("Fields", [column.name for column in self.columns])
        parts = ", ".join(column.code(raw) for column in self.columns)
        return compiled_source(f"return build({parts})", self, build)

    def field(self, name: str) -> Callable[[Row], Any]:
        """A function row → one field; kernels can call it."""
        return compiled_source(f"return {self.named(name).code()}", self)

    def start(self, name: str) -> Callable[[Row], int]:
        """A function row → where a field begins; kernels can call it."""
        a, b = self.named(name).start
        return compiled_source(f"return {a} + {b} * n", self)

    def empty(self) -> Callable[[int], Row]:
        """A function number of legs → a row with room for the fields; kernels can call it."""
        a, b = self.length
        return jitable(f"def new(n):\n    return empty({a} + {b} * n)\n", "new", {"empty": np.empty})

    def legs(self) -> Callable[[Row], int]:
        """A function row → the number of legs; kernels can call it."""
        return compiled_source("return n", self)

    def named(self, name: str) -> Column:
        """The column of a field."""
        return next(column for column in self.columns if column.name == name)

    def pack(self, values: Iterable[Any]) -> Row:
        """The fields, in order, in one new row."""
        return np.concatenate([np.asarray(value, dtype=np.float64).ravel() for value in values])


def numeric_fields(table: type) -> list[tuple[str, Any]]:
    """Name and annotation of the fields that go into a row: arrays with a shape, and floats."""
    if is_dataclass(table):
        pairs = [(field.name, field.type) for field in fields(table)]
    else:
        pairs = list(table.__annotations__.items())
    return [(name, of) for name, of in pairs if of is float or hasattr(of, "dim_str")]


def linear(shape: tuple[str, ...]) -> tuple[int, int]:
    """Numbers in an array of that shape: (constant, per leg)."""
    none, one, two = (
        prod(int(eval(length, {"__builtins__": {}}, {"legs": legs})) for length in shape)
        for legs in (0, 1, 2)
    )
    assert two - one == one - none, f"{shape} does not grow evenly with the legs"
    return none, one - none


def compiled_source(body: str, layout: Layout, build: Callable[..., Any] | None = None) -> Callable[..., Any]:
    """A small function of a row, written from a layout: its offsets are constants to the compiler."""
    constant, per_leg = layout.length
    legs = f"n = (row.size - {constant}) // {per_leg}\n    " if per_leg else ""
    return jitable(f"def read(row):\n    {legs}{body}\n", "read", {"build": build, "lent": lent})


def jitable(source: str, name: str, space: dict[str, Any]) -> Callable[..., Any]:
    """The function of that name in some source, for Python and for kernels."""
    exec(source, space)
    return register_jitable(space[name])


P = TypeVar("P", bound="Packed")
new, put = object.__new__, object.__setattr__


class Packed:
    """A frozen dataclass that may come as one row; its fields are views of it, made when they are asked for.

    `of_row` makes one of a row that nobody changes any more; `row` is that of a value made field by field.
    Of a class without slots, fields that are no numbers may be left out where they have a default.
    """

    __slots__ = ("row",)
    row: Row
    """All numbers in one row."""
    layout: ClassVar[Layout]
    readers: ClassVar[dict[str, Callable[[Row], Any]]]

    @classmethod
    def of_row(cls: type[P], row: Row, **others: Any) -> P:
        """The value in a row; `others`: fields that are no numbers."""
        value = new(cls)
        put(value, "row", row)
        if others:
            for name, other in others.items():
                put(value, name, other)
        return value

    def __getattr__(self, name: str) -> Any:
        """A field whose view was not made yet, or the row of a value made field by field."""
        reader = type(self).readers.get(name)
        if reader is not None:
            value = reader(object.__getattribute__(self, "row"))
        elif name == "row":
            value = self.layout.pack(getattr(self, column.name) for column in self.layout.columns)
        else:
            raise AttributeError(f"{type(self).__name__} has no {name!r}")
        object.__setattr__(self, name, value)
        return value


T = TypeVar("T", bound=type[Packed])


def packed(table: T) -> T:
    """Gives a dataclass below `Packed` its layout and readers."""
    table.layout = Layout.of(table)
    table.readers = {column.name: table.layout.field(column.name) for column in table.layout.columns}
    for column in table.layout.columns:
        if isinstance(vars(table).get(column.name), float):
            delattr(table, column.name)  # a default on the class would hide what is in the row
    return table
