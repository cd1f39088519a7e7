"""A recording keeps how things moved: in its file, for Foxglove, and of scenes that nobody has any more."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader

from gaitwright.errors import BadFile
from gaitwright.ground.moving import Mover
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.solids import Prism, Sphere
from gaitwright.ground.terrain import Box, Flat
from gaitwright.locomotion import Brain
from gaitwright.plant.kinematic import KinematicPlant
from gaitwright.record.channels import widths
from gaitwright.record.mcap_export import THINGS, export_mcap
from gaitwright.record.npz import write_npz
from gaitwright.record.recording import Recording, load
from gaitwright.record.scene_of import scene_of
from gaitwright.session import walk
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill
from oracles import robot_called

GO2 = robot_called("go2")
MOVERS = (
    Mover(Box(2.0, -1.0, 0.3, 0.5, 0.4, 0.3), ((2.0, 1.0),), 0.5, loop=True),
    Mover(Prism(((3.0, 0.0), (4.0, 0.0), (4.0, 1.0)), 0.4), appears=0.3, vanishes=0.8),
    Mover(Sphere(-2.0, 1.0, 0.4, 0.3), ((-2.0, -1.0),), 1.0, begins=0.5),
)
SECONDS = 1.0
BALL = {"type": "sphere", "x": 1, "y": 1, "radius": 1}


def walked(scene: Scene, name: str, seed: int = 0) -> Recording:
    chooser = fixed_skill(GO2, "walk", 0.2, 0.0, 0.0, "kinematic")
    brain = Brain.of(GO2, Scene("empty", Flat()), chooser)
    mission = Mission((), driver="kinematic")
    return walk(brain, KinematicPlant(GO2, scene), mission, SECONDS, seed, scene=name)


@pytest.fixture(scope="module")
def recording() -> Recording:
    """A second in a scene that was in a file."""
    return walked(Scene("garden", Flat(), movers=MOVERS), "garden")


def things_in(path: Path) -> list[dict]:
    """The messages that say where moving things are."""
    with path.open("rb") as file:
        read = [
            json.loads(message.data) for _, channel, message in make_reader(file).iter_messages()
            if channel.topic == "/gaitwright/scene"
        ]  # fmt: skip
    return [message["entities"][0] for message in read if message["entities"][0]["id"] == "things"]


def test_how_things_moved_is_in_the_file(recording: Recording, tmp_path: Path) -> None:
    assert recording.movers == MOVERS
    again = load(recording.save(tmp_path / "walk.npz"))
    assert again.movers == MOVERS
    np.testing.assert_array_equal(again.data, recording.data)
    assert again.report().state_hash == recording.report().state_hash


def test_where_nothing_moves_there_is_nothing_to_keep(tmp_path: Path) -> None:
    still = walked(load_scene("flat"), "flat")
    assert still.movers == () and load(still.save(tmp_path / "walk.npz")).movers == ()


def test_foxglove_is_told_where_they_are_all_the_time(recording: Recording, tmp_path: Path) -> None:
    scene = Scene("garden", Flat(), movers=MOVERS)
    told = things_in(export_mcap(recording, tmp_path / "walk.mcap", scene))
    assert len(told) == pytest.approx(SECONDS * THINGS, abs=1)
    for entity in told:
        time = entity["timestamp"]["sec"] + 1e-9 * entity["timestamp"]["nsec"]
        there = [mover for mover in MOVERS if mover.is_there(time)]
        shown = [*entity["cubes"], *entity["triangles"], *entity["spheres"]]
        assert len(shown) == len(there)
        (cube,) = entity["cubes"]
        place = [cube["pose"]["position"][axis] for axis in "xy"]
        assert place == pytest.approx(MOVERS[0].place(time), abs=1e-6)
        (ball,) = entity["spheres"]
        assert ball["pose"]["position"]["y"] == pytest.approx(MOVERS[2].place(time)[1], abs=1e-6)


def test_what_moved_is_shown_though_the_scene_is_not_to_be_had(recording: Recording, tmp_path: Path) -> None:
    assert isinstance(scene_of(recording), str)
    path = export_mcap(recording, tmp_path / "walk.mcap")
    assert len(things_in(path)) == pytest.approx(SECONDS * THINGS, abs=1)
    with path.open("rb") as file:
        facts = next(iter(make_reader(file).iter_metadata())).metadata
    assert facts["ground"].startswith("left out: no scene 'garden'")


def test_a_family_draws_the_same_motion_again() -> None:
    scene = load_scene("plaza", 5)
    told = walked(scene, "plaza", 5)
    assert scene_of(told) == scene and told.movers == scene.movers


@pytest.mark.parametrize(
    ("movers", "said"),
    [
        ("all", "array"),
        ([{"type": "ghost"}], "ghost"),
        ([{"type": "sphere", "x": 1, "y": 1}], "radius"),
        ([BALL | {"appears": 5, "vanishes": 2}], "never there"),
        (
            [{"type": "sphere", "x": 1, "y": 1, "radius": 1, "moves": {"along": [[1, 1]], "speed": 1}}],
            "no way",
        ),
        ([BALL] * 101, "length"),
    ],
)
def test_a_motion_that_cannot_be_is_no_recording(
    movers, said: str, recording: Recording, tmp_path: Path
) -> None:
    header = recording.header() | {"movers": movers}
    channels = {name: recording.channel(name) for name in widths(recording.robot.n)}
    write_npz(tmp_path / "odd.npz", json.dumps(header).encode(), channels)
    with pytest.raises(BadFile, match=said):
        load(tmp_path / "odd.npz")


def test_an_older_recording_has_none(recording: Recording, tmp_path: Path) -> None:
    header = recording.header()
    del header["movers"]
    channels = {name: recording.channel(name) for name in widths(recording.robot.n)}
    write_npz(tmp_path / "old.npz", json.dumps(header).encode(), channels)
    assert load(tmp_path / "old.npz").movers == ()
    assert replace(recording, movers=()).header()["movers"] == []
