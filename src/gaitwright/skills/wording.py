"""Which tree of the situation space reads which column, so that what is learned on numbers is said in its
words."""

from gaitwright.knowledge.expressed import Wording, number_columns
from gaitwright.skills.situation import FOREST, NUMBER_OF
from gaitwright.skills.vocabulary import VOCABULARY

WORDING = Wording(
    FOREST,
    {
        NUMBER_OF.get(tree.name, tree.name): tree.name
        for tree in FOREST.trees
        if tree.bounds or tree.name == "doing"
    },
)
"""Distance is read from what remains, pace from the speed that is possible, stability from the sway."""

NUMBERS = number_columns(VOCABULARY, WORDING)
"""The place of the column that each tree of numbers reads."""
