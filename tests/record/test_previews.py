"""What the terrain scanner held, in recordings: as it was made, in npz and MCAP, long, old and damaged."""

import io
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from mcap.reader import make_reader

from gaitwright.bench.fuzz.originals import recordings
from gaitwright.description.load import load_robot
from gaitwright.errors import BadFile
from gaitwright.gait.climb.climber import Climber, climb_call
from gaitwright.gait.climb.plan import climb
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain
from gaitwright.perception.reach_outline import RIM
from gaitwright.perception.terrain_preview import LAYOUT, TerrainPreview, corners_of
from gaitwright.plant.kinematic import KinematicPlant
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.record import npz, previews, rows
from gaitwright.record.mcap_export import export_mcap
from gaitwright.record.preview_facts import facts_of
from gaitwright.record.previews import EVERY, PREFIX, preview_at, preview_of, previews_in, shapes, times_of
from gaitwright.record.recording import Recorder, Recording, load
from gaitwright.record.scene_of import scene_for
from gaitwright.session import Session, record
from gaitwright.signals import Mission
from gaitwright.skills.chooser import HeldSkill, fixed_skill

GO2 = load_robot("go2")
STAIRS = load_scene("stairs", 1)


def session(seconds: float = 1.2) -> Session:
    """Go2 on its way over stairs."""
    return Session(Brain.of(GO2, STAIRS), MujocoPlant(GO2, STAIRS), Mission(((6.0, 0.0),)), seconds, 1)


@pytest.fixture(scope="module")
def recording() -> Recording:
    return record(session(), 1, "stairs", previews=True)


def same(one: TerrainPreview, other: TerrainPreview) -> None:
    for mine, theirs in zip(one, other, strict=True):
        np.testing.assert_array_equal(mine, theirs)


# --- made ------------------------------------------------------------------------------------------
def test_there_is_a_preview_for_every_twentieth_of_a_second_and_it_is_the_one_of_its_lap():
    run, recorder, made = session(), Recorder(GO2, "stairs", 1, 0.002), {}
    for lap in run:
        recorder.add(lap, run.mind)
        made[lap.sensed.time] = preview_of(GO2, lap, run.mind)
    done = recorder.finish()
    held = list(previews_in(done.previews))
    np.testing.assert_allclose(np.diff([one.time for one in held]), EVERY, atol=0.0021)
    assert held[0].time == 0.0 and len(held) == 25
    for one in held:
        same(one, made[one.time])
    assert preview_at(done.previews, 0.51).time == pytest.approx(0.5, abs=0.026)


def test_who_asks_for_previews_gets_the_same_run(recording: Recording):
    plain = record(session(), 1, "stairs")
    assert plain.previews is None
    assert plain.report().state_hash == recording.report().state_hash


def test_a_planned_climb_has_previews_without_what_comes():
    robot = load_robot("thesis")
    stairway = scene_for(robot, "stairway")
    ascent = climb(robot, stairway)
    chooser = HeldSkill(climb_call(ascent, "kinematic"))
    brain = replace(Brain.of(robot, stairway, chooser), coordinator=Climber(ascent, 0.002))
    plant = KinematicPlant(robot, stairway)
    done = record(Session(brain, plant, Mission((), driver="kinematic"), 1.0, vary=False), previews=True)
    last = list(previews_in(done.previews))[-1]
    assert np.isnan(last.coming_w).all() and not np.isnan(last.support_w[:3]).any()


# --- npz -------------------------------------------------------------------------------------------
def test_previews_survive_their_file(recording: Recording, tmp_path: Path):
    again = load(recording.save(tmp_path / "walk.npz"))
    np.testing.assert_array_equal(again.previews, recording.previews)
    np.testing.assert_array_equal(again.data, recording.data)


def test_a_notebook_reads_them_without_our_code(recording: Recording, tmp_path: Path):
    with np.load(recording.save(tmp_path / "walk.npz")) as file:
        held = {name.removeprefix(PREFIX): file[name] for name in file.files if name.startswith(PREFIX)}
    n = len(recording.previews)
    assert set(held) == {column.name for column in LAYOUT.columns}
    assert held["reach_w"].shape == (n, 4, RIM, 2) and held["supporting"].shape == (n, 4)
    for k, one in enumerate(previews_in(recording.previews)):
        corners = held["support_w"][k][~np.isnan(held["support_w"][k, :, 0])]
        np.testing.assert_array_equal(corners, corners_of(one.support_w))
        inside = len(corners) > 2 and shapely.contains_xy(shapely.polygons(corners), *held["centre_w"][k])
        assert inside == (held["margin"][k] > 0.0)
        assert not (held["critical"][k] > held["supporting"][k]).any()


def test_recordings_of_former_versions_have_none(tmp_path: Path):
    with np.load(io.BytesIO(recordings()[0])) as file:
        former = {name: file[name] for name in file.files if not name.startswith(PREFIX)}
        assert len(former) < len(file.files)
    np.savez_compressed(tmp_path / "former.npz", **former)
    again = load(tmp_path / "former.npz")
    assert again.previews is None and again.report().robot == "go2"


def test_what_a_former_scanner_did_not_hold_is_not_known(tmp_path: Path):
    with np.load(io.BytesIO(recordings()[0])) as file:
        np.savez_compressed(tmp_path / "a.npz", **{k: file[k] for k in file.files if k != "scanner_slope"})
    for held in previews_in(load(tmp_path / "a.npz").previews):
        assert np.isnan(held.slope).all() and np.isfinite(held.elevation).all()


