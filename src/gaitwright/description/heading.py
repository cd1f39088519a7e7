"""Which way a robot faces, as its legs say, and in which pairs they stand (row R2).

Legs that abduct say it by their first axes, which point forward. Others stand in left and right pairs about
some line through their middle, and that line is forward; of several, the one along the robot's long side.
"""

import math
import re
from typing import NamedTuple

import numpy as np

from gaitwright.errors import BadFile
from gaitwright.model import nominal_pose as stance
from gaitwright.model.nominal_pose import LegShape
from gaitwright.numerics.geometry import wrap

MIDLINE = 1e-3
"""A leg this close to the middle plane [m] is neither left nor right."""
SIX_NAMES = ("FL", "FR", "ML", "MR", "RL", "RR")
LEG_NAMES = {
    4: ("FL", "FR", "RL", "RR"),
    6: SIX_NAMES,
    8: ("FL", "FR", "M1L", "M1R", "M2L", "M2R", "RL", "RR"),
}
TOED = math.radians(15.0)
"""First axes within this angle of one line are along it: legs may be toed in a little."""
BESIDE = 0.1
"""A leg is beside the middle plane by more than this, per distance of the outermost one."""
AS_MIRRORED, FOR_A_TURN = 0.3, 0.1
"""Largest distance of a leg from its mate's image, per radius of the hips: as the file has it, and turned."""
WIDE = 1.5
"""A robot that is so many times as wide as long, by its hips, rather faces sideways."""
ROUNDED = 1e-4
"""Files write π so roughly: a turn this close to an eighth of a full one [rad] is it."""
FRONT = re.compile(r"front|fore|^(fl|fr|lf|rf)$")
REAR = re.compile(r"rear|hind|back|^(rl|rr|hl|hr|lh|rh|bl|br|lb|rb)$")
"""Words of a leg's name that say where it is."""


class Limb(NamedTuple):
    """A limb of three hinges as read: `name` of its first joint, first hinge in base axes [m], what it is."""

    name: str
    hip: np.ndarray
    shape: LegShape | None
    """`None` where its axes, lengths or foot are not those of a leg."""

    @property
    def place(self) -> np.ndarray:
        """Where it stands, for telling left from right: x and y [m]."""
        if self.shape is None or self.shape.yaws:
            return self.hip[:2]
        return stance.nominal_foot(self.shape)[:2]


class Heading(NamedTuple):
    """Forward as an angle from the file's x axis, about z [rad]; limbs in pairs from front to rear."""

    turn: float
    order: np.ndarray
    why: str

    def words(self, x: str = "x", y: str = "y") -> str:
        """Forward in the axes of the file, whose level ones are called `x` and `y`."""
        quarters = self.turn / (0.5 * math.pi)
        if abs(quarters - round(quarters)) < ROUNDED:
            axis = (x, y, "-" + x, "-" + y)[round(quarters) % 4]
            return f"the file's {axis.removeprefix('--')} axis"
        side = "left" if self.turn > 0.0 else "right"
        return f"{abs(math.degrees(self.turn)):.3g}° to the {side} of the file's {x} axis"


def heading(limbs: list[Limb]) -> Heading | None:
    """The way some limbs face as the legs of one robot; `None` where they are no two, three or four pairs."""
    if len(limbs) not in LEG_NAMES:
        return None
    places = np.array([limb.place for limb in limbs])
    along = common_axis(limbs)
    turns = candidates(places) if along is None else [along]
    why = "about which its legs stand in pairs" if along is None else "along which its first hinges point"
    known = [(turn, pairs(places, turn)) for turn in turns]
    paired = [Heading(turn, order, why) for turn, order in known if order is not None]
    if not paired:
        return None
    best = max(paired, key=lambda way: merit(limbs, places, way))
    return facing_front(limbs, places, best)


def common_axis(limbs: list[Limb]) -> float | None:
    """The angle of the line along which all first hinges point, if they abduct and there is one [rad]."""
    shapes = [limb.shape for limb in limbs]
    if any(shape is None or shape.yaws for shape in shapes):
        return None
    axes = np.array([shape.leg_frame[:2, 0] for shape in shapes if shape is not None])
    angles = np.arctan2(axes[:, 1], axes[:, 0])
    middle = 0.5 * math.atan2(float(np.sin(2.0 * angles).mean()), float(np.cos(2.0 * angles).mean()))
    if np.abs(0.5 * np.angle(np.exp(2j * (angles - middle)))).max() > TOED:
        return None
    return 0.0 if abs(middle) <= TOED else turned_least(middle)


def turned_least(angle: float) -> float:
    """The direction of a line [rad] that is nearest to x, of two equally near ones that nearest to y."""
    angle = math.remainder(angle, math.pi)
    eighth = 0.25 * math.pi * round(angle / (0.25 * math.pi))
    angle = eighth if abs(angle - eighth) < ROUNDED else angle
    return abs(angle) if abs(abs(angle) - 0.5 * math.pi) < ROUNDED else angle


