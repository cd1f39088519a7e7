"""A rulebook's own trees beside those of today: which it grew itself, and which came after it was made."""

from collections.abc import Mapping

from gaitwright.errors import WrongUse
from gaitwright.knowledge.expressed import read_in
from gaitwright.knowledge.forest import Situation
from gaitwright.knowledge.memory import Fact
from gaitwright.knowledge.rules import Rulebook
from gaitwright.knowledge.widen import widened
from gaitwright.skills.situation import FOREST, situation_of
from gaitwright.skills.vocabulary import COLUMN_PLACES, VOCABULARY
from gaitwright.skills.wording import NUMBERS


def in_trees_of(rulebook: Rulebook, now: Situation, raw: Mapping[str, Fact]) -> Situation:
    """The situation in a rulebook's own trees: those with bounds of its own are read from the numbers."""
    return now if rulebook.forest == FOREST else read_in(rulebook.forest, VOCABULARY, NUMBERS, now, raw)


def situation_in(rulebook: Rulebook, facts: Mapping[str, Fact]) -> Situation:
    """The situation that facts describe, in a rulebook's own trees."""
    return in_trees_of(rulebook, situation_of(facts), facts)


def up_to_date(rulebook: Rulebook) -> Rulebook:
    """The rulebook over today's trees too: those that came after it was made are widened in.

    Raises `WrongUse` for a rulebook that is about something else, or that asks for what nobody measures.
    """
    own = rulebook.forest
    if not set(own.names) & set(FOREST.names):
        raise WrongUse(f"this rulebook knows nothing of {', '.join(FOREST.names)}: it is not about skills")
    for tree in own.trees:
        here = FOREST[tree.name].leaves if tree.name in FOREST.names else ()
        if tree.leaves != here and not (tree.bounds and (tree.source or tree.name) in COLUMN_PLACES):
            there = f"that is {' or '.join(here)}" if here else f"nothing measures {tree.source or tree.name}"
            raise WrongUse(
                f"this rulebook asks whether {tree.name} is {' or '.join(tree.leaves)}, and here {there}: "
                "it is not about skills, or was made by a newer Gaitwright"
            )
    return widened(rulebook, FOREST.trees)
