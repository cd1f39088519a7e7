"""Storing a lesson does not grow slow with the book."""

import os
import subprocess
import sys
from pathlib import Path

import gaitwright


def test_a_lesson_is_stored_within_a_tenth_of_a_second_after_two_thousand():
    """In a process of its own, where no call is slowed down by type checks."""
    tests = Path(__file__).parents[1]
    paths = os.pathsep.join(
        [str(Path(__file__).parent), str(tests), str(Path(gaitwright.__file__).parents[1])]
    )
    done = subprocess.run(
        [sys.executable, str(Path(__file__).with_name("many_lessons.py")), "2000"],
        env={**os.environ, "PYTHONPATH": paths},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    median, _, stored = map(float, done.stdout.split())
    assert stored >= 2000 and median < 0.1
