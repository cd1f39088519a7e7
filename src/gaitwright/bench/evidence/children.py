"""A command run as a child, with its wall time, CPU time and the most memory it took.

A small Python of its own starts the command: Linux counts the memory of the process that a child was
started from as the child's, and ours holds a simulator.
"""

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

WAITER = """
import json, os, sys, time
began = time.perf_counter()
quiet = os.open(os.devnull, os.O_WRONLY)
child = os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ, file_actions=[(os.POSIX_SPAWN_DUP2, quiet, 1)])
_, status, used = os.wait4(child, 0)
print(json.dumps({
    "code": os.waitstatus_to_exitcode(status),
    "wall_s": time.perf_counter() - began,
    "cpu_s": used.ru_utime + used.ru_stime,
    "peak_bytes": used.ru_maxrss * (1 if sys.platform == "darwin" else 1024),
}))
"""


@dataclass(frozen=True)
class Used:
    """What a child took."""

    code: int
    wall_s: float
    cpu_s: float
    peak_bytes: int

    @property
    def peak_mb(self) -> float:
        return self.peak_bytes / 1e6


class Children:
    """Starts commands of ours the way an installed package starts: with its bytecode on disk.

    Where the environment forbids Python to keep bytecode, the first child fills a folder of our own.
    """

    def __enter__(self) -> "Children":
        self._folder = tempfile.TemporaryDirectory(prefix="gaitwright-bench-")
        self._env = dict(os.environ)
        if self._env.pop("PYTHONDONTWRITEBYTECODE", ""):
            self._env["PYTHONPYCACHEPREFIX"] = str(Path(self._folder.name) / "bytecode")
        return self

    def __exit__(self, *_: object) -> None:
        self._folder.cleanup()

    def gaitwright(self, *words: str) -> Used:
        """Runs `python -m gaitwright …` in an empty folder and waits for it. Raises `ChildFailed`."""
        return measured([sys.executable, "-m", "gaitwright", *words], self._env, Path(self._folder.name))


class ChildFailed(Exception):
    """A child did not do what it was asked; the sentence says what it said."""


def can_measure() -> bool:
    """Whether this system tells what a child took."""
    return hasattr(os, "wait4") and hasattr(os, "posix_spawn")


def measured(command: Sequence[str], env: Mapping[str, str], folder: Path) -> Used:
    """Runs a command in a folder and waits for it; what it prints is thrown away. Raises `ChildFailed`."""
    done = subprocess.run(
        [sys.executable, "-S", "-c", WAITER, *command],
        capture_output=True,
        text=True,
        check=False,
        env=env,
        cwd=folder,
    )
    if done.returncode:
        raise ChildFailed(f"it could not be started: {done.stderr.strip()[-200:]}")
    used = Used(**json.loads(done.stdout))
    if used.code:
        raise ChildFailed(f"it ended with exit code {used.code}: {done.stderr.strip()[-200:]}")
    return used
