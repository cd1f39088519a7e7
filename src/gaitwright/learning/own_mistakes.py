"""The robot's own mistakes teach (thesis 6.4): a fall, feet that slip, no way made, in physics.

What a mistake tells is that the action in use was wrong: a negative instance. What would have been right
nobody says; the pupil tries the next calmer action that she knows, and where that proves wrong too, the one
after that.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.told import Told
from gaitwright.learning.live_sources import Played
from gaitwright.learning.skill_pupil import SkillPupil, told_at
from gaitwright.learning.teacher import Shown
from gaitwright.model.kinematics import feet_over_time
from gaitwright.numerics.geometry import GRAVITY, rotations
from gaitwright.record.recording import Recording
from gaitwright.skills.library import LIBRARY

BEFORE = 1.0
"""A fall began so long before it was one [s]: what was done then was wrong."""
WINDOW, SLIPPING, SHARE = 1.0, 0.3, 0.3
"""Feet slip where, within such a time [s], loaded feet go faster than this share of √(g h) for such a share
of their ticks."""
STUCK, NO_WAY = 6.0, 0.3
"""No way is made where in such a time [s] the robot comes no farther than this share of its height, and
there is somewhere to go."""
STOP = Action("stop")


@dataclass(frozen=True, slots=True)
class Mistake:
    """What went wrong: when what was done was wrong [s], and a sentence."""

    time: float
    sentence: str


def mistakes_in(recording: Recording) -> tuple[Mistake, ...]:
    """The mistakes of a mission, in order; the first of a kind."""
    trip = recording.of_trip().sound()
    time = np.array(trip["time"])
    if len(time) < 2:
        return ()
    found = [fallen(trip, time), slipped(trip, time), stuck(trip, time)]
    return tuple(sorted((one for one in found if one is not None), key=lambda one: one.time))


def fallen(trip: Recording, time: Float[np.ndarray, " ticks"]) -> Mistake | None:
    """The moment before a fall."""
    if not trip.fell:
        return None
    return Mistake(max(time[0], time[-1] - BEFORE), f"it fell at {time[-1]:.1f} s")


def slipped(trip: Recording, time: Float[np.ndarray, " ticks"]) -> Mistake | None:
    """The first window in which loaded feet slip much."""
    slips, down = slipping(trip, time)
    ticks = max(1, round(WINDOW / trip.dt))
    for begin, end in pairwise(range(0, len(time), ticks)):
        loaded = down[begin:end].sum()
        if loaded and slips[begin:end].sum() > SHARE * loaded:
            return Mistake(float(time[begin]), f"its feet slipped from {time[begin]:.1f} s on")
    return None


def slipping(
    trip: Recording, time: Float[np.ndarray, " ticks"]
) -> tuple[Bool[np.ndarray, "ticks legs"], Bool[np.ndarray, "ticks legs"]]:
    """Which feet slip at each tick, and which carry load at all."""
    robot = trip.robot
    q = np.array(trip["q"]).reshape(len(time), robot.n, 3)
    feet_b = feet_over_time(robot.hip, robot.leg_frame, robot.offset, robot.sign, q)
    turned = np.einsum("tij,tlj->tli", rotations(np.array(trip["orientation_wb"])), feet_b)
    feet_w = (turned + np.array(trip["position_w"])[:, None])[:, :, :2]
    speed = np.linalg.norm(np.diff(feet_w, axis=0, append=feet_w[-1:]), axis=2) / trip.dt
    share = np.array(trip["load"]) / (robot.total_mass * GRAVITY)
    down = (share > 0.1) & np.array(trip["stance"]).astype(bool)
    return down & (speed > SLIPPING * np.sqrt(GRAVITY * robot.height)), down


def stuck(trip: Recording, time: Float[np.ndarray, " ticks"]) -> Mistake | None:
    """The beginning of a time in which no way was made, at the end of a trip that did not arrive."""
    if trip.arrived or trip.fell or time[-1] - time[0] < STUCK:
        return None
    begin = int(np.searchsorted(time, time[-1] - STUCK))
    place = np.array(trip["position_w"])[begin:, :2]
    if np.linalg.norm(place - place[0], axis=1).max() > NO_WAY * trip.robot.height:
        return None
    return Mistake(float(time[begin]), f"it made no way from {time[begin]:.1f} s on")


# --- what they teach -------------------------------------------------------------------------------
def lesson_of(recording: Recording, pupil: SkillPupil, name: str) -> Told | None:
    """What a pupil tells herself after a mission that she drove; `None` where she did nothing wrong.

    As the critic, she looks at the first mistake alone: what came after may be no more than its consequence.
    """
    for mistake in mistakes_in(recording)[:1]:
        played = Played(recording, name)
        played.at(mistake.time)
        moment = played.here().moment
        done = pupil.choose(moment).action
        if done is not None and done.fastest > 0.0:
            action = calmer(done, pupil.actions)
            shown = Shown(pupil.name_of(action), action, mistake.sentence)
            return told_at(moment, shown, name, "by itself")
    return None


def calmer(done: Action, known: Sequence[Action]) -> Action:
    """The fastest of the known actions to cruise with that is slower than what went wrong; where there is
    none, to stop."""
    cruising = (action for action in known if LIBRARY[action.skill].cruise)
    slower = [action for action in cruising if 0.0 < action.fastest < done.fastest]
    return max(slower, key=lambda action: action.fastest, default=STOP)
