"""Channels ↔ `.npz`: as numpy writes and reads it, but a part at a time, so that length costs no memory."""

import errno
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import IO

import numpy as np
from numpy.lib import format as npy

from gaitwright.errors import BadFile, NoRoom
from gaitwright.files import whole
from gaitwright.record.rows import BLOCK, Series, parts

HEADER = "header"
BROKEN = (
    OSError,
    ValueError,
    TypeError,
    LookupError,
    EOFError,
    NotImplementedError,
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


@contextmanager
def fitting(path: Path) -> Iterator[None]:
    """Raises `NoRoom` where what is written to `path` meets a full disk."""
    try:
        yield
    except OSError as error:
        if error.errno not in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
            raise
        raise NoRoom(f"no room for {path}: {error.strerror}") from error


def write_array(archive: zipfile.ZipFile, name: str, series: Series) -> None:
    """Writes a series as a member that numpy reads as an array."""
    none: np.ndarray = series[0:0]
    shape = (len(series), *none.shape[1:])
    about = {"descr": npy.dtype_to_descr(none.dtype), "fortran_order": False, "shape": shape}
    with archive.open(f"{name}.npy", "w", force_zip64=True) as file:
        npy.write_array_header_1_0(file, about)
        for part in parts(len(series)):
            file.write(series[part].tobytes())


@contextmanager
def opened(path: Path) -> Iterator[zipfile.ZipFile]:
    """The archive in a file. Raises `BadFile` for whatever is wrong with it while it is read."""
    try:
        with zipfile.ZipFile(path) as archive:
            yield archive
    except BROKEN as error:
        raise BadFile(f"{path} is not a recording: {error}") from error


def read_header(archive: zipfile.ZipFile) -> bytes:
    """The JSON that is kept beside the channels."""
    with archive.open(f"{HEADER}.npy") as file:
        return npy.read_array(file, allow_pickle=False).tobytes()


def read_blocks(
    archive: zipfile.ZipFile, widths: Mapping[str, int], optional: tuple[str, ...]
) -> Iterator[np.ndarray]:
    """All rows `(rows, width)`, some at a time; NaN for optional channels that are not there."""
    held = {name.removesuffix(".npy") for name in archive.namelist()}
    wanted = [name for name in widths if name in held or name not in optional]
    files = {name: archive.open(f"{name}.npy") for name in wanted}
    lengths = {length_of(file, name, widths[name]) for name, file in files.items()}
    if len(lengths) > 1:
        raise ValueError("its channels differ in length")
    for part in parts(max(lengths), BLOCK):
        shapes = {name: (part.stop - part.start, width) for name, width in widths.items()}
        columns = [
            numbers(files[name], shape) if name in files else np.full(shape, np.nan)
            for name, shape in shapes.items()
        ]
        yield np.concatenate(columns, axis=1)


def length_of(file: IO[bytes] | zipfile.ZipExtFile, name: str, width: int) -> int:
    """How many rows of float64 a member has, by its head. Raises `ValueError` where it is not as wide."""
    npy.read_magic(file)
    shape, by_column, kind = npy.read_array_header_1_0(file)
    if by_column or kind != np.float64 or shape != shape[:1] + (() if width == 1 else (width,)):
        raise ValueError(f"channel {name} is {shape} of {kind}; expected is {width} of float64 a tick")
    return shape[0]


def numbers(file: IO[bytes] | zipfile.ZipExtFile, shape: tuple[int, int]) -> np.ndarray:
    """The next rows of a member. Raises `ValueError` where it ends before."""
    return np.frombuffer(file.read(8 * shape[0] * shape[1])).reshape(shape)
