"""The studio's server as those who reach it meet it: who is let in, what is refused, who drives."""

import http.client
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from page_fixtures import Line, Studio, close
from websockets.exceptions import ConnectionClosed, InvalidStatus

from gaitwright.record.recording import load
from gaitwright.studio.frames import HEADER, columns_of

pytestmark = pytest.mark.xdist_group("studio")


def get(studio: Studio, path: str, **headers: str) -> tuple[int, dict[str, str], bytes]:
    """What a browser is answered."""
    connection = http.client.HTTPConnection(studio.place, timeout=20.0)
    connection.request("GET", path, headers={name.title(): value for name, value in headers.items()})
    answer = connection.getresponse()
    return answer.status, {name.lower(): value for name, value in answer.getheaders()}, answer.read()


# --- who is let in ----------------------------------------------------------------------------------
def test_the_page_comes_with_a_policy_that_lets_nothing_foreign_in(studio: Studio):
    status, headers, page = get(studio, "/")
    assert status == 200 and b"<script" in page
    assert "default-src 'self'" in headers["content-security-policy"]
    assert b"http://" not in page.replace(b"http://www.w3.org", b"") and b"https://" not in page


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:80", "127.0.0.1.evil.example", "", "[", "0.0.0.0"]
)
def test_a_request_for_another_host_is_refused(studio: Studio, host: str):
    assert get(studio, "/", host=host)[0] == 403


def test_a_tunnel_may_have_another_port(studio: Studio):
    assert get(studio, "/", host="localhost:9999", origin="http://localhost:9999")[0] == 200


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://127.0.0.1:1", "https://localhost"])
def test_a_page_from_elsewhere_gets_no_connection(studio: Studio, origin: str):
    with pytest.raises(InvalidStatus):
        studio.connect(origin=origin)
    assert get(studio, "/", origin=origin)[0] == 403


@pytest.mark.parametrize("token", ["", "x", "x" * 5000, "☃"])
def test_nobody_comes_in_without_the_token(studio: Studio, token: str):
    with pytest.raises((InvalidStatus, ConnectionClosed)):
        studio.connect(token=token)
    assert get(studio, f"/recordings/a.npz?token={'x' if token == '☃' else token}")[0] in (403, 431)


@pytest.mark.parametrize("name", ["..%2f..%2fetc%2fpasswd", "errors.txt", "studio.skills", "none.npz"])
def test_only_recordings_can_be_taken_home(studio: Studio, name: str):
    assert get(studio, f"/recordings/{name}?token={studio.token}")[0] == 404


# --- what is said -----------------------------------------------------------------------------------
def test_frames_come_as_their_columns_say(line: Line):
    line.frames.clear()
    line.status(lambda said: said["time"] > 0.5)
    width = sum(int(column["size"]) for column in columns_of(4))
    assert line.last["hello"]["columns"] == columns_of(4)
    kind, flags, robots, sequence, sent, _ = HEADER.unpack_from(line.frames[-1])
    assert (kind, flags, robots) == (1, 0, 1)
    assert len(line.frames[-1]) == HEADER.size + 4 * width
    assert abs(time.time() - sent) < 5.0
    assert sequence > HEADER.unpack_from(line.frames[0])[3]


@pytest.mark.parametrize(
    ("text", "because"),
    [
        ("", "no message"),
        ("{", "no message"),
        ("[]", "no message"),
        ('{"do": 3}', "no message"),
        ('{"do": "fly", "id": 7}', "nothing called 'fly'"),
        ('{"do": "go", "x": 1}', "missing required field `y`"),
        ('{"do": "go", "x": "1", "y": 2}', "Expected `float`"),
        ('{"do": "go", "x": 1e999, "y": 2}', "no message"),
        ('{"do": "go", "x": NaN, "y": 2}', "no message"),
        ('{"do": "go", "x": 1, "y": 2, "z": 3}', "unknown field"),
        ('{"do": "step", "ticks": 1000000}', "<= 5000"),
        ('{"do": "pace", "factor": 0}', ">= 0.05"),
        ('{"do": "steer", "forward": 1e300}', "<= 100"),
        ('{"do": "edit", "kind": "cycle", "skill": "trot", "leg": 0, "points": [[1]]}', "length >= 3"),
        ("🦎" * 1000, "no message"),
    ],
)
def test_what_makes_no_sense_is_refused_with_a_sentence(line: Line, text: str, because: str):
    line.socket.send(text)
    said = line.until(lambda said: said["say"] == "refused")
    assert because in said["because"] and len(said["because"]) < 700
    assert line.status()["velocity"] == [0.0, 0.0, 0.0]


