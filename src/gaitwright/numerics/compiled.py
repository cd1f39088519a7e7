"""Kernels: functions compiled by numba, kept on disk in a folder that belongs to exactly these sources.

numba checks only the file of the function it loads, not those of the functions it calls, so its own
cache goes stale when a callee in another file changes, or a constant, or a layout. A folder named after all
kernel files and all that they import cannot.
"""

import hashlib
import os
import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any

import numba
from filelock import FileLock
from numba import njit
from numba.core.compiler_lock import global_compiler_lock
from numba.core.sigutils import normalize_signature

settings: Any = vars(numba)["config"]  # its names are set at run time

LONGEST = 600.0
"""Nobody waits longer for another process that compiles a kernel [s]."""
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


def alone(compiled: Any) -> Any:
    """A compiled function that only one process at a time compiles; who waited loads what the other made.

    numba writes a kernel's index and its code one after the other and without a lock: of two processes at it
    at once, one may be left with an index that names the other's code.
    """
    if not hasattr(compiled, "py_func"):  # where numba was told to compile nothing
        return compiled
    function, compile_it = compiled.py_func, compiled.compile
    lock = Path(settings.CACHE_DIR) / "locks" / f"{function.__module__}.{function.__qualname__}"

    def compile_alone(signature: Any) -> Any:
        if tuple(normalize_signature(signature)[0]) in compiled.overloads:
            return compile_it(signature)
        with global_compiler_lock, held(lock):  # numba's own lock, of this process, always first
            return compile_it(signature)

    compiled.compile = compile_alone
    return compiled


@contextmanager
def held(lock: Path) -> Iterator[None]:
    """Holds a lock between processes; goes on without where there cannot be one, or after `LONGEST`."""
    with ExitStack() as holding:
        with suppress(OSError):  # a timeout is one, as is a folder that nobody may write to
            lock.parent.mkdir(parents=True, exist_ok=True)
            holding.enter_context(FileLock(lock, timeout=LONGEST))
        yield


def kernel(function: Callable[..., Any]) -> Callable[..., Any]:
    """Marks a function as a kernel: plain arithmetic on arrays and tuples, compiled at its first call."""
    return alone(njit(cache=True, error_model="numpy")(function))


def kernel_nogil(function: Callable[..., Any]) -> Callable[..., Any]:
    """The same for long work: it lets go of Python's lock, so that threads run it side by side."""
    return alone(njit(cache=True, error_model="numpy", nogil=True)(function))
