"""Where the ground has a friction of its own: ice, sand, a mat."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from gaitwright.ground.outlines import Outline
from gaitwright.ground.relief import Relief
from gaitwright.ground.solids import Prism


@dataclass(frozen=True)
class Patch:
    """A part of the ground with its own friction, and what stands on it too."""

    outline: Outline
    """Its corners, anticlockwise, world [m]."""
    friction: float
    """Coefficient [-]."""

    def corners(self) -> Float[np.ndarray, "corners 2"]:
        """Corners of its outline, anticlockwise, world [m]."""
        return np.array(self.outline)


def sorted_patches(patches: Sequence[Patch]) -> Relief:
    """Patches as blocks as high as their number, from 1: the last one lies on top."""
    blocks = [Prism(patch.outline, float(k)) for k, patch in enumerate(patches, 1)]
    return Relief.of(blocks, [0.0] * len(blocks))
