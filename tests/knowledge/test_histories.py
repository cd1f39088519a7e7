"""No earlier positive instance is lost and no earlier negative one fires, through random histories."""

import os
import subprocess
import sys
from pathlib import Path

from histories import run_histories

import gaitwright


def test_nothing_taught_is_lost_with_types_checked(rng):
    lessons, troubles, mended = run_histories(int(rng.integers(1 << 30)), 60, 8)
    assert lessons > 150 and troubles > 10 and mended > 5


def test_nothing_taught_is_lost_in_many_histories():
    """In a process of its own, where no call is slowed down by type checks."""
    here = Path(__file__).parent
    paths = os.pathsep.join([str(here), str(Path(gaitwright.__file__).parents[1])])
    done = subprocess.run(
        [sys.executable, str(here / "histories.py"), "20240229", "20000", "5"],
        env={**os.environ, "PYTHONPATH": paths},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    lessons, troubles, mended = map(int, done.stdout.split())
    assert lessons > 40_000 and troubles > 4_000 and mended > 2_000
