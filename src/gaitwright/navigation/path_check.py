"""Does what is known now come too near to a path?"""

import math
from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.navigation.piece_grid import is_apart, lines_apart2, point_apart2
from gaitwright.numerics.compiled import kernel

Pieces = Float[np.ndarray, "n _"]


def is_path_cut(
    pieces: Pieces, path: Sequence[tuple[float, float]] | Float[np.ndarray, "m 2"], room: float, deep: float
) -> bool:
    """Whether a piece comes nearer than `room` [m] to a path, and nearer than to its beginning; what is
    nearer than `deep` to the beginning does not count on the first leg."""
    return bool(is_cut(pieces, np.array(path, dtype=float).reshape(-1, 2), room, deep))


def crossed(pieces: Pieces, path: Float[np.ndarray, "m 2"], room: float) -> Bool[np.ndarray, " n"]:
    """Which pieces a path comes nearer to than `room` [m]."""
    return are_near(pieces, path, room)


@kernel
def is_cut(pieces, path, room, deep):
    for p in range(len(pieces)):
        piece = (pieces[p, 0], pieces[p, 1], pieces[p, 2], pieces[p, 3])
        for k in range(max(len(path) - 1, 1)):
            on = min(k + 1, len(path) - 1)
            leg = (path[k, 0], path[k, 1], path[on, 0], path[on, 1])
            if is_apart(leg, piece, room):
                continue
            least = lines_apart2(leg, piece)
            if least < room * room:
                own = math.sqrt(point_apart2(path[0, 0], path[0, 1], piece)) if k == 0 else room
                if own >= deep and math.sqrt(least) < min(room, own - 1e-7):
                    return True
    return False


@kernel
def are_near(pieces, path, room):
    near = np.zeros(len(pieces), np.bool_)
    for p in range(len(pieces)):
        piece = (pieces[p, 0], pieces[p, 1], pieces[p, 2], pieces[p, 3])
        for k in range(len(path) - 1):
            leg = (path[k, 0], path[k, 1], path[k + 1, 0], path[k + 1, 1])
            if not is_apart(leg, piece, room) and lines_apart2(leg, piece) < room * room:
                near[p] = True
    return near
