"""What the coordinator remembers from tick to tick: a value, handed in and handed back."""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.numerics.compiled import kernel

STANCE, SWING, SEARCH = 0, 1, 2
"""Modes of a leg: carrying load, on its way, or late and being lowered until it touches."""


GaitMemory = Float[np.ndarray, "numbers"]
"""A `GaitState` packed in one array, as it is handed from tick to tick."""


class GaitState(NamedTuple):
    """Memory of the gait. Arrays per leg are in the robot's leg order; world axes."""

    phase: np.ndarray
    """`(1,)` phase φ in [0, 1)."""
    command: np.ndarray
    """`(3,)` slewed command: forward, left [m/s], yaw rate [rad/s]."""
    anchor: np.ndarray
    """`(3,)` where the body should be by now: x, y [m], yaw [rad]; on a leash."""
    slope: np.ndarray
    """`(3,)` ground plane of the foot centres: ∂z/∂x, ∂z/∂y, and its height under the base [m]."""
    waited: np.ndarray
    """`(1,)` time that the phase has waited for a missing leg [s]."""
    clock: np.ndarray
    """`(2,)` period [s] and duty factor of the gait in use; a period of 0: none yet."""
    mode: np.ndarray
    """`(legs,)` STANCE, SWING or SEARCH."""
    progress: np.ndarray
    """`(legs,)` share of the swing done, or seconds of search."""
    age: np.ndarray
    """`(legs,)` time since this stance began [s]."""
    unfelt: np.ndarray
    """`(legs,)` time since contact was last felt [s]."""
    offset: np.ndarray
    """`(legs,)` relative phases of the gait in use."""
    lift: np.ndarray
    """`(legs,)` factor by which this swing is raised to clear the ground."""
    origin: np.ndarray
    """`(legs, 3)` where the swing, or the search, began [m]."""
    contact: np.ndarray
    """`(legs, 3)` centre of the foot at its last contact [m]."""
    foothold: np.ndarray
    """`(legs, 3)` centre of the foot where its swing is to end [m]."""


def standing(feet_w: np.ndarray, position_w: np.ndarray, yaw: float, phase: float) -> GaitState:
    """The memory of a robot that stands on all its feet `(legs, 3)`, about to start at `phase`."""
    n = len(feet_w)
    ground = float(feet_w[:, 2].mean())
    return GaitState(
        phase=np.array([phase]),
        command=np.zeros(3),
        anchor=np.array([position_w[0], position_w[1], yaw]),
        slope=np.array([0.0, 0.0, ground]),
        waited=np.zeros(1),
        clock=np.zeros(2),
        mode=np.zeros(n, dtype=np.int64),
        progress=np.zeros(n),
        age=np.full(n, 10.0),
        unfelt=np.zeros(n),
        offset=np.zeros(n),
        lift=np.ones(n),
        origin=feet_w.copy(),
        contact=feet_w.copy(),
        foothold=feet_w.copy(),
    )


def packed(state: GaitState) -> GaitMemory:
    """The state in one array, field after field."""
    return np.concatenate([field.ravel().astype(float) for field in state])


BODY, LEG = 13, 15
"""Numbers of the body, and of each leg, in a packed memory."""


@kernel
def state_of(memory):
    """The `GaitState` in a packed memory, as views."""
    n = (memory.size - BODY) // LEG
    legs = memory[BODY:]
    return GaitState(
        memory[:1],
        memory[1:4],
        memory[4:7],
        memory[7:10],
        memory[10:11],
        memory[11:13],
        legs[:n],
        legs[n : 2 * n],
        legs[2 * n : 3 * n],
        legs[3 * n : 4 * n],
        legs[4 * n : 5 * n],
        legs[5 * n : 6 * n],
        legs[6 * n : 9 * n].reshape(n, 3),
        legs[9 * n : 12 * n].reshape(n, 3),
        legs[12 * n :].reshape(n, 3),
    )
