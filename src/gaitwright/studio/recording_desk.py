"""Where recordings are begun, ended and listed."""

from collections.abc import Callable
from pathlib import Path
from threading import Thread
from typing import Any

from gaitwright.errors import WrongUse
from gaitwright.studio import messages as m
from gaitwright.studio.live_run import LiveRun
from gaitwright.studio.page_build import PAGE
from gaitwright.studio.recordings import Shelf
from gaitwright.studio.replay import TEMPLATE, write_replay


class RecordingDesk:
    """What is recorded of the run, and the folder where it is kept."""

    run: LiveRun

    def __init__(self, folder: Path) -> None:
        self.shelf = Shelf(folder)
        self.writer: Thread | None = None
        """Who writes the last recording as a page."""
        self.does: dict[type[m.Message], Callable[[Any], dict[str, Any] | None]] = {
            m.Record: self.record, m.Recordings: self.listed,
        }  # fmt: skip

    def attend(self, run: LiveRun) -> None:
        """From now on it is about this run."""
        self.run = run

    def record(self, said: m.Record) -> dict[str, Any] | None:
        run = self.run
        if said.on == (run.recorder is not None):
            raise WrongUse("it is recorded already" if said.on else "nothing is recorded now")
        if not said.on:
            return self.end()
        run.record()
        return None

    def end(self) -> dict[str, Any] | None:
        """Keeps what was recorded so far, if anything."""
        recorder, self.run.recorder = self.run.recorder, None
        if recorder is None or not recorder.laps:
            return None
        recording = recorder.finish()
        name = self.shelf.keep(recording, self.run.robot.name)
        if (PAGE / TEMPLATE).is_file():  # beside it, as a page, while the robot goes on
            where = self.shelf.folder / f"{name}.html"
            self.writer = Thread(target=write_replay, args=(recording, where, PAGE, self.run.scene))
            self.writer.start()
        return {"recording": f"{name}.npz"}

    def listed(self, said: m.Recordings) -> dict[str, Any]:
        return {"recordings": self.shelf.listed()}

    def close(self) -> None:
        """Keeps what was recorded; returns when all is written."""
        self.end()
        if self.writer is not None:
            self.writer.join()
