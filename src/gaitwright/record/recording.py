"""Laps ↔ file: every lap of a trip as arrays, and its report (row E1)."""

import json
import zipfile
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from gaitwright.description.load import robot_of
from gaitwright.errors import BadFile
from gaitwright.files import whole
from gaitwright.locomotion import Lap
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.record import metrics as figures
from gaitwright.record.metrics import Report

INTERRUPTED = "interrupted"
"""`stopped_because` of a trip that was cut off by the user."""


def widths(legs: int) -> dict[str, int]:
    """The channels of a recording and how many numbers each has."""
    return {
        "time": 1,
        "position_w": 3,
        "orientation_wb": 4,
        "velocity_w": 3,
        "angular_velocity_b": 3,
        "q": 3 * legs,
        "qd": 3 * legs,
        "load": legs,
        "tau": 3 * legs,
        "forces_w": 3 * legs,
        "stance": legs,
        "residual": 1,
        "phase": 1,
        "command": 3,
        "target_w": 3,
        "skill": 1,
        "driver": 1,
        "period": 1,
        "took": 2,
    }


STATE = ("time", "position_w", "orientation_wb", "velocity_w", "angular_velocity_b", "q", "qd", "load", "tau")
"""The channels that `state_hash` covers."""


@dataclass(frozen=True, eq=False)
class Recording:
    """Every lap of a trip as arrays, one row per tick."""

    robot: Robot
    scene: str
    seed: int
    dt: float
    skills: tuple[str, ...]
    """Names that the numbers in channel `skill` stand for."""
    drivers: tuple[str, ...]
    data: Float[np.ndarray, "ticks width"]
    arrived: bool
    fell: bool
    stopped_because: str

    def __len__(self) -> int:
        """Number of ticks."""
        return len(self.data)

    def __getitem__(self, channel: str) -> np.ndarray:
        """A channel `(ticks, width)`; those of one number are `(ticks,)`."""
        start = 0
        for name, width in widths(self.robot.n).items():
            if name == channel:
                block = self.data[:, start : start + width]
                return block[:, 0] if width == 1 else block
            start += width
        raise KeyError(f"no channel {channel!r}; there is: {', '.join(widths(self.robot.n))}")

    @property
    def done(self) -> bool:
        """Whether the robot did what it was asked: it came to its goal, or walked for the time asked for."""
        return self.arrived or self.stopped_because.endswith("asked for are over")

    def moved(self) -> Float[np.ndarray, "ticks 3"]:
        """Velocity forward and left [m/s] and yaw rate [rad/s], in the heading frame."""
        return figures.in_heading_frame(self["orientation_wb"], self["velocity_w"], self.dt)

    def sound(self) -> "Recording":
        """The part in which every number is one: what figures are made of when a simulation blew up."""
        with np.errstate(invalid="ignore"):
            return replace(self, data=self.data[(np.abs(self.data) < 1e12).all(axis=1)])

    def report(self) -> Report:
        """The figures of this trip; it must have a tick."""
        state_hash = figures.digest(self[name] for name in STATE)
        return self.sound().figures(state_hash)

    def figures(self, state_hash: str) -> Report:
        """The figures where every number is one."""
        time = self["time"]
        duration, distance = float(time[-1] - time[0]), figures.travelled(self["position_w"])
        roll, pitch = (float(angle.std()) for angle in figures.attitude(self["orientation_wb"]))
        error, yaw_error = figures.command_errors(
            self.moved(), self["command"], self["skill"], self["period"], self.dt
        )
        weight = self.robot.total_mass * GRAVITY
        work = figures.joint_work(self["tau"], self["qd"], self.dt)
        cost = work / (weight * distance) if distance > 0.1 * self.robot.body_length else 0.0
        upright = figures.uprightness(self.fell, roll, pitch)
        return Report(
            robot=self.robot.name,
            scene=self.scene,
            arrived=self.arrived,
            falls=int(self.fell),
            duration_s=duration,
            distance_m=distance,
            speed_mean_mps=distance / duration if duration else 0.0,
            velocity_error_mps=error,
            yaw_rate_error_radps=yaw_error,
            cost_of_transport=cost,
            roll_std_rad=roll,
            pitch_std_rad=pitch,
            driver_share={name: float((self["driver"] == i).mean()) for i, name in enumerate(self.drivers)},
            tick_us=figures.tick_times(self["took"], self["driver"], self.drivers),
            skills=[self.skills[int(self["skill"][start])] for start, _ in figures.stretches(self["skill"])],
            desirability=figures.desirability(upright, error, self.done, cost, self.robot.height),
            stopped_because=self.stopped_because,
            seed=self.seed,
            state_hash=state_hash,
        )

    def save(self, path: str | Path) -> Path:
        """Writes the recording as one `.npz` (arrays and a JSON header, no pickle), whole or not at all."""
        header = np.frombuffer(json.dumps(self.header()).encode(), dtype=np.uint8)
        arrays = {name: self[name] for name in widths(self.robot.n)}
        with whole(Path(path)) as draft, draft.open("wb") as file:
            np.savez_compressed(file, allow_pickle=False, header=header, **arrays)
        return Path(path)

    def header(self) -> dict[str, Any]:
        """All but the arrays, as plain JSON values."""
        robot = {field.name: getattr(self.robot, field.name) for field in fields(Robot)}
        plain = {
            name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in robot.items()
        }
        own = {name: getattr(self, name) for name in HEADER}
        return own | {"robot": plain}


