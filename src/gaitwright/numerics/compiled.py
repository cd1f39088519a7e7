"""Kernels: functions compiled by numba, kept on disk in a folder that belongs to exactly these sources.

numba checks only the file of the function it loads, not those of the functions it calls, so its own
cache goes stale when a callee in another file changes. A folder named after all kernel files cannot.
"""

import hashlib
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
from numba import njit

settings: Any = vars(numba)["config"]  # its names are set at run time


def sources_digest() -> str:
    """A name for the state of all files that hold kernels, from their names, sizes and times."""
    root = Path(__file__).parents[1]
    digest = hashlib.sha256()
    for path in sorted(root.rglob("*.py")):
        text = path.read_bytes()
        if b"@kernel" in text:
            digest.update(f"{path.relative_to(root)} {path.stat().st_mtime_ns} {len(text)}\n".encode())
    return digest.hexdigest()[:16]


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
