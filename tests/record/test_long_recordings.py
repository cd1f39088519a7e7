"""A trip of hours: what is old goes to a file, and everything made of it is what it would be in memory."""

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from gaitwright.cli.recorded_moment import situation_at
from gaitwright.description.load import load_robot
from gaitwright.errors import NoRoom
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain, Lap
from gaitwright.pictures import trip_picture
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.record import metrics, rows
from gaitwright.record.channels import SITUATION
from gaitwright.record.mcap_export import export_mcap
from gaitwright.record.moment import call_at, route_at, sensed_at
from gaitwright.record.recording import Recorder, Recording, load
from gaitwright.session import Session
from gaitwright.signals import Mission
from gaitwright.skills.measured import measured
from gaitwright.skills.situation import FOREST, named

ROBOT = load_robot("go2")
posix = pytest.mark.skipif(os.name != "posix", reason="limits of a process are POSIX's")


@pytest.fixture(scope="module")
def laps() -> list[Lap]:
    """Go2 on its way to a goal behind stairs: 1501 ticks."""
    scene = load_scene("stairs:0.1", 0)
    plant = MujocoPlant(ROBOT, scene)
    return list(Session(Brain.of(ROBOT, scene), plant, Mission(((6.0, 1.0),)), 3.0, vary=False))


def recorded(laps: list[Lap]) -> Recording:
    recorder = Recorder(ROBOT, "stairs", 0, 0.002)
    for lap in laps:
        recorder.add(lap)
    return recorder.finish()


@pytest.fixture
def short(laps: list[Lap]) -> Recording:
    """All of it in memory."""
    return recorded(laps)


@pytest.fixture
def filed(laps: list[Lap], monkeypatch: pytest.MonkeyPatch) -> Recording:
    """The same, with most of it in a file and worked on in parts of which none fits."""
    monkeypatch.setattr(rows, "IN_MEMORY", 1)
    monkeypatch.setattr(rows, "BLOCK", 64)
    monkeypatch.setattr(rows, "PART", 100)
    return recorded(laps)


# --- the same in memory and in a file --------------------------------------------------------------
def test_a_filed_recording_is_what_it_is_in_memory(laps: list[Lap], filed: Recording):
    assert isinstance(filed.data, rows.Table)
    assert len(filed) == len(laps) and filed.data.blocks > 15
    np.testing.assert_array_equal(filed["q"], [lap.sensed.q.ravel() for lap in laps])
    np.testing.assert_array_equal(filed["time"], [lap.sensed.time for lap in laps])
    np.testing.assert_array_equal(filed["tau"][-1], laps[-1].command.tau.ravel())
    np.testing.assert_array_equal(np.asarray(filed.data)[:, 0], filed["time"])


def test_figures_are_those_of_whole_arrays(short: Recording, filed: Recording):
    # `short` was made first; the parts of both are small by now, so the oracle is spelled out.
    roll, pitch = metrics.attitude(short["orientation_wb"])
    moved = metrics.in_heading_frame(short["orientation_wb"], short["velocity_w"], 0.002)
    work = np.abs(short["tau"] * short["qd"]).sum() * 0.002
    way = np.linalg.norm(np.diff(short["position_w"][:, :2], axis=0), axis=1).sum()
    report = filed.report()
    assert report.roll_std_rad == roll.std() and report.pitch_std_rad == pitch.std()
    np.testing.assert_allclose(filed.moved(), moved, rtol=0, atol=1e-12)
    assert report.distance_m == pytest.approx(way, rel=1e-12)
    assert report.cost_of_transport == pytest.approx(work / (ROBOT.total_mass * 9.81 * way), rel=1e-12)
    assert report.tick_us["lap"]["median"] == np.median(short["took"][:, 0])


def test_the_report_of_a_filed_recording_is_that_of_one_in_memory(
    laps: list[Lap], filed: Recording, monkeypatch: pytest.MonkeyPatch
):
    there = json.loads(filed.report().to_json())
    monkeypatch.undo()
    here = json.loads(recorded(laps).report().to_json())
    assert there["state_hash"] == here["state_hash"]
    assert there["tick_us"] == here["tick_us"]
    for name, value in here.items():
        assert there[name] == (pytest.approx(value, rel=1e-12) if isinstance(value, float) else value)


def test_a_heading_goes_on_from_part_to_part(monkeypatch: pytest.MonkeyPatch):
    yaw = np.cumsum(np.random.default_rng(0).uniform(-0.1, 0.5, 1000))
    turned = np.stack([np.cos(yaw / 2), 0 * yaw, 0 * yaw, np.sin(yaw / 2)], axis=1)
    monkeypatch.setattr(rows, "PART", 7)
    found = metrics.heading_over_time(turned)
    np.testing.assert_allclose(found - found[0], yaw - yaw[0], atol=1e-9)


