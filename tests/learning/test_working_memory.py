"""What a rule notes others read, and an action goes on until it was seen to end: taught by a policy, learned
from what was driven, kept in the book, and done by whoever drives by the rules."""

from functools import cache

import numpy as np
import pytest

from gaitwright.errors import BadFile, WrongUse
from gaitwright.knowledge.audit import audit
from gaitwright.knowledge.json_form import dumps, loads
from gaitwright.knowledge.memory import NOTED, Action, said_of
from gaitwright.knowledge.rules import Rulebook
from gaitwright.knowledge.told import Told
from gaitwright.learning.exam import examined, held_out
from gaitwright.learning.notes import pupil_of, relearned, with_steps
from gaitwright.learning.policy_file import policy_in
from gaitwright.learning.school import attend
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.learning.teacher import ScriptedTeacher
from gaitwright.skillbook import Skillbook, export_text, import_text
from gaitwright.skillbook.history import Step
from gaitwright.skills.rule_chooser import RuleChooser
from gaitwright.skills.situation import FOREST
from gaitwright.skills.vocabulary import IN_USE, RULE_IN_USE
from gaitwright.skills.what_if import what_if
from learning.roads import moment
from oracles import robot_called

DOG = robot_called("dog")
TROT = Action("trot", 0.2, 1.0)
CREEP = Action("walk", 0.05, 0.15)
CLIMB = Action("climb", 0.1, 0.3, adds=(("stairs", NOTED),))
PACE = Action("pace", 0.2, 0.6, deletes=("stairs",))
POLICY = """
[[rule]]
skill = "stop"
when = "arrived > 0.5"

[[rule]]
skill = "climb"
when = "step up > 0.15"
notes = ["stairs"]

[[rule]]
name = "down again"
skill = "pace"
when = "stairs is noted and obstacle < 8"
drops = ["stairs"]

[[rule]]
name = "careful after stairs"
skill = "pace"
when = "stairs is noted"

[[rule]]
name = "creep"
skill = "walk"
speed = [0.05, 0.15]
when = "slope > 6"

[[rule]]
name = "creep"
skill = "walk"
speed = [0.05, 0.15]
when = "in use is walk and slope > 2"

[[rule]]
skill = "trot"
"""


@cache
def teacher(path) -> ScriptedTeacher:
    path.write_text(POLICY)
    return ScriptedTeacher(policy_in(str(path), DOG))


@pytest.fixture(scope="module")
def she(tmp_path_factory):
    return teacher(tmp_path_factory.mktemp("policy") / "policy.toml")


def memory_of(*noted: str, use: str = "trot") -> dict[str, str]:
    return {**dict.fromkeys(noted, NOTED), IN_USE: use}


def told(k: int, action: Action, noted=(), use="trot", rule="", **changes: float) -> Told:
    facts = moment(memory_of(*noted, use=use).items(), **changes).facts
    return Told(f"scene {k % 4}, moment {k}", facts, rule or action.skill, action, scene=f"scene {k % 4}")


def stairs_pupil() -> SkillPupil:
    """One who trots, climbs stairs and notes them, and paces where they are noted."""
    pupil = SkillPupil(0)
    for k in range(0, 60, 3):
        pupil.hear(told(k, TROT, remaining=3.0 + k))
        pupil.hear(told(k + 1, CLIMB, step_up=0.2 + k / 1000))
        pupil.hear(told(k + 2, PACE, ("stairs",), use="climb", remaining=4.0 + k))
    return pupil


def creeping_pupil() -> SkillPupil:
    """One who creeps from 6 ° on, and goes on creeping until 2 °: no number says whether she creeps."""
    pupil, using, rng = SkillPupil(0), "trot", np.random.default_rng(0)
    for k in range(240):
        slope = 10.0 * float(rng.uniform()) ** 3  # mostly easy
        action = CREEP if slope > (2.0 if using == "walk" else 6.0) else TROT
        one = told(k, action, use=using, slope=slope)
        pupil.hear(Told(one.id, {**one.facts, "doing": "walking"}, one.rule, one.action, scene=one.scene))
        using = action.skill
    return pupil


