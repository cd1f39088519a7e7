"""The proof of a redesign, proved: it runs what it says, agrees with itself, and sees a difference."""

import json
import os
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

import gaitwright
import same_motion
from gaitwright.cli.options import read

QUICK = "--skill walk-"
"""In two of the commands, and they take seconds."""


def run(*words: str) -> subprocess.CompletedProcess[str]:
    """The script on the quick commands, in a process of its own as people start it."""
    command = [sys.executable, str(Path(same_motion.__file__)), f"--only={QUICK}", *words]
    paths = {**os.environ, "PYTHONPATH": str(Path(gaitwright.__file__).parents[1])}
    return subprocess.run(command, env=paths, capture_output=True, text=True, timeout=300, check=False)


def test_thirty_commands_that_the_command_line_knows() -> None:
    assert len(set(same_motion.COMMANDS)) == len(same_motion.COMMANDS) == 30
    for command in same_motion.COMMANDS:
        words = shlex.split(command)
        assert read(words).command == words[0] in ("skill", "mission")


def test_words_choose_commands_and_words_of_none_are_told() -> None:
    assert same_motion.chosen("") == same_motion.COMMANDS
    assert len(same_motion.chosen(QUICK)) == 2
    with pytest.raises(SystemExit, match="no command has 'moon' in it"):
        same_motion.chosen("moon")


def test_the_same_code_moves_alike_and_one_bit_of_difference_is_seen(tmp_path: Path) -> None:
    kept = tmp_path / "kept.json"
    assert run("--write", str(kept)).returncode == 0
    found = json.loads(kept.read_text())
    one, other = found
    assert (one, other) == same_motion.chosen(QUICK)
    assert all(len(told) == 64 and int(told, 16) for told in found.values()) and found[one] != found[other]
    kept.write_text(json.dumps({**found, other: found[one]}))
    done = run("--against", str(kept))
    assert done.returncode == 1
    first, second, last = done.stdout.splitlines()
    assert first.split()[2] == "same" and second.split()[2] == "DIFFERENT" and last == "1 of 2 the same"


def test_every_difference_is_counted(capsys: pytest.CaptureFixture[str]) -> None:
    assert same_motion.show({"a": "1", "b": "2"}, {"a": "1", "b": "2"}) == 0
    assert same_motion.show({"a": "1", "b": "2"}, {"a": "1", "b": "3", "c": "4"}) == 2
    assert capsys.readouterr().out.splitlines()[-1] == "1 of 3 the same"
