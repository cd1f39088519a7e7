"""The table "Where a change goes" in CONTRIBUTING.md, tried: made there, a change is noticed nowhere else."""

import re
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest

from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Surface
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.trees import interval_tree
from gaitwright.locomotion import Brain
from gaitwright.numerics.geometry import rotation
from gaitwright.perception.known_ground import KnownGround
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import walk
from gaitwright.signals import Measured, Mission, MotorCommand, Route, Sensed
from gaitwright.skills import library, situation
from gaitwright.skills.chooser import fixed_skill
from gaitwright.skills.library import Skill
from gaitwright.skills.measured import measured
from oracles import robot_called

ROOT = Path(__file__).parents[1]
GO2 = robot_called("go2")
FLAT = load_scene("flat")


def rows() -> list[list[str]]:
    """The cells of the table."""
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    table = text.split("## Where a change goes")[1].split("\n## ")[0]
    return [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in table.splitlines()[3:]
        if "|" in line
    ]


def test_every_file_and_folder_that_the_table_names_is_there() -> None:
    assert len(rows()) > 15 and len({wish for wish, *_ in rows()}) == len(rows()), "a wish stands once"
    for wish, where, _ in rows():
        named = [name for name in re.findall(r"`([\w/.]+)`", where) if "/" in name or name.endswith(".py")]
        for name in named:
            there = (ROOT / "src/gaitwright" / name, ROOT / name)
            assert any(place.exists() for place in there), f"{wish}: there is no {name}"


def test_a_gait_is_one_row_of_the_library_and_is_chosen(monkeypatch: pytest.MonkeyPatch) -> None:
    amble = Skill("amble", 0.42, 0.65, "single-foot", 0.3, 0.6, "a slow rack", cruise=0.6)
    monkeypatch.setitem(library.LIBRARY, "amble", amble)
    mission = Mission(((1.5, 0.0),), speed=0.45)
    recording = walk(Brain.of(GO2, FLAT), MujocoPlant(GO2, FLAT), mission, 20.0, seed=1)
    assert recording.arrived and "amble" in recording.skills, recording.stopped_because
    assert "trot" not in recording.skills, "0.45 m/s is for the new gait now"


class Ripples(Surface):
    """A terrain that nobody thought of: waves along x."""

    def height(self, x, y):
        return 0.01 * np.sin(4.0 * np.asarray(x)) + 0.0 * np.asarray(y)

    def normal(self, x, y):
        slope = 0.04 * np.cos(4.0 * np.asarray(x)) + 0.0 * np.asarray(y)
        up = np.stack([-slope, 0.0 * slope, np.ones_like(slope)], axis=-1)
        return up / np.linalg.norm(up, axis=-1, keepdims=True)


def test_a_terrain_is_one_class_for_eyes_feet_and_physics() -> None:
    scene = Scene("ripples", Ripples(), bounds=(-2.0, -2.0, 6.0, 2.0))
    brain = Brain.of(GO2, scene, fixed_skill(GO2, "trot", 0.4, 0.0, 0.0, "numerical"))
    recording = walk(brain, MujocoPlant(GO2, scene), Mission(()), 4.0, seed=1)
    assert recording.done and not recording.fell, recording.stopped_because
    sensed = MujocoPlant(GO2, scene).reset(vary=False)
    scan = brain.perception.look(KnownGround.of(scene, GO2).ground, sensed)
    assert scan is not None and scan.roughness > 0.003


@dataclass(frozen=True, slots=True)
class WithTilt(Measured):
    """A sensor more."""

    tilt: float = 0.0


class Instrumented(MujocoPlant):
    """The plant gives the sensor its value."""

    def sense(self) -> Measured:
        told = super().sense()
        tilt = float(np.arccos(np.clip(rotation(told.orientation_wb)[2, 2], -1.0, 1.0)))
        return WithTilt.of_row(told.row, specific_force_b=told.specific_force_b, tilt=tilt)


def test_a_sensor_is_a_field_and_its_value_and_stages_that_do_not_read_it_do_not_notice() -> None:
    seen: list[float] = []

    @dataclass(frozen=True)
    class Reading(KnownGround):
        def perceive(self, measured: Measured, memory: None):
            if isinstance(measured, WithTilt):
                seen.append(measured.tilt)
            return super().perceive(measured, memory)

    brain = Brain.of(GO2, FLAT, fixed_skill(GO2, "trot", 0.4, 0.0, 0.0, "numerical"))
    plain = walk(brain, MujocoPlant(GO2, FLAT), Mission(()), 0.5, seed=1)
    known = KnownGround.of(FLAT, GO2)
    reading = replace(brain, perception=Reading(known.ground, known.scanner))
    told = walk(reading, Instrumented(GO2, FLAT), Mission(()), 0.5, seed=1)
    np.testing.assert_array_equal(told["q"], plain["q"])
    assert len(seen) >= len(told) and max(seen) > 0.001


def test_a_feature_of_rules_is_a_tree_of_the_forest(monkeypatch: pytest.MonkeyPatch) -> None:
    hurry = replace(interval_tree("hurry", "m/s", (0.5,), ("calm", "hurried")), source="wished")
    monkeypatch.setattr(situation, "FOREST", Forest((*situation.FOREST.trees, hurry)))
    sensed = MujocoPlant(GO2, FLAT).reset(vary=False)
    for speed, leaf in ((0.2, "calm"), (0.8, "hurried")):
        raw = measured(GO2, Route(((3.0, 0.0),), 3.0, speed), sensed)
        assert situation.named(raw)["hurry"] == leaf


def test_a_real_robot_is_another_plant() -> None:
    class Radio:
        """Two methods and a period."""

        dt = 0.002

        def __init__(self) -> None:
            self.robot = MujocoPlant(GO2, FLAT)
            self.told: list[MotorCommand] = []

        def reset(self, seed: int = 0, vary: bool = True) -> Sensed:
            return self.robot.reset(seed, vary)

        def step(self, command: MotorCommand) -> Measured:
            self.told.append(command)
            return self.robot.step(command)

    radio = Radio()
    brain = Brain.of(GO2, FLAT, fixed_skill(GO2, "trot", 0.4, 0.0, 0.0, "numerical"))
    assert walk(brain, radio, Mission(()), 0.3, seed=1).done
    assert not radio.told[-1].tau.any(), "the last word is: motors off"
