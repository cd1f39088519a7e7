"""What would have to be different, in numbers: each answer is a situation that can be, and comes true."""

from functools import cache

from gaitwright.knowledge.memory import Action
from gaitwright.learning.skill_pupil import SkillPupil, told_at
from gaitwright.learning.teacher import ScriptedTeacher, Shown
from gaitwright.skills.rule_chooser import RuleChooser
from gaitwright.skills.situation import named
from gaitwright.skills.vocabulary import FLAGS
from gaitwright.skills.what_if import what_if
from learning.roads import ROADS, moment
from oracles import robot_called

DOG, TEACHER = robot_called("dog"), ScriptedTeacher()


@cache
def rules():
    """Rules from moments around each line of the teacher's policy."""
    pupil = SkillPupil(0)
    for k in range(12):
        for one in ROADS:
            raw = {name: number * (1.0 + 0.01 * k) for name, number in one.raw.items()} | {
                name: one.raw[name] for name in FLAGS
            }
            near = type(one)(f"{one.id}, {k}", named(raw), raw, {})
            pupil.hear(told_at(near, TEACHER.ideal(raw), f"scene {k % 4}"))
    return pupil.rulebook()


def fires(facts) -> str:
    """What whoever drives by the rules does."""
    chooser = RuleChooser(DOG, rules())
    raw = {name: fact for name, fact in facts.items() if not isinstance(fact, str)}
    return chooser.ruling(chooser.situation(raw, None), {}).rule


def test_every_answer_comes_true_and_changes_no_more_than_it_must():
    found = 0
    for one in ROADS:
        facts = one.facts
        for to in ("", *(rule.name for rule in rules().rules)):
            answer = what_if(rules(), facts, to)
            if not answer.changes:
                continue
            found += 1
            changed = facts | {change.fact: change.after for change in answer.changes}
            assert fires(changed) == answer.rule != fires(facts) and to in ("", answer.rule)
            for change in answer.changes:
                without = changed | {change.fact: facts[change.fact]}
                assert fires(without) != answer.rule, "each change is needed"
                if change.fact in FLAGS:
                    assert change.after in FLAGS[change.fact]
    assert found > 60


def test_it_speaks_of_numbers_as_people_do():
    pupil = SkillPupil()
    for k in range(8):
        for action, grip in ((Action("trot", 0.2, 1.0), 0.8), (Action("walk", 0.1, 0.3), 0.2)):
            shown = Shown(action.skill, action, about="grip")
            pupil.hear(told_at(moment(grip=grip, possible=0.5 + k / 40), shown, f"scene {k % 3}"))
    answer = what_if(pupil.rulebook(), moment(grip=0.3).facts, "trot")
    assert answer.sentence == "trot would fire if the grip of the ground were at least 0.5 instead of 0.3"
    nothing = what_if(pupil.rulebook(), moment(grip=0.3).facts, "fly")
    assert nothing.changes == () and "no change" in nothing.sentence


def test_who_has_arrived_or_not_is_said_in_words():
    answer = what_if(rules(), moment().facts, "stop")
    assert answer.sentence == "stop would fire if it had arrived"
