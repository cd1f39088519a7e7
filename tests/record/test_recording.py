"""A walk to file and back: npz, MCAP, picture, and the figures' laws."""

import json
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory

from gaitwright.description.load import load_robot
from gaitwright.errors import BadFile
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain
from gaitwright.model.kinematics import feet
from gaitwright.numerics.geometry import rotation
from gaitwright.pictures import trip_picture
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.record import metrics as figures
from gaitwright.record.mcap_export import export_mcap
from gaitwright.record.recording import Recording, load
from gaitwright.session import walk
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill


@pytest.fixture(scope="module")
def recording() -> Recording:
    """Go2 walks for a second over blocks."""
    robot, scene = load_robot("go2"), load_scene("blocks", 1)
    chooser = fixed_skill(robot, "walk", 0.2, 0.05, 0.1, "numerical")
    brain = Brain.of(robot, scene, chooser)
    return walk(brain, MujocoPlant(robot, scene), Mission(()), 1.0, seed=1, scene="blocks")


# --- npz -------------------------------------------------------------------------------------------
def test_a_recording_survives_its_file(recording: Recording, tmp_path: Path):
    again = load(recording.save(tmp_path / "deep" / "walk.npz"))
    np.testing.assert_array_equal(again.data, recording.data)
    assert again.report() == recording.report()
    assert [path.name for path in (tmp_path / "deep").iterdir()] == ["walk.npz"]


@pytest.mark.parametrize("content", [b"", b"hello", b"PK\x03\x04 torn"], ids=["empty", "text", "torn"])
def test_what_is_no_recording_is_refused(content: bytes, tmp_path: Path):
    (tmp_path / "a.npz").write_bytes(content)
    with pytest.raises(BadFile, match=r"a\.npz is not a recording"):
        load(tmp_path / "a.npz")


def test_a_recording_without_its_channels_is_refused(tmp_path: Path):
    np.savez(tmp_path / "a.npz", header=np.zeros(3))
    with pytest.raises(BadFile, match="is not a recording"):
        load(tmp_path / "a.npz")


def test_an_unknown_channel_names_those_there_are(recording: Recording):
    with pytest.raises(KeyError, match="no channel 'height'; there is: time, position_w"):
        _ = recording["height"]


def test_a_state_that_blew_up_leaves_finite_figures(recording: Recording):
    recording = Recording(**{**vars(recording), "data": recording.data.copy()})
    recording["velocity_w"][-1] = np.nan
    recording["position_w"][-2] = 1e300
    report = json.loads(recording.report().to_json(), parse_constant=pytest.fail)
    assert 0.1 < report["distance_m"] < 0.5


# --- MCAP ------------------------------------------------------------------------------------------
def test_mcap_reads_back_as_ros_2_messages(recording: Recording, tmp_path: Path):
    path = export_mcap(recording, tmp_path / "walk.mcap")
    with path.open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        assert {channel.topic for channel in reader.get_summary().channels.values()} == {
            "/joint_states", "/tf", "/tf_static", "/gaitwright/changes", "/gaitwright/scan",
            "/gaitwright/scene", "/robot_description",
        }  # fmt: skip
        decoded = [
            (m.log_time, ros) for _, _, m, ros in reader.iter_decoded_messages(topics=["/joint_states"])
        ]
        trees = [ros for *_, ros in reader.iter_decoded_messages(topics=["/tf", "/tf_static"])]
        changes = [json.loads(m.data) for _, _, m in reader.iter_messages(topics=["/gaitwright/changes"])]
        scans = [json.loads(m.data) for _, _, m in reader.iter_messages(topics=["/gaitwright/scan"])]
        schemas = {schema.name for schema in reader.get_summary().schemas.values()}
    assert schemas == {
        "sensor_msgs/msg/JointState",
        "tf2_msgs/msg/TFMessage",
        "gaitwright.Changes",
        "gaitwright.Scan",
        "foxglove.SceneUpdate",
        "std_msgs/msg/String",
    }
    walking = {"skill": "walk", "driver": "numerical", "rule": ""}
    assert changes == [{"time": 0.0, **walking, "because": "asked for"}]
    assert scans[0]["time"] == 0.0 and scans[0]["slope"] == recording["scan_slope"][0]
    assert len(scans) == 1  # with nowhere to go, nobody looks again

    times, states = zip(*decoded, strict=True)
    np.testing.assert_allclose(np.diff(times), 1e7, atol=1)
    assert list(states[0].name[:4]) == ["FL_hip1", "FL_hip2", "FL_knee", "FR_hip1"]
    np.testing.assert_array_equal([s.position for s in states], recording["q"][::5])
    np.testing.assert_array_equal([s.effort for s in states], recording["tau"][::5])
    assert states[10].header.stamp.nanosec == times[10] % 1_000_000_000
    np.testing.assert_allclose(
        foot_in_world(trees, "RR", at=30), expected_foot(recording, tick=145), atol=1e-12
    )


