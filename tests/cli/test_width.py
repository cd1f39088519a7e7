"""What a person sees at 80 columns: no line is longer, and no name is broken in the middle."""

import os
import pty
import subprocess
import sys
from pathlib import Path

import pytest
from rich.cells import cell_len

from gaitwright.assess.suitability import Finding
from gaitwright.bench import GROUPS
from gaitwright.bench.machine import machine
from gaitwright.bench.measurement import Figure, at_most
from gaitwright.bench.table import Result, Section, show
from gaitwright.cli import main
from gaitwright.cli.console import remark, show_table
from gaitwright.cli.options import COMMANDS
from gaitwright.cli.robots import FOUND, finding_rows
from gaitwright.ground.scenes_list import OFFERS
from gaitwright.model.catalogue import ROBOTS
from gaitwright.skills.library import skill_names

SKILLS = {6: skill_names(6), 4: skill_names(4)}


@pytest.fixture(autouse=True)
def in_an_empty_folder_without_columns(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("COLUMNS", raising=False)


def shown(words: list[str], capsys: pytest.CaptureFixture[str], code: int = 0, width: int = 80) -> set[str]:
    """The words that a command shows, none of whose lines is longer than the screen."""
    assert main(words) == code
    told = capsys.readouterr()
    lines = told.out.splitlines()
    assert lines and [line for line in lines if cell_len(line) > width] == []
    return {word.strip(",;:.()`|[]") for word in told.out.split()}


TABLES = [
    (["robots"], set(ROBOTS)),
    (["scenes"], set(OFFERS)),
    (["skills"], set(SKILLS[4])),
    (["skills", "--robot", "hexapod"], set(SKILLS[6])),
    (["skills", "--robot", "thesis"], set(SKILLS[4])),
    (["doctor"], {"matplotlib", "mcap-ros2-support", "gaitwright"}),
    (["bench", "--help"], {claim for claims in GROUPS.values() for claim in claims}),
    (["--help"], set(COMMANDS)),
    (["reproduce", "table-6.1"], {"agrees", "cannot", "misprint", "table-6.1"}),
    (
        ["skill", "--seconds", "0.2", "--out", "run"],
        {"trot", "numerical", "run/recording.npz", "run/trip.png"},
    ),
    (["mission", "--goal", "0.3", "0", "--seconds", "0.2"], {"desirability"}),
]


@pytest.mark.parametrize(("words", "names"), TABLES, ids=[" ".join(words) for words, _ in TABLES])
@pytest.mark.parametrize("columns", ["", "80"])
def test_a_table_fits_80_columns_with_every_name_whole(
    words: list[str],
    names: set[str],
    columns: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
):
    if columns:
        monkeypatch.setenv("COLUMNS", columns)
    if columns and "--out" in words:
        words = [*words[:-1], "run-80"]
        names = {name.replace("run/", "run-80/") for name in names}
    assert names <= shown(words, capsys, code=int("mission" in words))


@pytest.mark.parametrize("name", COMMANDS)
def test_a_help_fits_80_columns_with_every_option_whole(name: str, capsys: pytest.CaptureFixture[str]):
    assert "--json" in shown([name, "--help"], capsys)


def test_a_wider_screen_has_one_line_for_each_skill(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setenv("COLUMNS", "150")
    assert main(["skills"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len([line for line in lines if line.startswith(SKILLS[4])]) == len(SKILLS[4])
    assert any(line.startswith("turn-right") and line.endswith("in trot") for line in lines)


def test_a_school_and_its_book_are_told_at_80_columns(capsys: pytest.CaptureFixture[str]):
    assert "turn-in-place" in shown(["teach", "--out", "a.skills", "--trips", "1"], capsys)
    turn = "turn-in-place"
    for words in ([], ["--rule", turn], ["--history", turn], ["--situation", "road=rough"]):
        assert turn in shown(["explain", "a.skills", *words], capsys)
    assert "conflicts" in shown(["books", "merge", "a.skills", "a.skills", "--out", "b.skills"], capsys)


def test_a_checked_robot_is_told_at_80_columns(capsys: pytest.CaptureFixture[str]):
    long = "walk-backward at 0.203 m/s needs 26.4 N·m at the hip 2 of FL; the motor gives 2.5"
    findings = [Finding("file", "left open", "ok", long), Finding("trial", "turn in place", "limited", long)]
    show_table(FOUND, finding_rows(findings), prose=FOUND[2:])
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= 80
    assert sum("walk-backward" in line for line in lines) == 2
    assert "in simulation" in lines


def test_a_bench_is_told_at_80_columns(capsys: pytest.CaptureFixture[str]):
    figures = [
        Figure(
            "go2 turn-in-place at 0.41 rad/s on rough:0.05: 60 s without a fall",
            20.0,
            "of 20",
            note="note " * 30,
        ),
        Figure("tick", 19.9, "µs", at_most(100.0), 8),
    ]
    result = Result(machine(), True, 0, [Section("walks", "spine", figures, "how " * 60)])
    show(result, to_stderr=False)
    told = capsys.readouterr().out
    assert max(map(cell_len, told.splitlines())) <= 80
    assert "turn-in-place" in told and told.count("note") == 30 and told.count("how") == 60


def test_a_remark_is_one_line_in_a_pipe_and_breaks_between_words_on_a_terminal():
    sentence = "no skill 'trott'; there is: " + ", ".join(SKILLS[4])
    code = f"from gaitwright.cli.console import remark; remark({sentence!r})"
    piped = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert piped.stderr == sentence + "\n"
    ours, theirs = pty.openpty()
    subprocess.run(
        [sys.executable, "-c", code], stderr=theirs, check=True, env=os.environ | {"COLUMNS": "80"}
    )
    lines = os.read(ours, 10_000).decode().split("\r\n")
    assert max(map(len, lines)) <= 80
    assert " ".join(lines).strip() == sentence


def test_a_name_in_a_sentence_has_at_most_200_letters(capsys: pytest.CaptureFixture[str]):
    name = "a" * 150 + "b" * 150
    remark(f"{name}: taken as it is")
    assert capsys.readouterr().err == f"{'a' * 139}…{'b' * 59}: taken as it is\n"


def test_a_report_is_in_a_persons_words(capsys: pytest.CaptureFixture[str]):
    words = shown(["skill", "--seconds", "0.2"], capsys)
    assert {"computing", "control"} <= words
    assert not {"tick", "ticks", "lap", "p99"} & words
