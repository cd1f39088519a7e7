"""The facts that rules on skills may go by, and the columns that a pupil makes of them."""

from functools import lru_cache

from gaitwright.errors import WrongUse
from gaitwright.induction.columns import SPEED, WAY, Names, Quantity, Vocabulary
from gaitwright.knowledge.memory import NOTED
from gaitwright.skills.situation import (
    DISTANCE,
    DOING,
    EFFORT,
    FOREST,
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
    Quantity("feet down", "share of the feet", said="the share of feet on the ground"),
    *(
        Quantity(f"{side} feet", "share of the feet", said=f"the share of {side} feet on the ground")
        for side in ("front", "hind", "left", "right")
    ),
    Quantity("slope", "°", signed=True, known=(-STEEP, -GENTLE, GENTLE, STEEP), said="the slope ahead"),
    Quantity("roughness", "body heights", "height", known=(SMOOTH,), said="the roughness of the road"),
    Quantity("step up", "body heights", "height", known=(UNEVEN, STEP), said="the highest step up"),
    Quantity("step down", "body heights", "height", known=(UNEVEN, STEP), said="the deepest step down"),
    Quantity("gap", "body heights", "height", known=(GAP,), said="the widest gap"),
    Quantity("remaining", "body lengths", WAY, known=DISTANCE.bounds, said="the way left"),
    Quantity("points left", "points", said="the number of way-points left"),
    Quantity("arrived", said="arrival (1: there, -1: nowhere to go)"),
    Quantity(
        "off the path",
        "°",
        signed=True,
        known=(-130.0, -40.0, -15.0, 15.0, 40.0, 130.0),
        said="the angle to the path",
    ),
    Quantity("wished", "m/s at 0.29 m", SPEED, known=PACE.bounds, said="the wished speed"),
    Quantity("possible", "m/s at 0.29 m", SPEED, known=PACE.bounds, said="the speed asked for now"),
    Quantity("sway", known=STABILITY.bounds, said="its sway"),
    Quantity("obstacle", "body lengths", WAY, known=OBSTACLE.bounds, said="the way to an obstacle"),
    Quantity("effort", "share of the torque", known=EFFORT.bounds, said="the effort of the motors"),
    Quantity("direction", "°", signed=True, said="the direction of the way"),
    Quantity("direction at the start", "°", said="the direction in which the way began"),
    Quantity("direction at the end", "°", said="the direction in which the way ends"),
    Quantity("grip", known=(0.5,), said="the grip of the ground"),
    Quantity("familiar", said="having been here before (1: yes)"),
    Quantity("turning", said="turning already (1: yes)"),
    Quantity("speed", "m/s at 0.29 m", SPEED, known=PACE.bounds, said="its speed"),
    Names("doing", DOING.leaves, {"slow": DOING.leaves_below("slow"), "quick": DOING.leaves_below("quick")}),
)
"""The measured numbers (`situation.measured`) and what the robot has been doing."""

RULE_IN_USE, IN_USE = "rule in use", "in use"
"""The facts of working memory that name the rule that fired last and the skill that is in use."""
KEPT, LONGEST_NOTE = (RULE_IN_USE, IN_USE), 60

FLAGS = {
    "arrived": {1.0: "it had arrived", 0.0: "it were under way", -1.0: "there were nowhere to go"},
    "turning": {1.0: "it were turning already", 0.0: "it were not turning yet"},
    "familiar": {1.0: "it had been here before", 0.0: "it had never been here"},
}
"""Facts that are one of a few numbers, and how a sentence on what is not so speaks of each."""

VOCABULARY = Vocabulary(FACTS)


@lru_cache(maxsize=64)
def vocabulary_with(notes: tuple[str, ...]) -> Vocabulary:
    """The vocabulary of someone who makes notes in working memory: what is measured, and whether each note
    is made."""
    return Vocabulary((*FACTS, *(Names(name, (NOTED,)) for name in notes))) if notes else VOCABULARY


def check_note(name: str) -> None:
    """`WrongUse` where a note cannot be called so."""
    taken = {*VOCABULARY.names, *VOCABULARY.places, *FOREST.names, *KEPT}
    if not name.strip() or not name.isprintable() or len(name) > LONGEST_NOTE:
        raise WrongUse(f"a note has a name of up to {LONGEST_NOTE} letters that can be read, not {name!r}")
    if name in taken or " is " in name or " and " in name or set(name) & set("<>=,"):
        raise WrongUse(f"{name!r} is no name for a note: it is measured, or reads like a condition")
