"""What is timed side by side: our tick, MuJoCo's step, Pinocchio's inverse dynamics, and the peers.

Each has `round(ticks)`, which hands back the µs of every tick by name; empty where it cannot run.
"""

from collections.abc import Mapping, Sequence
from importlib import import_module
from importlib.metadata import version
from importlib.util import find_spec
from time import perf_counter_ns
from typing import Any, Protocol, runtime_checkable

import numpy as np

from gaitwright.bench.evidence.moments import LiveTrot, Moment
from gaitwright.bench.peers.client import Measured, Peer
from gaitwright.bench.peers.tick_protocol import rotation
from gaitwright.locomotion import Brain
from gaitwright.model.robot import Robot
from gaitwright.model.urdf import write_urdf

Times = dict[str, np.ndarray]
"""Name → µs of each tick."""


@runtime_checkable
class Contender(Protocol):
    """Something that is timed in rounds."""

    def round(self, ticks: int) -> Times: ...

    def about(self) -> str:
        """Version, and what has to be known; or why it was not measured."""
        ...


class OurTick:
    """From `Sensed` to `MotorCommand` on recorded moments: gait references, then the numerical controller."""

    def __init__(self, brain: Brain, moments: Sequence[Moment]) -> None:
        self.coordinator, self.controller = brain.coordinator, brain.controllers["numerical"]
        self.moments, self.cursor = moments, 0

    def round(self, ticks: int) -> Times:
        """The whole tick and the controller alone, both of the same ticks."""
        whole, alone = np.empty(ticks), np.empty(ticks)
        for tick in range(ticks):
            moment = self.moments[self.cursor]
            self.cursor = (self.cursor + 1) % len(self.moments)
            began = perf_counter_ns()
            target, _ = self.coordinator.move(moment.gait, moment.call, moment.sensed, moment.ground)
            handed = perf_counter_ns()
            self.controller.command(target, moment.sensed, moment.memory, moment.call, moment.ground)
            done = perf_counter_ns()
            whole[tick], alone[tick] = (done - began) / 1e3, (done - handed) / 1e3
        return {"tick": whole, "controller": alone}

    def about(self) -> str:
        return "called from Python on states of a recorded trot"


class LiveTick:
    """The same in a running simulation, and MuJoCo's step, which is the plant's step without its sensing."""

    def __init__(self, trot: LiveTrot) -> None:
        self.trot = trot

    def round(self, ticks: int) -> Times:
        """The whole tick as the recording has it, and the physics."""
        lap_us, step_us = np.empty(ticks), np.empty(ticks)
        for tick in range(ticks):
            lap = self.trot.think()
            began = perf_counter_ns()
            self.trot.sensed = self.trot.plant.step(lap.command)
            stepped = perf_counter_ns()
            self.trot.plant.sense()
            done = perf_counter_ns()
            lap_us[tick], step_us[tick] = lap.took[0], (2 * stepped - began - done) / 1e3
        return {"live": lap_us, "mj_step": step_us}

    def about(self) -> str:
        return f"MuJoCo {version('mujoco')}, step of {self.trot.plant.timestep * 1e3:g} ms"


class Rnea:
    """Pinocchio's inverse dynamics on the same states."""

    def __init__(self, robot: Robot, states: Mapping[str, np.ndarray]) -> None:
        self.there = find_spec("pinocchio") is not None
        if not self.there:
            return
        self.pin: Any = import_module("pinocchio")  # of use to tests and benches only, and without types
        self.model = self.pin.buildModelFromXML(write_urdf(robot), self.pin.JointModelFreeFlyer())
        self.data = self.model.createData()
        names = [f"{leg}_{part}_joint" for leg in robot.legs for part in ("hip", "thigh", "calf")]
        self.q, self.v = configurations(self.model, names, states)
        self.a, self.cursor = np.zeros(self.model.nv), 0

    def round(self, ticks: int) -> Times:
        if not self.there:
            return {}
        out = np.empty(ticks)
        for tick in range(ticks):
            q, v = self.q[self.cursor], self.v[self.cursor]
            self.cursor = (self.cursor + 1) % len(self.q)
            began = perf_counter_ns()
            self.pin.rnea(self.model, self.data, q, v, self.a)
            out[tick] = (perf_counter_ns() - began) / 1e3
        return {"rnea": out}

    def about(self) -> str:
        return f"pin {version('pin')}" if self.there else "pin is not installed"


def configurations(
    model: Any, names: Sequence[str], states: Mapping[str, np.ndarray]
) -> tuple[np.ndarray, np.ndarray]:
    """q and v of every state in Pinocchio's order; the base's velocity in its own axes."""
    ids = [model.getJointId(name) for name in names]
    count = len(states["position"])
    q, v = np.zeros((count, model.nq)), np.zeros((count, model.nv))
    q[:, :3], q[:, 3:7] = states["position"], states["quat"][:, [1, 2, 3, 0]]
    q[:, [model.idx_qs[i] for i in ids]] = states["q"].reshape(count, -1)
    turns = np.array([rotation(quat) for quat in states["quat"]])
    v[:, :3] = np.einsum("tji,tj->ti", turns, states["velocity_w"])
    v[:, 3:6] = states["angular_velocity_b"]
    v[:, [model.idx_vs[i] for i in ids]] = states["qd"].reshape(count, -1)
    return q, v


class PeerTick:
    """A peer's whole-body controller on the same states, in its own interpreter."""

    def __init__(self, peer: Peer) -> None:
        self.peer = peer

    def round(self, ticks: int) -> Times:
        times = self.peer.times(ticks)
        return {self.peer.name: times} if len(times) else {}

    def about(self) -> str:
        summary = self.peer.summary()
        if not isinstance(summary, Measured):
            return summary.reason
        failed = f", {summary.failed} ticks failed" if summary.failed else ""
        return f"version {summary.version}{failed}"