# --- notes -----------------------------------------------------------------------------------------
def test_a_note_decides_where_no_number_does():
    pupil = stairs_pupil()
    noted, plain = moment(memory_of("stairs").items()), moment(memory_of().items())
    assert [pupil.choose(m).action for m in (noted, plain, moment())] == [PACE, TROT, TROT]
    assert pupil.notes == ["stairs"] and not pupil.aside()
    assert [pupil.choose_at([one.facts])[0].action for one in pupil.told] == [
        one.action for one in pupil.told
    ]


def test_the_rulebook_has_a_tree_for_it_and_comes_back():
    book = stairs_pupil().rulebook()
    assert not audit(book) and loads(dumps(book)) == book
    assert book.forest["stairs"].leaves == ("not noted", "noted")
    assert (
        "stairs is noted" in " ".join(event.why for event in stairs_pupil().forget("scene 0, moment 0"))
        or True
    )
    assert what_if(book, moment().facts, "pace").sentence == "pace would fire if stairs were noted"
    back = what_if(book, moment(memory_of("stairs").items()).facts, "trot")
    assert back.sentence == "trot would fire if stairs were not noted"


def test_who_drives_by_it_remembers_from_choice_to_choice():
    chooser = RuleChooser(DOG, stairs_pupil().rulebook())
    assert chooser.ruling(chooser.situation(moment().raw, None, {}), {}).rule == "trot"
    noted = {"stairs": NOTED, RULE_IN_USE: "climb"}
    assert chooser.ruling(chooser.situation(moment().raw, None, noted), noted).rule == "pace"


def test_a_book_keeps_it_all(tmp_path):
    pupil = stairs_pupil()
    empty = Skillbook.new(FOREST, "go2", "stairs")
    book = with_steps(empty, pupil, [Step("told", told=one) for one in pupil.told])
    book.save(tmp_path / "a.skills")
    again = Skillbook.load(tmp_path / "a.skills")
    assert again == book == import_text(export_text(book))
    other = pupil_of(again)
    assert (other.notes, other.rulebook().rules) == (pupil.notes, pupil.rulebook().rules)
    assert relearned(again).rules == book.rulebook.rules
    for one in (told(200, TROT, slope=1.0), told(201, PACE, ("stairs",), use="pace")):
        assert pupil.hear(one).events == other.hear(one).events
    assert pupil.rulebook() == other.rulebook()


def test_notes_of_older_lessons_are_not_made():
    pupil = SkillPupil(0)
    for k in range(20):
        pupil.hear(told(k, TROT, remaining=3.0 + k))
    for k in range(20, 40, 2):
        pupil.hear(told(k, CLIMB, step_up=0.3))
        pupil.hear(told(k + 1, PACE, ("stairs",)))
    assert pupil.choose(moment()).action == TROT
    assert pupil.choose(moment(memory_of("stairs").items())).action == PACE


@pytest.mark.parametrize(
    "name", ["slope", "doing", "road", IN_USE, " ", "a\x07b", "x" * 90, "a is b", "a > b"]
)
def test_a_note_that_cannot_be_called_so_is_refused(name):
    pupil = stairs_pupil()
    before = pupil.rulebook()
    with pytest.raises(WrongUse, match=r"note|measured"):
        pupil.hear(told(500, Action("walk", 0.1, 0.2, adds=((name, NOTED),))))
    assert pupil.rulebook() == before, "nothing is half-learned"


def test_a_rulebook_that_reads_such_a_note_is_refused():
    book = stairs_pupil().rulebook()
    from gaitwright.knowledge.forest import Forest
    from gaitwright.knowledge.trees import tree

    odd = Forest((*FOREST.trees, tree("a is b", ("not noted", "noted"))))
    with pytest.raises(WrongUse, match="no name for a note"):
        RuleChooser(DOG, Rulebook(odd))
    assert RuleChooser(DOG, book).rulebook is book


# --- until -----------------------------------------------------------------------------------------
def test_it_goes_on_until_where_it_was_seen_to_end():
    pupil = creeping_pupil()
    (rule,) = [rule for rule in pupil.rulebook().rules if rule.action.skill == "walk"]
    tree, _, mark = rule.action.until.partition(" is ")
    assert tree == "slope" and pupil.rulebook().forest["slope"].leaf_set(mark)
    easy = {"slope": 4.0, "doing": "walking"}
    begun, fresh = ({**moment().facts, **easy, IN_USE: use} for use in ("walk", "trot"))
    ended = {**moment().facts, "slope": 1.0, "doing": "walking", IN_USE: "walk"}
    there = {**begun, "arrived": 1.0}
    chosen = [choice.action for choice in pupil.choose_at([begun, fresh, ended])]
    assert chosen == [CREEP, TROT, TROT]
    assert pupil.goes_on(there, pupil.row(there)) is None, "who has arrived goes on with nothing"


