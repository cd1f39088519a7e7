"""`gaitwright doctor`: what is installed, what is missing, how to mend it. Needs nothing but Python."""

import json
import os
import platform
import re
import sys
from argparse import Namespace
from dataclasses import asdict, dataclass
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from shutil import get_terminal_size

from gaitwright.cli.output import check_json, write_json
from gaitwright.cli.sentences import between_words

CORE = ("filelock", "jaxtyping", "msgspec", "mujoco", "numba", "numpy", "pillow", "rich", "shapely")
"""What Gaitwright cannot run without, by the names of modules and distributions."""
EXTRAS = {
    "plot": ("matplotlib",),
    "record": ("mcap-ros2-support",),
    "studio": ("starlette", "uvicorn", "websockets"),
}
MODULES = {"mcap-ros2-support": "mcap_ros2", "pillow": "PIL"}
"""Modules that are not named as their distribution."""
MUJOCO = "3.10 or later, not 4.0.0"


@dataclass(frozen=True)
class Finding:
    """One line of the examination."""

    what: str
    found: str
    fine: bool
    needed: bool = True
    mend: str = ""
    """The command that mends it."""


def run(args: Namespace) -> int:
    check_json(args.json)
    findings = [python(), own_version(), *map(core, CORE)]
    findings += [extra(group, package) for group, packages in EXTRAS.items() for package in packages]
    findings += [kernels(findings), runs_folder()]
    failed = any(not finding.fine and finding.needed for finding in findings)
    if args.json != "-":
        show(findings)
    report = {"fine": not failed, "findings": [asdict(finding) for finding in findings]}
    write_json(args.json, json.dumps(report, indent=2, ensure_ascii=False))
    return int(failed)


def show(findings: list[Finding]) -> None:
    """A line for each finding, broken between words; without `rich`, which may be what is missing."""
    width, screen = max(len(finding.what) for finding in findings), get_terminal_size().columns
    for finding in findings:
        mark = "ok" if finding.fine else "MISSING" if finding.needed else "absent"
        name = f"{mark:8}{finding.what:{width}}  "
        print("\n".join(between_words(name + finding.found, screen, " " * len(name))))
    mends = list(dict.fromkeys(finding.mend for finding in findings if finding.mend))
    if mends:
        print("\nto mend it:" if any(f.mend and f.needed for f in findings) else "\nto add what is absent:")
        print("\n".join(f"  {mend}" for mend in mends))
    else:
        print("\neverything is there")


def install(extras: str = "") -> str:
    """The command that installs Gaitwright with all it needs: from its folder where it is run from one."""
    root = Path(__file__).resolve().parents[3]
    what = (
        f"-e '{root}{extras}'" if (root / "pyproject.toml").is_file() else f"--upgrade 'gaitwright{extras}'"
    )
    return f"{sys.executable} -m pip install {what}"


# --- what is looked at -----------------------------------------------------------------------------
def python() -> Finding:
    fine = sys.version_info >= (3, 11)
    found = f"{platform.python_version()} ({sys.executable}) on {platform.platform()}"
    return Finding("python", found, fine, mend="" if fine else "install Python 3.11 or later")


def own_version() -> Finding:
    home = Path(__file__).resolve().parents[1]
    try:
        return Finding("gaitwright", f"{version('gaitwright')} in {home}", True)
    except PackageNotFoundError:
        return Finding("gaitwright", f"run from {home}, not installed", True)


def core(package: str) -> Finding:
    """A package that is needed: there, importable, and of a version that works."""
    found = installed(package)
    if not found:
        return Finding(package, "not installed", False, mend=install())
    try:
        import_module(MODULES.get(package, package))
    except (ImportError, OSError) as error:
        return Finding(package, f"{found} cannot be imported: {error}", False, mend=install())
    if package == "mujoco" and not mujoco_works(found):
        return Finding(package, f"{found}; needed: {MUJOCO}", False, mend=install())
    return Finding(package, found, True)


def mujoco_works(found: str) -> bool:
    """Whether a version of MuJoCo is in range; 4.0.0 has a solver defect that 4.0.1 mends."""
    numbers = tuple(int(number) for number in re.findall(r"\d+", found)[:3])
    return numbers >= (3, 10) and numbers != (4, 0, 0)


def extra(group: str, package: str) -> Finding:
    found = installed(package)
    if found and find_spec(MODULES.get(package, package)):
        return Finding(package, f"{found} (extra {group})", True, needed=False)
    return Finding(
        package, f"not installed (extra {group})", False, needed=False, mend=install("[plot,record,studio]")
    )


def installed(package: str) -> str:
    """Version of an installed package, empty where there is none."""
    try:
        return version(package)
    except PackageNotFoundError:
        return ""


def kernels(before: list[Finding]) -> Finding:
    """Whether the kernels are compiled; asked only where their compiler is there."""
    if any(not finding.fine and finding.needed for finding in before):
        return Finding("kernels", "not looked at", True)
    compiled = import_module("gaitwright.numerics.compiled")
    state = (
        "compiled" if compiled.is_warm() else "not compiled yet; the first run does it, in a minute or two"
    )
    return Finding("kernels", f"{state} ({compiled.settings.CACHE_DIR})", True)


def runs_folder() -> Finding:
    """Whether `gaitwright demo` could leave its files here."""
    place = Path("runs") if Path("runs").exists() else Path()
    if place.is_dir() and os.access(place, os.W_OK):
        return Finding("runs/", f"can be written in {Path.cwd()}", True)
    return Finding("runs/", f"cannot be written in {Path.cwd()}", False, mend="cd to a folder of your own")
