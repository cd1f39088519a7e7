"""Each kind of what users hand over: how it is damaged, and how it is taken."""

import io
import json
import sqlite3
import zipfile
import zlib
from collections.abc import Callable
from contextlib import closing, redirect_stderr, redirect_stdout
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from random import Random
from typing import Any

import numpy as np

from gaitwright.bench.fuzz import originals
from gaitwright.bench.fuzz.command_lines import command_lines, damaged_line
from gaitwright.bench.fuzz.mutations import (
    damaged_bytes,
    damaged_json,
    damaged_value,
    damaged_xml,
)
from gaitwright.control.balance_file import load_balance
from gaitwright.description.derive import derive
from gaitwright.description.load import load_robot
from gaitwright.description.mujoco_model import compiled
from gaitwright.gait.leg_cycles.check import check_cycle
from gaitwright.gait.leg_cycles.files import load_cycle
from gaitwright.ground.scene import load_scene
from gaitwright.knowledge.json_form import loads
from gaitwright.learning.map_books import learned_map_of
from gaitwright.learning.notes import relearned
from gaitwright.navigation.guidance_files import load_programme, load_steering
from gaitwright.navigation.known_field import known_field
from gaitwright.navigation.navigator import Navigator
from gaitwright.navigation.room_needed import half_width
from gaitwright.perception.known_ground import map_of
from gaitwright.plant.kinematic import KinematicPlant
from gaitwright.plant.mujoco.world import Placed, build_world
from gaitwright.record.preview_facts import facts_of
from gaitwright.record.previews import previews_in
from gaitwright.record.recording import load
from gaitwright.signals import Mission
from gaitwright.skillbook import rows
from gaitwright.skillbook.book import Skillbook, export_text, import_text
from gaitwright.skills.commanded import check_velocity
from gaitwright.skills.library import find_skill, gait_of

DOCUMENTED = (0, 1, 2, 3, 130)
"""Exit codes that a command may end with."""
GOAL = (3.0, 0.5)


class WrongEnd(Exception):
    """A command ended in another way than is documented."""


@dataclass(frozen=True)
class Kind:
    """A kind of input; `take` does what a command does with it, and raises what that raises."""

    suffix: str
    originals: Callable[[], tuple[bytes, ...]]
    damage: Callable[[Random, bytes], bytes]
    take: Callable[[Path], object]


def take_scene(path: Path) -> None:
    """Read, mapped, planned in and built."""
    robot, scene = load_robot("go2"), load_scene(str(path))
    known_field(map_of(scene, robot), half_width(robot)).way(scene.start[:2], GOAL)
    build_world([Placed(robot)], scene)


def take_cycle(path: Path) -> None:
    """Read, and checked on a robot."""
    robot, cycle = load_robot("go2"), load_cycle(path)
    check_cycle(cycle, robot, gait_of(find_skill("trot", robot), robot), 0.4)


def take_robot(path: Path) -> None:
    """Read as the child process reads it."""
    derive(compiled(path), path.stem)


def take_skillbook(path: Path) -> None:
    """Read, and its maps made of what was read."""
    book = Skillbook.load(path)
    export_text(book)
    for notes in book.maps:
        learned_map_of(notes)


def take_text(path: Path) -> None:
    """Read, and its lessons heard again."""
    book = import_text(path.read_bytes().decode(errors="surrogateescape"), path.name)
    relearned(book)


def take_route(path: Path) -> None:
    """Read, and set out on."""
    mission = Mission((), guidance=load_programme(path))
    robot, scene = load_robot("go2"), load_scene("flat")
    Navigator(robot).set_out(mission, KinematicPlant(robot, scene).reset(), map_of(scene, robot))


def take_commands(path: Path) -> None:
    """Read, and each held against what the robot can do."""
    for velocity in load_steering(path).velocities:
        check_velocity(load_robot("go2"), velocity)


def take_rulebook(path: Path) -> None:
    loads(path.read_bytes(), path.name)


def take_recording(path: Path) -> None:
    """Read, summed up, and asked about its last moment."""
    recording = load(path)
    recording.report()
    for held in previews_in(recording.previews) if recording.previews is not None else ():
        json.dumps(facts_of(recording.robot, held), allow_nan=False)
    import_module("gaitwright.cli.recorded_moment").recorded_facts(str(path), None)  # stands above us


def take_command(path: Path) -> None:
    """A command line, run in the folder of its file. Raises `WrongEnd`."""
    words = json.loads(path.read_bytes())
    main = import_module("gaitwright.cli").main  # stands above us: this is what users call
    out, err = (io.TextIOWrapper(io.BytesIO(), "utf-8") for _ in range(2))
    with redirect_stdout(out), redirect_stderr(err):
        code = main(words)
    err.flush()
    said = err.buffer.getvalue().decode(errors="replace")
    if code not in DOCUMENTED or "Traceback" in said or "\x1b" in said:
        raise WrongEnd(f"exit code {code} of {words}: {said[-400:]}")


