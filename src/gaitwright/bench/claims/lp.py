"""Shown beside the claims: the thesis's linear program in place of the quadratic one."""

from collections.abc import Iterator

from gaitwright.bench.claims.walks import Walk, measure_walks
from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure

WALKS = (
    Walk("go2", "trot", 0.4, seconds=60.0, starts=5, method="lp", least=None),
    Walk("go2", "walk", 0.25, seconds=60.0, starts=5, method="lp", least=None),
)


def measure(context: Context) -> Iterator[Figure]:
    """The figures of walks whose forces are shared by the linear program."""
    return measure_walks(context, WALKS)
