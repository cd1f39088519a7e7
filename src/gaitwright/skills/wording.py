"""Which tree of the situation space reads which column, so that what is learned on numbers is said in its
words."""

from functools import lru_cache

from gaitwright.knowledge.expressed import Wording, number_columns
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.memory import NOT_NOTED, NOTED
from gaitwright.knowledge.trees import tree
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


@lru_cache(maxsize=64)
def wording_with(notes: tuple[str, ...]) -> Wording:
    """The words of someone who makes notes in working memory: a tree for each of them."""
    if not notes:
        return WORDING
    trees = (tree(name, (NOT_NOTED, NOTED), about=f"{name} is") for name in notes)
    return Wording(Forest((*FOREST.trees, *trees)), {**WORDING.tree_of, **{name: name for name in notes}})


NUMBERS = number_columns(VOCABULARY, WORDING)
"""The place of the column that each tree of numbers reads."""