def test_stretches_end_where_parts_do_and_where_they_do_not(monkeypatch: pytest.MonkeyPatch):
    labels = np.array([0, 0, 0, 1, 1, 2, 2, 2, 2, 0])
    whole = metrics.stretches(labels)
    assert whole == [(0, 3), (3, 5), (5, 9), (9, 10)]
    for size in range(1, 11):
        monkeypatch.setattr(rows, "PART", size)
        assert metrics.stretches(labels) == whole


def test_a_filed_recording_that_blew_up_leaves_what_was_sound(laps: list[Lap], filed: Recording):
    burst = laps[700]._replace(sensed=replace(laps[700].sensed, position_w=np.full(3, 1e300)))
    broken = recorded([*laps[:700], burst, *laps[701:]])
    sound = broken.sound()
    assert len(sound) == len(laps) - 1
    np.testing.assert_array_equal(sound["q"], np.delete(filed["q"], 700, axis=0))
    assert filed.sound() is filed


# --- files -----------------------------------------------------------------------------------------
def test_a_filed_recording_survives_its_file(filed: Recording, tmp_path: Path):
    again = load(filed.save(tmp_path / "walk.npz"))
    assert isinstance(again.data, rows.Table)
    np.testing.assert_array_equal(np.asarray(again.data), np.asarray(filed.data))
    assert again.report() == filed.report()


def test_numpy_reads_it(short: Recording, tmp_path: Path):
    with np.load(short.save(tmp_path / "walk.npz")) as arrays:
        np.testing.assert_array_equal(arrays["q"], short["q"])
        assert arrays["time"].shape == (len(short),)


def test_an_older_recording_is_read_without_its_situation(short: Recording, tmp_path: Path):
    with np.load(short.save(tmp_path / "walk.npz")) as arrays:
        old = {name: arrays[name] for name in arrays.files if name not in SITUATION}
    np.savez_compressed(tmp_path / "old.npz", **old)
    again = load(tmp_path / "old.npz")
    np.testing.assert_array_equal(again["q"], short["q"])
    assert np.isnan(again["scan_slope"]).all() and route_at(again, 9) is None
    assert again.report() == short.report()


def test_mcap_and_picture_of_a_filed_recording_are_those_of_one_in_memory(
    short: Recording, filed: Recording, tmp_path: Path
):
    here, there = (export_mcap(r, tmp_path / f"{k}.mcap") for k, r in enumerate((short, filed)))
    assert here.read_bytes() == there.read_bytes()
    scene = load_scene("stairs:0.1", 0)
    here, there = (trip_picture(r, scene, tmp_path / f"{k}.png") for k, r in enumerate((short, filed)))
    assert here.read_bytes() == there.read_bytes()


# --- the situation ---------------------------------------------------------------------------------
def test_a_recording_keeps_the_situation(laps: list[Lap], filed: Recording):
    for tick in (0, 400, 1000, len(laps) - 1):
        lap, route, sensed = laps[tick], route_at(filed, tick), sensed_at(filed, tick)
        assert route is not None
        assert route.ahead == lap.route.ahead
        assert (route.remaining, route.speed, route.arrived) == (lap.route.remaining, lap.route.speed, False)
        assert route.path[0] == lap.route.path[0] and len(route.path) == len(lap.route.path)
        assert (route.begins, route.ends) == (lap.route.begins, lap.route.ends) and route.ends is not None
        np.testing.assert_array_equal(sensed.qd, lap.sensed.qd)
        assert call_at(filed, tick).skill == lap.call.skill


