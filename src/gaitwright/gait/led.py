"""A `MotionTarget` whose joint angles are worked out when somebody asks for them.

Who plays profiles pulls the legs to where their feet should be and never reads the angles, which take a sixth
of the coordination: six arc tangents a leg.
"""

from dataclasses import dataclass
from typing import Any

from gaitwright.gait.coordinator import write_angles
from gaitwright.model.robot import Robot
from gaitwright.numerics.packing import Packed
from gaitwright.signals import MotionTarget


@dataclass(frozen=True, slots=True)
class Led(MotionTarget):
    """As `lead` wrote it: in its row the angles are no numbers."""

    robot: Robot

    def __getattr__(self, name: str) -> Any:
        """A field whose view was not made yet; the angles, as the coordinator would have written them."""
        if name != "q":
            return Packed.__getattr__(self, name)
        whole = self.row.copy()
        write_angles(self.robot.packed, whole)
        q = MotionTarget.of_row(whole).q
        object.__setattr__(self, "q", q)
        return q
