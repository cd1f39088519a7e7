"""Rulebooks made by hand: rules by their upper marks, with instances that fit them."""

from collections.abc import Mapping

from gaitwright.knowledge.forest import Forest, Situation
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.rules import Choice, Event, Instance, Marks, Rule, Rulebook, outside
from gaitwright.knowledge.trees import ROOT, interval_tree, tree
from gaitwright.knowledge.widen import marks_around

Seen = Mapping[str, Situation]
"""Situations by the names of their lessons."""


def rule_of(
    forest: Forest,
    name: str,
    upper: Mapping[str, str] | None = None,
    right: Seen | None = None,
    wrong: Seen | None = None,
    action: Action | None = None,
) -> Rule:
    """A rule with these upper marks, all others at the root, and lower marks around what it was right at:
    where nothing is said, the first leaf below each upper mark."""
    upper = upper or {}
    above = [upper.get(tree, ROOT) for tree in forest.names]
    if right is None:
        leaves = [grown.leaves_below(mark)[0] for grown, mark in zip(forest.trees, above, strict=True)]
        right = {f"{name}, seen": Situation(forest.names, tuple(leaves))}
    positives = tuple(Instance(k, "positive", situation) for k, situation in right.items())
    negatives = tuple(Instance(k, "commission", situation) for k, situation in (wrong or {}).items())
    marks = tuple(
        Marks(grown.name, mark, marks_around(grown, positives).lower)
        for grown, mark in zip(forest.trees, above, strict=True)
    )
    rule = Rule(name, action or Action(name), marks, positives, negatives)
    kept_out = [outside(forest, rule, negative.situation) or [""] for negative in negatives]
    choices = tuple(Choice(trees[0], tuple(trees[1:])) for trees in kept_out)
    return Rule(name, rule.action, marks, positives, negatives, choices)


def book_of(forest: Forest, rules: Mapping[str, Mapping[str, str]]) -> Rulebook:
    """A book of such rules, the first one first."""
    made = tuple(rule_of(forest, name, upper) for name, upper in rules.items())
    return Rulebook(forest, made, lessons=len(made))


# --- a garden --------------------------------------------------------------------------------------
GARDEN = Forest(
    (
        tree("ground", {"firm": ("flat", "gravel"), "slope": ("uphill", "downhill")}, "the ground is"),
        interval_tree("speed", "m/s", (1.0, 2.0), {"calm": ("slow", "medium"), "fast": ()}, "the speed is"),
        tree("heading", ("forward", "backward")),
    )
)


def at(ground: str = "flat", speed: str = "slow", heading: str = "forward") -> Situation:
    return GARDEN.situation({"ground": ground, "speed": speed, "heading": heading})


def garden() -> Rulebook:
    """Trot on the flat, run when fast, else climb; with the history of its four lessons."""
    laps = {"lap 0": at(), "lap 1": at(speed="fast"), "lap 2": at("uphill"), "lap 3": at()}

    def seen(*numbers: int) -> Seen:
        return {f"lap {k}": laps[f"lap {k}"] for k in numbers}

    rules = (
        rule_of(GARDEN, "trot", {"ground": "firm", "speed": "calm"}, seen(0), seen(1, 2)),
        rule_of(GARDEN, "run", {"speed": "fast"}, seen(1), seen(2, 3)),
        rule_of(GARDEN, "climb", {}, seen(2)),
    )
    events = (
        *born("lap 0", rules[0]),
        *born("lap 1", rules[1]),
        Event("lap 1", "trot", "speed", "upper", "any", "calm", "trot was wrong at speed fast"),
        *born("lap 2", rules[2]),
        Event("lap 2", "trot", "ground", "upper", "any", "firm", "trot was wrong at ground uphill"),
        Event("lap 3", "run", "speed", "upper", "any", "fast", "run was wrong at speed slow"),
    )
    return Rulebook(GARDEN, rules, events=events, lessons=4)


def born(lesson: str, rule: Rule) -> tuple[Event, ...]:
    """The events of a rule's first lesson."""
    new = Event(lesson, rule.name, "", "rule", "", rule.name, f"{rule.name} is new")
    lower = (
        Event(lesson, rule.name, m.tree, "lower", "", str(m.lower), f"right at {m.lower}") for m in rule.marks
    )
    return (new, *lower)
