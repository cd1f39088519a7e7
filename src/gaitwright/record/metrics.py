"""The figures of a walk as functions of what was recorded (row E1): series in, numbers out.

They go through a trip a part at a time: one of hours takes a few numbers a tick.
"""

import hashlib
import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.numerics.geometry import GRAVITY
from gaitwright.record.rows import Series, parts

SETTLED = 5
"""Cycles of a skill that are left out of its velocity error: it has to get up to speed first."""
COSTLY = 4.0
"""A cost of transport at which the economy part of the desirability is nothing."""


@dataclass(frozen=True)
class Report:
    """The figures of one trip; the keys of its JSON stay."""

    robot: str
    scene: str
    arrived: bool
    falls: int
    duration_s: float
    distance_m: float
    speed_mean_mps: float
    velocity_error_mps: float
    """RMS of the cycle-averaged velocity error in the heading frame, once the skill has settled."""
    yaw_rate_error_radps: float
    """The same for the yaw rate."""
    cost_of_transport: float
    """∫ Σ|τ q̇| dt / (m g distance)."""
    roll_std_rad: float
    pitch_std_rad: float
    driver_share: dict[str, float]
    """Share of the ticks each driver had."""
    tick_us: dict[str, dict[str, float]]
    """Time of a tick [µs], median and p99: the whole lap, and gait and control by each driver."""
    skills: list[str]
    """Skills in the order of their use."""
    desirability: float
    stopped_because: str
    seed: int
    state_hash: str
    """SHA-256 of every sensed state and torque: equal for equal seeds on one machine."""
    faults: list[dict[str, Any]] = field(default_factory=list)
    """What was noticed to be broken: the fields of each `perception.fault_words.Fault`."""
    energy_j_per_m: float = 0.0
    """∫ Σ|τ q̇| dt over the distance [J/m]: the cost of transport times the weight."""

    def to_json(self) -> str:
        """As JSON; everything but `tick_us` is the same for the same seed."""
        return json.dumps(asdict(self), indent=2, ensure_ascii=False)


def attitude(orientation_wb: Series) -> tuple[np.ndarray, np.ndarray]:
    """Roll and pitch [rad] over time."""
    roll, pitch = np.empty(len(orientation_wb)), np.empty(len(orientation_wb))
    for part in parts(len(roll)):
        w, x, y, z = orientation_wb[part].T
        roll[part] = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
        pitch[part] = np.arcsin(np.clip(2 * (w * y - z * x), -1.0, 1.0))
    return roll, pitch


def heading_over_time(orientation_wb: Series) -> Float[np.ndarray, " ticks"]:
    """Yaw [rad] without jumps."""
    yaw = np.empty(len(orientation_wb))
    for part in parts(len(yaw)):
        w, x, y, z = orientation_wb[part].T
        new = np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
        before = yaw[max(0, part.start - 1) : part.start]
        yaw[part] = np.unwrap(np.concatenate([before, new]))[len(before) :]
    return yaw


def in_heading_frame(
    orientation_wb: Float[np.ndarray, "ticks 4"], velocity_w: Float[np.ndarray, "ticks 3"], dt: float
) -> Float[np.ndarray, "ticks 3"]:
    """Velocity forward and left [m/s] and yaw rate [rad/s]."""
    yaw = heading_over_time(orientation_wb)
    vx, vy = velocity_w[:, 0], velocity_w[:, 1]
    c, s = np.cos(yaw), np.sin(yaw)
    rate = np.gradient(yaw, dt) if len(yaw) > 1 else np.zeros_like(yaw)
    return np.stack([c * vx + s * vy, c * vy - s * vx, rate], axis=1)


