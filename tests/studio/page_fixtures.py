"""A studio that runs, someone who talks to it as a page does, and a browser to look at its page."""

import json
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

PATIENCE = 30.0
"""Longest wait for something that is said [s]; a first start may compile kernels, and has its own."""
FIRST = 240.0
BROWSER = ("chromium", "chromium-browser", "google-chrome")
SWITCHES = [
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
]


def lacking(what: str) -> None:
    """Skips a test for which something is not installed; where every check runs it is a failure."""
    if os.environ.get("CI"):
        pytest.fail(f"{what} is not installed")
    pytest.skip(f"{what} is not installed")


class Line:
    """A connection as a page has one: says, hears, and remembers the last of each kind that it heard."""

    def __init__(self, socket: ClientConnection) -> None:
        self.socket = socket
        self.last: dict[str, dict[str, Any]] = {}
        self.frames: list[bytes] = []
        self.asked = 0

    def say(self, **message: Any) -> int:
        """Says something; the number under which it will be answered."""
        self.asked += 1
        self.socket.send(json.dumps({"id": self.asked, **message}))
        return self.asked

    def ask(self, **message: Any) -> dict[str, Any]:
        """Says something and waits for its answer, done or refused."""
        number = self.say(**message)
        return self.until(lambda said: said["say"] in ("done", "refused") and said["id"] == number)

    def done(self, **message: Any) -> dict[str, Any]:
        """The answer to something that is to be done."""
        answer = self.ask(**message)
        assert answer["say"] == "done", answer
        return answer

    def refused(self, **message: Any) -> str:
        """Why something is not done."""
        answer = self.ask(**message)
        assert answer["say"] == "refused", answer
        return answer["because"]

    def until(self, fits: Callable[[dict[str, Any]], bool], seconds: float = PATIENCE) -> dict[str, Any]:
        """Hears until something fits."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for said in self.hear(end - time.monotonic()):
                if fits(said):
                    return said
        raise AssertionError(f"not said within {seconds:g} s; last: {self.last.get('status')}")

    def status(self, fits: Callable[[dict[str, Any]], bool] = lambda said: True, seconds: float = PATIENCE):
        """The next status that fits."""
        return self.until(lambda said: said["say"] == "status" and fits(said), seconds)

    def hear(self, seconds: float) -> Iterator[dict[str, Any]]:
        """The next thing that is said, unless it is a frame."""
        try:
            heard = self.socket.recv(timeout=max(seconds, 0.01))
        except TimeoutError:
            return
        if isinstance(heard, bytes):
            self.frames.append(heard)
            return
        said = json.loads(heard)
        self.last[said["say"]] = said
        yield said


class Studio:
    """`gaitwright studio` in a process of its own."""

    def __init__(self, folder: Path, *options: str) -> None:
        self.folder = folder
        command = [sys.executable, "-m", "gaitwright", "studio", "--no-browser", "--port", "0"]
        self.errors = (folder / "errors.txt").open("w+")
        self.process = subprocess.Popen(
            [*command, "--out", str(folder), *options], stdout=subprocess.PIPE, stderr=self.errors, text=True
        )
        assert self.process.stdout is not None
        said = self.process.stdout.readline()
        found = re.search(r"http://([\w.:\[\]]+)/\?token=(\S+)", said)
        assert found, f"{said!r}; {(folder / 'errors.txt').read_text()}"
        self.address, self.place, self.token = found[0], found[1], found[2]

    def connect(self, token: str | None = None, **settings: Any) -> ClientConnection:
        token = self.token if token is None else token
        own = {"max_size": None, "legacy": True, "close_timeout": 0.3}
        return connect(f"ws://{self.place}/live?token={token}", **own, **settings)

    def line(self) -> Line:
        """A page's connection, once the robot stands there."""
        line = Line(self.connect())
        line.until(lambda said: said["say"] == "status" and said["time"] > 0.0, FIRST)
        return line

    def close(self) -> int:
        """Ends it as a person does; its exit code."""
        self.process.terminate()
        try:
            return self.process.wait(20.0)
        finally:
            self.process.kill()
            self.errors.close()


def find_browser() -> str:
    """The browser to test with."""
    found = next((path for name in BROWSER if (path := shutil.which(name))), None)
    if found is None:
        lacking("a browser (Debian: apt install chromium)")
    return str(found)


def close(socket: ClientConnection) -> None:
    with suppress(ConnectionClosed, OSError):
        socket.close()


@pytest.fixture(scope="module")
def page_is_built() -> None:
    """The page, built from its sources; a minute at most, once."""
    from gaitwright.errors import WrongUse
    from gaitwright.studio.page_build import ready_page

    try:
        ready_page(lambda told: None)
    except WrongUse as error:
        if os.environ.get("CI"):
            raise
        pytest.skip(str(error).splitlines()[0])


@pytest.fixture(scope="module")
def studio(page_is_built: None, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    """One studio for all tests of a file."""
    running = Studio(tmp_path_factory.mktemp("studio"))
    yield running
    running.close()


def begun(studio: Studio, scene: str) -> Line:
    """One who drives a Go2, from its start in a scene."""
    line = studio.line()
    line.done(do="take")
    line.done(do="resume")
    line.done(do="mode", mode="plan")
    line.done(do="reset", robot="go2", scene=scene, seed=0, sight="known", driver="hybrid")
    return line


@pytest.fixture
def line(studio: Studio) -> Iterator[Line]:
    """One who drives it among blocks."""
    line = begun(studio, "blocks")
    yield line
    close(line.socket)


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """A browser without a window, that draws in 3-D by itself."""
    yield from opened(SWITCHES)


@pytest.fixture(scope="module")
def plain_browser() -> Iterator[Any]:
    """One that does not draw in 3-D, which takes a core: for all that is not in the views."""
    yield from opened(["--no-sandbox", "--disable-gpu", "--disable-3d-apis"])


def opened(switches: list[str]) -> Iterator[Any]:
    """A browser until it is no longer needed."""
    path = find_browser()
    from playwright.sync_api import sync_playwright

    with sync_playwright() as tool:
        running = tool.chromium.launch(executable_path=path, args=switches)
        yield running
        running.close()