# --- damage -----------------------------------------------------------------------------------------
def damaged_skillbook(chance: Random, content: bytes) -> bytes:
    """Bytes changed, or rows that say something else under a seal that fits."""
    if chance.random() < 0.4:
        return damaged_bytes(chance, content)
    with closing(sqlite3.connect(":memory:", isolation_level=None)) as db:
        db.deserialize(content)
        table = chance.choice(list(rows.KEYS))
        names = ", ".join(rows.KEYS[table])
        found = db.execute(f"SELECT {names}, content FROM {table}").fetchall()
        for *key, text in chance.sample(found, min(len(found), chance.choice((1, 1, 3)))):
            new = json.dumps(damaged_value(chance, json.loads(text)), ensure_ascii=True)
            put = {(table, tuple(key)): new}
            rows.put(db, put)
        return db.serialize()


def damaged_png(chance: Random, content: bytes) -> bytes:
    """Bytes changed, or numbers in a chunk under a check sum that fits."""
    if chance.random() < 0.5:
        return damaged_bytes(chance, content)
    chunks, at = [], 8
    while at < len(content):
        size = int.from_bytes(content[at : at + 4])
        chunks.append((content[at + 4 : at + 8], content[at + 8 : at + 8 + size]))
        at += size + 12
    k = chance.randrange(len(chunks))
    name, data = chunks[k]
    chunks[k] = name, damaged_bytes(chance, data)
    whole = (len(d).to_bytes(4) + n + d + zlib.crc32(n + d).to_bytes(4) for n, d in chunks)
    return content[:8] + b"".join(whole)


def damaged_text(chance: Random, content: bytes) -> bytes:
    """Lines lost, doubled or moved, or another value in the JSON of one."""
    if chance.random() < 0.2:
        return damaged_bytes(chance, content)
    lines = content.split(b"\n")
    for _ in range(chance.choice((1, 1, 3))):
        at = chance.randrange(len(lines))
        word, space, rest = lines[at].partition(b" ")
        how = chance.random()
        if how < 0.6 and plain_of(rest) is not None:
            lines[at] = word + space + json.dumps(damaged_value(chance, plain_of(rest))).encode()
        elif how < 0.75:
            del lines[at]
        elif how < 0.9:
            lines.insert(chance.randrange(len(lines)), lines[at])
        else:
            lines[at] = damaged_bytes(chance, lines[at])
        lines = lines or [b""]
    return b"\n".join(lines)


def plain_of(content: bytes) -> Any:
    """The values of JSON; `None` where it is none any more."""
    try:
        return json.loads(content)
    except ValueError:
        return None


def damaged_recording(chance: Random, content: bytes) -> bytes:
    """Bytes changed, another header, or channels of other numbers, lengths and types."""
    if chance.random() < 0.35:
        return damaged_bytes(chance, content)
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        members = {name: np.load(io.BytesIO(archive.read(name))) for name in archive.namelist()}
    if chance.random() < 0.5:
        header = damaged_value(chance, json.loads(members["header.npy"].tobytes()))
        members["header.npy"] = np.frombuffer(json.dumps(header).encode(), dtype=np.uint8)
    else:
        name = chance.choice(list(members))
        members[name] = damaged_array(chance, members[name])
    out = io.BytesIO()
    np.savez_compressed(out, **{name.removesuffix(".npy"): array for name, array in members.items()})
    return out.getvalue()


def damaged_array(chance: Random, array: np.ndarray) -> np.ndarray:
    """An array with other numbers, of another length or another type."""
    how = chance.randrange(6)
    if how == 0:
        return array[: chance.choice((0, 1, len(array) // 2))]
    if how == 1:
        with np.errstate(invalid="ignore"):  # what is no number is no whole one either
            return array.astype(chance.choice(("f4", "i8", "U3", "c16")))
    if how == 2:
        return array.reshape(-1, 1)
    array = array.astype(float)
    places = slice(None) if how == 3 else slice(chance.randrange(len(array)), None)
    array[places] = chance.choice((np.nan, np.inf, -1.0, 1e300, 0.0, 1e12, 0.5))
    return array


KINDS = {
    "scene": Kind(".json", originals.scenes, damaged_json, take_scene),
    "height map": Kind(".png", originals.height_maps, damaged_png, take_scene),
    "cycle": Kind(".json", originals.cycles, damaged_json, take_cycle),
    "mjcf": Kind(".xml", originals.mjcfs, damaged_xml, take_robot),
    "urdf": Kind(".urdf", originals.urdfs, damaged_xml, take_robot),
    "skillbook": Kind(".skills", originals.skillbooks, damaged_skillbook, take_skillbook),
    "book text": Kind(".txt", originals.texts, damaged_text, take_text),
    "rulebook": Kind(".json", originals.rulebooks, damaged_json, take_rulebook),
    "recording": Kind(".npz", originals.recordings, damaged_recording, take_recording),
    "route": Kind(".csv", originals.routes, damaged_bytes, take_route),
    "velocity": Kind(".csv", originals.commands, damaged_bytes, take_commands),
    "balance": Kind(".json", originals.balances, damaged_json, load_balance),
    "command": Kind(".line", command_lines, damaged_line, take_command),
}
