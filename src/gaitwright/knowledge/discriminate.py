"""Algorithm E: a negative instance lowers one upper mark; which one may be a choice (§5.4.2.1)."""

from dataclasses import dataclass

from gaitwright.knowledge.forest import Forest, Situation
from gaitwright.knowledge.rules import Choice, Marks
from gaitwright.knowledge.trees import FeatureTree


@dataclass(frozen=True, slots=True)
class Discrimination:
    """The marks that keep a negative instance out, and the choice that this was: with no others, a near
    miss."""

    marks: tuple[Marks, ...]
    choice: Choice


def grey_trees(forest: Forest, marks: tuple[Marks, ...], situation: Situation) -> list[int]:
    """Places of the trees that can keep a situation out: its value is not below the lower mark (E, steps
    a-d).

    A tree in which the value or the rule's own values were never noted can keep nothing out.
    """
    return [
        place
        for place, (tree, mark, value) in enumerate(zip(forest.trees, marks, situation.values, strict=True))
        if value is not None and mark.lower is not None and not tree.is_below(value, mark.lower)
    ]


def discriminate(
    forest: Forest, marks: tuple[Marks, ...], situation: Situation, blame: str = ""
) -> Discrimination | None:
    """The marks with one upper mark lowered just enough to exclude the situation; `None` if no tree is grey.

    Of a far miss's grey trees it takes one that keeps the situation out already, else the one a teacher
    blames, else the one where that costs the rule the largest share of its values. Too bold a choice is set
    right by the first instance that proves it wrong; too timid a one lets a whole row of mistakes happen.
    """
    grey = grey_trees(forest, marks, situation)
    if not grey:
        return None

    def rank(place: int) -> tuple[bool, bool, float]:
        tree, mark = forest.trees[place], marks[place]
        upper = lowered(tree, mark, str(situation.values[place]))
        kept = tree.sets[tree.at(upper)].bit_count() / tree.sets[tree.at(mark.upper)].bit_count()
        return upper != mark.upper, tree.name != blame, kept

    chosen = min(grey, key=rank)
    mark = marks[chosen]
    upper = lowered(forest.trees[chosen], mark, str(situation.values[chosen]))
    others = tuple(forest.names[place] for place in grey if place != chosen)
    changed = (*marks[:chosen], Marks(mark.tree, upper, mark.lower), *marks[chosen + 1 :])
    return Discrimination(changed, Choice(mark.tree, others))


def lowered(tree: FeatureTree, marks: Marks, value: str) -> str:
    """The upper mark lowered just enough to exclude the value (E, step e); as it is where it excludes it
    already.

    The value and the lower mark part below their least upper bound: its child towards the lower mark is the
    highest mark that excludes the value and still holds all that the lower mark holds.
    """
    if marks.lower is None or not tree.is_below(value, marks.upper):
        return marks.upper
    return tree.child_towards(tree.least_upper_bound(value, marks.lower), marks.lower)
