"""One thing on level ground before a robot: what recognising is tried on."""

import math
from collections.abc import Callable

import numpy as np

from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Box, Flat, HeightField

GRID = 0.01
"""Spacing of the height field that holds what is no box [m]."""
HALF = 4.0
"""Half the side of the field [m]."""

Heights = Callable[[np.ndarray, np.ndarray, dict[str, float]], np.ndarray]


def cylinder(u: np.ndarray, v: np.ndarray, of: dict[str, float]) -> np.ndarray:
    return np.where(u**2 + v**2 <= of["radius"] ** 2, of["height"], 0.0)


def sphere(u: np.ndarray, v: np.ndarray, of: dict[str, float]) -> np.ndarray:
    """Half of one."""
    return np.sqrt(np.clip(of["radius"] ** 2 - u**2 - v**2, 0.0, None))


def pyramid(u: np.ndarray, v: np.ndarray, of: dict[str, float]) -> np.ndarray:
    """Four planes that rise from its sides."""
    faces = [1.0 - 2.0 * side * at / of[length] for at, length in ((u, "lx"), (v, "ly")) for side in (1, -1)]
    return of["height"] * np.clip(np.min(faces, axis=0), 0.0, None)


def wedge(u: np.ndarray, v: np.ndarray, of: dict[str, float]) -> np.ndarray:
    """Rises along its side lx."""
    on_it = (2.0 * np.abs(u) <= of["lx"]) & (2.0 * np.abs(v) <= of["ly"])
    return np.where(on_it, of["height"] * (u / of["lx"] + 0.5), 0.0)


FIELDS: dict[str, Heights] = {"cylinder": cylinder, "sphere": sphere, "pyramid": pyramid, "wedge": wedge}
KINDS = ("box", *FIELDS)


def lone(kind: str, seed: int) -> tuple[Scene, dict[str, float]]:
    """A scene with one thing of a kind about 1.3 m along x, and its true numbers."""
    rng = np.random.default_rng(seed)
    of = {"x": 1.3 + rng.uniform(-0.1, 0.1), "y": rng.uniform(-0.3, 0.3), "yaw": rng.uniform(-3.0, 3.0)}
    of |= {"lx": rng.uniform(0.25, 0.5), "ly": rng.uniform(0.25, 0.5), "height": rng.uniform(0.1, 0.35)}
    of["radius"] = rng.uniform(0.15, 0.25)
    bounds = (-HALF, -HALF, HALF, HALF)
    if kind == "box":
        box = Box(of["x"], of["y"], of["yaw"], of["lx"], of["ly"], of["height"])
        return Scene(kind, Flat(), (box,), bounds), of
    if kind == "sphere":
        of["height"] = of["radius"]
    x = np.arange(-HALF, HALF + 0.5 * GRID, GRID)
    dx, dy = x[None, :] - of["x"], x[:, None] - of["y"]
    c, s = math.cos(of["yaw"]), math.sin(of["yaw"])
    heights = FIELDS[kind](c * dx + s * dy, c * dy - s * dx, of)
    return Scene(kind, HeightField(-HALF, -HALF, GRID, heights), (), bounds), of
