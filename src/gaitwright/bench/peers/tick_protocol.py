"""What the peers' scripts share: the states, the stop-watch and the line protocol.

Runs in a peer's own interpreter beside `tsid_tick.py` and `placo_tick.py`, so it imports nothing but
the standard library and NumPy, and nothing of gaitwright.

Spoken over stdin and stdout, one JSON object a line from us: a greeting at the start; for "run K [START]"
a round of K ticks from state START (else where the last round ended); for "summary" all ticks so far;
"quit", or the end of stdin, ends.
"""

from __future__ import annotations

import argparse
import gc
import json
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol, runtime_checkable

import numpy as np

PARTS = ("hip", "thigh", "calf")
PER_ROBOT = ("posture", "armature")


@dataclass(frozen=True)
class States:
    """States and targets of N ticks, SI units; `_w` is in the world, `_b` in the body. Legs in file order."""

    leg_names: tuple[str, ...]
    position: np.ndarray  # (N, 3) base, m
    quat: np.ndarray  # (N, 4) w, x, y, z
    velocity_w: np.ndarray  # (N, 3) m/s
    angular_velocity_b: np.ndarray  # (N, 3) rad/s
    q: np.ndarray  # (N, legs, 3) rad
    qd: np.ndarray  # (N, legs, 3) rad/s
    stance: np.ndarray  # (N, legs) bool
    foot_position_w: np.ndarray  # (N, legs, 3) m: foothold in stance, target in swing
    foot_velocity_w: np.ndarray  # (N, legs, 3) m/s, targets in swing
    foot_acceleration_w: np.ndarray  # (N, legs, 3) m/s², targets in swing
    target_position: np.ndarray  # (N, 3) m
    target_quat: np.ndarray  # (N, 4) w, x, y, z
    target_velocity_w: np.ndarray  # (N, 3) m/s
    target_angular_velocity_b: np.ndarray  # (N, 3) rad/s
    target_acceleration_w: np.ndarray  # (N, 3) m/s²
    target_angular_acceleration_b: np.ndarray  # (N, 3) rad/s²
    posture: np.ndarray  # (legs, 3) rad, what the posture task pulls to
    armature: np.ndarray  # (legs, 3) kg·m², rotor inertia seen at the joint
    friction: float

    def __len__(self) -> int:
        return len(self.position)

    def joint_names(self) -> list[str]:
        """Names of the hinges, leg by leg."""
        return [f"{leg}_{part}_joint" for leg in self.leg_names for part in PARTS]

    def foot_names(self) -> list[str]:
        """Names of the foot frames, leg by leg."""
        return [f"{leg}_foot" for leg in self.leg_names]


def read_states(path: Path) -> States:
    """Read the npz that `client.Peer` writes; targets left out are the state itself, at rest.

    Raises KeyError naming the first array that is missing, ValueError where one is not finite or too short.
    """
    with np.load(path, allow_pickle=False) as file:
        given = {name: file[name] for name in file.files}
    count = len(given["position"])
    defaults = {
        "foot_velocity_w": np.zeros_like(given["q"]),
        "foot_acceleration_w": np.zeros_like(given["q"]),
        "target_position": given["position"],
        "target_quat": given["quat"],
        "target_velocity_w": np.zeros((count, 3)),
        "target_angular_velocity_b": np.zeros((count, 3)),
        "target_acceleration_w": np.zeros((count, 3)),
        "target_angular_acceleration_b": np.zeros((count, 3)),
        "posture": given["q"].mean(axis=0),
        "armature": np.zeros(given["q"].shape[1:]),
        "friction": np.array(0.6),
    }
    arrays = {**defaults, **given}
    legs = tuple(str(name) for name in arrays.pop("leg_names"))
    stance = arrays.pop("stance").astype(bool)
    friction = float(arrays.pop("friction"))
    numbers = {name: np.ascontiguousarray(array, dtype=np.float64) for name, array in arrays.items()}
    _check(numbers | {"stance": stance}, count)
    return States(leg_names=legs, stance=stance, friction=friction, **numbers)


def _check(arrays: dict[str, np.ndarray], count: int) -> None:
    for name, array in arrays.items():
        if not np.isfinite(array).all():
            raise ValueError(f"states: {name} is not finite")
        if name not in PER_ROBOT and len(array) != count:
            raise ValueError(f"states: {name} has {len(array)} rows, position has {count}")


def rotation(quat: np.ndarray) -> np.ndarray:
    """Rotation matrix (3, 3), body to world, of a quaternion (w, x, y, z)."""
    w, x, y, z = quat / np.linalg.norm(quat)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


@dataclass(frozen=True)
class Joints:
    """Where our joints lie in a peer's configuration (free flyer first: xyz, quaternion x, y, z, w)."""

    in_q: np.ndarray  # (legs · 3,) index into the peer's q
    in_v: np.ndarray  # (legs · 3,) index into the peer's v


