"""A few hundred damaged files and command lines of a fixed seed: each is taken, or refused in a sentence.

`gaitwright bench fuzz` takes tens of thousands, in processes that are watched for hangs and memory.
"""

from pathlib import Path

import pytest

from gaitwright.bench.fuzz import hunt
from gaitwright.bench.fuzz.case import Outcome, content_of, prepared, run_case
from gaitwright.bench.fuzz.hunt import Found
from gaitwright.bench.fuzz.kinds import KINDS

SEED = 11
CASES = {"command": 15, "mjcf": 20, "urdf": 20, "scene": 25, "recording": 25}
"""Of each kind; of all others 40. `bench fuzz` tries thousands."""


@pytest.mark.parametrize("kind", KINDS)
def test_no_damage_ends_in_a_traceback(kind: str, tmp_path: Path):
    prepared(tmp_path)
    for number in range(CASES.get(kind, 40)):
        outcome = run_case(kind, SEED, number, tmp_path)
        assert not outcome.fault, f"case {number} of {kind}, seed {SEED}: {outcome.fault}"


def test_a_case_is_the_same_again():
    assert content_of("scene", SEED, 3) == content_of("scene", SEED, 3) != content_of("scene", SEED, 4)


def test_a_worker_tells_of_every_case(tmp_path: Path):
    prepared(tmp_path)
    run_case("cycle", SEED, 0, tmp_path)  # a worker has no time to compile kernels in
    found = hunt.hunt("cycle", SEED, 5)
    assert (found.cases, found.faults) == (5, 0)


def test_what_is_found_is_counted():
    found = Found("scene")
    for outcome in (
        Outcome(0, refused=True),
        Outcome(1, fault="ValueError at x.py:1"),
        Outcome(2, seconds=30.0),
    ):
        found.add(outcome)
    assert (found.cases, found.refused, found.faults, found.hangs) == (3, 1, 2, [2])