def candidates(places: np.ndarray) -> list[float]:
    """Directions that are square to the line between two legs, x first [rad]."""
    gaps = [b - a for i, a in enumerate(places) for b in places[i + 1 :] if np.abs(b - a).max() > MIDLINE]
    lines = {turned_least(math.atan2(gap[1], gap[0]) + 0.5 * math.pi) for gap in gaps}
    return [0.0, *sorted(lines - {0.0}, key=lambda turn: (round(abs(turn), 6), -turn))]


def seen_from(places: np.ndarray, turn: float) -> np.ndarray:
    """Places from their middle, forward and to the left, for a forward direction."""
    c, s = math.cos(turn), math.sin(turn)
    return (places - places.mean(axis=0)) @ np.array([[c, -s], [s, c]])


def pairs(places: np.ndarray, turn: float) -> np.ndarray | None:
    """Indices of the legs in pairs from front to rear, left first; `None` where they are not in pairs."""
    local = seen_from(places, turn)
    beside = np.abs(local[:, 1])
    left, right = np.flatnonzero(local[:, 1] > 0.0), np.flatnonzero(local[:, 1] < 0.0)
    if len(left) != len(right) or beside.min() < max(MIDLINE, BESIDE * beside.max()):
        return None
    order = in_order(local, left, right)
    images = local[order[1::2]] * (1.0, -1.0)
    off = float(np.linalg.norm(local[order[0::2]] - images, axis=1).max())
    allowed = AS_MIRRORED if turn == 0.0 else FOR_A_TURN
    return order if off <= allowed * float(np.linalg.norm(local, axis=1).max()) else None


def in_order(local: np.ndarray, left: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Indices of the legs in pairs from front to rear, left first."""
    front_to_rear = [side[np.argsort(-local[side, 0], kind="stable")] for side in (left, right)]
    return np.column_stack(front_to_rear).ravel()


def as_written(limbs: list[Limb]) -> Heading:
    """Forward along the file's x axis, left where y > 0. Raises `BadFile` where that gives no pairs."""
    places = np.array([limb.place for limb in limbs])
    left, right = np.flatnonzero(places[:, 1] > MIDLINE), np.flatnonzero(places[:, 1] < -MIDLINE)
    between = len(limbs) - len(left) - len(right)
    if len(left) != len(right) or len(limbs) not in LEG_NAMES or between:
        on_it = f", {between} on the middle plane" if between else ""
        turned = ", and no turn of the base makes them" if len(limbs) in LEG_NAMES else ""
        raise BadFile(
            f"{len(left)} legs on the left (y > 0) and {len(right)} on the right{on_it}; "
            f"expected 2, 3 or 4 pairs{turned}; they start at {', '.join(repr(x.name) for x in limbs[:10])}"
        )
    return Heading(0.0, in_order(places, left, right), "")


def merit(limbs: list[Limb], places: np.ndarray, way: Heading) -> tuple[bool, bool, float, float]:
    """How well a way suits: legs within their limits, not wider than long if that is easy, little turned."""
    length, width = np.ptp(seen_from(places, way.turn), axis=0)
    room = slack(limbs, way.turn)
    easily_long = bool(width <= WIDE * length) and (way.turn == 0.0 or room >= stance.COMFORT)
    return room >= 0.0, easily_long, -round(abs(way.turn), 6), way.turn


def slack(limbs: list[Limb], turn: float) -> float:
    """Least distance [rad] of the nominal stance from a joint limit, with forward turned so."""
    c, s = math.cos(turn), math.sin(turn)
    back = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    middle = np.mean([limb.hip for limb in limbs], axis=0)
    slacks = []
    for shape in (limb.shape for limb in limbs if limb.shape is not None):
        leg = shape._replace(hip=back @ (shape.hip - middle), leg_frame=back @ shape.leg_frame)
        reached = stance.branch_angles(leg, stance.nominal_foot(leg)).values()
        slacks.append(max((leg.margin(q) for q in reached), default=-math.inf))
    return min(slacks, default=0.0)


def facing_front(limbs: list[Limb], places: np.ndarray, way: Heading) -> Heading:
    """The same line the other way round, where the names of the limbs call its front legs the rear ones."""
    ahead = seen_from(places, way.turn)[:, 0]
    front = [x for limb, x in zip(limbs, ahead, strict=True) if says(FRONT, limb.name)]
    rear = [x for limb, x in zip(limbs, ahead, strict=True) if says(REAR, limb.name)]
    if not front or not rear or max(front) >= min(rear):
        return way
    # The last leg becomes the first, and left is right: the pairs from behind are the order backwards.
    return Heading(wrap(way.turn + math.pi), way.order[::-1].copy(), "where the legs called front are")


def says(word: re.Pattern[str], name: str) -> bool:
    """Whether a word of a joint's name says where it is."""
    return any(word.search(part) for part in re.split(r"[^a-z]+", name.lower()))
