"""A name or a file → `Robot` (rows R1, R2): our own robots here, files of users in a child process."""

import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path

import msgspec

from gaitwright.description.child import CPU_SECONDS, MEMORY_BYTES
from gaitwright.description.reading import read_robot
from gaitwright.errors import BadFile, WrongUse, short, unknown
from gaitwright.files import is_there
from gaitwright.model.catalogue import robot_file, robot_names
from gaitwright.model.robot import Robot, robot_of

SUFFIXES = (".xml", ".mjcf", ".urdf")
WALL_SECONDS = 60
"""Longest time that reading a user's file may take [s]."""
QUIET = {"NUMBA_DISABLE_JIT": "1", "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
"""Environment of the child: nothing is compiled for one robot, and threads do not count as memory."""


class Answer(msgspec.Struct, forbid_unknown_fields=True):
    """What the child process prints: a robot as plain lists, or why there is none."""

    robot: dict[str, str | float | list] = {}
    notes: tuple[str, ...] = ()
    error: str = ""


Packages = Mapping[str, str | Path]
"""Folders by the names of the packages that lie in them."""


def load_robot(name_or_path: str | Path, packages: Packages | None = None) -> Robot:
    """The robot of that name, or the one in that MJCF or URDF file.

    `packages`: where meshes may be that a file names as `package://NAME/…`, or that are outside its own
    folder. Raises `WrongUse` for a name that does not exist and `BadFile` for a file that cannot be used.
    """
    return load_robot_and_notes(name_or_path, packages)[0]


def load_robot_and_notes(
    name_or_path: str | Path, packages: Packages | None = None
) -> tuple[Robot, tuple[str, ...]]:
    """As `load_robot`, with a sentence about each thing that was mended, or left open and derived."""
    folders = {name: Path(folder) for name, folder in (packages or {}).items()}
    for name, folder in folders.items():
        if not folder.is_dir():
            raise WrongUse(f"package {name}: {folder} is no folder")
    asked = str(name_or_path)
    if asked in robot_names():
        return built_in(asked)
    path = Path(asked)
    if not is_there(path):
        path = Path(short(asked))
    elif path.is_file():
        return from_file(path, folders)
    elif path.is_dir():
        raise BadFile(f"{path}: a folder; expected an MJCF or URDF file")
    if path.suffix.lower() in SUFFIXES or len(path.parts) > 1:
        raise BadFile(f"{path}: no such file; expected an MJCF or URDF file")
    raise unknown("robot", asked, (*robot_names(), "or the path of an MJCF or URDF file"))


def built_in(name: str) -> tuple[Robot, tuple[str, ...]]:
    """A robot of the catalogue."""
    return read_robot(robot_file(name))


def from_file(path: Path, packages: Mapping[str, Path]) -> tuple[Robot, tuple[str, ...]]:
    """The robot in a user's file, which a child process reads under limits."""
    if not os.access(path, os.R_OK):
        raise BadFile(f"{path}: no permission to read it")
    reading = [sys.executable, "-P", "-B", "-m", "gaitwright.description.child", str(path.resolve())]
    reading += [f"{name}={folder.resolve()}" for name, folder in packages.items()]
    with tempfile.TemporaryDirectory() as empty:
        try:
            child = subprocess.run(
                reading,
                cwd=empty,
                env=os.environ | QUIET,
                capture_output=True,
                timeout=WALL_SECONDS,
                check=False,
            )
        except subprocess.TimeoutExpired as error:
            raise BadFile(f"{path}: reading it took longer than {WALL_SECONDS} s") from error
    if child.returncode not in (0, BadFile.exit_code):
        limits = f"{CPU_SECONDS} s of CPU and {MEMORY_BYTES / 1e9:g} GB"
        raise BadFile(f"{path}: its reader broke off, within limits of {limits}: {why(child)}")
    answer = msgspec.json.decode(child.stdout, type=Answer)
    if answer.error:
        raise BadFile(f"{path}: {answer.error}")
    return robot_of(answer.robot), answer.notes


def why(child: subprocess.CompletedProcess[bytes]) -> str:
    """How a process ended: the signal that stopped it, or what it said last."""
    if child.returncode < 0:
        return f"stopped by {signal.Signals(-child.returncode).name}"
    said = child.stderr.decode(errors="replace").strip().splitlines()
    return said[-1][:200] if said else f"exit code {child.returncode}"
