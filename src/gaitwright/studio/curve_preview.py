"""What an edit would do: two seconds in physics from where the robot is now, in a world of its own."""

import copy
import math
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any

import numpy as np

from gaitwright.control.takeover import HYBRID, LEARNED
from gaitwright.gait.coordinator import Coordinator
from gaitwright.locomotion import Lap
from gaitwright.plant.twins import twin
from gaitwright.record.metrics import in_heading_frame
from gaitwright.session import Session
from gaitwright.skills.chooser import HeldSkill
from gaitwright.studio.curve_change import Change, Parts
from gaitwright.studio.curve_measured import last_cycle, path_of
from gaitwright.studio.curve_walk import Walk

SECONDS = 2.0
"""Of physics, from when the edit takes effect."""
LONGEST_WAIT = 2.0
"""For the next cycle at most, in periods."""


@dataclass(frozen=True)
class Preview:
    """What was seen."""

    failed: str
    """Why the run ended where it would not have without the edit; empty: it did not."""
    at: float
    """How long after the edit took effect it ended, or was looked at [s]."""
    fell: bool
    velocity_error: float
    """Mean velocity over the last cycles less what was asked for [m/s]."""
    torque_share: float
    """The greatest torque over its limit [-]."""
    path: list[list[float]]
    """Of the foot in the last whole cycle, as `curve_measured.path_of` has it."""
    took: float
    """To compute [s]."""

    def facts(self) -> dict[str, Any]:
        """As plain values."""
        return {
            "seconds": round(self.at, 3),
            "fell": self.fell,
            "failed": self.failed,
            "velocity_error": self.velocity_error,
            "torque_share": self.torque_share,
            "path": self.path,
            "took": self.took,
        }


@dataclass(frozen=True)
class Wish:
    """What is to be seen: a walk with a leg looked at, by new parts of the brain."""

    walk: Walk
    leg: int
    parts: Parts
    played: bool = False
    """Whether it is about torque profiles: then whoever plays them drives."""
    imagined: float = 0.0
    """An obstacle that the leg takes for seen [m]."""


def previewed(session: Session, wish: Wish) -> Preview:
    """Two seconds of a session with an edit. The session itself is left alone.

    A robot that does something else takes the skill up, as it is meant. Where the run ends early it is
    seen once more without the edit: what then happens as well is not its fault. Raises `WrongUse` for a
    plant that tells nobody where it is.
    """
    began = perf_counter()
    laps, waited = run(session, wish)
    last = laps[-1]
    dt, start = session.plant.dt, laps[waited].sensed.time
    failed = ending(last)
    if failed and ending(run(session, replace(wish, parts=Parts.of(session.brain), imagined=0.0))[0][-1]):
        failed = ""
    seen = laps[waited:]
    most = wish.walk.robot.tau_max
    torques = np.array([lap.command.given(lap.sensed.q, lap.sensed.qd, most) for lap in seen])
    return Preview(
        failed,
        last.sensed.time - start,
        last.fell,
        velocity_error(seen, dt),
        float((np.abs(torques) / most).max()),
        path_of(wish.walk, last_cycle(seen, wish.walk.skill), wish.leg),
        perf_counter() - began,
    )


def run(session: Session, wish: Wish) -> tuple[list[Lap], int]:
    """The laps of a branch, and which of them is the first with the edit."""
    branch, change = branched(session, wish), Change()
    state, gait = branch.mind.memories.gait.state, branch.mind.memories.gait.gait
    is_walked = gait is None or gait.name == wish.walk.skill
    change.phase = float(state.phase[0]) if is_walked else math.inf
    change.ask(imagining(wish))
    laps: list[Lap] = []
    waited, patience = None, LONGEST_WAIT * wish.walk.gait.period
    while waited is None or (len(laps) - waited) * branch.plant.dt < SECONDS:
        lap = branch.step()
        if lap is None:
            break
        laps.append(lap)
        if len(laps) * branch.plant.dt > patience:
            change.phase = math.inf
        change.after(branch)
        if waited is None and change.wanted is None:
            waited = len(laps) - 1
        if len(laps) * branch.plant.dt > patience + 2.0 * SECONDS:
            break
    return laps, waited or 0


def imagining(wish: Wish) -> Parts:
    """The new parts, with the obstacle that the leg takes for seen."""
    if not wish.imagined:
        return wish.parts
    sizes = tuple(wish.imagined if k == wish.leg else 0.0 for k in range(wish.walk.robot.n))
    coordinator: Coordinator = replace(wish.parts.coordinator, imagined=sizes)
    return wish.parts._replace(coordinator=coordinator)


def branched(session: Session, wish: Wish) -> Session:
    """A session that goes on from this one in a world of its own, by the skill that is to be seen."""
    out = copy.copy(session)
    out.plant = twin(session.plant, session.brain.robot, session.measured)
    out.termination = copy.copy(session.termination)
    out.termination.ends = math.inf
    out.pushes, out.paused, out.closed, out.lowers = [], False, False, False
    if session.is_over or session.closed:
        out.lap, out.pushing_until = None, None
        out.measured = out.plant.reset(0, vary=False)
        out.mind = out.brain.begin(session.mind.mission, out.measured)
        out.termination.set_out(out.measured.time)
        out.termination.grounded_at = out.termination.fed_at = out.measured.time
    if wish.played:
        out.brain = Parts.of(out.brain)._replace(controllers=wish.parts.controllers).within(out.brain)
    return held(out, wish)


def held(branch: Session, wish: Wish) -> Session:
    """The same, where something else is done than is to be seen: the skill is held, and driven so."""
    call, walk = branch.mind.call, wish.walk
    driver = branch.mind.memories.drive.driver if call.driver == HYBRID else call.driver
    if call.gait.name == walk.skill and (driver == LEARNED or not wish.played):
        return branch
    driver = LEARNED if wish.played else branch.mind.mission.driver
    call = replace(
        call, skill=walk.skill, gait=walk.gait, velocity=walk.velocity, turn=walk.turn, driver=driver
    )
    branch.brain = replace(branch.brain, chooser=HeldSkill(call))
    branch.mind = branch.mind._replace(call=call)
    return branch


def ending(lap: Lap) -> str:
    """Why a run ended that should have gone on; empty: it went on, or was over."""
    return "" if lap.arrived or lap.stopped_because is None else lap.stopped_because


def velocity_error(laps: list[Lap], dt: float) -> float:
    """The mean error of velocity over the last whole cycles, up to half of what was seen [m/s]."""
    period = laps[-1].call.gait.period
    cycles = max(1, int(0.5 * len(laps) * dt / period))
    last = laps[-max(2, round(cycles * period / dt)) :]
    if len(last) < 2:
        return 0.0
    sensed = [lap.sensed for lap in last]
    moved = in_heading_frame(
        np.array([one.orientation_wb for one in sensed]), np.array([one.velocity_w for one in sensed]), dt
    )
    asked = np.array([lap.target.command for lap in last])
    return float(np.linalg.norm((moved - asked)[:, :2].mean(axis=0)))