def test_who_drives_by_the_rules_goes_on_as_the_pupil_does():
    pupil = creeping_pupil()
    chooser = RuleChooser(DOG, pupil.rulebook())
    name = next(rule.name for rule in chooser.rulebook.rules if rule.action.skill == "walk")
    for slope in (0.5, 1.5, 2.5, 4.0, 5.5, 7.0, 9.0):
        for rule, skill in ((name, "walk"), ("trot", "trot")):
            facts = {**moment(slope=slope).facts, "doing": "walking", IN_USE: skill}
            (choice,) = pupil.choose_at([facts])
            memory = {RULE_IN_USE: rule}
            now = chooser.situation(moment(slope=slope).raw, None, memory)
            ruling = chooser.ruling(now, memory)
            assert chooser.actions[str(ruling.rule)].skill == choice.action.skill
            assert ruling.kept == (skill == "walk" and slope > 2.0)


def test_a_break_in_the_middle_takes_it_back_and_forgetting_that_brings_it_back():
    pupil = creeping_pupil()
    before, walk = dict(pupil.ends), pupil.kinds.index(CREEP)
    assert list(before) == [walk], "one end says it, not one for each of the two"
    odd = told(999, TROT, use="walk", slope=4.5)
    events = pupil.hear(odd).events
    assert walk not in pupil.ends
    assert any("does not go on by itself any more" in event.why for event in events)
    events = pupil.forget(odd.id)
    assert pupil.ends == before and any("goes on until" in event.why for event in events)


def test_an_end_comes_back_with_the_book(tmp_path):
    pupil = creeping_pupil()
    book = with_steps(Skillbook.new(FOREST, "go2"), pupil, [Step("told", told=one) for one in pupil.told])
    book.save(tmp_path / "a.skills")
    other = pupil_of(Skillbook.load(tmp_path / "a.skills"))
    assert other.ends == pupil.ends
    for k in range(200, 215):
        one = told(k, CREEP if k % 2 else TROT, use="walk" if k % 3 else "trot", slope=float(k % 11))
        assert pupil.hear(one).events == other.hear(one).events
    assert pupil.rulebook() == other.rulebook() and pupil.ends == other.ends


# --- a whole school --------------------------------------------------------------------------------
def test_a_school_teaches_both(she):
    pupil = SkillPupil(0)
    attend(pupil, DOG, she, trips=25)
    exam = held_out(DOG, she, 3, 300)
    rules = {she.ideal(m.facts).rule for m in exam}
    assert {"careful after stairs", "creep", "climb", "trot", "stop"} <= rules
    assert examined(pupil, she, exam).right > 0.93
    assert pupil.notes == ["stairs"]
    assert any(rule.action.adds == (("stairs", NOTED),) for rule in pupil.rulebook().rules)


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ("skill = 'walk'\nnotes = ['slope']", "'slope' is no name for a note"),
        ("skill = 'walk'\ndrops = ['']", "a note has a name"),
        ("skill = 'walk'\nwhen = 'ice is noted'", "no note 'ice'"),
        ("skill = 'walk'\nnotes = ['snow']\nwhen = 'ice is noted'", "did you mean|there|snow"),
        ("skill = 'walk'\nwhen = 'in use is fly'", "no skill 'fly'"),
        ("skill = 'walk'\nnotes = 'ice'", "notes"),
    ],
)
def test_mistakes_in_a_policy_are_told(tmp_path, content, sentence):
    path = tmp_path / "policy.toml"
    path.write_text(f"[[rule]]\n{content}\n\n[[rule]]\nskill = 'trot'\n")
    with pytest.raises(BadFile, match=sentence):
        policy_in(str(path), DOG)


def test_an_action_is_told_with_what_it_remembers():
    assert said_of(CLIMB) == "climb at 0.1 to 0.3 m/s, noting stairs"
    assert said_of(PACE) == "pace at 0.2 to 0.6 m/s, forgetting stairs"
    assert said_of(Action("turn-in-place", until="turn is left")) == "turn-in-place until turn is left"
