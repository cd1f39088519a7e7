"""The facts that rules on skills may go by, and the columns that a pupil makes of them."""

from gaitwright.induction.columns import SPEED, WAY, Names, Quantity, Vocabulary
from gaitwright.skills.situation import (
    DISTANCE,
    DOING,
    EFFORT,
    GAP,
    GENTLE,
    OBSTACLE,
    PACE,
    SMOOTH,
    STABILITY,
    STEEP,
    STEP,
    UNEVEN,
)

FACTS = (
    Quantity("feet down", "share of the feet"),
    Quantity("slope", "°", signed=True, known=(-STEEP, -GENTLE, GENTLE, STEEP)),
    Quantity("roughness", "body heights", "height", known=(SMOOTH,)),
    Quantity("step up", "body heights", "height", known=(UNEVEN, STEP)),
    Quantity("step down", "body heights", "height", known=(UNEVEN, STEP)),
    Quantity("gap", "body heights", "height", known=(GAP,)),
    Quantity("remaining", "body lengths", WAY, known=DISTANCE.bounds),
    Quantity("points left", "points"),
    Quantity("arrived"),
    Quantity("off the path", "°", signed=True, known=(-130.0, -40.0, -15.0, 15.0, 40.0, 130.0)),
    Quantity("wished", "m/s at 0.29 m", SPEED, known=PACE.bounds),
    Quantity("possible", "m/s at 0.29 m", SPEED, known=PACE.bounds),
    Quantity("sway", known=STABILITY.bounds),
    Quantity("obstacle", "body lengths", WAY, known=OBSTACLE.bounds),
    Quantity("effort", "share of the torque", known=EFFORT.bounds),
    Quantity("direction", "°", signed=True),
    Quantity("familiar"),
    Quantity("turning"),
    Quantity("speed", "m/s at 0.29 m", SPEED, known=PACE.bounds),
    Names("doing", DOING.leaves, {"slow": DOING.leaves_below("slow"), "quick": DOING.leaves_below("quick")}),
)
"""The measured numbers (`situation.measured`) and what the robot has been doing."""

VOCABULARY = Vocabulary(FACTS)
