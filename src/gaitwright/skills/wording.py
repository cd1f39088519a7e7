"""Which tree of the situation space reads which column, so that what is learned on numbers is said in its
words."""

from gaitwright.knowledge.expressed import Wording
from gaitwright.skills.situation import FOREST, NUMBER_OF

WORDING = Wording(
    FOREST,
    {
        NUMBER_OF.get(tree.name, tree.name): tree.name
        for tree in FOREST.trees
        if tree.bounds or tree.name == "doing"
    },
)
"""Distance is read from what remains, pace from the speed that is possible, stability from the sway."""