def foot_in_world(trees: list, leg: str, at: int) -> np.ndarray:
    """Where the transforms put a foot."""
    links = {t.child_frame_id: t for tree in (trees[0], trees[at]) for t in tree.transforms}
    frame, point = f"{leg}_foot", np.zeros(3)
    while frame != "world":
        moved = links[frame].transform
        turn = rotation(np.array([moved.rotation.w, moved.rotation.x, moved.rotation.y, moved.rotation.z]))
        point = turn @ point + [moved.translation.x, moved.translation.y, moved.translation.z]
        frame = links[frame].header.frame_id
    return point


def expected_foot(recording: Recording, tick: int) -> np.ndarray:
    """Where the kinematics put the last foot."""
    foot = feet(recording.robot, np.ascontiguousarray(recording["q"][tick].reshape(-1, 3)))[-1]
    turn = rotation(np.ascontiguousarray(recording["orientation_wb"][tick]))
    return recording["position_w"][tick] + turn @ foot


# --- picture ---------------------------------------------------------------------------------------
@pytest.mark.parametrize("scene", ["blocks", "rough:0.05"])
def test_a_picture_is_drawn_1600_pixels_wide(scene: str, recording: Recording, tmp_path: Path):
    picture = imread(trip_picture(recording, load_scene(scene, 1), tmp_path / "trip.png"))
    assert picture.shape[1] == 1600
    assert picture[..., :3].std() > 0.05
    assert [path.name for path in tmp_path.iterdir()] == ["trip.png"]


# --- figures ---------------------------------------------------------------------------------------
def test_the_velocity_error_sees_a_constant_lag_and_no_ripple():
    ticks, dt, period = 5000, 0.002, 0.4
    command = np.tile([0.5, 0.0, 0.2], (ticks, 1))
    ripple = 0.3 * np.sin(2 * np.pi * np.arange(ticks) * dt / period)
    moved = command - [0.04, 0.03, 0.01] + ripple[:, None]
    skill, periods = np.zeros(ticks), np.full(ticks, period)
    error, yaw_error = figures.command_errors(moved, command, skill, periods, dt)
    assert error == pytest.approx(0.05)
    assert yaw_error == pytest.approx(0.01)
    assert figures.command_errors(moved, 0.0 * command, skill, periods, dt) == (0.0, 0.0)


def test_roll_and_pitch_are_those_of_the_axes():
    half = 0.1
    turned = np.array([[np.cos(half), np.sin(half), 0, 0], [np.cos(half), 0, np.sin(half), 0]])
    roll, pitch = figures.attitude(turned)
    np.testing.assert_allclose([roll, pitch], [[0.2, 0.0], [0.0, 0.2]], atol=1e-15)


def test_desirability_is_one_at_best_and_nothing_at_worst():
    assert figures.desirability(1.0, 0.0, True, 0.0, 0.3) == 1.0
    assert figures.desirability(0.0, 1e9, False, 1e9, 0.3) == 0.0
    assert figures.uprightness(True, 0.0, 0.0) == 0.0


def test_footfalls_are_the_starts_of_stance():
    stance = np.array([[1, 0], [1, 1], [0, 1], [1, 1]], dtype=bool)
    assert figures.touchdowns(stance) == [(0, 0), (1, 1), (3, 0)]
