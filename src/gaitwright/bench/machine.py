"""The machine and the versions that figures were measured with, in one line."""

import os
import platform
import sys
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from gaitwright.workers import cores

PACKAGES = ("gaitwright", "numpy", "numba", "mujoco")


def machine() -> dict[str, Any]:
    """What there is to know about this machine."""
    return {
        "cpu": cpu_model(),
        "cores": cores(),
        "system": f"{platform.system()} {platform.release()}",
        "python": platform.python_version(),
        "versions": {name: version_of(name) for name in PACKAGES},
        "load_at_start": round(os.getloadavg()[0], 2) if hasattr(os, "getloadavg") else None,
    }


def line(known: dict[str, Any]) -> str:
    """The same in one line."""
    packages = ", ".join(f"{name} {number}" for name, number in known["versions"].items())
    load = f", load {known['load_at_start']} at the start" if known["load_at_start"] is not None else ""
    computer = f"{known['cpu']}, {known['cores']} cores, {known['system']}"
    return f"{computer}, Python {known['python']}, {packages}{load}"


def cpu_model() -> str:
    """Name of the processor, as the system has it."""
    info = Path("/proc/cpuinfo")
    if sys.platform == "linux" and info.exists():
        for text in info.read_text(encoding="utf-8", errors="replace").splitlines():
            if text.lower().startswith("model name"):
                return " ".join(text.split(":", 1)[1].split())
    return platform.processor() or platform.machine()


def version_of(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "from source"
