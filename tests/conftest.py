"""What every test shares: seeded numbers, repeatable examples, and shape checks that leave kernels alone."""

import inspect
import os

import numba
import numpy as np
import pytest
from hypothesis import Phase, settings

EXAMPLES = 25
"""Of each property in a run; other seeds try others. The whole must stay under a quarter of an hour."""
# A first call compiles: no deadline can hold, and to trace one, as the phase `explain` does, takes an hour.
PHASES = tuple(phase for phase in Phase if phase is not Phase.explain)
settings.register_profile("here", deadline=None, max_examples=EXAMPLES, phases=PHASES)
settings.register_profile(
    "ci", deadline=None, max_examples=EXAMPLES, phases=PHASES, derandomize=True, print_blob=True
)
settings.load_profile("ci" if os.environ.get("CI") else "here")


def _compile_the_function_itself(decorate):
    """A numba decorator that takes the jaxtyping check off a function again before it compiles it.

    The checks are put inside all other decorators, where they would hand numba a Python wrapper. Without
    them a kernel is what it is outside the tests, so both share one cache on disk.
    """

    def decorator(*args, **options):
        if args and inspect.isfunction(args[0]):
            return decorate(inspect.unwrap(args[0]), *args[1:], **options)
        compile_it = decorate(*args, **options)
        return lambda function: compile_it(inspect.unwrap(function))

    return decorator


numba.njit = _compile_the_function_itself(numba.njit)
numba.cfunc = _compile_the_function_itself(numba.cfunc)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """What a module sets up once for its tests is set up by one process, not by every one."""
    for item in items:
        fixtures = getattr(item, "_fixtureinfo").name2fixturedefs  # noqa: B009 - it has no public name
        is_shared = any(one.scope == "module" for made in fixtures.values() for one in made)
        if is_shared and item.get_closest_marker("xdist_group") is None:
            item.add_marker(pytest.mark.xdist_group(item.nodeid.partition("::")[0]))


@pytest.fixture
def rng() -> np.random.Generator:
    """Random numbers that are the same in every run."""
    return np.random.default_rng(20240229)
