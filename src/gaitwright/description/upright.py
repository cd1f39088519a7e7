"""Which way is up in a robot's file, as its hips say: they lie in a plane that is level when it stands."""

from typing import NamedTuple

import numpy as np

from gaitwright.description.heading import Limb
from gaitwright.description.leg_shape import Frame

FLAT = 0.2
"""Hips lie in a plane where they are spread square to it by less than this, per spread within it."""
APART = 0.2
"""Hips that are spread less than this, per length of the legs, say nothing."""


class Up(NamedTuple):
    """The axes of the base once it is upright, and the sentence about it where the file is not."""

    frame: Frame
    names: tuple[str, str]
    """What the horizontal axes are called in the file."""
    notes: tuple[str, ...]


def upright(limbs: list[Limb], frame: Frame) -> Up:
    """The frame turned so that z is square to the plane of the hips, if another axis of the file is that.

    `limbs` in the axes of `frame`, those of the file. Feet are down where they are at zero angles.
    """
    shapes = [limb.shape for limb in limbs if limb.shape is not None]
    axis = level_axis(np.array([shape.hip for shape in shapes])) if len(shapes) > 3 else 2
    length = float(np.median([shape.stretched for shape in shapes] or [0.0]))
    across = [np.ptp([shape.hip[i] for shape in shapes]) for i in range(3) if i != axis] if shapes else [0.0]
    if axis == 2 or min(across) < APART * length:
        return Up(frame, ("x", "y"), ())
    drop = float(np.mean([(shape.leg_frame @ shape.offset.sum(axis=0))[axis] for shape in shapes]))
    sign = -1.0 if drop > APART * length else 1.0
    x, y = (axis + 1) % 3, (axis + 2) % 3
    turn = np.eye(3)[:, [x, y, axis]] * (1.0, sign, sign)
    minus = "-" if sign < 0.0 else ""
    note = (
        f"up is the file's {minus}{'xyz'[axis]} axis, square to the plane of its hips: "
        "the robot is turned so that up is z"
    )
    return Up(frame._replace(axes=frame.axes @ turn), ("xyz"[x], minus + "xyz"[y]), (note,))


def level_axis(hips: np.ndarray) -> int:
    """The axis square to a plane in which hips `(legs, 3)` lie; z where that is so or none is."""
    spread = np.ptp(hips, axis=0)
    flat = [i for i in (2, 1, 0) if spread[i] <= FLAT * min(np.delete(spread, i))]
    return flat[0] if flat else 2
