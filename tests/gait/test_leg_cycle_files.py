"""Files of leg cycles: what they say is read, what is wrong gets one sentence."""

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.cli import main
from gaitwright.errors import BadFile, WrongUse
from gaitwright.gait.leg_cycles import files
from gaitwright.gait.leg_cycles.files import MAX_BYTES, cycle_names, load_cycle
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle

GOOD = [[0, -0.5, 0], [0.3, -0.3, 0.1], [0.7, 0.3, 0.1], [1, 0.5, 0]]


def written(tmp_path: Path, content: object, name: str = "walk.json") -> Path:
    """A file with that content: bytes, text, or a value as JSON."""
    text = content if isinstance(content, bytes | str) else json.dumps(content)
    path = tmp_path / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def with_point(number: int, point: object) -> dict:
    """Good points but for one; counted from 1."""
    return {"points": [*GOOD[: number - 1], point, *GOOD[number:]]}


# --- good ones -------------------------------------------------------------------------------------
def test_the_cycles_that_come_along_can_be_read() -> None:
    assert set(cycle_names()) >= {"walk", "trot", "climb"}
    for name in cycle_names():
        cycle = load_cycle(name)
        assert cycle.name == name and cycle.about


def test_a_file_has_the_name_and_points_that_it_says(tmp_path: Path) -> None:
    path = written(tmp_path, {"about": "low", "points": GOOD, "hind": GOOD}, "low.json")
    cycle = load_cycle(path)
    points = tuple(tuple(map(float, point)) for point in GOOD)
    assert cycle == load_cycle(str(path)) == LegCycle("low", points, points, "low")


inner = st.tuples(st.floats(-0.5, 0.5), st.floats(0.0, 1.0))


@given(
    st.lists(inner, min_size=2, max_size=20),
    st.booleans(),
    st.text(st.characters(codec="utf-8"), max_size=50),
)
def test_any_cycle_is_read_from_its_points(tmp_path_factory, inside, hind: bool, about: str) -> None:
    n = len(inside) + 1
    body = tuple(((i + 1) / n, forward, height) for i, (forward, height) in enumerate(inside))
    points = ((0.0, -0.5, 0.0), *body, (1.0, 0.5, 0.0))
    cycle = LegCycle("mine", points, points[:1] + points[2:] if hind and n > 3 else None, about)
    content = {"points": cycle.points, "hind": cycle.hind, "about": about}
    assert load_cycle(written(tmp_path_factory.mktemp("cycles"), content, "mine.json")) == cycle


# --- bad ones --------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ("", "is not JSON"),
        ('{"points": [[0', "is not JSON"),
        (b"\xff\xfe{}", "is not JSON"),
        ({}, "missing required field `points`"),
        ({"points": GOOD, "pionts": []}, "unknown field `pionts`"),
        ({"points": GOOD, "about": "a" * 201}, "length <= 200 - at `\\$.about`"),
        ({"points": GOOD[:3]}, "walk.json has 3 points; a leg cycle has 4 to 64"),
        ({"points": [[0, -0.5, 0]] * 65}, "walk.json has 65 points"),
        ({"points": [[0, -0.5, 0]] * 1001}, "length <= 1000"),
        (with_point(3, [0.7, 0.3, -0.03]), "point 3 of walk.json lies 0.03 below the ground"),
        (with_point(3, [0.2, 0.3, 0.1]), "point 3 of walk.json is at share 0.2 of the swing, the point"),
        (with_point(2, [0.3, -0.3]), "point 2 of walk.json: expected `array` of length 3"),
        (with_point(2, [0.3, "x", 0.1]), "point 2 of walk.json, forward: expected `float`, got `str`"),
        (with_point(2, [0.3, -0.3, None]), "point 2 of walk.json, height: expected `float`, got `null`"),
        (with_point(4, [1, 0.4, 0]), r"point 4 of walk.json is \(1, 0.4, 0\); touch-down is always"),
        (json.dumps(with_point(2, [0.3, -0.3, 7])).replace("7]", "1e999]"), "point 2|not JSON|out of range"),
        (json.dumps(with_point(2, [0.3, -0.3, 7])).replace("7]", "NaN]"), "is not JSON"),
        ({"points": GOOD, "hind": [*GOOD[:2], [0.7, 2, 0.1], GOOD[3]]}, "point 3 of the hind legs of walk"),
        ({"points": GOOD, "hind": [*GOOD[:2], 3, GOOD[3]]}, "point 3 of the hind legs of walk.json: exp"),
        ({"points": GOOD, "about": "x" * MAX_BYTES}, "larger than the limit of 100 kB"),
    ],
)  # fmt: skip
def test_a_bad_file_gets_a_sentence(tmp_path: Path, content: object, sentence: str) -> None:
    path = written(tmp_path, content)
    with pytest.raises(BadFile, match=f"(?i)^leg cycle .*({sentence})"):
        load_cycle(path)


