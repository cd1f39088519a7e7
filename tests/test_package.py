"""The package's door: cheap to import, every public name behind it, shapes checked while tests run."""

import ast
import re
import subprocess
import sys
from importlib.metadata import packages_distributions, requires
from pathlib import Path

import numpy as np
import pytest
from jaxtyping import TypeCheckError

import gaitwright
from gaitwright import _HOME
from gaitwright.numerics import geometry

NEEDED_BY_NUMBA: set[str] = set()
"""Never imported here: numba looks for it when a kernel has `@` or `np.linalg`."""
HEAVY = ("numpy", "scipy", "numba", "mujoco", "matplotlib", "jaxtyping", "rich")


def in_a_fresh_python(program: str) -> str:
    """What a program prints in an interpreter of its own."""
    command = [sys.executable, "-c", program]
    return subprocess.run(command, capture_output=True, text=True, timeout=60, check=True).stdout.strip()


def test_importing_the_package_loads_nothing_heavy():
    loaded = in_a_fresh_python("import gaitwright, sys; print(*sys.modules)").split()
    assert [name for name in HEAVY if name in loaded] == []


def test_importing_the_package_takes_milliseconds():
    clocked = "from time import perf_counter as now; t = now(); import gaitwright; print(now() - t)"
    assert min(float(in_a_fresh_python(clocked)) for _ in range(3)) < 0.1


@pytest.mark.parametrize("name", sorted(_HOME))
def test_a_public_name_is_there(name: str):
    assert getattr(gaitwright, name) is not None
    assert name in dir(gaitwright)


def test_type_checkers_see_the_same_names():
    with open(gaitwright.__file__, encoding="utf-8") as file:
        imports = [line.split() for line in file if line.startswith("    from gaitwright.")]
    assert {words[-1]: words[1] for words in imports} == _HOME


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="has no attribute 'Gate'"):
        _ = gaitwright.Gate


def test_the_version_is_the_installed_one():
    assert gaitwright.__version__.count(".") >= 2


PEERS = ("_tick.py", "clips_rules.py", "paths_planners.py", "sklearn_teachers.py")
"""Scripts that run in the environments of the peers."""


def declared(extra: bool) -> set[str]:
    """Names of the distributions that the package needs, or those of its extras."""
    lines = [line for line in requires("gaitwright") or [] if ("extra ==" in line) == extra]
    return {re.split(r"[\s;<>=!~\[]", line)[0].lower() for line in lines}


def imported() -> set[str]:
    """Names of the distributions that the package imports anywhere; scripts of the peers run elsewhere."""
    files = [p for p in Path(gaitwright.__file__).parent.rglob("*.py") if not p.name.endswith(PEERS)]
    nodes = [node for file in files for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))]
    names = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    names |= {node.module for node in nodes if isinstance(node, ast.ImportFrom) and node.module}
    foreign = {name.partition(".")[0] for name in names} - sys.stdlib_module_names - {"gaitwright"}
    homes = packages_distributions()
    return {homes.get(name, [name])[0].lower() for name in foreign} - {"tick-protocol", "tick_protocol"}


def test_the_package_declares_what_it_imports_and_no_more():
    assert declared(extra=False) <= imported() | NEEDED_BY_NUMBA
    assert imported() <= declared(extra=False) | declared(extra=True)


def test_shapes_are_checked_while_tests_run():
    with pytest.raises(TypeCheckError):
        geometry.roll_pitch_yaw(np.eye(4))


def test_kernels_compile_under_the_checks():
    assert geometry.rotation.py_func.__name__ == "rotation"
    np.testing.assert_array_equal(geometry.rotation(np.array([1.0, 0.0, 0.0, 0.0])), np.eye(3))
