"""The command line before any work starts: helps, and one sentence for every wrong use."""

import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from gaitwright.cli import main
from gaitwright.cli.doctor import CORE, EXTRAS, mujoco_works
from gaitwright.cli.options import COMMANDS, read

HEAVY = ("numpy", "scipy", "numba", "mujoco", "matplotlib", "rich")
MISSION = ("mission", "--goal", "6", "0")
ROOT = Path(__file__).parents[2]


def test_help_imports_nothing_heavy():
    program = "import sys; from gaitwright.cli import main; main(sys.argv[1:]); print(*sys.modules)"
    for words in (["--help"], ["mission", "--help"]):
        told = [sys.executable, "-c", program, *words]
        done = subprocess.run(told, capture_output=True, text=True, timeout=60, check=True)
        loaded = done.stdout.split()
        assert "argparse" in loaded
        assert [name for name in HEAVY if name in loaded] == []


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_has_a_help_with_examples(name: str, capsys: pytest.CaptureFixture[str]):
    assert main([name, "--help"]) == 0
    shown = capsys.readouterr().out
    assert "examples:\n" in shown
    assert 2 <= len(COMMANDS[name].examples) <= 3
    assert "--json FILE|-" in shown


def test_without_a_command_the_help_is_shown(capsys: pytest.CaptureFixture[str]):
    assert main([]) == 0
    shown = capsys.readouterr().out
    assert "exit codes:" in shown
    assert "examples:" in shown


@pytest.mark.parametrize("name", COMMANDS)
def test_the_examples_of_a_help_are_read(name: str):
    for example in COMMANDS[name].examples:
        words = example.partition("#")[0].split()
        assert words[0] == "gaitwright"
        assert read(words[1:]).command == words[1]


def test_negative_numbers_are_values():
    args = read(["mission", "--waypoints", "-1,2", "-1e-3,-.5", "--start", "-1", "-2e0", "-.3"])
    assert args.waypoints == [(-1.0, 2.0), (-0.001, -0.5)]
    assert args.start == [-1.0, -2.0, -0.3]


WRONG = [
    (["mision"], "no command 'mision'; there is: demo, mission"),
    (["mision"], "did you mean 'mission'?"),
    ([*MISSION, "--sped", "1"], "no option --sped; did you mean --speed?"),
    (["mission"], "--goal --waypoints --route --velocity is required"),
    (["mission", "--goal", "6"], "argument --goal: expected 2 arguments"),
    (["mission", "--goal", "nan", "0"], "'nan' is not a finite number"),
    (["mission", "--goal", "-inf", "0"], "'-inf' is not a finite number"),
    (["mission", "--goal", "six", "0"], "'six' is not a finite number"),
    (["mission", "--waypoints", "1,2", "3"], "'3' is not a point; write X,Y"),
    (["mission", "--goal", "1", "0", "--waypoints", "1,2"], "not allowed with argument --goal"),
    ([*MISSION, "--seconds", "-5"], "-5 is not greater than 0"),
    ([*MISSION, "--seconds", "1e9"], "longer than the limit of 3600 s"),
    ([*MISSION, "--speed", "inf"], "'inf' is not a finite number"),
    ([*MISSION, "--speed", "-1"], "-1 is not greater than 0"),
    ([*MISSION, "--seed", "1.5"], "'1.5' is not a whole number"),
    ([*MISSION, "--seed", "-1"], "'-1' is not a whole number"),
    ([*MISSION, "--driver", "learned"], "drivers hybrid and learned and --skillbook FILE go together"),
    (["skill", "--driver", "learned"], "driver learned and --skillbook FILE go together"),
    ([*MISSION, "--driver", "numericl"], "no driver 'numericl'; there is: numerical"),
    ([*MISSION, "--skillbook", "a.skills"], "drivers hybrid and learned and --skillbook FILE go together"),
    (["skill", "--skillbook", "a.skills"], "driver learned and --skillbook FILE go together"),
    (["skill", "--driver", "hybrid"], "driver hybrid chooses skills by rules"),
    (["teach", "--lesson", "gaits", "--out", "a.skills"], "no lesson 'gaits'; there is: skills, profiles"),
    ([*MISSION, "--distribution", "lq"], "no distribution 'lq'; there is: qp, lp"),
    (["skill", "--push", "1"], "argument --push: expected 2 arguments"),
    (["demo", "fast"], "unrecognized arguments: fast"),
]


@pytest.mark.parametrize(("words", "sentence"), WRONG, ids=lambda value: " ".join(value)[:40])
def test_wrong_words_are_told_in_one_sentence(
    words: list[str], sentence: str, capsys: pytest.CaptureFixture[str]
):
    assert main(words) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert sentence in err
    assert err.startswith("gaitwright: ")
    assert err.count("\n") == 1


def test_the_doctor_looks_for_what_the_package_declares():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert tuple(line.partition(">")[0] for line in project["dependencies"]) == CORE
    assert {name: tuple(lines) for name, lines in project["optional-dependencies"].items()} == EXTRAS


def test_mujoco_4_0_0_is_refused():
    assert [mujoco_works(v) for v in ("3.9.1", "3.10.0", "3.17", "4.0.0", "4.0.1", "4.1")] == [
        False, True, True, False, True, True,
    ]  # fmt: skip
