"""The commands at work: exit codes, what they print, what they write, what they refuse."""

import json
import signal
import stat
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from gaitwright import bench
from gaitwright.cli import demo, main, trips
from gaitwright.record.metrics import Report
from gaitwright.record.recording import load
from gaitwright.skillbook.book import Skillbook
from gaitwright.skills.library import skill_names
from gaitwright.studio.replay import PLACE, TEMPLATE

KEYS = {
    "arrived", "falls", "duration_s", "distance_m", "speed_mean_mps", "velocity_error_mps",
    "yaw_rate_error_radps", "cost_of_transport", "roll_std_rad", "pitch_std_rad", "driver_share", "tick_us",
    "skills", "desirability", "stopped_because", "seed", "state_hash",
}  # fmt: skip
"""What the JSON of a report carries at least (design.md §6)."""
MISSION = ["mission", "--goal", "6", "0"]
SKILL = ["skill", "--seconds", "0.4"]


@pytest.fixture(autouse=True)
def in_an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)


def reported(words: list[str], capsys: pytest.CaptureFixture[str], code: int = 0) -> dict:
    """What a command reports on its standard output."""
    assert main([*words, "--json", "-"]) == code
    return json.loads(capsys.readouterr().out)


# --- skill -----------------------------------------------------------------------------------------
def test_skill_reports_every_figure(capsys: pytest.CaptureFixture[str]):
    report = reported(SKILL, capsys)
    assert report.keys() >= KEYS
    assert report["skills"] == ["trot"]
    assert report["driver_share"] == {"numerical": 1.0}
    assert report["stopped_because"] == "the 0.4 s asked for are over"


def test_the_same_seed_gives_the_same_report_but_for_the_clock(capsys: pytest.CaptureFixture[str]):
    first, again, other = (reported([*SKILL, "--seed", seed], capsys) for seed in "112")
    assert other["state_hash"] != first["state_hash"]
    assert first.pop("tick_us").keys() == again.pop("tick_us").keys() == {"lap", "numerical"}
    assert first == again


