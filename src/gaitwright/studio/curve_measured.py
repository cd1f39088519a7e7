"""What a leg did in the last cycle: the ghost behind a curve."""

from collections import deque
from collections.abc import Iterable, Sequence

import numpy as np

from gaitwright.gait.foot_references import feet_in_world
from gaitwright.locomotion import Lap
from gaitwright.numerics.geometry import heading, rotation
from gaitwright.studio.curve_walk import Walk

SECONDS = 4.0
"""So much is remembered: a cycle of the slowest skill of a large robot."""
SHOWN = 100
"""Places of a ghost at most."""


class LastLaps:
    """The laps of the last seconds; `dt`: control period [s]."""

    def __init__(self, dt: float) -> None:
        self.laps: deque[Lap] = deque(maxlen=max(1, round(SECONDS / dt)))

    def add(self, lap: Lap) -> None:
        """Takes a lap; one after a new start forgets those before."""
        if self.laps and lap.sensed.time <= self.laps[-1].sensed.time:
            if lap.sensed.time == self.laps[-1].sensed.time:
                return
            self.laps.clear()
        self.laps.append(lap)

    def cycle(self, skill: str) -> list[Lap]:
        """The last whole cycle of a skill, the oldest lap first; empty: there was none."""
        return last_cycle(self.laps, skill)


def last_cycle(laps: Iterable[Lap], skill: str) -> list[Lap]:
    """The last whole cycle among laps; empty where the last of them are none of it."""
    found: list[Lap] = []
    gone, later = 0.0, None
    for lap in reversed(list(laps)):
        if lap.call.gait.name != skill:
            break
        if later is not None:
            gone += (later - lap.target.phase + 0.5) % 1.0 - 0.5
        if gone >= 1.0:
            return found[::-1]
        later = lap.target.phase
        found.append(lap)
    return []


def path_of(walk: Walk, laps: Sequence[Lap], leg: int) -> list[list[float]]:
    """Own phase, forward [strides] and height [body heights] of a foot as its hip saw it."""
    robot, rows = walk.robot, []
    for lap in thinned(laps):
        turn, at = rotation(lap.sensed.orientation_wb), tuple(lap.sensed.position_w)
        foot = feet_in_world(robot.arrays, turn, at, lap.sensed.q)[leg]
        x, y = foot[:2] - lap.sensed.position_w[:2]
        c, s = np.cos(heading(turn)), np.sin(heading(turn))
        place = np.array([c * x + s * y, c * y - s * x]) - robot.nominal_feet[leg, :2]
        rows.append((lap.target.phase, float(place @ walk.way), foot[2]))
    if not rows:
        return []
    phase, forward, height = np.array(rows).T
    forward = forward / walk.stride if walk.stride else np.zeros_like(forward)
    height = (height - height.min()) / robot.height
    return in_order(walk.own(phase, leg), np.stack([forward, height], axis=1))


def torques_of(walk: Walk, laps: Sequence[Lap], leg: int) -> list[list[float]]:
    """Own phase and torques of the three joints of a leg, as its motors gave them [N·m]."""
    few, most = thinned(laps), walk.robot.tau_max
    rows = [lap.command.given(lap.sensed.q, lap.sensed.qd, most)[leg] for lap in few]
    return in_order(phases(walk, few, leg), np.array(rows).reshape(-1, 3))


def angles_of(walk: Walk, laps: Sequence[Lap], leg: int) -> list[list[float]]:
    """Own phase and angles of the three joints of a leg [rad]."""
    few = thinned(laps)
    return in_order(phases(walk, few, leg), np.array([lap.sensed.q[leg] for lap in few]).reshape(-1, 3))


def thinned(laps: Sequence[Lap]) -> Sequence[Lap]:
    """At most `SHOWN` of them."""
    return laps[:: max(1, -(-len(laps) // SHOWN))]


def phases(walk: Walk, laps: Sequence[Lap], leg: int) -> np.ndarray:
    """A leg's own phase in each lap."""
    return walk.own(np.array([lap.target.phase for lap in laps]), leg)


def in_order(own: np.ndarray, columns: np.ndarray) -> list[list[float]]:
    """Rows from touch-down on."""
    return np.column_stack([own, columns])[np.argsort(own, kind="stable")].tolist()
