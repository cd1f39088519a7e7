"""A moment for each line of the scripted teacher's policy."""

from gaitwright.learning.decision_point import DecisionPoint
from gaitwright.skills.situation import READ_FROM, named

EASY = {
    **dict.fromkeys(READ_FROM, 0.0),
    **dict.fromkeys(("feet down", "front feet", "hind feet", "left feet", "right feet"), 1.0),
    "remaining": 20.0,
    "points left": 1.0,
    "possible": 0.6,
    "wished": 0.6,
    "obstacle": 20.0,
    "effort": 0.4,
    "grip": 0.8,
}


def moment(memory=(), **changes) -> DecisionPoint:
    """An easy moment, but for what is named."""
    raw = EASY | {name.replace("_", " "): value for name, value in changes.items()}
    return DecisionPoint(f"{changes}", named(raw), raw, dict(memory))


ROADS = (
    moment(),
    moment(slope=15.0),
    moment(slope=-15.0),
    moment(roughness=0.2),
    moment(off_the_path=90.0),
    moment(off_the_path=25.0),
    moment(off_the_path=-25.0),
    moment(possible=1.3),
    moment(possible=1.9),
    moment(sway=0.5),
    moment(obstacle=0.5),
    moment(possible=0.2),
    moment(arrived=1.0),
)
