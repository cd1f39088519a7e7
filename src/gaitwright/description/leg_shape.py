"""Three hinges and a foot of a compiled model → `LegShape`: the frame on the axes, and the offsets in it."""

import math
from typing import NamedTuple

import mujoco
import numpy as np

from gaitwright.description.feet import Foot
from gaitwright.errors import BadFile
from gaitwright.model.nominal_pose import LegShape

AXES_TOLERANCE = 5e-3
"""Largest deviation [rad] of the hinges from: second square to the first, third parallel to the second."""
ROUNDED = 1e-3
"""So much of it is rounding and not told [rad]."""
NEARLY_ALONG = 0.94
"""An axis whose direction is this close (cosine) to x, y or z of the base is called by what it does."""
NO_LIMIT = 1000.0
"""A joint limit beyond this [rad] stands for none."""
ROLL, PITCH, YAW = "roll", "pitch", "yaw"


class Frame(NamedTuple):
    """Where the base frame is, in the world."""

    axes: np.ndarray
    """Its axes as columns: what takes its components to the world's."""
    origin: np.ndarray
    """Its origin [m]."""

    def points(self, world: np.ndarray) -> np.ndarray:
        """World points in this frame."""
        return (world - self.origin) @ self.axes


def shape_of(
    m: mujoco.MjModel, d: mujoco.MjData, joints: np.ndarray, foot: Foot, base: Frame, name: str
) -> LegShape:
    """The leg of three hinges that ends in `foot`. Raises `BadFile` where its axes are not those of a leg."""
    frame, sign = leg_frame(d.xaxis[joints], base, name)
    anchors = d.xanchor[joints]
    limited = m.jnt_limited[joints].astype(bool)[:, None] & (np.abs(m.jnt_range[joints]) < NO_LIMIT)
    q_min, q_max = np.where(limited, m.jnt_range[joints], (-math.pi, math.pi)).T
    return LegShape(
        hip=base.points(anchors[0]),
        leg_frame=base.axes.T @ frame,
        offset=offsets(anchors, foot, frame),
        sign=sign,
        q_min=q_min,
        q_max=q_max,
    )


def offsets(anchors: np.ndarray, foot: Foot, frame: np.ndarray) -> np.ndarray:
    """Rows hinge 1 → hinge 2 → hinge 3 → foot in the leg frame [m], from world points."""
    return np.diff(np.vstack([anchors, foot.centre]), axis=0) @ frame


def leg_frame(axes: np.ndarray, base: Frame, name: str) -> tuple[np.ndarray, float]:
    """Orthonormal frame on the first two axes of a leg (rows of `axes`, world), and the sign of the third."""
    first, second, third = axes
    off_square, off_parallel = crooked(axes)
    if off_square > AXES_TOLERANCE:
        raise BadFile(
            f"leg {name}: its second hinge is {math.degrees(off_square):.2f}° from square to the first"
            f"{in_words(axes @ base.axes)}"
        )
    if off_parallel > AXES_TOLERANCE:
        raise BadFile(
            f"leg {name}: its third hinge is {math.degrees(off_parallel):.2f}° from parallel to the second"
            f"{in_words(axes @ base.axes)}"
        )
    y = second - (second @ first) * first
    y /= np.linalg.norm(y)
    return np.column_stack([first, y, np.cross(first, y)]), math.copysign(1.0, float(second @ third))


def crooked(axes: np.ndarray) -> tuple[float, float]:
    """How far hinges are off: the second from square to the first, the third from parallel to it [rad]."""
    first, second, third = axes
    off_square = math.asin(min(1.0, abs(float(first @ second))))
    return off_square, math.asin(min(1.0, float(np.linalg.norm(np.cross(second, third)))))


def in_words(axes: np.ndarray) -> str:
    """What the hinges do, and in which order a leg wants them; empty where an axis is oblique. Base frame."""
    if np.abs(axes).max(axis=1).min() < NEARLY_ALONG:
        return ""
    names = [(ROLL, PITCH, YAW)[i] for i in np.abs(axes).argmax(axis=1)]
    single = [name for name in names if names.count(name) == 1]
    wanted = f"{single[0]} must come first" if len(single) == 1 else "one hinge, then two parallel ones"
    return f" ({', '.join(names)}; {wanted})"