def command_errors(
    moved: Series, command: Series, skill: Series, period: Series, dt: float
) -> tuple[float, float]:
    """RMS of the cycle-averaged velocity error [m/s] and yaw rate error [rad/s].

    `moved` and `command`: forward, left [m/s], yaw rate [rad/s]. Each window is one period of the skill in
    use; the first `SETTLED` cycles of every skill are left out, and so is standing.
    """
    error, moving = summed(moved, command), moves(command)
    velocity, yaw = [], []
    for start, end in stretches(skill):
        window = max(1, round(float(period[start : start + 1][0]) / dt))
        first = np.arange(start + SETTLED * window, end - window + 1, max(1, window // 4))
        first = first[moving[first]] if len(first) else first
        mean = (error[first + window] - error[first]) / window
        velocity.append((mean[:, :2] ** 2).sum(axis=1))
        yaw.append(mean[:, 2] ** 2)
    return root_mean(velocity), root_mean(yaw)


def summed(moved: Series, command: Series) -> np.ndarray:
    """The sum of all errors before each tick and, last, of all; `(ticks + 1, 3)`."""
    out = np.zeros((len(command) + 1, 3))
    for part in parts(len(command)):
        error = moved[part] - command[part]
        error[0] += out[part.start]
        np.cumsum(error, axis=0, out=out[part.start + 1 : part.stop + 1])
    return out


def moves(command: Series) -> np.ndarray:
    """Whether a velocity is asked for, at each tick."""
    out = np.empty(len(command), dtype=bool)
    for part in parts(len(command)):
        out[part] = np.abs(command[part]).sum(axis=1) > 1e-6
    return out


def root_mean(squares: list[np.ndarray]) -> float:
    """Root of the mean of all squares; nothing where there are none."""
    together = np.concatenate([*squares, np.empty(0)])
    return float(np.sqrt(together.mean())) if len(together) else 0.0


def stretches(labels: Series) -> list[tuple[int, int]]:
    """Where a label stays the same: (start, end) of each stretch."""
    bounds = [0]
    for part in parts(len(labels)):
        edges = np.flatnonzero(np.diff(labels[part.start : part.stop + 1])) + part.start + 1
        bounds.extend(edges.tolist())
    return list(pairwise([*bounds, len(labels)]))


def travelled(position_w: Series) -> float:
    """Length of the way over ground [m]."""
    return sum(
        float(np.linalg.norm(np.diff(position_w[part.start : part.stop + 1][:, :2], axis=0), axis=1).sum())
        for part in parts(len(position_w))
    )


def joint_work(tau: Series, qd: Series, dt: float) -> float:
    """∫ Σ|τ q̇| dt [J]."""
    return sum(float(np.abs(tau[part] * qd[part]).sum() * dt) for part in parts(len(tau)))


def tick_times(took: Series, driver: Series, names: Iterable[str]) -> dict[str, dict[str, float]]:
    """Median and 99th percentile [µs] of whole laps, and of gait and control by each driver that ticked."""
    every = list(parts(len(took)))
    out = {"lap": middle_and_tail(np.concatenate([took[part][:, 0].copy() for part in every]))}
    for number, name in enumerate(names):
        own = np.concatenate([took[part][driver[part] == number, 1] for part in every])
        if len(own):
            out[name] = middle_and_tail(own)
    return out


def middle_and_tail(times: np.ndarray) -> dict[str, float]:
    return {"median": float(np.median(times)), "p99": float(np.percentile(times, 99))}


def desirability(upright: float, error: float, reached: bool, cost: float, height: float) -> float:
    """The thesis's desirability D in [0, 1]: the mean of those of its measures that every trip has.

    Each measure is 1 at its best: `upright`, the velocity held (`error` in m/s, against the pace √(g h)),
    the goal reached where there was one, economy (`cost` of transport).
    """
    pace = np.sqrt(GRAVITY * height)
    measures = (
        upright,
        float(np.exp(-error / (0.1 * pace))),
        float(reached),
        max(0.0, 1.0 - cost / COSTLY),
    )
    return float(np.mean(measures))


def uprightness(fell: bool, roll_std: float, pitch_std: float) -> float:
    """1 for a body that keeps still, nothing after a fall; the spreads in rad."""
    return 0.0 if fell else float(np.exp(-(roll_std + pitch_std) / np.radians(10)))


def digest(arrays: Iterable[Series]) -> str:
    """SHA-256 over the bits of some arrays."""
    sha = hashlib.sha256()
    for array in arrays:
        for part in parts(len(array)):
            sha.update(np.ascontiguousarray(array[part]).tobytes())
    return sha.hexdigest()


def touchdowns(stance: Bool[np.ndarray, "ticks legs"]) -> list[tuple[int, int]]:
    """(tick, leg) of every footfall: a leg that carries load and did not at the tick before."""
    began = stance.copy()
    began[1:] &= ~stance[:-1]
    ticks, legs = np.nonzero(began)
    return list(zip(ticks.tolist(), legs.tolist(), strict=True))
