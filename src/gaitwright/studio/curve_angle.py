"""Joint angles over the phase of a leg as a curve, and what an edit of one means (thesis 3.2; row S4).

What a robot is told in the first place is where its feet go; joint angles follow by the leg's kinematics, for
servos as for torques, and in the support from the body that goes over a standing foot. So an angle is an
edit of the foot's path: the points are those of the leg cycle, told as angles. Moving hip 2 or knee at
one moves the foot, by forward kinematics in the plane of the leg, and the cycle takes it over; between the
points the foot keeps to its smooth path, and angles to what brings it there.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from gaitwright.gait.leg_cycles.leg_cycle import FEWEST, MOST, NEAREST, LegCycle
from gaitwright.model.kinematics import HINGES
from gaitwright.model.reach import LIMIT_TOLERANCE
from gaitwright.studio.curve_checks import Refusal, Rows, numbers_in
from gaitwright.studio.curve_cycle import DRAWN, CycleCurve
from gaitwright.studio.curve_walk import Walk

MOVED = 1e-5
"""A joint that is moved by less [rad] is not."""
ASIDE = 0.5
"""A foot that is moved out of the plane of its path by more than this share of its way leaves it."""


@dataclass(frozen=True)
class AngleCurve:
    """Points (own phase of the leg, hip 1, hip 2, knee [rad]), one for each point of the leg cycle."""

    walk: Walk
    cycle: LegCycle
    leg: int

    @property
    def as_path(self) -> CycleCurve:
        """The same as the path of the foot."""
        return CycleCurve(self.walk, self.cycle, self.leg)

    @property
    def points(self) -> list[list[float]]:
        s, forward, height = np.array(self.as_path.points).T
        duty = self.walk.gait.duty
        seen = np.stack([forward - (1.0 - duty) * (s - 0.5), height], axis=1)
        own = duty + (1.0 - duty) * s
        return np.column_stack([own, self.walk.angles(self.leg, seen)]).tolist()

    def line(self) -> list[list[float]]:
        """Own phase and the three angles over a whole cycle, from touch-down on."""
        own = np.linspace(0.0, 1.0, DRAWN + 1)
        path = self.walk.path(self.cycle, self.leg, own)
        return np.column_stack([own, self.walk.angles(self.leg, path)]).tolist()

    def limits(self) -> dict[str, Any]:
        """What a point has to keep to."""
        robot, duty = self.walk.robot, self.walk.gait.duty
        return {
            "columns": ["phase", *HINGES],
            "units": ["", "rad", "rad", "rad"],
            "lower": [duty, *robot.q_min[self.leg].tolist()],
            "upper": [1.0, *robot.q_max[self.leg].tolist()],
            "fewest": FEWEST,
            "most": MOST,
            "nearest": NEAREST * (1.0 - duty),
            "fixed": [1, len(self.points)],
            "periodic": False,
        }

    def edited(self, points: Rows, mirror: bool) -> LegCycle | Refusal:
        """The leg cycle whose points have these angles."""
        rows = numbers_in(points, 4, FEWEST, MOST)
        if isinstance(rows, Refusal):
            return rows
        over = self.beyond_joints(rows)
        if over:
            return over
        duty, path = self.walk.gait.duty, []
        known = {
            round(point[0], 9): place for point, place in zip(self.points, self.as_path.points, strict=True)
        }
        usual = {round(point[0], 9): np.array(point[1:]) for point in self.points}
        for number, row in enumerate(rows, start=1):
            own = round(float(row[0]), 9)
            if own in known and np.abs(row[1:] - usual[own]).max() < MOVED:
                path.append(known[own])  # to the bit as it was
                continue
            if number in (1, len(rows)):
                what = "leaves" if number == 1 else "meets"
                because = (
                    f"where the foot {what} the ground its joints follow from the body: it stays as it is"
                )
                return Refusal(f"point {number}: {because}", number)
            place = self.placed(row, (own - duty) / (1.0 - duty))
            if place is None:
                because = "that moves the foot out of the plane of its path, which goes along its way and up"
                return Refusal(f"point {number}: {because}", number)
            path.append(place)
        return self.as_path.edited(path, mirror)

    def placed(self, row: np.ndarray, s: float) -> list[float] | None:
        """The point of the leg cycle at share `s` where a row of angles brings the foot; `None`: it is moved
        aside."""
        walk = self.walk
        own = np.array([min(max(row[0], 0.0), 1.0)])
        before = walk.path(self.cycle, self.leg, own)
        was, now = walk.feet(self.leg, np.stack([walk.angles(self.leg, before)[0], row[1:]]))
        (x, y, _), (along, across) = now - was, walk.way
        if abs(along * y - across * x) > ASIDE * float(np.linalg.norm(now - was)):
            return None
        forward = float(now[:2] @ walk.way) / walk.stride if walk.stride else float(before[0, 0])
        return [s, forward + (1.0 - walk.gait.duty) * (s - 0.5), float(now[2]) / walk.robot.height]

    def beyond_joints(self, rows: np.ndarray) -> Refusal | None:
        """The angle that is farthest beyond its joint's limit."""
        low, high = self.walk.robot.q_min[self.leg], self.walk.robot.q_max[self.leg]
        over = np.maximum(low - rows[:, 1:], rows[:, 1:] - high)
        if over.max() <= LIMIT_TOLERANCE:
            return None
        i, joint = np.unravel_index(int(over.argmax()), over.shape)
        angle, leg = rows[i, 1 + joint], self.walk.robot.legs[self.leg]
        where = f"point {i + 1}, leg {leg}: {HINGES[joint]} would stand at {angle:.3g} rad"
        return Refusal(f"{where}; its limits are {low[joint]:.3g} to {high[joint]:.3g} rad", int(i) + 1)
