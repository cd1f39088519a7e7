"""Algorithm C: which rule a situation calls for, and how sure that is (§5.4.2.1)."""

from dataclasses import dataclass
from typing import Literal

from gaitwright.knowledge.forest import Situation
from gaitwright.knowledge.rules import Rulebook, covers, grey

Certainty = Literal["sure", "grey", "none"]


@dataclass(frozen=True, slots=True)
class Decision:
    """The rule that fires (`None`: none may), all that could in their order, and the trees that leave
    doubt."""

    rule: str | None
    conflict: tuple[str, ...]
    certainty: Certainty
    grey: tuple[str, ...]
    situation: Situation


def consult(rulebook: Rulebook, situation: Situation) -> Decision:
    """The first rule of the conflict set, in the book's order.

    (a) All rules share the book's forest, so it is merged as it stands. (b, c) Each value of the situation is
    set into its tree and leaves the rules whose upper mark it is below. (d) The first of these is applied.
    """
    conflict = [rule for rule in rulebook.rules if rule.may_fire]
    for place, (tree, value) in enumerate(zip(rulebook.forest.trees, situation.values, strict=True)):
        conflict = [rule for rule in conflict if covers(tree, rule.marks[place].upper, value)]
    if not conflict:
        return Decision(None, (), "none", (), situation)
    doubts = tuple(grey(rulebook.forest, conflict[0], situation))
    names = tuple(rule.name for rule in conflict)
    return Decision(names[0], names, "grey" if doubts else "sure", doubts, situation)