def test_too_long_a_message_ends_the_connection_and_nothing_else(studio: Studio, line: Line):
    other = studio.connect()
    other.send("x" * 200_000)
    with pytest.raises(ConnectionClosed):
        for _ in range(1000):
            other.recv(timeout=5.0)
    assert line.done(do="recordings")


# --- who drives -------------------------------------------------------------------------------------
def test_one_drives_and_the_others_watch(studio: Studio, line: Line):
    watcher = studio.line()
    assert watcher.last["role"]["role"] == "watcher"
    assert "somebody else drives" in watcher.refused(do="go", x=1.0, y=0.0)
    assert watcher.done(do="why")["sentences"]
    watcher.done(do="take")
    assert "somebody else drives" in line.refused(do="stand")
    watcher.done(do="stand")
    close(watcher.socket)
    line.until(lambda said: said["say"] == "role" and not said["has_driver"])
    line.done(do="take")


def test_who_comes_later_is_told_what_the_others_know(studio: Studio, line: Line):
    late = studio.line()
    assert set(late.last) >= {"hello", "world", "rules", "status", "role"}
    assert late.last["world"]["scene"] == "blocks"
    close(late.socket)


def test_a_robot_whose_driver_is_gone_stands(studio: Studio, line: Line):
    other = studio.line()
    other.done(do="take")
    other.done(do="steer", forward=0.4)
    close(other.socket)
    line.until(lambda said: said["say"] == "role" and not said["has_driver"])
    line.status(lambda said: said["skill"] == "stand", 3.0)


# --- what comes to an end ---------------------------------------------------------------------------
def test_it_keeps_what_was_recorded_when_it_is_told_to_end(page_is_built: None, tmp_path):
    studio = Studio(tmp_path)
    line = studio.line()
    line.done(do="record", on=True)
    line.status(lambda said: said["recording"] and said["time"] > 0.5)
    studio.process.send_signal(signal.SIGINT)
    time.sleep(0.2)  # and again, as one who thinks that it was not heard
    assert studio.close() == 0
    assert "Traceback" not in (tmp_path / "errors.txt").read_text()
    (kept,) = tmp_path.glob("*.npz")
    assert len(load(kept)) > 50


@pytest.mark.parametrize(
    ("options", "code", "sentence"),
    [
        (("--scene", "nowhere"), 2, "no scene 'nowhere'"),
        (("--skillbook", "no.skills"), 3, "no.skills"),
        (("--port", "99999"), 2, "port"),
    ],
)
def test_what_cannot_be_opened_is_told_in_a_sentence(page_is_built: None, tmp_path, options, code, sentence):
    (tmp_path / "re.py").write_text("raise SystemExit('a file of the folder was run')")
    words = ["-P", "-m", "gaitwright", "studio", "--no-browser", "--port", "0", "--out", ".", *options]
    done = subprocess.run(
        [sys.executable, *words], cwd=tmp_path, capture_output=True, text=True, timeout=120.0, check=False
    )
    assert done.returncode == code and sentence in done.stderr, done.stderr
    assert "Traceback" not in done.stderr


def test_a_run_whose_process_died_is_begun_again_by_a_reset(page_is_built: None, tmp_path):
    studio = Studio(tmp_path, "--scene", "flat")
    line = studio.line()
    (child,) = (
        int(pid)
        for pid in Path(f"/proc/{studio.process.pid}/task/{studio.process.pid}/children")
        .read_text()
        .split()[-1:]
    )
    os.kill(child, signal.SIGKILL)
    closed = line.until(lambda said: said["say"] == "closed")
    assert "unexpectedly" in closed["because"]
    assert "a reset begins another" in line.refused(do="go", x=1.0, y=0.0)
    line.done(do="reset", scene="stairs")
    assert line.status(lambda said: said["time"] > 0.0)["setup"]["scene"] == "stairs"
    line.done(do="go", x=1.0, y=0.0)
    assert studio.close() == 0
