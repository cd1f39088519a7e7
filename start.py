"""Sets up `.venv` beside this file and runs a command in it. Needs Python 3.11 or later, nothing else.

    python3 start.py demo     installs Gaitwright, then runs `gaitwright demo`
    python3 start.py test     installs what the tests need too, then runs `pytest`
    python3 start.py check    installs what development needs too, then runs every check there is, tests last;
                              `check lint types` runs some: format, lint, types, law

Every other command of `gaitwright` works the same way; further arguments are passed on.
"""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

VENV = Path(".venv")
BIN = VENV / ("Scripts" if os.name == "nt" else "bin")
PYTHON = BIN / ("python.exe" if os.name == "nt" else "python")
UNFINISHED = VENV / "unfinished"  # there while a step runs: found at the start, a run was cut off
CHECK_AGE = "import sys; sys.exit(sys.version_info < (3, 11))"
GROUPS = {
    "test": ["--group", "test"],
    "check": ["--group", "dev"],
    "studio": [] if shutil.which("npm") else ["--group", "page"],
}  # what a command needs besides the package
CHECKS = {
    "format": ["ruff", "format", "--check"],
    "lint": ["ruff", "check"],
    "types": ["pyright"],
    "law": ["lint-imports"],
}
TESTS = [
    "pytest",
    "-n",
    "auto",
    "--maxprocesses",
    "4",
    "--dist",
    "loadgroup",
]  # one process for each core; `-n 0` for one in all
COMPILES = ["mission", "--scene", "blocks", "--goal", "3", "0", "--seconds", "0.1"]
PINNED = ["-c", "constraints.txt", "-b", "constraints.txt", "-e", ".[plot,record,studio]"]


def step(what, *command):
    """Run a command under a line that says what it does; what it prints follows, less package lists."""
    print("==> " + what, flush=True)
    UNFINISHED.touch()
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "encoding": "utf-8", "errors": "replace"}
    with subprocess.Popen([str(word) for word in command], **pipes) as process:
        for line in process.stdout or ():
            if not line.startswith((" + ", " ~ ")):
                print("    " + re.sub(r"https?://\S+", "(address)", line), end="", flush=True)
    UNFINISHED.unlink()
    if process.returncode:
        sys.exit("start.py: {} failed; the lines above say why".format(what))


def make_environment():
    """Make `.venv` with uv in it, or use the one that is there."""
    if UNFINISHED.exists():
        print("==> removing the .venv of a run that was cut off", flush=True)
        shutil.rmtree(str(VENV))
    if not VENV.exists():
        if not importlib.util.find_spec("venv") or not importlib.util.find_spec("ensurepip"):
            sys.exit("start.py: this Python lacks ensurepip; Debian and Ubuntu: apt install python3-venv")
        VENV.mkdir()
        step("making .venv", sys.executable, "-m", "venv", "--without-pip", VENV)
    if not PYTHON.exists() or subprocess.call([str(PYTHON), "-c", CHECK_AGE]):
        sys.exit("start.py: .venv holds no Python 3.11 or later; delete that folder and run this again")
    if not shutil.which("uv", path=str(BIN)):
        step("installing pip", PYTHON, "-m", "ensurepip")
        step("installing uv", PYTHON, "-m", "pip", "install", "--quiet", "-c", "constraints.txt", "uv")


def install(*what):
    """Install Gaitwright with all it needs, unless the same was done before."""
    done = VENV / "-".join(["installed", *what]).replace("---", "-")
    wanted = "".join(Path(name).read_text(encoding="utf-8") for name in ("pyproject.toml", "constraints.txt"))
    if not done.exists() or done.read_text(encoding="utf-8") != wanted:
        step("installing Gaitwright", BIN / "uv", "pip", "install", "--python", PYTHON, *PINNED, *what)
        done.write_text(wanted, encoding="utf-8")


def run(program, *arguments):
    """Run a program of `.venv` under a line that names it; its exit code."""
    print("==> " + " ".join([program, *arguments]), flush=True)
    return subprocess.call([str(BIN / program), *arguments])


def check(*names):
    """Run the checks named, or all of them and then the tests, whatever fails; 0 where nothing does.

    What failed is told before the tests, so that the last line is pytest's.
    """
    for name in names:
        if name not in CHECKS:
            sys.exit("start.py: no check '{}'; there is: {}".format(name, ", ".join(CHECKS)))
    if not names:  # kernels are compiled meanwhile, on another core
        ahead, quiet = [str(BIN / "gaitwright"), *COMPILES], subprocess.DEVNULL
        subprocess.Popen(ahead, stdout=quiet, stderr=quiet)
    failed = [name for name in names or CHECKS if run(*CHECKS[name])]
    if failed:
        print("==> FAILED: " + ", ".join(failed), flush=True)
    untested = 0 if names else run(*TESTS)
    return 1 if failed else untested


def main(command="", *arguments):
    if sys.version_info < (3, 11):
        sys.exit("start.py: Python 3.11 or later is needed, this is {}".format(sys.version.split()[0]))
    if not command or command.startswith("-"):
        sys.exit(__doc__)
    os.chdir(str(Path(__file__).resolve().parent))
    make_environment()
    install(*GROUPS.get(command, []))
    if command == "check":
        sys.exit(check(*arguments))
    sys.exit(run(*TESTS, *arguments) if command == "test" else run("gaitwright", command, *arguments))


if __name__ == "__main__":
    main(*sys.argv[1:])