def test_a_push_to_the_left_moves_the_robot_to_the_left(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(trips, "illustrate", lambda *_: [])
    for name, direction in (("left", "90"), ("right", "-90")):
        words = ["skill", "--seconds", "1", "--push", "0.5", direction, "--out", name]
        assert main(words) == 0
    left, right = (load(f"{name}/recording.npz")["velocity_w"][:, 1] for name in ("left", "right"))
    assert (left[:251] == right[:251]).all()  # nothing before half of the time
    assert left[310] - right[310] > 0.4


def test_a_push_that_topples_the_robot_is_exit_code_1(capsys: pytest.CaptureFixture[str]):
    report = reported(["skill", "--seconds", "3", "--push", "4", "90"], capsys, code=1)
    assert report["falls"] == 1
    assert report["stopped_because"].startswith("fell")


def test_both_force_distributions_walk(capsys: pytest.CaptureFixture[str]):
    words = ["skill", "--seconds", "0.8", "--distribution"]
    qp, lp = (reported([*words, method], capsys) for method in ("qp", "lp"))
    assert qp["state_hash"] != lp["state_hash"]
    for report in (qp, lp):
        assert report["falls"] == 0 and report["distance_m"] == pytest.approx(0.4 * 0.8, rel=0.3)


# --- mission ---------------------------------------------------------------------------------------
def test_a_mission_arrives(capsys: pytest.CaptureFixture[str]):
    words = ["mission", "--scene", "flat", "--goal", "0.3", "0", "--seed", "1"]
    report = reported(words, capsys)
    assert report["arrived"]
    assert report["stopped_because"] == "arrived at the goal"


def test_a_mission_out_of_time_is_exit_code_1(capsys: pytest.CaptureFixture[str]):
    report = reported([*MISSION, "--seconds", "0.4"], capsys, code=1)
    assert report["stopped_because"].startswith("out of time after 0.4 s")


def test_a_goal_in_an_obstacle_is_reported_not_refused(capsys: pytest.CaptureFixture[str]):
    report = reported(["mission", "--goal", "2.9", "-0.1"], capsys, code=1)
    assert report["stopped_because"].startswith("there is no way to the goal")


def test_a_mission_starts_where_it_is_told(capsys: pytest.CaptureFixture[str]):
    words = ["mission", "--scene", "flat", "--start", "3", "1", "1.57", "--goal", "3", "1.02"]
    report = reported(words, capsys)
    assert report["arrived"]
    assert report["distance_m"] < 0.3


# --- what is refused -------------------------------------------------------------------------------
WRONG = [
    (
        ["mission", "--goal", "60", "0"],
        2,
        "the goal (60, 0) lies outside scene blocks, which goes from (-4, -4)",
    ),
    (["mission", "--waypoints", "0,9", "1,0"], 2, "the way-point (0, 9) lies outside scene blocks"),
    ([*MISSION, "--start", "-9", "0", "0"], 2, "the start (-9, 0) lies outside scene blocks"),
    ([*MISSION, "--start", "3", "0", "0"], 2, "the start (3, 0) is on an obstacle of scene blocks"),
    ([*MISSION, "--start", "0", "0", "90"], 2, "yaw is in radians"),
    ([*MISSION, "--speed", "9"], 2, "at 9 m/s is beyond the reach of go2"),
    ([*MISSION, "--robot", "go3"], 2, "no robot 'go3'; there is: go2"),
    ([*MISSION, "--robot", "nowhere.xml"], 3, "nowhere.xml: no such file"),
    ([*MISSION, "--scene", "blok"], 2, "did you mean 'blocks'?"),
    ([*MISSION, "--scene", "nowhere.json"], 3, "nowhere.json cannot be read"),
    (["skill", "--skill", "trott"], 2, "no skill 'trott'; there is: stand, stop, walk"),
    (["skill", "--speed", "3"], 2, "trot at 3 m/s is beyond the reach of go2"),
    (["skill", "--speed", "-3"], 2, "beyond the reach of go2"),
    (["skill", "--lateral", "3"], 2, "beyond the reach of go2"),
    (["skill", "--turn", "99"], 2, "trot at a yaw rate of 99 rad/s is beyond the reach of go2"),
    (["skill", "--push", "-1", "0"], 2, "the impulse of a push is not negative"),
    ([*SKILL, "--json", "nowhere/a.json"], 2, "there is no folder"),
    ([*SKILL, "--json", "."], 2, "is a folder; name a file in it"),
]


@pytest.mark.parametrize(("words", "code", "sentence"), WRONG, ids=lambda value: str(value)[:40])
def test_wrong_use_is_one_sentence_and_leaves_nothing(
    words: list[str], code: int, sentence: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    assert main([*words, "--out", "run"]) == code
    out, err = capsys.readouterr()
    assert out == ""
    assert sentence in err
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_folder_with_files_in_it_is_left_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "mine.txt").write_text("mine")
    assert main([*SKILL, "--out", "run"]) == 2
    assert "--out run holds files already" in capsys.readouterr().err


# --- files -----------------------------------------------------------------------------------------
def test_a_run_leaves_picture_recordings_and_report(
    tmp_path: Path,
    tmp_path_factory: pytest.TempPathFactory,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
):
    page = tmp_path_factory.mktemp("page")
    (page / TEMPLATE).write_text(f"<html>{PLACE}</script></html>", encoding="utf-8")
    monkeypatch.setattr(trips, "built_page", lambda: page)
    assert main([*SKILL, "--json", "a.json", "--out", "run"]) == 0
    names = {path.name for path in (tmp_path / "run").iterdir()}
    assert names == {"trip.png", "recording.npz", "recording.mcap", "replay.html", "report.json"}
    assert (tmp_path / "a.json").read_text() == (tmp_path / "run" / "report.json").read_text()
    shown = capsys.readouterr().out
    assert [name for name in names if f"run/{name}" not in shown] == []
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.json", "run"]


def test_json_replaces_the_file_a_link_points_to(tmp_path: Path):
    (tmp_path / "real.json").write_text("old")
    (tmp_path / "link.json").symlink_to("real.json")
    assert main(["scenes", "--json", "link.json"]) == 0
    assert (tmp_path / "link.json").is_symlink()
    assert json.loads((tmp_path / "real.json").read_text())[0]["name"] == "flat"


@pytest.mark.skipif(sys.platform == "win32", reason="no such device")
def test_json_to_a_device_leaves_the_device():
    assert main(["scenes", "--json", "/dev/null"]) == 0
    assert stat.S_ISCHR(Path("/dev/null").stat().st_mode)


def test_runs_are_numbered_not_overwritten(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    for name, little in (("SECONDS", 0.2), ("SCHOOL", 1), ("SKILLS", ())):
        monkeypatch.setattr(f"gaitwright.cli.demo.{name}", little)
    monkeypatch.setattr(trips, "illustrate", lambda *_: [])
    kept = tmp_path / "runs" / "demo-001" / "report.json"
    kept.parent.mkdir(parents=True)
    kept.write_text("of an earlier run")
    assert main(["demo"]) == 1  # nobody crosses the field in that time
    assert sorted(path.name for path in (tmp_path / "runs").iterdir()) == ["demo-001", "demo-002"]
    assert kept.read_text() == "of an earlier run" and list(kept.parent.iterdir()) == [kept]
    left = {path.name for path in (tmp_path / "runs" / "demo-002").iterdir()}
    assert {"first", "third", "fourth", "go2.skills", "map.png", "recording.npz", "report.json"} == left
    book = Skillbook.load(tmp_path / "runs" / "demo-002" / "go2.skills")
    assert [notes.place for notes in book.maps] == ["blocks (seed 9)", "bugtrap (seed 8)"]


def test_the_demo_says_who_drove_and_what_a_map_is_good_for(capsys: pytest.CaptureFixture[str]):
    report = Report(**reported(SKILL, capsys))
    once = replace(report, arrived=True, distance_m=14.42, duration_s=41.3)
    again = replace(once, distance_m=12.68, duration_s=33.4)
    second = replace(report, driver_share={"learned": 0.94, "numerical": 0.06})
    said = demo.lessons_of({"first": report, "second": second, "third": once, "fourth": again})
    assert said == [
        "The learned controller drove 94% of the way through the second field.",
        "Past the bay it went 14.4 m in 41 s with nothing known, and 12.7 m in 33 s by its map.",
    ]
    (said,) = demo.lessons_of({"second": report, "third": once, "fourth": replace(again, arrived=False)})
    assert said.startswith("The numerical controller drove in the second field")


def test_a_missing_extra_is_a_line_not_a_failure(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
):
    monkeypatch.setattr(trips, "find_spec", lambda module: None)
    monkeypatch.setattr(trips, "built_page", lambda: None)
    assert main([*SKILL, "--out", "run"]) == 0
    assert {path.name for path in (tmp_path / "run").iterdir()} == {"recording.npz", "report.json"}
    assert "the picture is left out: it needs `pip install 'gaitwright[plot]'`" in capsys.readouterr().err


# --- interrupts, pipes, defects --------------------------------------------------------------------
HEARING = """
import signal, sys
from gaitwright.cli import main
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs are started deaf to it
sys.exit(main(sys.argv[1:]))
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no process can press Ctrl-C for another")
def test_ctrl_c_keeps_the_report_and_the_recording(tmp_path: Path):
    """A signal to a process that simulates, as the terminal sends it, after its first line of progress."""
    words = [sys.executable, "-c", HEARING, "skill", "--seconds", "600", "--json", "-", "--out", "run"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        told = next((line for line in process.stderr if line.startswith("simulating")), None)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
    assert told is not None and process.returncode == 130
    report = json.loads(out)
    assert report["stopped_because"] == "interrupted" and 0.0 < report["duration_s"] < 600.0
    kept = f"interrupted after {report['duration_s']:.1f} s; kept: the report, and the recording in run"
    assert kept in err and "Traceback" not in err
    recording = load("run/recording.npz")
    assert len(recording.of_trip()) == pytest.approx(report["duration_s"] / 0.002, abs=2)
    assert len(recording) > len(recording.of_trip()) + 100, "not let down"


def test_our_own_mistakes_show_where_they_are(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
):
    monkeypatch.setattr("gaitwright.cli.scenes.OFFERS", None)
    assert main(["scenes"]) == 70
    err = capsys.readouterr().err
    assert "Traceback" in err
    assert "please report it" in err


# --- what there is ---------------------------------------------------------------------------------
def test_robots_scenes_and_skills_are_listed(capsys: pytest.CaptureFixture[str]):
    assert {row["name"] for row in reported(["robots"], capsys)} >= {"go2", "thesis", "hexapod"}
    assert {row["name"] for row in reported(["scenes"], capsys)} >= {"flat", "blocks", "rough"}
    skills = reported(["skills", "--robot", "hexapod"], capsys)
    assert [row["name"] for row in skills["skills"]] == list(skill_names(6))
    assert main(["robots"]) == main(["scenes"]) == main(["skills"]) == 0
    assert "Unitree Go2" in capsys.readouterr().out


def test_tall_robots_get_taller_scenes():
    thesis, dog = trips.find_robot("thesis"), trips.find_robot("go2")
    assert trips.find_scene("blocks", 0, dog).bounds[2] == 10.0
    assert trips.find_scene("blocks", 0, thesis).bounds[2] == 90.0


def test_the_doctor_finds_everything_here(capsys: pytest.CaptureFixture[str]):
    report = reported(["doctor"], capsys)
    assert report["fine"]
    assert main(["doctor"]) == 0
    assert "everything is there" in capsys.readouterr().out


def test_the_doctor_names_the_command_that_mends(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
):
    monkeypatch.setattr("gaitwright.cli.doctor.CORE", ("numpy", "no-such-package"))
    assert main(["doctor"]) == 1
    out = capsys.readouterr().out
    assert "MISSING no-such-package" in out
    assert "-m pip install" in out


def test_bench_is_passed_on(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    asked = []
    monkeypatch.setattr(
        bench, "run", lambda *words, robots: asked.append((*words, robots)) or 0, raising=False
    )
    assert main(["bench", "tick", "--quick", "--json", "-"]) == 0
    assert main(["bench", "strangers", "--robots", str(tmp_path)]) == 0
    assert asked == [(["tick"], True, "-", None), (["strangers"], False, None, tmp_path)]


def test_a_folder_of_robots_that_is_none_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    assert main(["bench", "strangers", "--robots", str(tmp_path / "none")]) == 2
    assert "none: no such folder" in capsys.readouterr().err
