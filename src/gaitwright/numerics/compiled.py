"""Kernels: functions compiled by numba, kept on disk in a folder that belongs to exactly these sources.

numba checks only the file of the function it loads, not those of the functions it calls, so its own
cache goes stale when a callee in another file changes, or a constant, or a layout. A folder named after all
kernel files and all that they import cannot.
"""

import hashlib
import os
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numba
from numba import njit

settings: Any = vars(numba)["config"]  # its names are set at run time

IMPORTED = re.compile(rb"^from gaitwright\.([\w.]+) import", re.MULTILINE)


def sources_digest() -> str:
    """A name for the state of all files that kernels are made of, from their names, sizes and times."""
    root = Path(__file__).parents[1]
    texts = {path.relative_to(root): path.read_bytes() for path in root.rglob("*.py")}
    digest = hashlib.sha256()
    for path in sorted(made_of(texts)):
        digest.update(f"{path} {(root / path).stat().st_mtime_ns} {len(texts[path])}\n".encode())
    return digest.hexdigest()[:16]


def made_of(texts: Mapping[Path, bytes]) -> set[Path]:
    """The files with kernels, and those that they import, and so on: what is in them is compiled in."""
    found: set[Path] = set()
    new = {path for path, text in texts.items() if b"@kernel" in text}
    while new:
        found |= new
        names = {name.decode() for path in new for name in IMPORTED.findall(texts[path])}
        new = {Path(*name.split(".")).with_suffix(".py") for name in names} & texts.keys() - found
    return found


def cache_folder() -> Path:
    """Where the compiled kernels of these sources are kept."""
    base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "gaitwright" / "kernels" / sources_digest()


def is_warm(longest: str = "coordinator.coordinate") -> bool:
    """Whether the kernels of these sources were compiled before: asked of the one that takes longest."""
    return any(Path(settings.CACHE_DIR).rglob(f"{longest}-*.nbc"))


if not settings.CACHE_DIR:
    settings.CACHE_DIR = str(cache_folder())

kernel: Callable[[Callable[..., Any]], Callable[..., Any]] = njit(cache=True, error_model="numpy")
"""Marks a function as a kernel: plain arithmetic on arrays and tuples, compiled at its first call."""

kernel_nogil: Callable[[Callable[..., Any]], Callable[..., Any]] = njit(
    cache=True, error_model="numpy", nogil=True
)
"""The same for long work: it lets go of Python's lock, so that threads run it side by side."""
