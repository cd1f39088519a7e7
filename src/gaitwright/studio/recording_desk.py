"""Where recordings are begun, ended and listed."""

import importlib.util
import sys
import traceback
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from gaitwright.errors import GaitwrightError, WrongUse
from gaitwright.ground.scene import Scene
from gaitwright.record.recording import Recording
from gaitwright.studio import messages as m
from gaitwright.studio.live_run import LiveRun
from gaitwright.studio.page_build import PAGE
from gaitwright.studio.recordings import Shelf
from gaitwright.studio.replay import TEMPLATE, write_replay


class RecordingDesk:
    """What is recorded of the run, and the folder where it is kept: written by a thread of its own, since a
    long trip takes seconds and the robot goes on. `say` is told what became of it."""

    run: LiveRun

    def __init__(self, folder: Path, say: Callable[[dict[str, Any]], None]) -> None:
        self.shelf, self.say = Shelf(folder), say
        self.writer = ThreadPoolExecutor(1)
        self.unwritten: dict[str, tuple[Recording, Scene]] = {}
        """What is not in the folder yet, by its name: it is being written, or could not be."""
        self.news: list[str] = []
        """What the writer has to say, in sentences."""
        self.does: dict[type[m.Message], Callable[[Any], dict[str, Any] | None]] = {
            m.Record: self.record, m.Recordings: self.listed,
        }  # fmt: skip

    @property
    def forms(self) -> list[str]:
        """Endings of the files that a recording can be had as."""
        pages = ["html"] if (PAGE / TEMPLATE).is_file() else []
        return ["npz", *pages, *(["mcap"] if importlib.util.find_spec("mcap_ros2") else [])]

    def attend(self, run: LiveRun) -> None:
        """From now on it is about this run."""
        self.run = run

    def record(self, said: m.Record) -> dict[str, Any] | None:
        if said.on == (self.run.recorder is not None):
            raise WrongUse("it is recorded already" if said.on else "nothing is recorded now")
        if not said.on:
            return self.end()
        self.run.record()
        return None

    def end(self) -> dict[str, Any] | None:
        """Keeps what was recorded so far, if anything, and what could not be kept before."""
        recorder, self.run.recorder = self.run.recorder, None
        if recorder is None or not recorder.laps:
            return None
        name = self.shelf.free_name(self.run.robot.name, self.unwritten)
        self.unwritten[name] = recorder.finish(), self.run.scene
        for one in list(self.unwritten):
            self.writer.submit(self.write, one)
        return {"recording": f"{name}.npz"}

    def write(self, name: str) -> None:
        """Writes a recording, then a page of it beside it; where it cannot be, it is kept in mind."""
        if name not in self.unwritten:  # asked for twice
            return
        recording, scene = self.unwritten[name]
        try:
            self.shelf.keep(recording, name)
            del self.unwritten[name]
            self.news.append(f"recording {name} is kept")
            if (PAGE / TEMPLATE).is_file():
                write_replay(recording, self.shelf.folder / f"{name}.html", PAGE, scene)
        except (GaitwrightError, OSError) as error:
            again = "; it is tried again with the next one" if name in self.unwritten else ""
            self.news.append(f"recording {name} could not be written: {error}{again}")
        except Exception:
            traceback.print_exc()

    def after(self) -> None:
        """To be called now and then: says what became of recordings."""
        if self.news:
            self.say({"say": "recordings", "names": self.shelf.listed()})
        while self.news:
            self.say({"say": "remark", "sentence": self.news.pop(0)})

    def listed(self, said: m.Recordings) -> dict[str, Any]:
        return {"recordings": self.shelf.listed()}

    def close(self) -> None:
        """Keeps what was recorded; returns when all is written."""
        self.end()
        self.writer.shutdown(wait=True)
        if self.unwritten:
            print(*self.news, sep="\n", file=sys.stderr)
