"""One case: a kind, a seed and a number → damaged content → what became of it."""

import os
import traceback
from contextlib import chdir
from pathlib import Path
from random import Random
from time import perf_counter

import msgspec

from gaitwright.bench.fuzz import originals
from gaitwright.bench.fuzz.kinds import KINDS
from gaitwright.errors import GaitwrightError


class Outcome(msgspec.Struct, frozen=True):
    """What became of a case: it was taken, or refused in a sentence, or ended in a fault of ours."""

    number: int
    refused: bool = False
    fault: str = ""
    """The kind of the exception, where it came from, and what it says."""
    seconds: float = 0.0
    peak_mb: float = 0.0
    """The most memory that the process took so far."""


def content_of(kind: str, seed: int, number: int) -> bytes:
    """The damaged content of a case."""
    chance, made = Random(f"{kind} {seed} {number}"), KINDS[kind]
    return made.damage(chance, chance.choice(made.originals()))


def prepared(folder: Path) -> None:
    """Lays sound files and a pipe that nobody writes to into a folder, for commands that name them."""
    files = {
        "sound.skills": originals.skillbooks,
        "sound.txt": originals.texts,
        "sound.npz": originals.recordings,
        "sound.json": originals.scenes,
        "sound.xml": originals.mjcfs,
        "sound.png": originals.height_maps,
        "sound.csv": originals.routes,
        "sound.steer": originals.commands,
    }
    for name, made in files.items():
        (folder / name).write_bytes(made()[0])
    if hasattr(os, "mkfifo") and not (folder / "pipe").exists():
        os.mkfifo(folder / "pipe")


def run_case(kind: str, seed: int, number: int, folder: Path) -> Outcome:
    """Writes the case into a folder and takes it there."""
    path = folder / f"case{KINDS[kind].suffix}"
    path.write_bytes(content_of(kind, seed, number))
    began, refused, fault = perf_counter(), False, ""
    try:
        with chdir(folder):
            KINDS[kind].take(path)
    except GaitwrightError:
        refused = True
    except Exception as error:  # whatever comes is what we look for
        fault = told(error)
    return Outcome(number, refused, fault, perf_counter() - began, peak_mb())


def told(error: BaseException) -> str:
    """An exception and the last place of ours that it came through, on one line."""
    ours = [at for at in traceback.extract_tb(error.__traceback__) if f"gaitwright{os.sep}" in at.filename]
    where = f"{Path(ours[-1].filename).name}:{ours[-1].lineno}" if ours else "elsewhere"
    return f"{type(error).__name__} at {where}: {' '.join(str(error).split())[:500]}"


def peak_mb() -> float:
    """The most memory that this process took so far; 0 where the system does not tell.

    Linux is asked for its high-water mark: the peak that `getrusage` tells of begins with that of the process
    that started this one.
    """
    marks = Path("/proc/self/status")
    if marks.exists():
        return next(float(line.split()[1]) for line in marks.open() if line.startswith("VmHWM")) / 1e3
    try:
        import resource  # noqa: PLC0415 - not everywhere
    except ImportError:
        return 0.0
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
