"""Peers' environments: a folder of its own for each peer, made once by uv with pinned wheels.

A peer's wheels fit neither our Python nor our NumPy for sure, so nothing of it is imported here: we hand
out the path of its interpreter. The folder is built beside its place and renamed when it imports, so that
an interrupted build leaves nothing that looks whole. Interpreters are looked for, never downloaded.
"""

import hashlib
import importlib.util
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from gaitwright.errors import GaitwrightError, unknown

INSTALL_TIMEOUT_S = 900.0


class PeerUnavailable(GaitwrightError):
    """A peer's environment cannot be made here; the sentence says why."""


@dataclass(frozen=True)
class Recipe:
    """A combination of Python and wheels that works."""

    python: str
    """Minor version of the interpreter, e.g. "3.13"."""
    requirements: tuple[str, ...]
    """Every distribution with its version: nothing is resolved, nothing else is installed."""
    check: str
    """A statement that must run in the finished environment."""


# cmeel-urdfdom and cmeel-tinyxml2 are older than what `pin` asks for: it was linked against these.
_COMMON = (
    "cmeel==0.62.0",
    "cmeel-console-bridge==1.0.2.3",
    "cmeel-octomap==1.10.0",
    "cmeel-qhull==8.0.2.1",
    "cmeel-tinyxml2==10.0.0",
    "cmeel-urdfdom==4.0.1",
    "cmeel-zlib==1.3.2",
    "numpy==2.3.5",
)
_LATE = (
    *_COMMON,
    "cmeel-assimp==6.0.5",
    "cmeel-boost==1.89.0",
    "coal==3.0.2",
    "eigenpy==3.12.0",
    "libcoal==3.0.2",
)
_TSID_1_9 = (
    *_LATE,
    "eiquadprog==1.3.0",
    "libpinocchio==3.9.0",
    "libtsid==1.9.0",
    "pin==3.9.0",
    "tsid==1.9.0",
)
_TSID_1_7 = (
    *_COMMON,
    "cmeel-assimp==5.4.3.1",
    "cmeel-boost==1.87.0.1",
    "coal-library==3.0.1",
    "eigenpy==3.10.3",
    "eiquadprog==1.2.9",
    "pin==3.4.0",
    "tsid==1.7.1",
)
_PLACO = (*_LATE, "libpinocchio==3.8.0", "pin==3.8.0", "placo==0.10.2", "rhoban-cmeel-jsoncpp==1.9.4.9")
_CLIPS = ("cffi==2.1.1", "clipspy==1.0.6", "pycparser==3.12")
_SKLEARN = (
    "cloudpickle==3.1.2",
    "joblib==1.6.0",
    "narwhals==2.29.0",
    "numpy==2.3.5",
    "scikit-learn==1.9.1",
    "scipy==1.17.1",
    "threadpoolctl==3.8.0",
)
_POLICY = (
    "flatbuffers==25.12.19",
    "ml-dtypes==0.6.0",
    "numpy==2.3.5",
    "onnx==1.23.2",
    "onnxruntime==1.32.0",
    "packaging==26.4",
    "protobuf==7.36.2",
    "typing-extensions==4.16.0",
)
_PATHS = ("extremitypathfinder==2.8.0", "networkx==3.7", "numpy==2.5.5", "shapely==2.2.0")
_IMPORT_TSID = "import pinocchio; from tsid import tsid_pywrap"
_IMPORT_PLACO = "import pinocchio, placo"

RECIPES = {
    "tsid": (
        Recipe("3.13", _TSID_1_9, _IMPORT_TSID),
        Recipe("3.12", _TSID_1_7, _IMPORT_TSID),
        Recipe("3.11", _TSID_1_7, _IMPORT_TSID),
    ),
    "placo": tuple(Recipe(python, _PLACO, _IMPORT_PLACO) for python in ("3.13", "3.12", "3.11")),
    "policy": tuple(
        Recipe(python, _POLICY, "import onnx, onnxruntime") for python in ("3.13", "3.12", "3.11")
    ),
    "clips": tuple(Recipe(python, _CLIPS, "import clips") for python in ("3.13", "3.12", "3.11")),
    "paths": tuple(
        Recipe(python, _PATHS, "import extremitypathfinder, networkx, shapely") for python in ("3.13", "3.12")
    ),
    "sklearn": tuple(
        Recipe(python, _SKLEARN, "import sklearn.tree, sklearn.neighbors")
        for python in ("3.13", "3.12", "3.11")
    ),
}
"""Peer → recipes, the preferred first: the first whose Python is on this machine is made."""


def peer_python(name: str) -> Path:
    """Interpreter of the peer's environment, made on the first call (about 400 MB, seconds to minutes).

    Raises `WrongUse` for a peer that does not exist, `PeerUnavailable` where its environment cannot be made.
    """
    if name not in RECIPES:
        raise unknown("peer", name, RECIPES)
    for recipe in RECIPES[name]:
        if _interpreter(_folder(name, recipe)).exists():
            return _interpreter(_folder(name, recipe))
    uv = _uv()
    recipe, base = _buildable(name, uv)
    _build(name, recipe, base, uv)
    return _interpreter(_folder(name, recipe))


