"""The depth camera that a robot carries: where it sits, what it sees, how far its ranges are off (row V2).

Camera axes are x along the optical axis, y left, z up; rays go through the middles of pixels (a pinhole).
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float

from gaitwright.errors import WrongUse
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import about_axis

MAST = 0.65
"""Height of the camera over the base origin, in body heights: on a short mast, it sees its own feet's next
step over the trunk's front end."""
TILT = 0.6
"""Down from level [rad]: the lowest ray meets the ground before the front feet, the highest nearly at the
horizon."""
ACROSS, UPRIGHT = math.radians(90.0), math.radians(67.5)
"""Fields of view [rad]."""
REACH = 11.0
"""How far it sees, in body heights: 3.3 m for a Go2, as far as its chips with active light are good for."""
MOST_PIXELS = 1_000_000
"""Nobody needs more, and they would have to be cast one by one."""


@dataclass(frozen=True)
class Camera:
    """Settings of a depth camera. Raises `WrongUse` for a field that makes no sense."""

    mount: tuple[float, float, float]
    """Its eye, base axes [m]."""
    tilt: float = TILT
    """Of its optical axis, down from the base's x axis [rad]."""
    across: float = ACROSS
    upright: float = UPRIGHT
    """Fields of view from rim to rim, along rows and along columns [rad]."""
    rows: int = 48
    columns: int = 64
    """Pixels."""
    range: float = 3.0
    """Farther things send nothing back [m]."""
    rate: float = 10.0
    """Frames per second [Hz]."""
    noise: float = 0.0
    """Standard deviation of a range near by [m]."""
    noise_growth: float = 0.0
    """What is added to it, times the square of the range [1/m]: so stereo and active light go."""
    dropouts: float = 0.0
    """Share of the rays of which nothing comes back, by chance [-]."""

    def __post_init__(self) -> None:
        numbers = (*self.mount, self.tilt, self.range, self.rate, self.noise, self.noise_growth)
        if not all(math.isfinite(number) for number in numbers):
            raise WrongUse(f"a camera's numbers are finite, not {numbers}")
        if not (0.0 < self.across < math.pi and 0.0 < self.upright < math.pi):
            raise WrongUse(
                f"a camera sees between 0 and 180 degrees, not {math.degrees(self.across):g} by "
                f"{math.degrees(self.upright):g}"
            )
        if min(self.rows, self.columns) < 1 or self.rows * self.columns > MOST_PIXELS:
            raise WrongUse(f"a camera has 1 to {MOST_PIXELS} pixels, not {self.rows} by {self.columns}")
        if min(self.range, self.rate) <= 0.0 or min(self.noise, self.noise_growth) < 0.0:
            raise WrongUse(
                f"a camera's range and rate are positive and its noise is not negative: {self.range:g} m, "
                f"{self.rate:g} Hz, {self.noise:g} m, {self.noise_growth:g} /m"
            )
        if not 0.0 <= self.dropouts <= 1.0:
            raise WrongUse(f"drop-outs are a share from 0 to 1, not {self.dropouts:g}")

    @classmethod
    def for_robot(cls, robot: Robot) -> "Camera":
        """One on the back of a robot, at the front end of its trunk, as big as the robot is."""
        centre, half = robot.trunk
        top = float(centre[2] + half[2])
        mount = (float(centre[0] + half[0]), 0.0, max(top, MAST * robot.height))
        return cls(mount, range=REACH * robot.height)

    @property
    def pixels(self) -> tuple[int, int]:
        """Rows and columns of a frame."""
        return self.rows, self.columns

    def spread(self, ranges: Float[np.ndarray, "..."]) -> Float[np.ndarray, "..."]:
        """Standard deviation of ranges [m]."""
        return self.noise + self.noise_growth * ranges * ranges

    @cached_property
    def axes(self) -> Float[np.ndarray, "3 3"]:
        """Rotation that takes camera components to base components."""
        return about_axis(1, self.tilt)

    @cached_property
    def lens(self) -> tuple[float, float, float]:
        """Half the width and height of what it sees at a distance of one metre, and its range [m]."""
        return math.tan(self.across / 2), math.tan(self.upright / 2), self.range

    @cached_property
    def rays_c(self) -> Float[np.ndarray, "pixels 3"]:
        """Unit directions of the rays, camera axes; row by row from above, each from left to right."""
        y = self.lens[0] * (1.0 - (2.0 * np.arange(self.columns) + 1.0) / self.columns)
        z = self.lens[1] * (1.0 - (2.0 * np.arange(self.rows) + 1.0) / self.rows)
        wide, high = np.meshgrid(y, z)
        rays = np.column_stack([np.ones(wide.size), wide.ravel(), high.ravel()])
        return rays / np.linalg.norm(rays, axis=1, keepdims=True)

    @cached_property
    def rays(self) -> Float[np.ndarray, "pixels 3"]:
        """The same, base axes."""
        return np.ascontiguousarray(self.rays_c @ self.axes.T)

    def eye(
        self, position_w: Float[np.ndarray, "3"], rotation_wb: Float[np.ndarray, "3 3"]
    ) -> Float[np.ndarray, "3"]:
        """Where it looks from when the base is at `position_w`, turned by `rotation_wb`, world [m]."""
        return position_w + rotation_wb @ np.array(self.mount)
