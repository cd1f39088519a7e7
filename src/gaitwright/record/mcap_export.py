"""Recording → MCAP with ROS 2 messages in CDR, which Foxglove and Rerun open as they are.

Topics: `/joint_states` (sensor_msgs/JointState: angles, rates, torques), `/tf` (tf2_msgs/TFMessage: world →
base → the links of every leg), `/tf_static` (their feet), `/robot_description` (std_msgs/String: a URDF with
these links and joints), `/gaitwright/scene` (foxglove.SceneUpdate: ground, boxes, the way, what moves),
`/gaitwright/changes` (JSON: skill, driver and rule, whenever one changes, and why), `/gaitwright/mode`,
`/lesson`, `/edit` and `/world` (JSON: what a person did), `/gaitwright/scan` (JSON: the ground ahead,
whenever it looks different), and those of `mcap_previews`. Needs the extra `record`.
"""

import json
import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
from mcap_ros2.writer import Writer

from gaitwright.files import fitting, whole
from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Flat
from gaitwright.model.robot import Robot
from gaitwright.model.urdf import Names, write_urdf
from gaitwright.numerics.geometry import quaternion_of
from gaitwright.plant.mujoco.world import JOINTS
from gaitwright.record.changes import Change, changes_of
from gaitwright.record.channels import SCAN
from gaitwright.record.mcap_previews import write_previews
from gaitwright.record.notes import DONE
from gaitwright.record.recording import Recording
from gaitwright.record.rows import parts
from gaitwright.record.scene_of import rearranged, scene_of
from gaitwright.record.scenery import SCHEMA, scene_update, things_update, way_update
from gaitwright.signals import Scan

RATE = 100.0
"""Messages per second of simulated time."""
THINGS = 20.0
"""Messages per second that say where moving things are."""

