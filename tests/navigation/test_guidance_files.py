"""Programmes and commands in files: what is written is read, and every fault has a sentence and its row."""

import os
import sys
from pathlib import Path

import pytest

from gaitwright.errors import BadFile
from gaitwright.missions import Programme, Steering, Stop, Velocity
from gaitwright.navigation.guidance_files import load_programme, load_steering


@pytest.fixture
def write(tmp_path: Path):
    def written(content: str | bytes, name: str = "a.csv") -> Path:
        path = tmp_path / name
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    return written


# --- what is written --------------------------------------------------------------------------------
def test_a_route_is_its_stops_in_their_order(write) -> None:
    csv = "# rounds\n\nx,y,speed,wait\n2,0,0.4,\n2, 1.5,,2\n-1,0\t,0.5,0\n"
    stops = (Stop(2.0, 0.0, 0.4, 0.0), Stop(2.0, 1.5, None, 2.0), Stop(-1.0, 0.0, 0.5, 0.0))
    assert load_programme(write(csv)) == Programme(stops)
    assert load_programme(write("wait,y,x\n,0,2\n2,1.5,2\n")).stops[1] == Stop(2.0, 1.5, None, 2.0)
    json = (
        '{"stops": [{"x": 2, "y": 0, "speed": 0.4}, {"x": 2, "y": 1.5, "wait": 2, "speed": null}, '
        '{"x": -1, "y": 0, "speed": 0.5, "wait": 0}]}'
    )
    assert load_programme(write(json, "a.json")) == Programme(stops)


def test_commands_are_held_from_their_times_on(write) -> None:
    csv = "time,forward,left,turn\r\n0.5,0.4,0,0\r\n3,0.3,,0.5\r\n5,,,\r\n"
    steering = Steering((0.5, 3.0), (Velocity(0.4), Velocity(0.3, 0.0, 0.5)), 5.0)
    assert load_steering(write(csv)) == steering
    assert load_steering(write("\ufeff" + csv)) == steering, "as some editors begin it"
    json = (
        '{"commands": [{"time": 0.5, "forward": 0.4}, {"time": 3, "forward": 0.3, "turn": 0.5}, {"time": 5}]}'
    )
    assert load_steering(write(json, "a.txt")) == steering
    moments = {0.0: Velocity(0.0), 0.5: Velocity(0.4), 2.99: Velocity(0.4), 3.0: Velocity(0.3, 0.0, 0.5)}
    assert {time: steering.at(time) for time in moments} == moments
    assert steering.at(5.0) == steering.at(1e6) == Velocity(0.0)
    assert Steering((0.0,), (Velocity(0.1),)).at(1e6) == Velocity(0.1), "until another one is given"


