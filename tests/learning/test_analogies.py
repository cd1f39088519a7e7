"""Rules by analogy: proposed where their counterpart is known, and nothing until someone confirms them."""

import pytest

from gaitwright.errors import WrongUse
from gaitwright.knowledge.memory import Action
from gaitwright.learning.analogies import MOST, proposal_of, proposals
from gaitwright.learning.skill_pupil import SkillPupil, told_at
from gaitwright.learning.teacher import Shown
from learning.roads import moment


def taught(*skills: str) -> SkillPupil:
    """A pupil who knows the trot, and these skills on slopes of their side."""
    pupil = SkillPupil()
    for k in range(6):
        tell(pupil, "trot", slope=0.5 * k, possible=0.5 + k / 20)
        for skill in skills:
            tell(pupil, skill, slope=(12.0 + k) * (1 if skill == "climb" else -1), possible=0.5 + k / 30)
    return pupil


def tell(pupil: SkillPupil, skill: str, **changes: float) -> None:
    pupil.hear(told_at(moment(**changes), Shown(skill, Action(skill, 0.1, 0.3), about="slope"), "a"))


def test_descending_is_proposed_from_climbing_and_learned_once_it_is_confirmed() -> None:
    pupil = taught("climb")
    down = moment(slope=-14.0)
    (offer,) = proposals(pupil)
    assert offer.skill == "descend" and len(offer.told) == 6
    assert all(float(told.facts["slope"]) < 0.0 and told.given == "by analogy" for told in offer.told)
    assert pupil.choose(down).action.skill == "trot"
    for told in proposal_of(pupil, "descend").told:
        pupil.hear(told)
    assert pupil.choose(down).action == Action("descend", 0.1, 0.3)
    assert pupil.choose(moment(slope=14.0)).action.skill == "climb"
    assert proposals(pupil) == ()


def test_what_is_seen_overrules_what_was_only_concluded() -> None:
    pupil = taught("climb")
    for told in proposal_of(pupil, "descend").told:
        pupil.hear(told)
    for k in range(8):
        tell(pupil, "walk", slope=-12.0 - 0.5 * k, possible=0.51 + k / 40)
    assert pupil.choose(moment(slope=-13.2)).action.skill == "walk"


def test_nothing_is_proposed_that_is_known_already_and_few_lessons_of_many() -> None:
    assert proposals(taught("climb", "descend")) == ()
    pupil = taught()
    for k in range(40):
        tell(pupil, "climb", slope=12.0 + k / 10)
    assert len(proposal_of(pupil, "descend").told) <= MOST
    with pytest.raises(WrongUse, match="proposed are descend"):
        proposal_of(pupil, "gallop")
