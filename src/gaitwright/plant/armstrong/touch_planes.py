"""Scene → the planes that feet may touch in the next control period.

A kernel cannot ask a `Scene`; a plane it can. Boxes are felt from all sides; of holes and of all other shapes
feet touch the plane of the ground below their middle.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float

from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Box, Surface
from gaitwright.plant.armstrong.contact import NOWHERE, SLOTS

LOOKED_AT = 4
"""Nearest boxes among which those are found that have a plane of their own."""
FLUSH = 1e-6
"""A point this near to a plane is in it [m]."""


@dataclass(frozen=True)
class Ground:
    """A scene's surface, its shapes in it, and its boxes, one row each."""

    surface: Surface
    boxes: Float[np.ndarray, "boxes 7"]
    """Middle of the top x, y, z; cosine and sine of the yaw; half lengths of the sides."""

    @classmethod
    def of(cls, scene: Scene) -> "Ground":
        """The ground of a scene."""
        boxes = [*scene.boxes, *(thing for thing in scene.things if isinstance(thing, Box))]
        rows = [(b.x, b.y, scene.top(b), np.cos(b.yaw), np.sin(b.yaw), b.lx / 2, b.ly / 2) for b in boxes]
        others = tuple(thing for thing in scene.things if not isinstance(thing, Box))
        shaped = scene.shapes or others
        surface = replace(scene, boxes=(), things=others) if shaped else scene.surface
        return cls(surface, np.array(rows, dtype=float).reshape(-1, 7))

    def planes(self, centre: Float[np.ndarray, "feet 3"]) -> Float[np.ndarray, "slots 6"]:
        """Point and normal of the planes, `SLOTS` per foot, for feet with these centres."""
        centre = np.nan_to_num(centre)
        out = np.empty((len(centre), SLOTS, 6))
        out[:] = 0.0, 0.0, NOWHERE, 0.0, 0.0, 1.0
        x, y = centre[:, 0], centre[:, 1]
        out[:, 0, :2] = centre[:, :2]
        out[:, 0, 2] = self.surface.height(x, y)
        out[:, 0, 3:] = self.surface.normal(x, y)
        if len(self.boxes):
            self._write_boxes(centre, out)
        return out.reshape(-1, 6)

    def _write_boxes(
        self, centre: Float[np.ndarray, "feet 3"], out: Float[np.ndarray, "feet slots 6"]
    ) -> None:
        """Writes the planes through the nearest points of the nearest boxes, square to the way there.

        Boxes reach down without end: what they stand on hides their bottoms. Where a box's nearest point
        is in an earlier plane, as on the other side of a seam, that plane holds the foot already.
        """
        x, y, z, c, s, half_x, half_y = self.boxes.T
        dx, dy = centre[:, :1] - x, centre[:, 1:2] - y
        at = np.stack([c * dx + s * dy, c * dy - s * dx, centre[:, 2:] - z], axis=2)
        low = np.stack([-half_x, -half_y, np.full_like(z, -np.inf)], axis=1)
        nearest = np.clip(at, low, np.stack([half_x, half_y, np.zeros_like(z)], axis=1))
        distance = np.linalg.norm(at - nearest, axis=2)
        # Inside, the nearest point is on the nearest face: a side, or the top.
        room = np.concatenate([self.boxes[:, 5:] - np.abs(at[..., :2]), -at[..., 2:]], axis=2)
        distance = np.where(distance == 0.0, -room.min(axis=2), distance)
        for f, order in enumerate(distance.argsort(axis=1)):
            slot = 1
            for box in order[:LOOKED_AT]:
                place, point = at[f, box], nearest[f, box]
                normal = place - point
                if distance[f, box] <= 0.0:
                    normal, depth = nearest_face(place, room[f, box])
                    point = place + depth * normal
                turn = np.array([[c[box], -s[box], 0.0], [s[box], c[box], 0.0], [0.0, 0.0, 1.0]])
                touched = self.boxes[box, :3] + turn @ point
                if slot < SLOTS and not in_a_plane(touched, out[f, :slot]):
                    out[f, slot, :3], out[f, slot, 3:] = touched, turn @ normal / np.linalg.norm(normal)
                    slot += 1


def in_a_plane(point: Float[np.ndarray, "3"], planes: Float[np.ndarray, "planes 6"]) -> bool:
    """Whether a point is in one of some planes, given by point and normal."""
    off = ((point - planes[:, :3]) * planes[:, 3:]).sum(axis=1)
    return bool(np.abs(off).min() < FLUSH)


def nearest_face(
    place: Float[np.ndarray, "3"], room: Float[np.ndarray, "3"]
) -> tuple[Float[np.ndarray, "3"], float]:
    """Normal of the face of a box that is nearest to a place in it, and how far it is [m].

    `room`: from the place to the nearer side along x and y, and to the top.
    """
    face = int(room.argmin())
    normal = np.zeros(3)
    normal[face] = 1.0 if face == 2 or place[face] >= 0.0 else -1.0
    return normal, float(room[face])
