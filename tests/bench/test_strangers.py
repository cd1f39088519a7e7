"""The bench of strangers' robots: which files are whole robots, and what is said of each."""

from pathlib import Path

import pytest

from gaitwright import bench
from gaitwright.bench.claims import strangers
from gaitwright.bench.context import Context
from gaitwright.bench.strangers.robot_files import robot_files
from gaitwright.bench.trial import Outcome
from gaitwright.model.catalogue import robot_file
from gaitwright.workers import Workers

HINGE = '<body pos="0 0 -.2"><joint/><geom size=".02"/>{}</body>'


def limb(hinges: int) -> str:
    return HINGE.format(limb(hinges - 1)) if hinges else ""


def mjcf(*limbs: int, base: str = "<freejoint/>") -> str:
    """An MJCF file with limbs of so many hinges."""
    return f"<mujoco><worldbody><body>{base}{''.join(map(limb, limbs))}</body></worldbody></mujoco>"


def urdf(*limbs: int, floating: bool = False) -> str:
    """The same as URDF; with `floating` the trunk hangs on a world."""
    joints = [("world", "trunk", "floating")] if floating else []
    for i, hinges in enumerate(limbs):
        row = ["trunk", *(f"l{i}_{j}" for j in range(hinges)), f"foot{i}"]
        kinds = ["revolute"] * hinges + ["fixed"]
        joints += list(zip(row, row[1:], kinds, strict=False))
    text = "".join(
        f'<joint type="{kind}" name="{b}"><parent link="{a}"/><child link="{b}"/></joint>'
        for a, b, kind in joints
    )
    return f'<robot name="r">{text}</robot>'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Files of several projects as they lie about."""
    files = {
        "a/dog.xml": mjcf(3, 3, 3, 3),
        "a/again.xml": mjcf(3, 3, 3, 3),
        "a/scene.xml": '<mujoco><include file="dog.xml"/><worldbody><geom size="1"/></worldbody></mujoco>',
        "a/motors.xml": "<mujoco><actuator/></mujoco>",
        "a/launch.xml": "<launch/>",
        "a/notes.xml": "not XML",
        "b/urdf/dog.urdf": urdf(3, 3, 3, 3, floating=True),
        "b/urdf/arm.urdf": urdf(6),
        "b/urdf/wheels.URDF": urdf(4, 4, 4, 4),
        "b/urdf/cube.urdf": urdf(0),
        "b/urdf/broken.urdf": "<robot>",
        "b/biped.mjcf": mjcf(3, 3),
        "b/mesh.stl": "",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    return tmp_path


def test_whole_robots_are_told_from_their_parts_scenes_and_copies(folder: Path):
    files, others = robot_files(folder)
    assert {file.name: file.legs for file in files} == {
        "a/again.xml": 4,
        "b/biped.mjcf": 2,
        "b/urdf/arm.urdf": 0,
        "b/urdf/broken.urdf": 0,
        "b/urdf/dog.urdf": 4,
        "b/urdf/wheels.URDF": 0,
    }
    assert others == 6


def test_limbs_of_the_world_count_too_and_forks_do_not(tmp_path: Path):
    fork = HINGE.format(HINGE.format("") + HINGE.format(""))
    (tmp_path / "fixed.xml").write_text(f"<mujoco><worldbody>{limb(3) * 4}</worldbody></mujoco>")
    (tmp_path / "forks.xml").write_text(f"<mujoco><worldbody><body>{fork * 4}</body></worldbody></mujoco>")
    files, _ = robot_files(tmp_path)
    assert {file.name: file.legs for file in files} == {"fixed.xml": 4, "forks.xml": 0}


def measured(folder: Path, monkeypatch: pytest.MonkeyPatch, seconds: float = 1.0):
    monkeypatch.setattr(strangers, "SECONDS", seconds)
    with Workers(1) as workers, Context(workers, quick=True, robots=folder) as context:
        return list(strangers.measure(context))


def test_a_folder_is_measured_file_by_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    (tmp_path / "good.xml").write_bytes(Path(robot_file("go2")).read_bytes())
    (tmp_path / "massless.urdf").write_text(urdf(3, 3, 3, 3))
    (tmp_path / "arm.urdf").write_text(urdf(6))
    arm, good, massless, total, clear = measured(tmp_path, monkeypatch)
    assert (arm.what, arm.measured, arm.reached) == ("arm.urdf", 0.0, None)
    assert arm.note
    assert good.what == "good.xml"
    assert good.measured_text == "3 of 3"
    assert good.note == "walk 1/1, trot 1/1, turn-in-place 1/1"
    assert massless.note
    assert "massless.urdf" not in massless.note
    assert (total.measured_text, total.wanted_text) == ("1 of 2", "≥ 2 of 2")
    assert "not: massless.urdf" in total.note
    assert (clear.measured_text, clear.reached) == ("2 of 2", True)


def test_a_robot_that_goes_but_not_as_fast_as_asked_does_not_do_it():
    slow = Outcome.__new__(Outcome)
    object.__setattr__(slow, "kept_up", True)
    object.__setattr__(slow, "held", 0.5)
    assert not strangers.goes_well(slow)
    object.__setattr__(slow, "held", 0.9)
    assert strangers.goes_well(slow)


@pytest.mark.parametrize(
    ("text", "fine"),
    [("it is a xacro template", True), ("", False), ("one\ntwo", False), ("x" * 1000, False)],
)
def test_a_refusal_is_one_sentence(text: str, fine: bool):
    assert strangers.is_sentence(text) is fine


def test_without_a_folder_and_models_it_is_told_how_to_name_one(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(strangers, "models_folder", lambda: None)
    with Workers(1) as workers, Context(workers, quick=True) as context:
        (figure,) = strangers.measure(context)
    assert "--robots FOLDER" in figure.note
    assert figure.measured_text == "not measured"
    assert ("outside", "strangers") in bench.claims_named(["strangers"])