def test_a_recording_keeps_what_was_remembered(laps: list[Lap], tmp_path: Path):
    notes = ({}, {"stairs": "noted"}, {"stairs": "noted", "height": 0.3})
    told = [lap._replace(call=replace(lap.call, memory=notes[k // 4 % 3])) for k, lap in enumerate(laps[:20])]
    again = load(recorded(told).save(tmp_path / "a.npz"))
    assert [dict(call_at(again, k).memory) for k in range(20)] == [notes[k // 4 % 3] for k in range(20)]
    with np.load(tmp_path / "a.npz") as arrays:
        old = {name: arrays[name] for name in arrays.files if name != "memory"}
    np.savez_compressed(tmp_path / "old.npz", **old)
    assert call_at(load(tmp_path / "old.npz"), 7).memory == {}


def test_the_situation_of_a_recording_is_the_one_that_was_met(laps: list[Lap], filed: Recording):
    for tick in (1, 400, 1000, len(laps) - 1):
        lap, before = laps[tick], laps[tick - 1].call
        met = named(measured(ROBOT, lap.route, lap.sensed, before), before)
        assert FOREST.read({}, situation_at(filed, tick)) == met


def test_nobody_looked_is_recorded_as_such(laps: list[Lap]):
    blind = laps[0]._replace(route=replace(laps[0].route, ahead=None, path=()))
    route = route_at(recorded([blind]), 0)
    assert route is not None and route.ahead is None and route.path == ()


# --- what a lap is made of -------------------------------------------------------------------------
def test_arrays_of_other_types_are_converted(laps: list[Lap], short: Recording):
    def other(lap: Lap) -> Lap:
        q, load = np.asfortranarray(lap.sensed.q), lap.sensed.load.astype(np.float32)
        return lap._replace(sensed=replace(lap.sensed, q=q, load=load))

    again = recorded([other(lap) for lap in laps])
    np.testing.assert_array_equal(again["q"], short["q"])
    np.testing.assert_allclose(again["load"], short["load"], rtol=1e-6)


# --- a full disk -----------------------------------------------------------------------------------
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that takes nothing")
def test_a_full_disk_ends_a_trip_and_loses_nothing(laps: list[Lap], monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(rows, "IN_MEMORY", 1)
    recorder = Recorder(ROBOT, "stairs", 0, 0.002)
    many = [*laps, *laps, *laps]
    for lap in many[:2100]:  # one block is in the file
        recorder.add(lap)
    assert recorder.writer.file is not None
    recorder.writer.file.close()
    recorder.writer.file = open("/dev/full", "wb", buffering=0)  # noqa: SIM115 - takes nothing
    recorder.writer.blocks = 0
    taken = 2100
    with pytest.raises(NoRoom, match=r"no room for the recording in .*: No space left on device"):
        for lap in many[2100:]:
            taken += 1
            recorder.add(lap)
    assert len(recorder.finish()) == taken - 1024
    assert "No space left on device" in recorder.finish().stopped_because


FULL = """
import resource
from gaitwright import Mission, load_robot, load_scene, walk
from gaitwright.locomotion import Brain
from gaitwright.skills.chooser import fixed_skill
from gaitwright.plant.registry import make_plant
from gaitwright.record import rows
rows.IN_MEMORY = 1
resource.setrlimit(resource.RLIMIT_FSIZE, (2_000_000, 2_000_000))
robot, scene = load_robot("go2"), load_scene("flat", 0)
brain = Brain.of(robot, scene, fixed_skill(robot, "stand", 0.0, 0.0, 0.0, "numerical"))
r = walk(brain, make_plant("mujoco", robot, scene, 0.002), Mission(()), 20.0)
print(len(r), r.stopped_because, r.report().falls)
"""


@posix
def test_a_walk_whose_file_may_not_grow_is_kept(tmp_path: Path):
    environment = {**os.environ, "TMPDIR": str(tmp_path)}
    child = subprocess.run(
        [sys.executable, "-c", FULL], env=environment, capture_output=True, text=True, check=False
    )
    assert child.stdout.strip() == f"4096 no room for the recording in {tmp_path}: File too large 0", child
    assert not any(tmp_path.iterdir())


# --- memory ----------------------------------------------------------------------------------------
LONG = """
import sys
from dataclasses import replace
from itertools import cycle, islice
from pathlib import Path
from gaitwright import Brain, Mission, load_robot, load_scene
from gaitwright.session import Session
from gaitwright.pictures import trip_picture
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.record.recording import Recorder, load
from gaitwright.skills.chooser import fixed_skill

def peak():
    status = Path("/proc/self/status").read_text()
    return int(status.split("VmHWM:")[1].split()[0]) * 1024

def made_of(laps, ticks, name):
    recorder = Recorder(robot, "flat", 0, 0.002)
    for tick, lap in enumerate(islice(cycle(laps), ticks)):
        recorder.add(lap._replace(sensed=replace(lap.sensed, time=0.002 * tick)))
    recording = recorder.finish()
    del recorder
    report = recording.report()
    again = load(recording.save(name))
    assert again.report() == report and len(again) == ticks
    del again
    trip_picture(recording, scene, name + ".png")
    return recording

robot, scene = load_robot("go2"), load_scene("flat", 0)
brain = Brain.of(robot, scene, fixed_skill(robot, "trot", 0.4, 0.0, 0.3, "numerical"))
laps = list(Session(brain, MujocoPlant(robot, scene), Mission(()), 1.0))
made_of(laps, 30_000, "short.npz")
before = peak()
made_of(laps, int(sys.argv[1]), "long.npz")
print(peak() - before)
"""


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="only Linux tells a process its peak")
def test_a_long_recording_takes_little_more_memory_than_a_short_one(tmp_path: Path):
    pytest.importorskip("matplotlib")
    ticks = 200_000
    child = subprocess.run(
        [sys.executable, "-c", LONG, str(ticks)], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert child.returncode == 0, child.stderr
    assert int(child.stdout) < 784 * ticks / 2, "its rows alone are 784 bytes a tick"
