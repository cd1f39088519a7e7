"""The foot of a leg: the sphere with which its last link meets the ground."""

import re
from collections.abc import Sequence
from typing import NamedTuple

import mujoco
import numpy as np

from gaitwright.errors import BadFile

FOOT_WORD = re.compile(r"foot|toe|sole|tip|contact|(^|_)ee($|_)", re.IGNORECASE)
NEARLY = 0.9
"""A round end this close to the farthest point of the link, per distance, is the foot."""
LOWEST = 0.05
"""Points this close to the lowest one, per length of the shank, tell the width of a foot without a sphere."""
RADIUS_RANGE = (0.02, 0.12)
"""Radius of an estimated foot, per length of the shank."""

AXIS = np.array([0.0, 0.0, 1.0])
"""The axis of a capsule or cylinder in its own frame."""


class NoFoot(BadFile):
    """A leg ends in nothing that could be its foot: none of these links, fixed to one another, has one."""

    def __init__(self, sentence: str, links: Sequence[str]):
        super().__init__(sentence)
        self.links = links


class Foot(NamedTuple):
    """A spherical foot, world frame [m]; `points` are the surface it was guessed from, else empty."""

    centre: np.ndarray
    radius: float
    reach: float
    """Distance of its far side from the knee [m]."""
    points: np.ndarray


def find_foot(m: mujoco.MjModel, d: mujoco.MjData, bodies: np.ndarray, knee: np.ndarray) -> Foot | None:
    """The foot among the shapes and names fixed to the last link; `knee` is its hinge, world frame [m].

    A sphere, a capsule's end or a wheel-like cylinder is taken as it is; any other shape gives its
    farthest point, to be refined by `lowest` once the leg's posture is known.
    """
    shapes = [foot for geom in solid(m, bodies) for foot in ends(m, d, geom, knee)]
    named = named_foot(m, d, bodies, knee)
    if not shapes:
        return named
    far = max(shapes, key=lambda foot: foot.reach)
    rounds = [foot for foot in shapes if not len(foot.points) and foot.reach >= NEARLY * far.reach]
    if rounds:
        return max(rounds, key=lambda foot: foot.reach)
    if named is not None and named.reach >= NEARLY * far.reach:
        length = float(np.linalg.norm(named.centre - knee))
        return named._replace(radius=clipped(far.reach - length, length))
    return far


def lowest(foot: Foot, down: np.ndarray, across: np.ndarray, length: float) -> Foot:
    """A foot guessed from a surface, as the sphere that touches the ground where the surface does.

    `down` is the direction of the ground and `across` that of the knee's axis in the nominal posture
    (unit, world frame of the model); `length` is the shank's [m].
    """
    if not len(foot.points):
        return foot
    depth = foot.points @ down
    touching = foot.points[depth >= depth.max() - LOWEST * length]
    radius = clipped(0.5 * float(np.ptp(touching @ across)), length)
    middle = 0.5 * (touching.min(axis=0) + touching.max(axis=0))
    return foot._replace(centre=middle + (depth.max() - radius - middle @ down) * down, radius=radius)


def clipped(radius: float, length: float) -> float:
    """A guessed radius kept to what feet look like on a shank of that length [m]."""
    return float(np.clip(radius, RADIUS_RANGE[0] * length, RADIUS_RANGE[1] * length))


def solid(m: mujoco.MjModel, bodies: np.ndarray) -> list[int]:
    """Shapes of the bodies that can touch something; where none can, all of them."""
    geoms = [g for g in range(m.ngeom) if m.geom_bodyid[g] in bodies]
    touching = [g for g in geoms if m.geom_contype[g] or m.geom_conaffinity[g]]
    return touching or geoms


def ends(m: mujoco.MjModel, d: mujoco.MjData, geom: int, knee: np.ndarray) -> list[Foot]:
    """What of one shape may be a foot."""
    centre, axes, size = d.geom_xpos[geom], d.geom_xmat[geom].reshape(3, 3), m.geom_size[geom]
    kind = m.geom_type[geom]
    if kind == mujoco.mjtGeom.mjGEOM_SPHERE:
        return [round_end(centre, size[0], knee)]
    if kind == mujoco.mjtGeom.mjGEOM_CAPSULE:
        return [round_end(centre + side * size[1] * axes[:, 2], size[0], knee) for side in (-1.0, 1.0)]
    if kind == mujoco.mjtGeom.mjGEOM_CYLINDER and size[1] < size[0]:
        return [round_end(centre, size[0], knee)]
    points = surface(m, geom)
    if not len(points):
        return []
    points = centre + points @ axes.T
    far = points[np.argmax(np.linalg.norm(points - knee, axis=1))]
    return [Foot(far, 0.0, float(np.linalg.norm(far - knee)), points)]


def round_end(centre: np.ndarray, radius: float, knee: np.ndarray) -> Foot:
    """A sphere as a foot."""
    return Foot(centre.copy(), float(radius), float(np.linalg.norm(centre - knee) + radius), np.empty((0, 3)))


def surface(m: mujoco.MjModel, geom: int) -> np.ndarray:
    """Points on the surface of a shape, in its own frame [m]; none for a plane or a height field."""
    size, kind = m.geom_size[geom], m.geom_type[geom]
    if kind == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = m.geom_dataid[geom]
        return m.mesh_vert[m.mesh_vertadr[mesh] :][: m.mesh_vertnum[mesh]].astype(float)
    if kind == mujoco.mjtGeom.mjGEOM_BOX:
        return np.array(np.meshgrid(*[(-1.0, 1.0)] * 3)).reshape(3, 8).T * size
    turn = np.linspace(0.0, 2.0 * np.pi, 32, endpoint=False)
    rim = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(32)])
    if kind == mujoco.mjtGeom.mjGEOM_CYLINDER:
        radius, half = size[:2]
        return np.concatenate([radius * rim + end * AXIS for end in (-half, half)])
    if kind == mujoco.mjtGeom.mjGEOM_ELLIPSOID:
        return np.concatenate([rim, rim[:, [0, 2, 1]], rim[:, [2, 0, 1]]]) * size
    return np.empty((0, 3))


def named_foot(m: mujoco.MjModel, d: mujoco.MjData, bodies: np.ndarray, knee: np.ndarray) -> Foot | None:
    """A fixed body or a site called a foot; else the outermost fixed body; `None` where there is neither."""
    fixed = [(m.body(b).name, d.xpos[b]) for b in bodies if m.body_jntnum[b] == 0]
    sites = [(m.site(s).name, d.site_xpos[s]) for s in range(m.nsite) if m.site_bodyid[s] in bodies]
    called = [place for name, place in fixed + sites if FOOT_WORD.search(name)]
    places = called or [place for _, place in fixed]
    if not places:
        return None
    far = max(places, key=lambda place: float(np.linalg.norm(place - knee)))
    length = float(np.linalg.norm(far - knee))
    return round_end(far, clipped(0.0, length), knee) if length > 0.0 else None


def required(foot: Foot | None, leg: str, links: Sequence[str]) -> Foot:
    """The foot, or a `NoFoot` that says what would have been one; `links` are those of the leg's end."""
    if foot is None:
        raise NoFoot(
            f"leg {leg} has no foot: expected a collision shape, or a fixed body or site "
            "with 'foot' in its name, on its last link",
            links,
        )
    return foot