# --- what is wrong ----------------------------------------------------------------------------------
ROUTES = [
    ("", "has no stops, and may have 1 to 10000"),
    ("x,y\n", "has no stops"),
    ("x\n1\n", "row 1: object missing required field `y`"),
    ("x,y\n1,\n", "row 1: object missing required field `y`"),
    ("x,y\n1,2\n1,2,3\n", "row 2 has 3 numbers under 2 names"),
    ("x,y\n1,two\n", "row 1, y: 'two' is no number"),
    ("x,y\n1,nan\n", "row 1, y: expected `float`"),
    ("x,y\n1,1e999\n", "row 1, y: expected `float`"),
    ("x,y\n1,1e7\n", "row 1, y: expected `float` <= 1000000.0"),
    ("x,y,x\n1,2,3\n", "names a column twice"),
    ("x,y,yaw\n1,2,3\n", "no column is called 'yaw'; there is: x, y, speed, wait"),
    ("1,2\n3,4\n", "no column is called '1'"),
    ("x,y,speed\n1,2,0\n", "row 1, speed: expected `float` > 0.0"),
    ("x,y,speed\n1,2,-1\n", "row 1, speed: expected `float` > 0.0"),
    ("x,y,wait\n1,2,-1\n", "row 1, wait: expected `float` >= 0.0"),
    ("x,y,wait\n1,2,99999\n", "row 1, wait: expected `float` <= 3600.0"),
    ("x,y\n" + "1,2\n" * 10_001, "has 10001 stops, and may have 1 to 10000"),
    (b"x,y\n1,\xff\n", "is no text in UTF-8: invalid start byte at byte 6"),
    (b"x,y\n1,\x00\n", "row 1, y: '\\\\x00' is no number"),
    ("[1, 2]", "expected `object`, got `array`"),
    ("{", "is not JSON"),
    ('{"stops": []}', "has no stops"),
    ('{"stops": [{"x": 1, "y": 2}], "more": []}', "object contains unknown field `more`"),
    ('{"points": [{"x": 1, "y": 2}]}', "object contains unknown field `points`"),
    ('{"stops": [{"x": 1, "y": 2}, {"x": 1, "y": "2"}]}', "row 2, y: expected `float`, got `str`"),
    ('{"stops": [{"x": 1, "y": 1e400}]}', "is not JSON|row 1, y"),
    ('{"stops": [{"x": 1, "y": 2, "z": 2}]}', "row 1: object contains unknown field `z`"),
    ('{"stops": [{"x": 1, "x": 2, "y": 3}]}', "'x' is told twice"),
]


@pytest.mark.parametrize(("content", "sentence"), ROUTES, ids=lambda value: repr(value)[:30])
def test_a_route_that_is_none_is_told(content: str | bytes, sentence: str, write) -> None:
    with pytest.raises(BadFile, match=sentence) as raised:
        load_programme(write(content))
    assert "\n" not in str(raised.value) and len(str(raised.value)) < 400
    assert "a.csv" in str(raised.value)


COMMANDS = [
    ("time,forward\n0,0.4\n", "the last of two rows or more ends it, so its forward, left and turn are 0"),
    ("time,forward\n0,0\n", "the last of two rows or more ends it"),
    ("time,forward\n0,0.4\n2,0.1\n", "so its forward, left and turn are 0"),
    ("time,forward\n0,0.4\n4000,0\n", "row 2, time: expected `float` <= 3600.0"),
    ("time,forward\n-1,0.4\n4,0\n", "row 1, time: expected `float` >= 0.0"),
    ("time,forward\n0,0.4\n2,0.2\n2,0\n", "row 3: it begins at 2 s, and not after the one before"),
    ("time,forward\n2,0.4\n1,0\n", "row 2: it begins at 1 s, and not after the one before"),
    ("forward\n0.4\n", "row 1: object missing required field `time`"),
    ("time,speed\n0,0.4\n1,0\n", "no column is called 'speed'; there is: time, forward, left, turn"),
]


@pytest.mark.parametrize(("content", "sentence"), COMMANDS, ids=lambda value: repr(value)[:30])
def test_commands_that_are_none_are_told(content: str, sentence: str, write) -> None:
    with pytest.raises(BadFile, match=sentence):
        load_steering(write(content))


def test_what_is_no_file_is_told(tmp_path: Path) -> None:
    with pytest.raises(BadFile, match=r"route file .*none\.csv cannot be read: No such file"):
        load_programme(tmp_path / "none.csv")
    with pytest.raises(BadFile, match=r"velocity file .* cannot be read: Is a directory"):
        load_steering(tmp_path)
    (tmp_path / "large.csv").write_bytes(b"x,y\n" + b" " * 1_000_001)
    with pytest.raises(BadFile, match="is larger than the limit of 1 MB"):
        load_programme(tmp_path / "large.csv")


@pytest.mark.skipif(sys.platform == "win32", reason="no such pipes")
def test_a_pipe_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.csv")
    with pytest.raises(BadFile, match="it is a pipe, not a file"):
        load_steering(tmp_path / "pipe.csv")