@given(st.binary(max_size=200) | st.recursive(
    st.none() | st.booleans() | st.floats(allow_nan=False, allow_infinity=False) | st.text(max_size=5),
    lambda inside: st.lists(inside, max_size=5)
    | st.dictionaries(st.sampled_from(["points", "hind", "about", "x"]), inside, max_size=4),
    max_leaves=30,
))  # fmt: skip
def test_whatever_a_file_holds_it_is_a_cycle_or_a_bad_file(tmp_path_factory, content: object) -> None:
    path = written(tmp_path_factory.mktemp("any"), content)
    with pytest.raises(BadFile):
        load_cycle(path)


def test_a_file_that_is_not_there_or_no_file(tmp_path: Path) -> None:
    for path in (tmp_path / "none.json", tmp_path, "no\0name.json"):
        with pytest.raises(BadFile, match="cannot be read"):
            load_cycle(path)


def test_an_unknown_name_is_wrong_use_with_a_near_miss() -> None:
    with pytest.raises(WrongUse, match=r"no leg cycle 'trott'; there is: climb, trot, walk.*mean 'trot'\?"):
        load_cycle("trott")


# --- the command -----------------------------------------------------------------------------------
@pytest.fixture
def in_an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.usefixtures("in_an_empty_folder")
def test_the_command_draws_the_cycles_of_a_robot(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["skills", "--plot", "--robot", "hexapod", "--json", "-"]) == 0
    assert json.loads(capsys.readouterr().out)["picture"] == "runs/skills-hexapod.png"
    assert Path("runs/skills-hexapod.png").read_bytes().startswith(b"\x89PNG")


def test_the_command_checks_and_draws_a_file(
    in_an_empty_folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    own, hind = load_cycle("trot").points, load_cycle("climb").points
    good = written(in_an_empty_folder, {"points": own, "hind": hind}, "mine.json")
    assert main(["skills", "--cycle", str(good), "--out", "mine.png"]) == 0
    assert "fits" in capsys.readouterr().out
    assert (in_an_empty_folder / "mine.png").is_file()


@pytest.mark.usefixtures("in_an_empty_folder")
def test_the_command_says_what_is_wrong_with_a_cycle(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("gaitwright.cli.skills.has", lambda *_: False)
    path = written(Path(), with_point(2, [0.3, -0.3, 0.95]), "trot.json")
    assert main(["skills", "--cycle", str(path), "--json", "-"]) == 1
    report = json.loads(capsys.readouterr().out)
    (fault, *_) = report["leg_cycle"]["faults"]["trot"]
    assert (fault["kind"], fault["point"]) == ("reach", 2) and "leg" in fault["sentence"]
    assert "picture" not in report


@pytest.mark.usefixtures("in_an_empty_folder")
def test_the_command_refuses_what_it_cannot_do(capsys: pytest.CaptureFixture[str]) -> None:
    bad = written(Path(), with_point(3, [0.7, 0.3, -0.03]))
    assert main(["skills", "--cycle", str(bad)]) == 3
    assert "point 3 of walk.json lies 0.03 below the ground" in capsys.readouterr().err
    assert main(["skills", "--cycle", "trott"]) == 2
    assert main(["skills", "--plot", "--out", "picture.jpg"]) == 2
    assert "ends in .png" in capsys.readouterr().err


def test_files_of_the_package_are_beside_the_module() -> None:
    assert {path.suffix for path in files.BUILT_IN.iterdir()} == {".json"}