@pytest.mark.parametrize(
    ("name", "change", "told"),
    [
        ("time", lambda time: time[::-1], "time goes backwards"),
        ("time", lambda time: np.full(len(time), np.nan), "scanner_time holds what is no number"),
        ("feet_w", lambda feet: feet * np.nan, "scanner_feet_w holds what is no number"),
        ("reach_w", lambda reach: np.where(np.isnan(reach), np.inf, reach), "scanner_reach_w holds what"),
        ("margin", lambda margin: np.full(len(margin), 1e12), "scanner_margin holds what is no number"),
        ("critical", lambda critical: critical + 0.5, "scanner_critical holds what is neither 0 nor 1"),
        ("support_w", lambda support: support[:1], "differ in length"),
        (
            "support_w",
            lambda support: support[:, :3],
            r"scanner_support_w is \(2, 3, 2\).* expected is 4 × 2",
        ),
        ("roll", lambda roll: roll.astype("f4"), "scanner_roll is"),
        ("feet_w", lambda feet: None, "scanner_feet_w"),
    ],
)
def test_previews_that_no_scanner_held_are_refused(name: str, change, told: str, tmp_path: Path):
    with np.load(io.BytesIO(recordings()[0])) as file:
        members = dict(file)
    changed = change(members.pop(PREFIX + name))
    members |= {} if changed is None else {PREFIX + name: changed}
    np.savez_compressed(tmp_path / "a.npz", **members)
    with pytest.raises(BadFile, match=told):
        load(tmp_path / "a.npz")


def test_of_a_long_run_old_previews_go_to_a_file(recording: Recording, tmp_path: Path, monkeypatch):
    monkeypatch.setattr(previews, "BLOCK", 8)
    monkeypatch.setattr(npz, "PART", 100)
    filed = record(session(), 1, "stairs", previews=True)
    assert isinstance(filed.previews, rows.Table)
    for one, other in zip(previews_in(filed.previews), previews_in(recording.previews), strict=True):
        same(one, other)
    again = load(filed.save(tmp_path / "long.npz"))
    assert isinstance(again.previews, rows.Table)
    np.testing.assert_array_equal(np.asarray(again.previews), recording.previews)
    np.testing.assert_array_equal(times_of(again.previews), times_of(recording.previews))


# --- JSON and MCAP ---------------------------------------------------------------------------------
def test_the_facts_are_the_numbers(recording: Recording):
    for held in previews_in(recording.previews):
        facts = json.loads(json.dumps(facts_of(GO2, held), allow_nan=False))
        assert set(facts["critical_feet"]) <= set(facts["supporting_feet"]) <= set(GO2.legs)
        np.testing.assert_allclose(facts["centre_of_gravity_m"], held.centre_w, atol=1e-5)
        np.testing.assert_allclose(facts["lowered_polygon_m"], corners_of(held.lowered_w), atol=1e-5)
        for leg, name in enumerate(GO2.legs):
            foot = facts["feet"][name]
            np.testing.assert_allclose(foot["place_m"], held.feet_w[leg], atol=1e-5)
            rings = [shapely.linearrings(ring) for ring in foot["reachable_m"]]
            parts = sum(shapely.area(shapely.polygons(r)) * (1 if r.is_ccw else -1) for r in rings)
            assert foot["reachable_m2"] == pytest.approx(parts, abs=1e-4) and parts > 0.1
            swings = np.isfinite(held.footholds_w[leg]).all()
            assert (foot["foothold_m"] is not None) == swings


def test_foxglove_gets_them_as_json_and_drawn_on_the_ground(recording: Recording, tmp_path: Path):
    path = export_mcap(recording, tmp_path / "walk.mcap", STAIRS)
    with path.open("rb") as file:
        reader = make_reader(file)
        told = [json.loads(m.data) for _, _, m in reader.iter_messages(topics=["/gaitwright/scanner"])]
        drawn = [json.loads(m.data) for _, _, m in reader.iter_messages(topics=["/gaitwright/support"])]
    held = list(previews_in(recording.previews))
    assert told == [facts_of(GO2, one) for one in held]
    assert len(drawn) == len(held)
    for update, one in zip(drawn, held, strict=True):
        (entity,) = update["entities"]
        assert entity["id"] == "support" and not update["deletions"]
        assert len(entity["spheres"]) == one.supporting.sum() + 1
        for line in entity["lines"]:
            for place in line["points"]:
                ground = float(STAIRS.height(place["x"], place["y"]))
                assert place["z"] == pytest.approx(ground + 0.01, abs=0.12), "over the ground, steps rounded"


def test_the_names_in_a_file_are_those_of_the_fields():
    named = shapes(6)
    assert list(named) == [PREFIX + column.name for column in LAYOUT.columns]
    assert named["scanner_reach_w"] == (6, RIM, 2) and named["scanner_time"] == ()
    assert sum(int(np.prod(shape)) for shape in named.values()) == LAYOUT.size(6)


def test_a_robot_that_flies_has_no_support():
    brain = Brain.of(GO2, load_scene("flat"), fixed_skill(GO2, "pronk", None, 0.0, 0.0, "numerical"))
    run = Session(brain, MujocoPlant(GO2, load_scene("flat")), Mission(()), 1.5, 2)
    held = list(previews_in(record(run, previews=True).previews))
    flying = [one for one in held if not one.supporting.any()]
    assert flying and all(np.isnan(one.margin) and not one.critical.any() for one in flying)
    assert all(facts_of(GO2, one)["margin_m"] is None for one in flying)
