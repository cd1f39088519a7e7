"""Channels ↔ `.npz`: as numpy writes and reads it, but a part at a time, so that length costs no memory."""

import math
import os
import struct
import tokenize
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import IO

import msgspec
import numpy as np
from numpy.lib import format as npy

from gaitwright.errors import BadFile, short
from gaitwright.files import fitting, opened_file, whole
from gaitwright.record.rows import BLOCK, PART, Series, parts

HEADER = "header"
MAX_BYTES = 4_000_000_000
"""Of a file; an hour of a robot of four legs has 1.1 GB before it is packed."""
MOST_PACKED, PLENTY = 100, 50_000_000
"""A recording unpacks to at most this many times its size; below so many bytes to anything."""
MAX_HEADER = 1_000_000
MAX_HEAD = 10_000
"""Letters in which an array says what it is."""
WIDE = 16
"""Numbers in a row up to which rows are written `PART` at a time; of wider ones fewer."""
MAX_TICKS = 10_000_000
"""More than a simulated hour at any step of ours."""
BROKEN = (
    OSError,
    ValueError,
    TypeError,
    LookupError,
    EOFError,
    NotImplementedError,
    RecursionError,
    struct.error,
    tokenize.TokenError,
    SyntaxError,
    msgspec.MsgspecError,
    zipfile.BadZipFile,
    zlib.error,
)
"""What reading a file that is none, or a part of one, raises."""


def write_npz(path: Path, header: bytes, channels: Mapping[str, Series]) -> None:
    """Writes some JSON and the channels, compressed; complete or not at all."""
    with fitting(path), whole(path) as draft, zipfile.ZipFile(draft, "w", zipfile.ZIP_DEFLATED) as archive:
        write_array(archive, HEADER, np.frombuffer(header, dtype=np.uint8))
        for name, series in channels.items():
            write_array(archive, name, series)


def write_array(archive: zipfile.ZipFile, name: str, series: Series) -> None:
    """Writes a series as a member that numpy reads as an array."""
    none: np.ndarray = series[0:0]
    shape = (len(series), *none.shape[1:])
    about = {"descr": npy.dtype_to_descr(none.dtype), "fortran_order": False, "shape": shape}
    at_once = PART // max(1, math.prod(none.shape[1:]) // WIDE)
    with archive.open(f"{name}.npy", "w", force_zip64=True) as file:
        npy.write_array_header_1_0(file, about)
        for part in parts(len(series), max(1, at_once)):
            file.write(series[part].tobytes())


@contextmanager
def opened(path: Path) -> Iterator[zipfile.ZipFile]:
    """The archive in a file. Raises `BadFile` for whatever is wrong with it while it is read."""
    name = short(str(path))
    with opened_file(path, "recording", MAX_BYTES) as file:
        try:
            with zipfile.ZipFile(file) as archive:
                check_sizes(archive, os.fstat(file.fileno()).st_size)
                yield archive
        except BROKEN as error:
            raise BadFile(f"{name} is not a recording: {error}") from error


def check_sizes(archive: zipfile.ZipFile, packed: int) -> None:
    """Raises `ValueError` for what unpacks to more than walks do."""
    size = sum(info.file_size for info in archive.infolist())
    if size > max(PLENTY, MOST_PACKED * packed):
        raise ValueError(f"its {packed / 1e6:.3g} MB unpack to {size / 1e6:.3g} MB, which no walk does")


def member(archive: zipfile.ZipFile, name: str) -> IO[bytes] | zipfile.ZipExtFile:
    """An array in the archive, stored or deflated: other ways to pack have limits of their own.
    Raises `KeyError` where there is none, `ValueError` where it is packed otherwise."""
    info = archive.getinfo(f"{name}.npy")
    if info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise ValueError(f"{name} is packed in a way that recordings are not")
    return archive.open(info)


def read_header(archive: zipfile.ZipFile) -> bytes:
    """The JSON that is kept beside the channels. Raises `ValueError` where it is none, or too long."""
    with member(archive, HEADER) as file:
        length = length_of(file, HEADER, (), np.uint8)
        if length > MAX_HEADER:
            raise ValueError(f"its header has {length} bytes; at most {MAX_HEADER} are read")
        return file.read(length)


def holds(archive: zipfile.ZipFile, name: str) -> bool:
    """Whether an archive has an array of that name."""
    return f"{name}.npy" in archive.namelist()


def read_blocks(
    archive: zipfile.ZipFile, shapes: Mapping[str, tuple[int, ...]], optional: tuple[str, ...] = ()
) -> Iterator[np.ndarray]:
    """All rows `(rows, width)`, some at a time, of channels that have such a shape in each row; NaN for
    optional ones that are not there."""
    wanted = [name for name in shapes if name not in optional or holds(archive, name)]
    files = {name: member(archive, name) for name in wanted}
    lengths = {length_of(file, name, shapes[name]) for name, file in files.items()}
    if len(lengths) > 1:
        raise ValueError("its channels differ in length")
    if not 0 < (length := max(lengths)) <= MAX_TICKS:
        raise ValueError(f"it has {length} ticks; expected are 1 to {MAX_TICKS}")
    for part in parts(length, BLOCK):
        sizes = {name: (part.stop - part.start, math.prod(shape)) for name, shape in shapes.items()}
        columns = [
            numbers(files[name], size) if name in files else np.full(size, np.nan)
            for name, size in sizes.items()
        ]
        yield np.concatenate(columns, axis=1)


def length_of(
    file: IO[bytes] | zipfile.ZipExtFile, name: str, row: tuple[int, ...], wanted: type = np.float64
) -> int:
    """How many rows of float64 a member has, by its head. Raises `ValueError` for others than asked for."""
    if npy.read_magic(file) != (1, 0):
        raise ValueError(f"{name} is an array of another version of numpy's format")
    shape, by_column, kind = npy.read_array_header_1_0(file, max_header_size=MAX_HEAD)
    if by_column or kind != wanted or not shape or shape[1:] != row:
        expected = f"{' × '.join(map(str, row)) or 1} of {np.dtype(wanted)} a tick"
        raise ValueError(f"channel {name} is {shape} of {kind}; expected is {expected}")
    return shape[0]


def numbers(file: IO[bytes] | zipfile.ZipExtFile, shape: tuple[int, int]) -> np.ndarray:
    """The next rows of a member. Raises `ValueError` where it ends before."""
    return np.frombuffer(file.read(8 * shape[0] * shape[1])).reshape(shape)
