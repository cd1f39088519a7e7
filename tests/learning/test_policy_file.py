"""A teacher's policy that a person wrote down, and every mistake in it as one sentence."""

import pytest

from gaitwright.errors import BadFile
from gaitwright.knowledge.memory import Action
from gaitwright.learning.policy_file import policy_in
from gaitwright.learning.teacher import ScriptedTeacher
from learning.roads import moment
from oracles import robot_called

DOG = robot_called("dog")
POLICY = """
[[rule]]
skill = "stop"
when = "arrived > 0.5"

[[rule]]
name = "walk where it is slippery"
skill = "walk"
speed = [0.1, 0.25]
when = "grip < 0.5 and size of slope <= 8"
because = "it slips"

[[rule]]
skill = "turn-in-place"
when = "size of off the path > 42"

[[rule]]
skill = "trot"
"""


@pytest.fixture
def written(tmp_path):
    def write(content: str) -> str:
        path = tmp_path / "policy.toml"
        path.write_text(content)
        return str(path)

    return write


def test_the_first_rule_that_holds_is_what_she_does(written):
    teacher = ScriptedTeacher(policy_in(written(POLICY), DOG))
    assert teacher.ideal(moment(arrived=1.0, grip=0.2).facts).action == Action("stop")
    shown = teacher.ideal(moment(grip=0.2, slope=-7.0).facts)
    assert (shown.rule, shown.because, shown.about) == ("walk where it is slippery", "it slips", "grip")
    assert shown.action == Action("walk", 0.1, 0.25)
    assert teacher.ideal(moment(grip=0.2, slope=-9.0).facts).action.skill == "trot"
    turn = teacher.ideal(moment(off_the_path=-50.0).facts).action
    assert turn == Action("turn-in-place", until="turn is straight on")


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("", "rule"),
        ("[[rule]]\n", "skill"),
        ("rule = 3", "array"),
        ("[[rule]]\nskill = 'fly'", "rule 1: no skill 'fly'"),
        ("[[rule]]\nskill = 'walk'\nspeed = [0.1, 7.0]", "rule 1: walk goes at 0 to"),
        ("[[rule]]\nskill = 'walk'\nspeed = [0.1, nan]", "rule 1: walk goes at 0 to"),
        ("[[rule]]\nskill = 'walk'\nwhen = 'weather < 3'", "rule 1: no number 'weather'"),
        ("[[rule]]\nskill = 'walk'\nwhen = 'grip'", "rule 1: 'grip' is no condition"),
        ("[[rule]]\nskill = 'walk'\nuntil = 'turn is nowhere'", "rule 1: no value of turn 'nowhere'"),
        ("[[rule]]\nskill = 'walk'\nwhen = 'grip < 0.5'", "its last rule has no `when`"),
        ("[[rule]]\nskill = 'walk'\nname = \"a\\u0007b\"", "a rule has a name"),
        ("[[rule]]\nskill = 'walk'\nspeed = 'fast'", "speed"),
        ("[[rule]]\nskill = 'walk'\nfaster = 1", "faster"),
        ("[[rule", "policy"),
    ],
)
def test_mistakes_are_told_in_a_sentence(written, content, told):
    with pytest.raises(BadFile) as caught:
        policy_in(written(content), DOG)
    assert told in str(caught.value) and "\n" not in str(caught.value)
