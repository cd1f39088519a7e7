"""What the coordinator remembers from tick to tick: a value, handed in and handed back."""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.numerics.packing import Layout, Row
from gaitwright.signals import Gait

STANCE, SWING, SEARCH = 0, 1, 2
"""Modes of a leg: carrying load, on its way, or late and being lowered until it touches."""


class GaitState(NamedTuple):
    """Memory of the gait. Arrays per leg are in the robot's leg order; world axes."""

    phase: Float[np.ndarray, "1"]
    """Phase φ in [0, 1)."""
    command: Float[np.ndarray, "3"]
    """Slewed command: forward, left [m/s], yaw rate [rad/s]."""
    reference_pose: Float[np.ndarray, "3"]
    """Where the body should be by now: x, y [m], yaw [rad]; it leads by no more than a bound."""
    slope: Float[np.ndarray, "3"]
    """Ground plane of the foot centres: ∂z/∂x, ∂z/∂y, and its height under the base [m]."""
    waited: Float[np.ndarray, "1"]
    """Time that the phase has waited for a missing leg [s]."""
    clock: Float[np.ndarray, "2"]
    """Period [s] and duty factor of the gait in use; a period of 0: none yet."""
    mode: Float[np.ndarray, "legs"]
    """STANCE, SWING or SEARCH."""
    progress: Float[np.ndarray, "legs"]
    """Share of the swing done, or seconds of search."""
    age: Float[np.ndarray, "legs"]
    """Time since this stance began [s]."""
    unfelt: Float[np.ndarray, "legs"]
    """Time since contact was last felt [s]."""
    offset: Float[np.ndarray, "legs"]
    """Relative phases of the gait in use."""
    grip: Float[np.ndarray, "legs"]
    """Coefficient of friction that a foot may count on (`grip`); 0: nothing was felt yet."""
    lift: Float[np.ndarray, "legs"]
    """Factor by which this swing is raised to clear the ground."""
    operator: Float[np.ndarray, "legs"]
    """Number of the terrain operator of this swing, from 1 on; 0: nothing is ahead, −1: none is for it."""
    reach: Float[np.ndarray, "legs"]
    """Metres of obstacle that it is applied to."""
    origin: Float[np.ndarray, "legs 3"]
    """Where the swing, or the search, began [m]."""
    contact: Float[np.ndarray, "legs 3"]
    """Centre of the foot at its last contact [m]."""
    foothold: Float[np.ndarray, "legs 3"]
    """Centre of the foot where its swing is to end [m]."""


LAYOUT = Layout.of(GaitState)
state_of = LAYOUT.views(GaitState)
"""The `GaitState` in a row, as views; for kernels too."""


class GaitMemory(NamedTuple):
    """What is handed from tick to tick."""

    row: Row
    """A packed `GaitState`."""
    gait: Gait | None = None
    """The gait in use; `None` before the first one."""

    @property
    def state(self) -> GaitState:
        """The fields of the row, as views."""
        return state_of(self.row)


def standing(feet_w: np.ndarray, position_w: np.ndarray, yaw: float, phase: float) -> GaitMemory:
    """The memory of a robot that stands on all its feet `(legs, 3)`, about to start at `phase`."""
    n = len(feet_w)
    ground = float(feet_w[:, 2].mean())
    state = GaitState(
        phase=np.array([phase]),
        command=np.zeros(3),
        reference_pose=np.array([position_w[0], position_w[1], yaw]),
        slope=np.array([0.0, 0.0, ground]),
        waited=np.zeros(1),
        clock=np.zeros(2),
        mode=np.zeros(n),
        progress=np.zeros(n),
        age=np.full(n, 10.0),
        unfelt=np.zeros(n),
        offset=np.zeros(n),
        grip=np.zeros(n),
        lift=np.ones(n),
        operator=np.zeros(n),
        reach=np.zeros(n),
        origin=feet_w.copy(),
        contact=feet_w.copy(),
        foothold=feet_w.copy(),
    )
    return GaitMemory(LAYOUT.pack(state))
