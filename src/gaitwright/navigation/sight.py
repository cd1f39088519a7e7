"""What one look around showed, seen from above: the value that a learned map is fed with (row V2)."""

from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float


class Sight(NamedTuple):
    """What one look showed, seen from above, world [m]."""

    eye: tuple[float, float]
    pieces: Float[np.ndarray, "n 4"]
    """x0, y0, x1, y1 of seen edge pieces of obstacles."""
    corners: Bool[np.ndarray, "n 2"]
    """Whether each end is a corner (free ground was seen beyond it); else range, view or occlusion ended it.
    """
    free: Float[np.ndarray, "m 2"]
    """Rim of the star-shaped region around the eye seen to be free (in angular order; the eye itself is first
    if the view is not all round)."""
