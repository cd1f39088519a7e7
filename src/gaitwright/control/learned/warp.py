"""A profile at another pace: the same path of body and feet, walked faster or slower (row L9, time warp).

Forces and what carries the legs' own weight are held; the rest of the legs' torques goes with the square of
the pace (`dynamics.time_warp`, thesis 5.3). Beyond ±20 % the body's sway is another one: then it is taught
anew.
"""

import math
from dataclasses import replace

import numpy as np
from jaxtyping import Float

from gaitwright.control.learned.profile import ROW, Profile, Table, row_of
from gaitwright.dynamics.newton_euler import inverse_dynamics
from gaitwright.dynamics.time_warp import warped_torques
from gaitwright.errors import WrongUse
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY

MOST = 0.2
"""So far from its own period a profile may be played."""


def can_be_warped(ratio: float) -> bool:
    """Whether a profile can be played at `ratio` times its period."""
    return abs(ratio - 1.0) <= MOST + 1e-9


def warped(robot: Robot, profile: Profile, ratio: float) -> Profile:
    """The profile at `ratio` times its period, and so at its speed over `ratio`. Raises `WrongUse` beyond
    ±20 %."""
    if not can_be_warped(ratio):
        raise WrongUse(
            f"a profile of {profile.skill} can be played at 0.8 to 1.2 times its period of "
            f"{profile.gait.period:.3g} s, not at {ratio:.3g} times"
        )
    table, legs = profile.table.copy(), robot.n
    held = weight_torques(robot, table).reshape(len(table), -1)
    where = ROW.slices(legs)
    before = table[:, where["free"]].copy()
    table[:, where["free"]] = warped_torques(before, held, np.zeros_like(held), 1.0 / ratio)
    table[:, where["tau"]] += table[:, where["free"]] - before
    for name in ("lag_rate", "qd", "velocity", "omega"):
        table[:, where[name]] /= ratio
    forward, left, turn = (part / ratio for part in profile.command)
    gait = replace(profile.gait, period=profile.gait.period * ratio)
    return replace(profile, gait=gait, command=(forward, left, turn), table=table)


def weight_torques(robot: Robot, table: Table) -> Float[np.ndarray, "bins legs 3"]:
    """Torques that carry the legs' own weight in the pose of each row [N·m]."""
    out = np.empty((len(table), robot.n, 3))
    still, none = (0.0, 0.0, 0.0), np.zeros((robot.n, 3))
    for k, numbers in enumerate(table):
        row = row_of(numbers)
        _, roll, pitch = row.pose
        level = GRAVITY * math.cos(pitch)
        up = (-GRAVITY * math.sin(pitch), level * math.sin(roll), level * math.cos(roll))
        out[k] = inverse_dynamics(robot.arrays, still, still, up, row.q, none, none)[2]
    return out
