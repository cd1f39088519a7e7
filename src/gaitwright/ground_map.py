"""What is known of the ground: the map that perception makes, and what it is made of."""

import math
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from jaxtyping import Bool, Float

GRIP = 0.8
"""Coefficient of friction of ground of which nothing is known [-]."""


class Sight(NamedTuple):
    """What one look shows of what is too high to step on, seen from above, world x, y [m]."""

    eye: tuple[float, float]
    """From where."""
    pieces: Float[np.ndarray, "n 4"]
    """Pieces of edges: x0, y0, x1, y1, with the ground on their left."""
    corners: Bool[np.ndarray, "n 2"]
    """At each end of a piece, whether free ground was seen beyond it; else range, view or cover ended it."""
    free: Float[np.ndarray, "m 2"]
    """Rim of what was seen to be free: star-shaped around the eye, anticlockwise; the eye may lie on it."""


class Blocked(NamedTuple):
    """Ground on which a foot finds no place to stand, as far as it is known."""

    rim: tuple[tuple[float, float], ...]
    """Where it begins, point by point, world x, y [m]; one point: it is not known how far it goes on."""
    direction: float
    """World direction from where it is come to [rad]."""
    is_seen: bool
    """Whether there was seen to be none; else not all was seen."""


class Moving(NamedTuple):
    """A thing that moves, as far as it is known, seen from above."""

    edge: Float[np.ndarray, "n 2"]
    """Points along what is known of its edge, world [m]."""
    velocity: tuple[float, float]
    """World [m/s]."""
    time: float
    """When it was there [s]."""


class ElevationGrid(NamedTuple):
    """Heights on a grid, as feet and kernels read them (`ground.elevation`); no nodes: nothing is known."""

    place: np.ndarray
    """`(3,)` x, y of the first node, spacing [m]."""
    heights: np.ndarray
    """`(rows, columns)` of the ground [m]; rows along y."""
    edges: np.ndarray
    """`(rows, columns)` 1 where an edge is too near for a foot, else 0."""


@runtime_checkable
class Elevation(Protocol):
    """Heights at places: a scene, or what a robot remembers of one."""

    def height(self, x: Any, y: Any) -> Any:
        """Height of the ground at places x, y [m], arrays of one shape; NaN where it is not known."""
        ...


@dataclass(frozen=True, eq=False)
class GroundMap:
    """What is known of the ground; a known scene is a map that is full from the start.

    Made by `perception`, handed to navigation, skills, gait and control. Never changed: who learns more of
    the ground makes a new one.
    """

    bounds: tuple[float, float, float, float]
    """x_min, y_min, x_max, y_max of the field [m]: robots stay inside."""
    obstacles: tuple[Float[np.ndarray, "_ 2"], ...]
    """Outlines of what is too high to step on, seen from above, world x, y [m]."""
    elevation: Elevation | None
    """For eyes; `None` for a robot that does not look."""
    footholds: ElevationGrid
    """For feet."""
    step: float
    """A sudden rise by more than this is an obstacle [m]."""
    friction: float = GRIP
    """Coefficient of friction that feet count on until they slip [-]."""
    sight: Sight | None = None
    """What the newest look showed; `None` in a map that is full from the start, and before any look."""
    moving: tuple[Moving, ...] = ()
    """What moves: it is in none of the others, but that feet see it where it is."""


@dataclass(frozen=True, slots=True)
class Scan:
    """What is known of the ground ahead, from where the robot is and along its heading (row V3)."""

    slope: float = 0.0
    """Mean slope ahead, uphill positive [rad]."""
    cross: float = 0.0
    """Slope across, rising to the left positive [rad]."""
    roughness: float = 0.0
    """Standard deviation of the ground from that slope [m]; stairs are rough too."""
    step_up: float = 0.0
    """Highest sudden rise from that slope [m]."""
    step_down: float = 0.0
    """Deepest sudden drop from that slope, positive [m]; a gap is none."""
    gap: float = 0.0
    """Widest hole ahead with ground on its other side [m]."""
    obstacle: float = math.inf
    """Distance to the next thing too high to step on [m]."""
    course: float = 0.0
    """World direction of the way ahead [rad]."""
    familiar: bool = False
    """Whether this trip has come along here before."""
    friction: float = GRIP
    """Coefficient of friction of the ground [-]."""