HEADER = ("scene", "seed", "dt", "skills", "drivers", "arrived", "fell", "stopped_because")
"""Fields of a recording that its file holds as they are."""


class Recorder:
    """Collects laps in one growing array."""

    def __init__(self, robot: Robot, scene: str, seed: int, dt: float) -> None:
        self.robot, self.scene, self.seed, self.dt = robot, scene, seed, dt
        self.width = sum(widths(robot.n).values())
        self.rows = np.empty((4096, self.width))
        self.count = 0
        self.skills: dict[str, int] = {}
        self.drivers: dict[str, int] = {}
        self.last: Lap | None = None

    def add(self, lap: Lap) -> None:
        """Takes one lap."""
        if self.count == len(self.rows):
            self.rows = np.concatenate([self.rows, np.empty_like(self.rows)])
        s, t, u = lap.sensed, lap.target, lap.command
        numbers = (
            self.skills.setdefault(lap.call.skill, len(self.skills)),
            self.drivers.setdefault(lap.call.driver, len(self.drivers)),
            lap.call.gait.period,
            *lap.took,
        )
        # In the order of `widths`.
        pieces = (
            (s.time,),
            s.position_w,
            s.orientation_wb,
            s.velocity_w,
            s.angular_velocity_b,
            s.q.ravel(),
            s.qd.ravel(),
            s.load,
            u.tau.ravel(),
            u.forces_w.ravel(),
            t.stance,
            (u.residual, t.phase),
            t.command,
            t.position_w,
            numbers,
        )
        np.concatenate(pieces, out=self.rows[self.count])
        self.count += 1
        self.last = lap

    def finish(self) -> Recording:
        """The recording of what was taken so far."""
        last = self.last
        return Recording(
            self.robot,
            self.scene,
            self.seed,
            self.dt,
            tuple(self.skills),
            tuple(self.drivers),
            self.rows[: self.count].copy(),
            arrived=last is not None and last.arrived,
            fell=last is not None and last.fell,
            stopped_because=(last.stopped_because if last else None) or INTERRUPTED,
        )


# --- files ------------------------------------------------------------------------------------------
def load(path: str | Path) -> Recording:
    """The recording in a file. Raises `BadFile` where the file is not one."""
    arrays = read_arrays(Path(path))
    try:
        return recording_of(arrays)
    except (KeyError, TypeError, ValueError) as error:
        raise BadFile(f"{path} is not a recording: {error}") from error


def read_arrays(path: Path) -> dict[str, np.ndarray]:
    """What an `.npz` holds. Raises `BadFile`."""
    try:
        with np.load(path, allow_pickle=False) as file:
            return {name: file[name] for name in file.files}
    except (OSError, ValueError, EOFError, AttributeError, zipfile.BadZipFile) as error:
        raise BadFile(f"{path} is not a recording: {error}") from error


def recording_of(arrays: dict[str, np.ndarray]) -> Recording:
    """A recording from the arrays that `Recording.save` wrote."""
    header = json.loads(arrays["header"].tobytes())
    robot = robot_of(header["robot"])
    columns = [arrays[name].reshape(-1, width) for name, width in widths(robot.n).items()]
    own: dict[str, Any] = {
        name: tuple(header[name]) if name in ("skills", "drivers") else header[name] for name in HEADER
    }
    return Recording(robot=robot, data=np.concatenate(columns, axis=1, dtype=np.float64), **own)
