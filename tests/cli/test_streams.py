"""Outputs that are full, closed or read by nobody, and where files may go: one sentence and the exit code."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from gaitwright.cli import main

SCENES = f"{sys.executable} -m gaitwright scenes"


@pytest.mark.parametrize(
    ("command", "said"),
    [
        (f"{SCENES} > /dev/full", "no room for the output: No space left on device"),
        (f"{SCENES} >&-", "the standard output is closed"),
        (f"{SCENES} --json /dev/full > /dev/null", "no room for /dev/full"),
    ],
)
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that takes nothing")
def test_an_output_that_takes_nothing_is_told(command: str, said: str):
    done = subprocess.run(["sh", "-c", command], stderr=subprocess.PIPE, text=True, check=False)
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert done.stderr.startswith(f"gaitwright: {said}")


def test_an_output_that_nobody_reads_is_told():
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run(SCENES.split(), stdout=writer, stderr=subprocess.PIPE, text=True, check=False)
    os.close(writer)
    assert (done.returncode, done.stderr) == (2, "gaitwright: nobody reads the output any more\n")


def test_a_pipe_that_nobody_reads_is_not_waited_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    os.mkfifo(tmp_path / "pipe")
    assert main(["scenes", "--json", str(tmp_path / "pipe")]) == 2
    assert "nobody reads it" in capsys.readouterr().err


@pytest.mark.parametrize(
    "words",
    [
        ["skill", "--scene", "{}.json"], ["skill", "--robot", "{}.xml"], ["skill", "--robot", "{}"],
        ["skill", "--cycle", "{}"], ["skill", "--out", "{}"], ["explain", "{}"], ["teach", "--out", "{}"],
        ["books", "export", "{}"], ["scenes", "--json", "{}"], ["skills", "--out", "{}.png"], ["{}"],
        ["--{}"], ["scenes", "two words {}"],
    ],
)  # fmt: skip
def test_a_name_of_five_thousand_letters_is_told_in_short(
    words: list[str], capsys: pytest.CaptureFixture[str]
):
    assert main([word.format("x" * 5000) for word in words]) in (2, 3)
    said = capsys.readouterr().err
    assert said.startswith("gaitwright: ") and said.count("\n") == 1 and "x" * 200 not in said


def test_control_characters_of_a_name_do_not_reach_the_terminal(capsys: pytest.CaptureFixture[str]):
    for words in (
        ["skill", "--scene", "\x1b[2J.json"],
        ["skills", "--robot", "a\x07"],
        ["explain", "\x1b]0;x"],
    ):
        assert main(words) in (2, 3)
        assert capsys.readouterr().err.rstrip("\n").isprintable()


def test_a_way_through_a_folder_that_is_not_there_leads_to_no_full_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
):
    monkeypatch.chdir(tmp_path)
    Path("full").mkdir()
    Path("full/kept").write_text("kept")
    assert main(["skill", "--seconds", "0.01", "--out", "missing/../full"]) == 2
    assert "holds files already" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["full"]
    assert [path.name for path in Path("full").iterdir()] == ["kept"]
