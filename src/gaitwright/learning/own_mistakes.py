"""The robot's own mistakes teach (thesis 6.4), in physics: motion bugs (a fall, feet that slip, a failed
step, an illegal operation), and no way made.

What a mistake tells is that the action in use was wrong: a negative instance. What would have been right
nobody says; the pupil tries the next calmer action that she knows, and where that proves wrong too, the one
after that.
"""

from collections.abc import Iterable, Sequence
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
from gaitwright.plant.names import JOINTS
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
NO_GROUND, CARRIES = 0.25, 0.02
"""A step has failed where a foot that should carry bears less than this share of the weight so long [s]."""
AT_LIMIT, NEARLY = 0.25, 0.999
"""An illegal operation: a torque at this share of its limit for so long [s], which asks for more than the
motor has, or a joint as long at its stop."""
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
    found = [*motion_bugs_in(trip), stuck(trip, time)]
    return in_order(found)


def motion_bugs_in(trip: Recording) -> tuple[Mistake, ...]:
    """Those of the mistakes that a movement itself was, in order; the first of a kind. `trip`: without what
    came after it, in which every number is one."""
    time = np.array(trip["time"])
    return in_order(law(trip, time) for law in (fallen, slipped, missed, overdone)) if len(time) > 1 else ()


def in_order(found: Iterable[Mistake | None]) -> tuple[Mistake, ...]:
    """Mistakes by their times."""
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


def missed(trip: Recording, time: Float[np.ndarray, " ticks"]) -> Mistake | None:
    """The first step that found no ground."""
    carries = np.array(trip["load"]) > CARRIES * trip.robot.total_mass * GRAVITY
    lacking = np.array(trip["stance"]).astype(bool) & ~carries
    found = [
        (start, leg) for leg in range(trip.robot.n) for start in held_for(lacking[:, leg], NO_GROUND, trip)
    ]
    if not found:
        return None
    start, leg = min(found)
    return Mistake(float(time[start]), f"foot {trip.robot.legs[leg]} found no ground at {time[start]:.1f} s")


def overdone(trip: Recording, time: Float[np.ndarray, " ticks"]) -> Mistake | None:
    """The first illegal operation: a torque that no motor gives, a joint at its stop."""
    robot = trip.robot
    torques, angles = (np.array(trip[name]).reshape(len(time), robot.n, 3) for name in ("tau", "q"))
    kinds = {
        "was asked for more torque than it has": np.abs(torques) >= NEARLY * robot.tau_max,
        "stood at its stop": (angles <= robot.q_min) | (angles >= robot.q_max),
    }
    found = [
        (start, f"{robot.legs[leg]} {JOINTS[joint]} {what} at {time[start]:.1f} s")
        for what, seen in kinds.items()
        for leg in range(robot.n)
        for joint in range(3)
        for start in held_for(seen[:, leg, joint], AT_LIMIT, trip)
    ]
    return Mistake(float(time[min(found)[0]]), min(found)[1]) if found else None


def held_for(seen: Bool[np.ndarray, " ticks"], seconds: float, trip: Recording) -> list[int]:
    """The ticks at which something begins that is then seen for so long [s]; the first alone."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], seen, [False]]).astype(np.int8)))
    begins, ends = edges[::2], edges[1::2]
    return begins[(ends - begins) * trip.dt >= seconds].tolist()[:1]


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
