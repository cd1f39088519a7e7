"""Tables and figures of the thesis, computed anew and held against what it prints (row E2).

One module per table or figure; each has `reproduce(say)`, which returns a `Reproduction`: what the thesis
says, claim by claim, with what we get beside it, and whether the two agree, differ, or cannot agree.
"""

from gaitwright.errors import unknown

NAMES = (
    "table-6.1",
    "table-6.2",
    "figure-6.5",
    "figure-6.6",
    "figure-6.9",
    "figure-6.10",
    "figure-6.11",
)
"""What can be reproduced; the module of `table-6.1` is `table_6_1`."""


def run(names: list[str], out: str = "runs/reproduce", json_path: str | None = None) -> int:
    """Reproduces tables and figures, all where `names` is empty; prints them and leaves files in `out`.

    Returns 0 where every claim agrees that can, 1 where one does not. Raises `WrongUse` for a name that
    does not exist.
    """
    asked = chosen(names)
    from gaitwright.reproduce.runs import reproduce_all  # noqa: PLC0415 - heavy: names first

    return reproduce_all(asked, out, json_path)


def chosen(names: list[str]) -> list[str]:
    """The names, each once, in the order of `NAMES`; all of them where none is given."""
    for name in names:
        if name not in NAMES:
            raise unknown("table or figure", name, NAMES)
    return [name for name in NAMES if not names or name in names]
