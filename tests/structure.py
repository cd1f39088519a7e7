"""Counts what docs/layout.md says of the code's structure.

    python tests/structure.py [FOLDER]     # of the package in FOLDER/src (this checkout)

Modules and lines, the longest of each kind, the longest chain of imports between modules, circles among them,
and pairs of places with six or more equal lines.
"""

import ast
import sys
from collections import defaultdict
from itertools import combinations
from pathlib import Path
from statistics import median

SAME = 6
"""Equal lines in a row that count as standing twice."""


def modules_of(root: Path) -> dict[str, ast.Module]:
    """Dotted name → syntax tree of every module of the package."""
    found = {}
    for path in sorted(root.rglob("*.py")):
        parts = path.relative_to(root.parent).with_suffix("").parts
        name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
        found[name] = ast.parse(path.read_text(encoding="utf-8"))
    return found


def imports_of(tree: ast.Module, known: set[str]) -> set[str]:
    """Modules of the package that a module imports when it is loaded or while it runs."""
    out = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module:
            named = {f"{node.module}.{alias.name}" for alias in node.names}
            out |= (named & known) or ({node.module} & known)
    return out


def longest_chain(imports: dict[str, set[str]]) -> tuple[int, int]:
    """Modules in the longest chain of imports, and how many circles were met."""
    length: dict[str, int] = {}
    circles = 0

    def depth(name: str, above: tuple[str, ...]) -> int:
        nonlocal circles
        if name in above:
            circles += 1
            return 0
        if name not in length:
            length[name] = 1 + max((depth(to, (*above, name)) for to in imports[name]), default=0)
        return length[name]

    return max(depth(name, ()) for name in imports), circles


def functions_of(tree: ast.Module) -> list[int]:
    """Lines of every function."""
    kinds = ast.FunctionDef | ast.AsyncFunctionDef
    return [(node.end_lineno or 0) - node.lineno + 1 for node in ast.walk(tree) if isinstance(node, kinds)]


def twins(root: Path) -> int:
    """Pairs of files that share so many equal lines in a row, imports and blank lines left out."""
    where: dict[tuple[str, ...], set[Path]] = defaultdict(set)
    for path in root.rglob("*.py"):
        lines = [line.strip() for line in path.read_text(encoding="utf-8").splitlines()]
        lines = [line for line in lines if line and not line.startswith(("from ", "import ", '"""', "@"))]
        for i in range(len(lines) - SAME + 1):
            where[tuple(lines[i : i + SAME])].add(path)
    return len({pair for paths in where.values() for pair in combinations(sorted(paths), 2)})


def main() -> None:
    base = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[1]
    root = base / "src" / "gaitwright"
    modules = modules_of(root)
    lines = {path: len(path.read_text(encoding="utf-8").splitlines()) for path in root.rglob("*.py")}
    functions = [length for tree in modules.values() for length in functions_of(tree)]
    chain, circles = longest_chain({name: imports_of(tree, set(modules)) for name, tree in modules.items()})
    longest = max(lines, key=lines.__getitem__)
    print(f"modules                      {len(modules)}")
    print(f"lines                        {sum(lines.values())}")
    print(f"median module                {median(lines.values()):.0f} lines")
    print(f"longest module               {lines[longest]} lines, {longest.relative_to(root)}")
    print(f"median function              {median(functions):.0f} lines")
    print(f"longest function             {max(functions)} lines")
    print(f"longest chain of imports     {chain} modules")
    print(f"circles                      {circles}")
    print(f"files that share {SAME} lines     {twins(root)} pairs")


if __name__ == "__main__":
    main()
