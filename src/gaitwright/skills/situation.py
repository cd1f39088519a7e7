"""Numbers → Situation: where the robot stands among the features that rules tell apart (§5.4.2.1).

`named` names the leaf of each tree that the numbers of `skills.measured` fall into. Nothing else looks at the
world for the rules: a new feature is one tree here, and one number where none has it yet. A rulebook that was
made before knows nothing of it and is indifferent to it (`book_trees.up_to_date`).
"""

import math
from collections.abc import Callable, Mapping

from gaitwright.knowledge.forest import Forest, Situation
from gaitwright.knowledge.memory import Fact
from gaitwright.knowledge.trees import FeatureTree, interval_tree, tree
from gaitwright.signals import SkillCall
from gaitwright.skills.chooser import KEEP_TURNING, TURN_FIRST
from gaitwright.skills.library import LIBRARY, OTHER_NAMES

GAP, STEP, STEEP, GENTLE, SMOOTH, UNEVEN = 0.1, 0.14, 8.0, 3.0, 0.03, 0.06
"""Where names of the road begin: gap and step [body heights], steep and gentle slope [°], roughness and small
steps of rough ground [body heights]."""

SUPPORT = tree(
    "support",
    {
        "planted": ("all feet down", "most feet down"),
        "light": ("half the feet down", "few down", "in flight"),
    },
    about="on the ground are",
)
LEGS = tree(
    "leg setting",
    {
        "on all sides": ("all feet", "feet across"),
        "on one side": ("front feet", "hind feet", "left feet", "right feet"),
        "no feet": (),
    },
    about="the feet that are down are",
)
ROAD = tree(
    "road",
    {
        "easy": ("flat", "gently uphill", "gently downhill"),
        "up": ("steep uphill", "stairs up"),
        "down": ("steep downhill", "stairs down"),
        "broken": ("rough", "gap"),
    },
    about="the road is",
)
DISTANCE = interval_tree(
    "distance",
    "body lengths",
    (1.0, 3.0, 10.0),
    ("at hand", "near", "some way", "far"),
    about="the way left is",
)
GOAL = tree(
    "goal",
    {"nothing to do": ("no goal", "arrived"), "under way": ("way-point ahead", "goal ahead", "goal near")},
    about="the mission has",
)
TURN = tree(
    "turn",
    {
        "ahead": ("straight on", "left", "right"),
        "off the way": ("sharp left", "sharp right", "behind"),
    },
    about="the path goes",
)
PACE = interval_tree(
    "pace",
    "m/s at 0.29 m",
    (0.15, 0.3, 1.0, 1.6),
    {"slow": ("crawling", "walking pace"), "trotting pace": (), "fast": ("running pace", "racing pace")},
    about="the speed asked for now is a",
)
STABILITY = interval_tree(
    "stability", "", (0.15, 0.3), {"under control": ("steady", "swaying"), "stumbling": ()}, about="it is"
)
OBSTACLE = interval_tree(
    "obstacle",
    "body lengths",
    (1.0, 3.0),
    {"close": (), "clear": ("near", "far or none")},
    about="an obstacle is",
)
EFFORT = interval_tree(
    "effort", "", (0.25, 0.6), {"lightly": (), "hard": ("normally", "heavily")}, about="the motors work"
)
STREETS = {"east-west": ("east", "west"), "north-south": ("north", "south")}
STREET = tree("street", STREETS, about="the way leads")
INITIAL = tree("initial location", STREETS, about="the way began")
FINAL = tree("final location", STREETS, about="the way ends")
PATH = tree("path", ("unknown", "travelled before"), about="the path is")
DOING = tree(
    "doing",
    {"slow": ("standing", "turning", "walking"), "quick": ("trotting", "flying")},
    about="it has been",
)

FOREST = Forest(
    (
        *(SUPPORT, LEGS, ROAD, DISTANCE, GOAL, TURN, PACE, STABILITY, OBSTACLE, EFFORT),
        *(STREET, INITIAL, FINAL, PATH, DOING),
    )
)
"""The situation space: what the trees of the thesis's experimental system say, and what a robot of today can
measure beside it. Its four trees of a leg's place in the cycle are one here, for any number of legs."""

READ_FROM = {
    "feet down": "support",
    "front feet": "leg setting",
    "hind feet": "leg setting",
    "left feet": "leg setting",
    "right feet": "leg setting",
    "slope": "road",
    "roughness": "road",
    "step up": "road",
    "step down": "road",
    "gap": "road",
    "remaining": "distance",
    "points left": "goal",
    "arrived": "goal",
    "off the path": "turn",
    "wished": "pace",
    "possible": "pace",
    "sway": "stability",
    "obstacle": "obstacle",
    "effort": "effort",
    "direction": "street",
    "direction at the start": "initial location",
    "direction at the end": "final location",
    "familiar": "path",
    "speed": "doing",
    "turning": "doing",
}
"""The tree in which each measured number is read."""

