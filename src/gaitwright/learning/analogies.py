"""New rules from old, for robots (row L12): walk-backward from walk, descend from climb, left from right.

What is mirrored is offered as a shell: it does not fire until it is confirmed or seen right.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from gaitwright.knowledge.analogy import ValueMaps, mirrored
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Learned
from gaitwright.knowledge.rules import Rulebook


def swapped(*pairs: tuple[str, str]) -> dict[str, str]:
    """A map that exchanges the two values of each pair."""
    return {a: b for pair in pairs for a, b in (pair, pair[::-1])}


@dataclass(frozen=True, slots=True)
class Analogy:
    """A skill that is another one the other way round."""

    skill: str
    new: str
    values: ValueMaps


FORTH_AND_BACK: Mapping[str, Mapping[str, str]] = {"turn": swapped(("straight on", "behind"))}
UP_AND_DOWN: Mapping[str, Mapping[str, str]] = {
    "road": swapped(
        ("stairs up", "stairs down"),
        ("steep uphill", "steep downhill"),
        ("gently uphill", "gently downhill"),
    )
}
LEFT_AND_RIGHT: Mapping[str, Mapping[str, str]] = {
    "turn": swapped(("left", "right"), ("sharp left", "sharp right"))
}
ANALOGIES = (
    Analogy("walk", "walk-backward", FORTH_AND_BACK),
    Analogy("climb", "descend", UP_AND_DOWN),
    Analogy("descend", "climb", UP_AND_DOWN),
    Analogy("turn-left", "turn-right", LEFT_AND_RIGHT),
    Analogy("turn-right", "turn-left", LEFT_AND_RIGHT),
)


def proposals(rulebook: Rulebook) -> tuple[Learned, ...]:
    """The rules that could be had by analogy and are not there yet, one after the other."""
    made: list[Learned] = []
    for analogy in ANALOGIES:
        names = {rule.name for rule in rulebook.rules}
        if analogy.skill not in names or analogy.new in {rule.action.skill for rule in rulebook.rules}:
            continue

        def action(old: Action, new: str = analogy.new) -> Action:
            return replace(old, skill=new)

        learned = mirrored(rulebook, analogy.skill, analogy.new, action, analogy.values)
        if learned.trouble is None:
            made.append(learned)
            rulebook = learned.rulebook
    return tuple(made)