def _cache() -> Path:
    home = os.environ.get("XDG_CACHE_HOME")
    return (Path(home) if home else Path.home() / ".cache") / "gaitwright" / "peers"


def _folder(name: str, recipe: Recipe) -> Path:
    digest = hashlib.sha256("\n".join(sorted(recipe.requirements)).encode()).hexdigest()[:8]
    return _cache() / f"{name}-py{recipe.python}-{digest}"


def _interpreter(folder: Path) -> Path:
    return folder / "bin" / "python"


def _uv() -> list[str]:
    """The command that runs uv."""
    if importlib.util.find_spec("uv"):
        return [sys.executable, "-m", "uv"]
    found = shutil.which("uv")
    if not found:
        raise PeerUnavailable(
            "uv is not installed, and peers' environments are made with it (pip install uv)"
        )
    return [found]


def _buildable(name: str, uv: list[str]) -> tuple[Recipe, Path]:
    """The first recipe whose Python is on this machine, and that Python."""
    for recipe in RECIPES[name]:
        base = _find_python(recipe.python, uv)
        if base:
            return recipe, base
    versions = ", ".join(recipe.python for recipe in RECIPES[name])
    raise PeerUnavailable(f"it needs one of Python {versions}, and none is installed here")


def _find_python(version: str, uv: list[str]) -> Path | None:
    """An interpreter of this minor version: uv's find, else one that pyenv keeps but does not show."""
    command = [*uv, "python", "find", "--no-project", "--no-python-downloads", "--quiet", version]
    found = subprocess.run(command, capture_output=True, text=True, check=False, cwd="/")
    if found.returncode == 0:
        return Path(found.stdout.strip())
    pyenv = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv"))
    return next(iter(sorted(pyenv.glob(f"versions/{version}.*/bin/python{version}"))), None)


def _build(name: str, recipe: Recipe, base: Path, uv: list[str]) -> None:
    """Make the environment beside its place and rename it there once it imports."""
    target = _folder(name, recipe)
    building = _cache() / f".building-{os.getpid()}-{target.name}"
    print(
        f"gaitwright: installing the peer {name} for Python {recipe.python} into {target} …", file=sys.stderr
    )
    try:
        _cache().mkdir(parents=True, exist_ok=True)
    except OSError as problem:
        raise PeerUnavailable(f"the folder for peers cannot be made: {problem}") from problem
    _sweep()
    try:
        _must([*uv, "venv", "--quiet", "--no-project", "--python", str(base), str(building)])
        install = ["pip", "install", "--quiet", "--no-deps", "--only-binary", ":all:"]
        _must([*uv, *install, "--python", str(_interpreter(building)), *recipe.requirements])
        _must([str(_interpreter(building)), "-W", "ignore", "-c", recipe.check])
        _move(building, target)
    finally:
        shutil.rmtree(building, ignore_errors=True)


def _must(command: list[str]) -> None:
    """Run one step of the build; raises PeerUnavailable with the line that tells most."""
    try:
        done = subprocess.run(
            command,
            capture_output=True,
            text=True,
            check=False,
            timeout=INSTALL_TIMEOUT_S,
            cwd="/",
            env=clean_env(),
        )
    except subprocess.TimeoutExpired as problem:
        raise PeerUnavailable(f"installing it took more than {INSTALL_TIMEOUT_S:.0f} s") from problem
    if done.returncode:
        said = [line.strip() for line in done.stderr.splitlines() if line.strip()]
        raise PeerUnavailable(f"it cannot be installed: {_why(said)}")


def _why(said: list[str]) -> str:
    """The line of a failed step that tells most: uv's first "cause", else its last line."""
    causes = [line.split(":", 1)[1].strip() for line in said if line.lower().startswith("cause:")]
    return (causes or said[-1:] or ["no reason was given"])[0]


def _move(building: Path, target: Path) -> None:
    """Put the finished environment in its place; another process may have been quicker, which is as good."""
    if target.exists() and not _interpreter(target).exists():  # its Python was removed since
        shutil.rmtree(target)
    try:
        building.rename(target)
    except OSError:
        if not _interpreter(target).exists():
            raise


def _sweep() -> None:
    """Remove what builds left whose process was killed."""
    for left in _cache().glob(".building-*"):
        pid = int(left.name.split("-")[1])
        if pid != os.getpid() and not _alive(pid):
            shutil.rmtree(left, ignore_errors=True)


def _alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    return True


def clean_env() -> dict[str, str]:
    """Our environment without what would lead a peer to our packages; one thread for its linear algebra."""
    kept = {
        key: value
        for key, value in os.environ.items()
        if key not in {"PYTHONPATH", "PYTHONHOME", "VIRTUAL_ENV"}
    }
    return kept | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
