"""A rulebook's own trees beside those of today: which it grew itself, and which came after it was made."""

from collections.abc import Mapping

from gaitwright.errors import WrongUse
from gaitwright.knowledge.expressed import read_in
from gaitwright.knowledge.forest import Situation
from gaitwright.knowledge.memory import NOT_NOTED, NOTED, Fact, read_notes
from gaitwright.knowledge.rules import Rulebook
from gaitwright.knowledge.widen import widened
from gaitwright.skills.situation import FOREST, situation_of
from gaitwright.skills.vocabulary import VOCABULARY, check_note
from gaitwright.skills.wording import NUMBERS


def in_trees_of(rulebook: Rulebook, now: Situation, raw: Mapping[str, Fact]) -> Situation:
    """The situation in a rulebook's own trees: those with bounds of its own are read from the numbers."""
    if rulebook.forest == FOREST:
        return now
    facts = {**raw, **read_notes(notes_of(rulebook), raw)}
    return read_in(rulebook.forest, VOCABULARY, NUMBERS, now, facts)


def notes_of(rulebook: Rulebook) -> tuple[str, ...]:
    """The notes in working memory that a rulebook goes by."""
    return tuple(tree.name for tree in rulebook.forest.trees if tree.leaves == (NOT_NOTED, NOTED))


def situation_in(rulebook: Rulebook, facts: Mapping[str, Fact]) -> Situation:
    """The situation that facts describe, in a rulebook's own trees."""
    return in_trees_of(rulebook, situation_of(facts), facts)


def up_to_date(rulebook: Rulebook) -> Rulebook:
    """The rulebook over today's trees too: those that came after it was made are widened in.

    Raises `WrongUse` for a rulebook that is about something else, or that asks for what nobody measures.
    """
    own, notes = rulebook.forest, notes_of(rulebook)
    if not set(own.names) & set(FOREST.names):
        raise WrongUse(f"this rulebook knows nothing of {', '.join(FOREST.names)}: it is not about skills")
    for tree in own.trees:
        here = FOREST[tree.name].leaves if tree.name in FOREST.names else ()
        if tree.name in notes:
            check_note(tree.name)
        elif tree.leaves != here and not (tree.bounds and (tree.source or tree.name) in VOCABULARY.places):
            there = f"that is {' or '.join(here)}" if here else f"nothing measures {tree.source or tree.name}"
            raise WrongUse(
                f"this rulebook asks whether {tree.name} is {' or '.join(tree.leaves)}, and here {there}: "
                "it is not about skills, or was made by a newer Gaitwright"
            )
    return widened(rulebook, FOREST.trees)