NUMBER_OF = {"distance": "remaining", "pace": "possible", "stability": "sway"}
"""The number that a tree of intervals reads, where the tree is not called like it and names no source."""


def named(raw: Mapping[str, float], call: SkillCall | None = None) -> Situation:
    """The situation that measured numbers describe."""
    return Situation(FOREST.names, tuple(leaf_named(tree, raw, call) for tree in FOREST.trees))


def situation_of(facts: Mapping[str, Fact]) -> Situation:
    """The situation that facts describe, numbers and what the robot has been doing; a tree whose facts were
    not measured is open."""
    numbers = {name: fact for name, fact in facts.items() if not isinstance(fact, str)}
    known: dict[str, str | None] = {}
    for feature in FOREST.trees:
        try:
            known[feature.name] = leaf_named(feature, numbers, None)
        except KeyError:
            known[feature.name] = None
    return FOREST.read({**known, "doing": str(facts["doing"])} if "doing" in facts else known, {})


def leaf_named(tree: FeatureTree, raw: Mapping[str, float], call: SkillCall | None) -> str:
    """The leaf of one tree, by its own rule or by the interval that its number is in."""
    if tree.name in NAMED_BY:
        return NAMED_BY[tree.name](raw, call)
    return tree.leaf_of(raw[NUMBER_OF.get(tree.name, tree.source or tree.name)])


# --- names -----------------------------------------------------------------------------------------
def support_of(down: float) -> str:
    """How many of the feet carry load, by their share."""
    bounds = (
        (1.0, "all feet down"),
        (0.51, "most feet down"),
        (0.49, "half the feet down"),
        (0.01, "few down"),
    )
    return next((name for least, name in bounds if down >= least), "in flight")


def setting_of(raw: Mapping[str, float]) -> str:
    """On which side the feet are that carry load, by the shares of those in front, behind, left and right."""
    shares = {name: raw[name] for name in ("front feet", "hind feet", "left feet", "right feet")}
    if min(shares.values()) == 1.0:
        return "all feet"
    if max(shares.values()) == 0.0:
        return "no feet"
    opposite = zip(shares, ("hind feet", "front feet", "right feet", "left feet"), strict=True)
    return next((side for side, other in opposite if shares[other] == 0.0), "feet across")


def road_of(raw: Mapping[str, float]) -> str:
    """What the road ahead is, the hardest part of it first."""
    slope, up, down = raw["slope"], raw["step up"], raw["step down"]
    if raw["gap"] > GAP:
        return "gap"
    if max(up, down) > STEP:
        return "stairs up" if up > down else "stairs down"
    if abs(slope) > STEEP:
        return "steep uphill" if slope > 0.0 else "steep downhill"
    if raw["roughness"] > SMOOTH or max(up, down) > UNEVEN:
        return "rough"
    if abs(slope) > GENTLE:
        return "gently uphill" if slope > 0.0 else "gently downhill"
    return "flat"


def goal_of(raw: Mapping[str, float]) -> str:
    """How far the mission is."""
    if raw["arrived"]:
        return "arrived" if raw["arrived"] > 0.0 else "no goal"
    if raw["points left"] > 1.0:
        return "way-point ahead"
    return "goal near" if raw["remaining"] < DISTANCE.bounds[1] else "goal ahead"


def turn_of(degrees: float) -> str:
    """Where the path goes from the robot's nose."""
    off = math.radians(abs(degrees))
    if off > math.radians(130.0):
        return "behind"
    side = "left" if degrees > 0.0 else "right"
    if off > TURN_FIRST:
        return f"sharp {side}"
    return side if off > KEEP_TURNING else "straight on"


def street_of(degrees: float) -> str:
    """The quarter of the compass in which a direction lies; east is along x."""
    return ("east", "north", "west", "south")[round(degrees / 90.0) % 4]


def doing_of(call: SkillCall | None) -> str:
    """What kind of motion a skill is; a skill that is not known here, in an older recording, is none."""
    skill = None if call is None else LIBRARY.get(OTHER_NAMES.get(call.skill, call.skill))
    if skill is None or skill.duty >= 1.0:
        return "standing"
    if skill.speed == 0.0:
        return "turning"
    return "walking" if skill.duty > 0.7 else "trotting" if skill.duty >= 0.55 else "flying"


NAMED_BY: Mapping[str, Callable[[Mapping[str, float], SkillCall | None], str]] = {
    "support": lambda raw, call: support_of(raw["feet down"]),
    "leg setting": lambda raw, call: setting_of(raw),
    "road": lambda raw, call: road_of(raw),
    "goal": lambda raw, call: goal_of(raw),
    "turn": lambda raw, call: turn_of(raw["off the path"]),
    "street": lambda raw, call: street_of(raw["direction"]),
    "initial location": lambda raw, call: street_of(raw["direction at the start"]),
    "final location": lambda raw, call: street_of(raw["direction at the end"]),
    "path": lambda raw, call: "travelled before" if raw["familiar"] else "unknown",
    "doing": lambda raw, call: doing_of(call),
}
"""How the leaf is found in each tree whose leaves are names."""
