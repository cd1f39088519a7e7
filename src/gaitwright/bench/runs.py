"""One run of the bench: claim after claim, then the tables and the JSON, of what was finished in any case."""

from collections.abc import Sequence
from importlib import import_module
from pathlib import Path

from gaitwright.bench.context import Context
from gaitwright.bench.machine import machine
from gaitwright.bench.measurement import Figure
from gaitwright.bench.table import Result, Section, show, write
from gaitwright.workers import Workers

INTERRUPTED = 130
"""Exit code of a run that was cut off by the user."""


def measure_claims(
    claims: Sequence[tuple[str, str]],
    quick: bool,
    json_path: str | None,
    seed: int,
    workers: int | None,
    robots: Path | None = None,
) -> int:
    """Measures (group, claim) after (group, claim), prints and writes; returns the exit code."""
    known = machine()
    sections: list[Section] = []
    finished = False
    try:
        with Workers(workers) as processes, Context(processes, quick, seed, robots) as context:
            context.warm_up()
            for group, claim in claims:
                measure_claim(context, group, claim, sections)
        finished = True
    except KeyboardInterrupt:
        pass
    finally:  # a defect in one claim does not cost the figures of the others
        result = Result(known, quick, seed, sections, interrupted=not finished)
        show(result, to_stderr=json_path == "-")
        write(result, json_path)
    if not finished:
        return INTERRUPTED
    return 0 if result.reached else 1


def measure_claim(context: Context, group: str, claim: str, sections: list[Section]) -> None:
    """Adds a claim's section, which fills while it is measured."""
    module = import_module(f"gaitwright.bench.claims.{claim}")
    figures: list[Figure] = []  # filled one by one: an interrupt keeps what is there
    sections.append(Section(claim, group, figures, getattr(module, "NOTE", "")))
    for figure in module.measure(context):
        figures.append(figure)
