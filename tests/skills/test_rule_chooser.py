"""Skills by rules: the rule's skill at a speed within its range, until its condition, with its reason."""

import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_chooser import DOG, angles, places, route, sensed

from gaitwright.errors import WrongUse
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.rules import QUIET, Rulebook
from gaitwright.knowledge.trees import tree
from gaitwright.signals import Scan
from gaitwright.skills.chooser import DefaultChooser
from gaitwright.skills.library import speed_scale
from gaitwright.skills.measured import measured
from gaitwright.skills.rule_chooser import RuleChooser, carry_out
from gaitwright.skills.situation import FOREST, named
from gaitwright.skills.vocabulary import RULE_IN_USE
from knowledge.hand_made import rule_of
from oracles import robot_called

AHEAD = route((5.0, 0.0), speed=0.4 * speed_scale(DOG))
STAIRS = replace(AHEAD, ahead=Scan(slope=0.3, step_up=0.3 * DOG.height))
SIDEWAYS = route((0.0, 5.0))
TURN = Action("turn-in-place", until="turn is straight on", adds=(("turns", 1.0),))


def situation(robot, way, here):
    return named(measured(robot, way, here))


def taught(*rules: tuple[Action, object, dict[str, str]]) -> Rulebook:
    """Rules that were seen right on a way each, with their upper marks."""
    made = []
    for action, way, upper in rules:
        rule = rule_of(FOREST, action.skill, upper, {"seen": situation(DOG, way, sensed())}, action=action)
        made.append(replace(rule, quiet=QUIET))
    return Rulebook(FOREST, tuple(made))


BOOK = taught(
    (TURN, SIDEWAYS, {"turn": "off the way"}),
    (Action("climb", 0.1, 0.3), STAIRS, {"road": "up"}),
    (Action("trot", 0.2, 0.6), AHEAD, {}),
)
RULES = RuleChooser(DOG, BOOK)


def test_each_lesson_is_what_it_then_does_and_it_says_by_which_rule():
    for way, skill in ((AHEAD, "trot"), (STAIRS, "climb"), (SIDEWAYS, "turn-in-place")):
        call = RULES.choose(way, sensed())
        assert (call.skill, call.because, call.memory[RULE_IN_USE]) == (skill, f"rule {skill}: sure", skill)
    grey = RULES.choose(replace(AHEAD, ahead=Scan(familiar=True)), sensed())
    assert grey.skill == "trot" and "not seen just like this" in grey.because


@given(places, angles, st.floats(0.05, 2.0), st.floats(0.0, 20.0))
def test_the_rule_is_the_one_that_consulting_finds(place, yaw, speed, left):
    way, here = route((5.0, 0.0), speed=speed, remaining=left), sensed(place, yaw)
    decision, call = consult(BOOK, situation(DOG, way, here)), RULES.choose(way, here)
    assert call.memory.get(RULE_IN_USE) == decision.rule
    assert ("sure" in call.because) == (decision.certainty == "sure")


@given(st.floats(0.05, 2.0), st.floats(0.0, 20.0), st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_it_goes_as_fast_as_wished_within_the_rule_and_slower_before_the_goal(wish, left, a, b):
    slow, fast = sorted((a, b))
    way = route((5.0, 0.0), speed=wish, remaining=left)
    call = carry_out(DOG, Action("trot", slow, fast), way, sensed())
    k = speed_scale(DOG)
    brake = max(0.1 * k, 0.6 / k * left)
    assert call.velocity == (pytest.approx(min(fast * k, max(wish, slow * k), brake)), 0.0)


def test_what_was_begun_goes_on_until_its_condition_holds():
    turning = RULES.choose(SIDEWAYS, sensed())
    near = sensed(yaw=math.radians(65.0))  # 25° off: no rule was taught to turn on the spot there
    assert RULES.choose(SIDEWAYS, near).skill != "turn-in-place"
    on = RULES.choose(SIDEWAYS, near, turning)
    assert on.skill == "turn-in-place" and "until turn is straight on" in on.because
    assert on.memory["turns"] == 1.0
    assert RULES.choose(SIDEWAYS, sensed(yaw=math.radians(85.0)), on).skill == "trot"
    assert RULES.choose(replace(SIDEWAYS, arrived=True), near, on).skill != "turn-in-place"


@given(places, angles)
def test_where_no_rule_fires_the_plain_rules_do_and_that_is_said(place, yaw):
    here = sensed(place, yaw)
    call, plainly = (
        RuleChooser(DOG, Rulebook(FOREST)).choose(AHEAD, here),
        DefaultChooser(DOG).choose(AHEAD, here),
    )
    assert (call.skill, call.velocity, call.turn) == (plainly.skill, plainly.velocity, plainly.turn)
    assert call.because == f"no rule fires; plainly: {plainly.because}"


def test_a_skill_that_a_robot_lacks_is_left_to_the_plain_rules():
    hexapod = robot_called("hexapod")
    run = Action("run", 0.1, 2.0)
    seen = {"seen": situation(hexapod, AHEAD, six())}
    book = Rulebook(FOREST, (rule_of(FOREST, "run", right=seen, action=run),))
    call = RuleChooser(hexapod, book).choose(replace(AHEAD, speed=0.1), six())
    assert call.skill in ("walk", "trot") and "wants a skill it does not have" in call.because


def six():
    import numpy as np

    return replace(sensed(), q=np.zeros((6, 3)), qd=np.zeros((6, 3)), load=np.ones(6))


def test_books_about_something_else_and_conditions_that_are_none_are_refused():
    other = Rulebook(Forest((tree("weather", ("dry", "wet")),)))
    with pytest.raises(WrongUse, match="knows nothing of support"):
        RuleChooser(DOG, other)
    for until, told in (
        ("straight", "is no condition"),
        ("turn is any", "is true at once"),
        ("turn is round", "no value of turn"),
    ):
        with pytest.raises(WrongUse, match=told):
            RuleChooser(DOG, taught((Action("trot", 0.1, 0.5, until=until), AHEAD, {})))
