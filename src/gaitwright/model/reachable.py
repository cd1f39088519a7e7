"""Which places on the ground each leg reaches with its foot, from where the body is (row V3)."""

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.model.kinematics import REACHED, leg_angles, to_leg
from gaitwright.model.reach import LIMIT_TOLERANCE
from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, dot, length, sub, times, times_t, vec


def reachable(
    robot: Robot,
    position_w: Float[np.ndarray, "3"],
    R_wb: Float[np.ndarray, "3 3"],
    nodes: tuple[Float[np.ndarray, "columns"], Float[np.ndarray, "rows"]],
    heights: Float[np.ndarray, "rows columns"],
) -> Bool[np.ndarray, "legs rows columns"]:
    """On which nodes each foot can stand: its leg gets there in its own branch, within its joint limits.

    `position_w`, `R_wb`: pose of the base; `nodes`: x of the columns and y of the rows; `heights`: of the
    ground there, world [m], NaN where it is not known: there nothing is within reach.
    """
    out = np.zeros((robot.n, *heights.shape), dtype=np.bool_)
    write_reachable(robot.arrays, (position_w, R_wb), nodes, np.ascontiguousarray(heights), out)
    return out


@kernel
def write_reachable(model, pose, nodes, heights, out):
    """Sets `out`, which says no everywhere, for each leg and node as `reachable` says."""
    (position, R_wb), (x, y) = pose, nodes
    at = vec(position)
    for leg in range(out.shape[0]):
        hip = add(at, times(R_wb, vec(model.hip[leg])))
        far = length(vec(model.offset[leg, 0])) + length(vec(model.offset[leg, 1]))
        far += length(vec(model.offset[leg, 2]))
        for row in range(y.size):
            for column in range(x.size):
                foot = (x[column], y[row], heights[row, column] + model.foot_radius[leg])
                way = sub(foot, hip)
                if not dot(way, way) <= far * far:  # nor where the height is no number
                    continue
                point = to_leg(model.leg_frame[leg], model.hip[leg], times_t(R_wb, sub(foot, at)))
                side, bend = model.branch[leg, 0], model.branch[leg, 1]
                q, code = leg_angles(point, model.offset[leg], model.sign[leg], side, bend)
                out[leg, row, column] = code == REACHED and is_allowed(model, leg, q)


@kernel
def is_allowed(model, leg, q):
    """Whether the angles of a leg are within its joint limits."""
    for joint in range(3):
        low, high = model.q_min[leg, joint], model.q_max[leg, joint]
        if not low - LIMIT_TOLERANCE <= q[joint] <= high + LIMIT_TOLERANCE:
            return False
    return True
