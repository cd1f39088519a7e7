"""Where boxes are placed, moved and taken away while the robot walks."""

from collections.abc import Callable
from typing import Any

from gaitwright.ground.terrain import Box
from gaitwright.studio import messages as m
from gaitwright.studio.live_run import LiveRun


class WorldDesk:
    """The world of the run; `tell` is called where it has changed."""

    run: LiveRun

    def __init__(self, tell: Callable[[], None]) -> None:
        self.tell = tell
        self.does: dict[type[m.Message], Callable[[Any], dict[str, Any] | None]] = {
            m.PlaceBox: self.place, m.Move: self.move, m.Remove: self.remove,
        }  # fmt: skip

    def attend(self, run: LiveRun) -> None:
        """From now on it is about this run."""
        self.run = run

    def place(self, said: m.PlaceBox) -> dict[str, Any]:
        number = self.run.place(Box(said.x, said.y, said.yaw, said.lx, said.ly, said.height))
        size = f"{said.lx:.2f} × {said.ly:.2f} × {said.height:.2f} m"
        self.run.note("world", f"box {number} of {size} is placed at ({said.x:.2f}, {said.y:.2f})")
        self.tell()
        return {"thing": number}

    def move(self, said: m.Move) -> None:
        self.run.move(said.thing, said.x, said.y, said.yaw)
        self.run.note("world", f"box {said.thing} is moved to ({said.x:.2f}, {said.y:.2f})")
        self.tell()

    def remove(self, said: m.Remove) -> None:
        self.run.remove(said.thing)
        self.run.note("world", f"box {said.thing} is taken away")
        self.tell()