def configurations(states: States, joints: Joints) -> tuple[np.ndarray, np.ndarray]:
    """States as Pinocchio has them: q (N, 7 + n), and v (N, 6 + n) whose first six are in the body."""
    count, hinges = len(states), len(joints.in_q)
    q, v = np.zeros((count, 7 + hinges)), np.zeros((count, 6 + hinges))
    q[:, :3] = states.position
    q[:, 3:7] = states.quat[:, [1, 2, 3, 0]] / np.linalg.norm(states.quat, axis=1, keepdims=True)
    q[:, joints.in_q] = states.q.reshape(count, -1)
    for tick in range(count):
        v[tick, :3] = rotation(states.quat[tick]).T @ states.velocity_w[tick]
    v[:, 3:6] = states.angular_velocity_b
    v[:, joints.in_v] = states.qd.reshape(count, -1)
    return q, v


@dataclass(frozen=True)
class Answer:
    """What a peer answered to one state."""

    torques: np.ndarray  # (legs, 3) N·m
    forces_w: np.ndarray  # (legs, 3) N, from ground to foot, zero in swing


@runtime_checkable
class Tick(Protocol):
    """One peer's control tick."""

    peer: str
    version: str
    note: str

    def prepare(self, state: int) -> None:
        """Not timed: set contacts to the state's stance feet."""
        ...

    def step(self, state: int) -> bool:
        """Timed: references, problem, solve, torques. False where the solver found no answer."""
        ...

    def answer(self) -> Answer:
        """Not timed: what the last step answered."""
        ...


@dataclass
class Watch:
    """All tick times so far, µs, and how many ticks failed."""

    times_us: list[float] = field(default_factory=list)
    failed: int = 0
    cursor: int = 0


def time_round(tick: Tick, watch: Watch, states: int, ticks: int) -> dict[str, object]:
    """Time `ticks` ticks, going round the states; returns the round's figures with every tick's µs."""
    times, failed = [], 0
    gc.disable()
    for _ in range(ticks):
        tick.prepare(watch.cursor)
        start = time.perf_counter_ns()
        solved = tick.step(watch.cursor)
        times.append((time.perf_counter_ns() - start) / 1e3)
        failed += not solved
        watch.cursor = (watch.cursor + 1) % states
    gc.enable()
    watch.times_us += times
    watch.failed += failed
    return {**figures(tick, times, failed), "times_us": times}


def figures(tick: Tick, times_us: list[float], failed: int) -> dict[str, object]:
    """The line that a bench prints about these ticks."""
    median, p99 = np.percentile(times_us, [50, 99]) if times_us else (float("nan"), float("nan"))
    return {
        "peer": tick.peer,
        "version": tick.version,
        "ticks": len(times_us),
        "median_us": float(median),
        "p99_us": float(p99),
        "failed": failed,
        "note": tick.note,
    }


def write_answers(tick: Tick, states: States, path: Path) -> None:
    """One pass over all states: torques (N, legs, 3), forces_w (N, legs, 3), solved (N,) as npz."""
    torques, forces_w, solved = np.zeros_like(states.q), np.zeros_like(states.q), np.zeros(len(states), bool)
    for state in range(len(states)):
        tick.prepare(state)
        solved[state] = tick.step(state)
        answer = tick.answer()
        torques[state], forces_w[state] = answer.torques, answer.forces_w
    np.savez(path, torques=torques, forces_w=forces_w, solved=solved)


def _commands() -> Iterator[list[str]]:
    """Words of each line on stdin, until "quit" or its end."""
    for line in sys.stdin:
        words = line.split()
        if words == ["quit"]:
            return
        if words:
            yield words


def serve(tick: Tick, states: States) -> None:
    """Answer the line protocol (see the top of this file) until told to quit."""
    watch = Watch()
    _say({"peer": tick.peer, "version": tick.version, "note": tick.note, "states": len(states)})
    for words in _commands():
        if words[0] == "run":
            watch.cursor = int(words[2]) % len(states) if len(words) > 2 else watch.cursor
            _say(time_round(tick, watch, len(states), int(words[1])))
        elif words[0] == "summary":
            _say(figures(tick, watch.times_us, watch.failed))
        else:
            _say({"error": f"no command {words[0]!r}; commands: run K [START], summary, quit"})


def _say(message: dict[str, object]) -> None:
    print(json.dumps(message), flush=True)


def arguments(description: str) -> argparse.Namespace:
    """The command line that both scripts share."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("urdf", type=Path, help="robot, its root link named base")
    parser.add_argument("states", type=Path, help="npz of states (tick_protocol.States)")
    parser.add_argument("--serve", action="store_true", help="speak the line protocol")
    parser.add_argument("--passes", type=int, default=20, help="passes over the states when not serving")
    parser.add_argument("--answers", type=Path, help="write torques and forces of one pass to this npz")
    return parser.parse_args()


def main(tick: Tick, states: States, options: argparse.Namespace) -> None:
    """Write answers if asked, then serve, or time some passes and print one JSON line."""
    if options.answers:
        write_answers(tick, states, options.answers)
    if options.serve:
        serve(tick, states)
        return
    watch = Watch()
    time_round(tick, Watch(), len(states), len(states))  # warm up
    time_round(tick, watch, len(states), options.passes * len(states))
    _say(figures(tick, watch.times_us, watch.failed))