HEADER = """
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""
JOINT_STATE = f"""std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
{HEADER}"""
TF_MESSAGE = f"""geometry_msgs/TransformStamped[] transforms
================================================================================
MSG: geometry_msgs/TransformStamped
std_msgs/Header header
string child_frame_id
geometry_msgs/Transform transform
================================================================================
MSG: geometry_msgs/Transform
geometry_msgs/Vector3 translation
geometry_msgs/Quaternion rotation
================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
================================================================================
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
{HEADER}"""
CHANGES = {
    "title": "gaitwright.Changes",
    "type": "object",
    "properties": {"time": {"type": "number"}, **{name: {"type": "string"} for name in Change._fields[1:]}},
    "required": list(Change._fields),
}
NOTES = {
    "title": "gaitwright.Note",
    "type": "object",
    "properties": {"time": {"type": "number"}, "sentence": {"type": "string"}},
    "required": ["time", "sentence"],
}
FIELDS = tuple(field.name for field in fields(Scan))
SCANS = {
    "title": "gaitwright.Scan",
    "type": "object",
    "properties": {name: {"type": ["number", "null"]} for name in ("time", *FIELDS)},
    "required": ["time", *FIELDS],
}


def export_mcap(recording: Recording, path: str | Path, scene: Scene | None = None) -> Path:
    """Writes the recording as `.mcap`, thinned to 100 Hz; complete or not at all.

    `scene`: where it was made, else the one that the recording names; where that is not to be had, the ground
    is left out, and the metadata `gaitwright` says why.
    """
    path, sound = Path(path), recording.sound()
    facts = {"robot": recording.robot.name, "scene": recording.scene, "seed": str(recording.seed)}
    facts |= {"stopped_because": recording.stopped_because}
    with fitting(path), whole(path) as draft, draft.open("wb") as file, Writer(file) as writer:
        write_description(writer, sound)
        ground = rearranged(scene, recording) if scene else scene_of(recording)
        facts |= write_scene(writer, sound, ground)
        write_changes(writer, sound)
        write_notes(writer, sound)
        write_scans(writer, sound)
        write_previews(writer, sound, ground)
        write_states(writer, sound)
        writer.add_metadata("gaitwright", facts)
    return path


def write_description(writer: Writer, r: Recording) -> None:
    """The robot, as what shows it wants it: a URDF with the frames and joints of the other topics."""
    text = writer.register_msgdef("std_msgs/msg/String", "string data")
    urdf = write_urdf(r.robot, Names(JOINTS, JOINTS), shapes=True)
    writer.write_message("/robot_description", text, {"data": urdf}, nanoseconds(float(r.at("time", 0))))


def write_scene(writer: Writer, r: Recording, scene: Scene | str) -> dict[str, str]:
    """Ground, boxes, way, and what moves; a sentence in place of the scene is handed back as a fact."""
    if isinstance(scene, str) and not r.movers:
        return {"ground": f"left out: {scene}"}
    start = float(r.at("time", 0))
    write = topic(writer, "/gaitwright/scene", "foxglove.SceneUpdate", SCHEMA)
    told, way = {}, way_points(r)
    if isinstance(scene, str):  # what moved is in the recording itself
        told, scene = {"ground": f"left out: {scene}"}, rearranged(Scene("", Flat()), r)
    else:
        write(scene_update(scene, start), start)
        if len(way) > 1:
            write(way_update(scene, way, start), start)
    for (time,) in thinned(r, "time", rate=THINGS) if r.movers else ():
        write(things_update(scene, float(time)), float(time))
    return told


def way_points(r: Recording) -> list[tuple[float, float]]:
    """From the start over the points that the robot walked towards, each as often as it turned to it [m]."""
    x, y, _ = r.at("position_w", 0).tolist()
    way = [(x, y)]
    for (next_point,) in thinned(r, "route_next"):
        target = (float(next_point[0]), float(next_point[1]))
        if all(map(math.isfinite, target)) and target != way[-1]:
            way.append(target)
    return way


def write_states(writer: Writer, r: Recording) -> None:
    """Joint states and transforms, 100 times a second."""
    joint_state = writer.register_msgdef("sensor_msgs/msg/JointState", JOINT_STATE)
    tf_message = writer.register_msgdef("tf2_msgs/msg/TFMessage", TF_MESSAGE)
    names = joint_names(r.robot)
    fixed = {"transforms": [transform(0, *frame) for frame in feet_on_shanks(r.robot)]}
    writer.write_message("/tf_static", tf_message, fixed, nanoseconds(float(r.at("time", 0))))
    ticks = thinned(r, "time", "q", "qd", "tau", "position_w", "orientation_wb")
    for count, (time, q, qd, tau, position, orientation) in enumerate(ticks):
        at = nanoseconds(time)
        header = {"stamp": stamp(at), "frame_id": "world"}
        joints = {"header": header, "name": names, "position": q, "velocity": qd, "effort": tau}
        writer.write_message("/joint_states", joint_state, plain(joints), at, at, count)
        frames = transforms(r.robot, q.reshape(-1, 3), position, orientation)
        tf = {"transforms": [transform(at, *frame) for frame in frames]}
        writer.write_message("/tf", tf_message, tf, at, at, count)


def write_changes(writer: Writer, r: Recording) -> None:
    """Which skill by which driver and by which rule, whenever one of them changes."""
    write = topic(writer, "/gaitwright/changes", "gaitwright.Changes", CHANGES)
    for change in changes_of(r):
        write(change._asdict(), change.time)


def write_notes(writer: Writer, r: Recording) -> None:
    """What a person did, a topic for each kind of thing."""
    for kind in dict.fromkeys(note.kind for note in r.notes if note.kind in DONE):
        write = topic(writer, f"/gaitwright/{kind}", "gaitwright.Note", NOTES)
        for note in (one for one in r.notes if one.kind == kind):
            write({"time": note.time, "sentence": note.sentence}, note.time)


def write_scans(writer: Writer, r: Recording) -> None:
    """What was seen of the ground ahead, whenever that changes; null for what is out of sight."""
    write = topic(writer, "/gaitwright/scan", "gaitwright.Scan", SCANS)
    before: list[float] = []
    for time, *values in thinned(r, "time", *SCAN):
        scan = [float(value) for value in values]
        if scan == before or math.isnan(scan[0]):
            continue
        before = scan
        seen = {
            name: value if math.isfinite(value) else None for name, value in zip(FIELDS, scan, strict=True)
        }
        write({"time": float(time), **seen}, float(time))


def topic(writer: Writer, name: str, kind: str, schema: dict[str, Any]) -> Callable[[Any, float], None]:
    """A topic of JSON messages, and who writes one of a time [s] to it. The ROS 2 writer offers no JSON; the
    one that it wraps does."""
    raw = writer._writer
    described = raw.register_schema(kind, "jsonschema", json.dumps(schema).encode())
    channel = raw.register_channel(name, "json", described)

    def write(message: Any, time: float) -> None:
        at = nanoseconds(time)
        raw.add_message(channel, at, json.dumps(message).encode(), at)

    return write


def thinned(r: Recording, *names: str, rate: float = RATE) -> Iterator[tuple[Any, ...]]:
    """What some channels are, so often a second."""
    step, channels = max(1, round(1.0 / (rate * r.dt))), [r.channel(name) for name in names]
    for part in parts(len(r)):
        yield from zip(*(channel[part][-part.start % step :: step] for channel in channels), strict=True)


def joint_names(robot: Robot) -> list[str]:
    """`FL_hip1`, `FL_hip2`, `FL_knee`, `FR_hip1`, …"""
    return [f"{leg}_{joint}" for leg in robot.legs for joint in JOINTS]


Frame = tuple[str, str, np.ndarray, np.ndarray]
"""Parent, child, translation [m], rotation (w, x, y, z)."""


def transforms(robot: Robot, q: np.ndarray, position: np.ndarray, orientation: np.ndarray) -> Iterable[Frame]:
    """World → base → hip 1 → hip 2 → knee, for every leg."""
    yield "world", "base", position, orientation
    for k, leg in enumerate(robot.legs):
        hip1, hip2, knee = (f"{leg}_{joint}" for joint in JOINTS)
        yield "base", hip1, robot.hip[k], times(quaternion_of(robot.leg_frame[k]), about(0, q[k, 0]))
        yield hip1, hip2, robot.offset[k, 0], about(1, q[k, 1])
        yield hip2, knee, robot.offset[k, 1], about(1, robot.sign[k] * q[k, 2])


def feet_on_shanks(robot: Robot) -> Iterable[Frame]:
    """Knee → foot, which never changes."""
    for k, leg in enumerate(robot.legs):
        yield f"{leg}_{JOINTS[2]}", f"{leg}_foot", robot.offset[k, 2], np.array([1.0, 0.0, 0.0, 0.0])


def about(axis: int, angle: float) -> np.ndarray:
    """The quaternion of a turn by `angle` [rad] about x (0) or y (1)."""
    out = np.array([np.cos(angle / 2), 0.0, 0.0, 0.0])
    out[1 + axis] = np.sin(angle / 2)
    return out


def times(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The product of two quaternions: first `b`, then `a`."""
    (aw, ax, ay, az), (bw, bx, by, bz) = a.tolist(), b.tolist()
    return np.array(
        [
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by + ay * bw + az * bx - ax * bz,
            aw * bz + az * bw + ax * by - ay * bx,
        ]
    )


# --- messages --------------------------------------------------------------------------------------
def transform(
    at: int, parent: str, child: str, translation: np.ndarray, rotation: np.ndarray
) -> dict[str, Any]:
    """One TransformStamped."""
    x, y, z = map(float, translation)
    qw, qx, qy, qz = map(float, rotation)
    moved = {"translation": {"x": x, "y": y, "z": z}, "rotation": {"x": qx, "y": qy, "z": qz, "w": qw}}
    return {"header": {"stamp": stamp(at), "frame_id": parent}, "child_frame_id": child, "transform": moved}


def plain(message: dict[str, Any]) -> dict[str, Any]:
    """Arrays as lists."""
    return {key: value.tolist() if isinstance(value, np.ndarray) else value for key, value in message.items()}


def nanoseconds(time: float) -> int:
    return round(time * 1e9)


def stamp(at: int) -> dict[str, int]:
    return {"sec": at // 1_000_000_000, "nanosec": at % 1_000_000_000}
