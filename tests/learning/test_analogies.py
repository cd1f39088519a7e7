"""Rules by analogy: proposed where their counterpart is known, and silent until someone confirms them."""

from gaitwright.knowledge.analogy import confirm
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.correction import teach
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Lesson
from gaitwright.knowledge.rules import Rulebook
from gaitwright.learning.analogies import proposals
from gaitwright.skills.situation import FOREST


def at(**values: str):
    """A situation: the first leaf of every tree, but for what is named."""
    return FOREST.situation({tree.name: values.get(tree.name, tree.leaves[0]) for tree in FOREST.trees})


def test_descending_is_proposed_from_climbing_and_waits_to_be_confirmed() -> None:
    up, down = at(road="stairs up"), at(road="stairs down")
    action = Action("climb", 0.1, 0.3)
    lesson = Lesson("omission", "climb", up, "1", "steps up", {}, "road", action)
    book = teach(Rulebook(FOREST), lesson).rulebook
    (offer,) = proposals(book)
    assert offer.rulebook["descend"].action.skill == "descend" and offer.rulebook["descend"].proposed
    assert consult(offer.rulebook, down).rule != "descend"
    sure = confirm(offer.rulebook, "descend", "2").rulebook
    assert "descend" in consult(sure, down).conflict


def test_nothing_is_proposed_that_is_known_already() -> None:
    book = Rulebook(FOREST)
    for k, (skill, road) in enumerate((("climb", "stairs up"), ("descend", "stairs down"))):
        lesson = Lesson(
            "omission", skill, at(road=road), str(k), "steps", {}, "road", Action(skill, 0.1, 0.3)
        )
        book = teach(book, lesson).rulebook
    assert proposals(book) == ()
