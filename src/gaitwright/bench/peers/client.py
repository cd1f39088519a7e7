"""A peer's control tick, timed round by round beside ours in the same run.

with Peer("tsid", robot, states) as tsid:
    for _ in range(rounds):
        ours.append(time_ours(200))
        theirs.append(tsid.round(200))
    print(tsid.summary())        # TSID 1.9.0: 52.1 µs (median of 40,000) …  or  tsid: not measured: …
"""

import math
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from gaitwright.bench.peers.environment import PeerUnavailable, peer_python
from gaitwright.bench.peers.script import Script
from gaitwright.model.robot import Robot
from gaitwright.model.urdf import write_urdf

START_TIMEOUT_S = 60.0
ROUND_TIMEOUT_S = 120.0
SCRIPTS = {name: Path(__file__).with_name(f"{name}_tick.py") for name in ("tsid", "placo", "policy")}


@dataclass(frozen=True)
class Measured:
    """What a peer's ticks took."""

    peer: str
    version: str
    ticks: int
    median_us: float
    p99_us: float
    failed: int
    """Ticks in which its solver found no answer."""
    note: str
    """What richer problem it solves."""

    def __str__(self) -> str:
        failed = f", {self.failed} failed" if self.failed else ""
        times = f"{self.median_us:.1f} µs, p99 {self.p99_us:.1f} µs"
        return f"{self.peer} {self.version}: {times} ({self.ticks:,} ticks{failed}); {self.note}"


@dataclass(frozen=True)
class NotMeasured:
    """A peer that could not be timed, and why, in one sentence."""

    peer: str
    reason: str

    def __str__(self) -> str:
        return f"{self.peer}: not measured: {self.reason}"


@dataclass(frozen=True)
class Answers:
    """A peer's answers to all states: what a test compares with ours."""

    torques: np.ndarray
    """(N, legs, 3) N·m."""
    forces_w: np.ndarray
    """(N, legs, 3) N, from ground to foot."""
    solved: np.ndarray
    """(N,) bool."""


class Peer:
    """A peer's script running in its own interpreter; use it as a context manager.

    `states` has the arrays of `tick_protocol.States` by name (position, quat, velocity_w,
    angular_velocity_b, q, qd, stance, foot_position_w; targets where they differ from rest where it is).
    A peer that cannot run raises nothing: `reason` says why, rounds are NaN, `summary` is `NotMeasured`.
    """

    def __init__(self, name: str, robot: Robot, states: Mapping[str, np.ndarray]) -> None:
        self.name = name
        self.reason: str | None = None
        self._robot = robot
        self._states = dict(states)
        self._script: Script | None = None

    def __enter__(self) -> "Peer":
        self._folder = tempfile.TemporaryDirectory(prefix="gaitwright-peer-")
        try:
            self._start(Path(self._folder.name))
        except PeerUnavailable as problem:
            self.reason = str(problem)
        return self

    def __exit__(self, *_: object) -> None:
        if self._script:
            self._script.close()
        self._folder.cleanup()

    def _start(self, folder: Path) -> None:
        """Start the script; by its greeting it has answered every state once, which warms it up."""
        python = peer_python(self.name)
        (folder / "robot.urdf").write_text(write_urdf(self._robot), encoding="utf-8")
        own = {"leg_names": np.array(self._robot.legs), "armature": self._robot.armature}
        np.savez(folder / "states.npz", **(own | self._states))  # type: ignore[arg-type]
        command = (python, SCRIPTS[self.name], folder / "robot.urdf", folder / "states.npz")
        options = ("--serve", "--answers", folder / "answers.npz")
        self._script = Script([str(word) for word in command + options], folder / "stderr.txt")
        self._script.hear(START_TIMEOUT_S)

    def _ask(self, command: str) -> dict | None:
        """The script's answer; None, and `reason` set for good, where there is none."""
        if self._script is None or self.reason is not None:
            return None
        try:
            return self._script.ask(command, ROUND_TIMEOUT_S)
        except PeerUnavailable as problem:
            self.reason = str(problem)
            return None

    def times(self, ticks: int, start: int | None = None) -> np.ndarray:
        """Every tick's µs (ticks,), from state `start` or where the last round ended; empty if unmeasured."""
        answer = self._ask(f"run {ticks}" if start is None else f"run {ticks} {start}")
        return np.array(answer["times_us"]) if answer else np.empty(0)

    def round(self, ticks: int, start: int | None = None) -> float:
        """Median µs of a tick over a round of `ticks` ticks; NaN if unmeasured."""
        times = self.times(ticks, start)
        return float(np.median(times)) if len(times) else math.nan

    def summary(self) -> Measured | NotMeasured:
        """All ticks so far, or why there are none."""
        answer = self._ask("summary")
        return Measured(**answer) if answer else self._unmeasured()

    def answers(self) -> Answers | NotMeasured:
        """What the peer answers to each state, once."""
        if self.reason is not None:
            return self._unmeasured()
        with np.load(Path(self._folder.name) / "answers.npz", allow_pickle=False) as file:
            return Answers(file["torques"], file["forces_w"], file["solved"])

    def _unmeasured(self) -> NotMeasured:
        return NotMeasured(self.name, self.reason or "it was not started")
