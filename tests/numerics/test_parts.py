"""A part of a row is what numpy's slice and reshape make of it, in Python and in kernels."""

import ast
from pathlib import Path

import numpy as np
import pytest

import gaitwright
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.parts import lent, part


@kernel
def matrix_in_a_kernel(row, start, rows):
    return part(row, start, (rows, 3))


@kernel
def tensor_of_a_row_that_is_gone(size):
    """The row is the kernel's own; its part must keep it alive."""
    row = np.arange(size) * 1.0
    return part(row, 2, (2, 3, 4))


@pytest.mark.parametrize(("start", "rows"), [(0, 4), (5, 1), (7, 3), (3, 0)])
def test_a_part_is_a_slice_in_that_shape(start: int, rows: int) -> None:
    row = np.arange(20.0)
    expected = row[start : start + 3 * rows].reshape(rows, 3)
    for found in (part(row, start, (rows, 3)), matrix_in_a_kernel(row, start, rows)):
        np.testing.assert_array_equal(found, expected)
        assert found.flags.c_contiguous
        found[:] = -1.0  # a view
        assert (row[start : start + 3 * rows] == -1.0).all()
        row[:] = np.arange(20.0)


def test_a_part_keeps_its_row() -> None:
    parts = [tensor_of_a_row_that_is_gone(100) for _ in range(200)]
    for found in parts:
        np.testing.assert_array_equal(found, np.arange(2.0, 26.0).reshape(2, 3, 4))


@kernel
def sum_of_what_is_lent(row, start, rows):
    lent(row, start, (rows, 3))[0, 1] += 1.0
    return lent(row, start, (rows, 3)).sum()


def test_what_is_lent_is_the_same_part() -> None:
    row = np.arange(20.0)
    np.testing.assert_array_equal(lent(row, 5, (2, 3)), part(row, 5, (2, 3)))
    assert sum_of_what_is_lent(row, 5, 2) == np.arange(5.0, 11.0).sum() + 1.0
    assert row[6] == 7.0


SOURCES = Path(gaitwright.__file__).parent


def readers_in(tree: ast.Module) -> set[str]:
    """Names of a module's functions that read fields of rows, made by a layout's `views` and `field`."""
    found = set()
    for node in (node for node in tree.body if isinstance(node, ast.Assign)):
        made = ast.unparse(node.value)
        if any(f".{maker}(" in made for maker in ("views", "field")):
            found |= {name.id for name in ast.walk(node.targets[0]) if isinstance(name, ast.Name)}
    return found


def readers_known_to(tree: ast.Module, readers: dict[str, set[str]]) -> set[str]:
    """Those of its own, and those that it imports."""
    found = readers_in(tree)
    for node in (node for node in tree.body if isinstance(node, ast.ImportFrom)):
        of_module = readers.get(node.module or "", set())
        found |= {alias.asname or alias.name for alias in node.names if alias.name in of_module}
    return found


def root_of(node: ast.expr) -> str:
    """The variable of which `node` is a part: `load` of `load.rows[k]`, `row` of `part(row, …)`."""
    while not isinstance(node, ast.Name):
        node = node.args[0] if isinstance(node, ast.Call) else node.value
    return node.id


def test_every_row_that_a_kernel_reads_was_handed_to_it() -> None:
    """A view does not keep its row alive: the caller does, who has it."""
    paths = {
        ".".join(path.relative_to(SOURCES.parent).with_suffix("").parts): path
        for path in SOURCES.rglob("*.py")
    }
    trees = {name: ast.parse(path.read_text(encoding="utf-8")) for name, path in paths.items()}
    readers, read = {name: readers_in(tree) for name, tree in trees.items()}, 0
    kernels = [
        (node, readers_known_to(tree, readers))
        for tree in trees.values()
        for node in tree.body
        if isinstance(node, ast.FunctionDef)
        and any("kernel" in ast.unparse(decorator) for decorator in node.decorator_list)
    ]
    for node, known in kernels:
        handed = {argument.arg for argument in node.args.args}
        for told in (inner for inner in ast.walk(node) if isinstance(inner, ast.Assign)):
            parts = told.value.elts if isinstance(told.value, ast.Tuple) else [told.value]
            if all(ast.unparse(one).startswith("part(") and root_of(one) in handed for one in parts):
                handed |= {name.id for name in ast.walk(told.targets[0]) if isinstance(name, ast.Name)}
        for call in (inner for inner in ast.walk(node) if isinstance(inner, ast.Call)):
            if isinstance(call.func, ast.Name) and call.func.id in known:
                assert root_of(call.args[0]) in handed, f"{node.name}: {ast.unparse(call)}"
                read += 1
    assert read > 20
