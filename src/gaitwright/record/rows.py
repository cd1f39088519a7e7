"""Rows of numbers, of which there may be millions: the newest in memory, older ones in a file without a name.

A run of a minute or so stays in memory. The file of a longer one is never seen in a folder: the system takes
it away when nobody holds it any more, however the run ends. In the file are blocks of `BLOCK` rows, each
column by column, so that one channel is read without its neighbours.
"""

import os
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from io import FileIO
from typing import Any, Protocol, runtime_checkable

import numpy as np

from gaitwright.errors import NoRoom

BLOCK = 1024
"""Rows that go to the file at once."""
IN_MEMORY = 16_000_000
"""What is newest stays in memory [bytes]."""
PART = 65536
"""Ticks that are worked on at once."""


@runtime_checkable
class Series(Protocol):
    """Something for every tick, taken by slices: an array, or `Lazy`."""

    def __len__(self) -> int: ...

    def __getitem__(self, ticks: slice, /) -> Any: ...


@dataclass(frozen=True)
class Lazy:
    """A series whose values are read or worked out when they are taken."""

    length: int
    take: Callable[[slice], np.ndarray]
    """Values of the ticks from `start` to `stop`."""

    def __len__(self) -> int:
        return self.length

    def __getitem__(self, ticks: slice) -> np.ndarray:
        start, stop, _ = ticks.indices(self.length)
        return self.take(slice(start, max(start, stop)))


def parts(length: int, size: int | None = None) -> Iterator[slice]:
    """All ticks, `size` at a time (`PART`)."""
    size = size or PART
    for start in range(0, length, size):
        yield slice(start, min(start + size, length))


def filled(series: Series) -> np.ndarray:
    """All of a series as one array, taken part by part."""
    out = np.empty((len(series), *series[0:0].shape[1:]))
    for part in parts(len(out)):
        out[part] = series[part]
    return out


@dataclass(frozen=True, eq=False)
class Table:
    """Rows of which most are in a file; `table[ticks, columns]` reads them, both slices without a step."""

    file: FileIO
    blocks: int
    """How many are in the file."""
    tail: np.ndarray
    """The rows after them, `(rows, width)`."""
    block: int
    """Rows of a block."""

    def __len__(self) -> int:
        return self.blocks * self.block + len(self.tail)

    @property
    def shape(self) -> tuple[int, int]:
        return len(self), self.tail.shape[1]

    def __getitem__(self, key: tuple[slice, slice]) -> np.ndarray:
        (start, stop, _), (left, right, _) = (k.indices(n) for k, n in zip(key, self.shape, strict=True))
        out = np.empty((max(0, stop - start), right - left))
        filed = self.blocks * self.block
        for begin in range(start - start % self.block, min(stop, filed), self.block):
            first, last = max(start, begin), min(stop, begin + self.block)
            out[first - start : last - start] = self.read(begin, left, right)[
                :, first - begin : last - begin
            ].T
        if stop > filed:
            first = max(start, filed)
            out[first - start :] = self.tail[first - filed : stop - filed, left:right]
        return out

    def read(self, begin: int, left: int, right: int) -> np.ndarray:
        """The columns `(columns, block)` of the block that begins with a row."""
        out = np.empty((right - left, self.block))
        self.file.seek(8 * (begin * self.shape[1] + left * self.block))
        got = self.file.readinto(out.data)
        assert got == out.nbytes, "a file without a name lost what was written to it"
        return out

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        """All of it, in memory."""
        return np.asarray(self[:, :], dtype=dtype)


def first_rows(data: "np.ndarray | Table", length: int) -> "np.ndarray | Table":
    """The first rows of some; those that are left out are in memory."""
    if isinstance(data, Table):
        return Table(data.file, data.blocks, data.tail[: length - data.blocks * data.block], data.block)
    return data[:length]


class Writer:
    """Takes rows, one after the other."""

    def __init__(self, width: int, block: int | None = None) -> None:
        """`block`: rows that go to the file at once, and no more stay in memory (`BLOCK` and `IN_MEMORY`)."""
        self.width = width
        self.block = block or BLOCK
        self.most = block or max(BLOCK, IN_MEMORY // (8 * width))
        self.newest: list[bytes] = []
        """Rows that are in no file."""
        self.file: FileIO | None = None
        self.blocks = 0

    def add(self, row: bytes) -> None:
        """Takes a row of float64. Raises `NoRoom` where older ones cannot be written; all are kept then."""
        self.newest.append(row)
        if len(self.newest) >= self.most + self.block:
            self.write()

    def extend(self, rows: np.ndarray) -> None:
        """Takes some rows `(rows, width)` of float64."""
        for row in rows:
            self.add(row.tobytes())

    def write(self) -> None:
        """Writes the oldest block that is still in memory."""
        block = self.array(self.newest[: self.block]).T.tobytes()
        try:
            if self.file is None:
                self.file = tempfile.TemporaryFile(buffering=0, dir=folder())  # noqa: SIM115 - closed by its last owner
            self.file.seek(self.blocks * len(block))
            written = 0
            while written < len(block):  # a disk that is nearly full takes a part
                written += self.file.write(block[written:])
        except OSError as error:
            raise NoRoom(f"no room for the recording in {folder()}: {error.strerror}") from error
        self.blocks += 1  # with the next line: nothing may come between the two
        del self.newest[: self.block]

    def array(self, rows: list[bytes]) -> np.ndarray:
        """Rows as an array that may be changed."""
        return np.frombuffer(bytearray().join(rows)).reshape(-1, self.width)

    def table(self) -> np.ndarray | Table:
        """What was taken so far: an array while all of it is in memory."""
        newest = self.array(self.newest)
        return newest if self.file is None else Table(self.file, self.blocks, newest, self.block)


def folder() -> str:
    """Where the file is: the folder the environment names, else one that is rarely held in memory."""
    asked = any(os.environ.get(name) for name in ("TMPDIR", "TEMP", "TMP"))
    return tempfile.gettempdir() if asked or not os.access("/var/tmp", os.W_OK) else "/var/tmp"
