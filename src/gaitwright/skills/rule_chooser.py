"""Skills by rules: the situation, the rule that fires there, and its skill (row L2; algorithm C)."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from gaitwright.errors import WrongUse
from gaitwright.knowledge.compiled import Compiled, compile_book, decide
from gaitwright.knowledge.forest import Forest, Situation
from gaitwright.knowledge.memory import Action, Fact, applied, remembered
from gaitwright.knowledge.rules import Rulebook, status
from gaitwright.knowledge.trees import ROOT
from gaitwright.model.robot import Robot
from gaitwright.signals import Route, Sensed, SkillCall
from gaitwright.skills.book_trees import in_trees_of, up_to_date
from gaitwright.skills.chooser import DefaultChooser
from gaitwright.skills.library import fastest, find_skill, gait_of, skill_names, speed_scale
from gaitwright.skills.measured import measured
from gaitwright.skills.path_following import approach_speed, heading_error, turn_rate
from gaitwright.skills.situation import named
from gaitwright.skills.vocabulary import RULE_IN_USE
from gaitwright.stages import Map, Now

CAREFUL, NO_GOAL = "goal", ("no goal", "arrived")
"""The tree, and the values of it, at which a rule that was never seen right there moves nothing: where nobody
knows, a robot without a goal stays where it is."""
NOTHING = remembered({})
LACKING, UNSEEN = "wants a skill it does not have", "was never seen right without a goal"


@dataclass(frozen=True, slots=True)
class Ruling:
    """What the rules say: the rule (`None`: none fires), how sure, and whether it only goes on (`until`)."""

    rule: str | None
    sure: bool
    kept: bool
    situation: Situation


@dataclass(frozen=True)
class RuleChooser:
    """Chooses the skills of one robot by a rulebook; where no rule fires, by the plain rules."""

    robot: Robot
    rulebook: Rulebook

    def __post_init__(self) -> None:
        """Brings an older rulebook up to date. Raises `WrongUse` for one over other trees, or an
        until-condition that asks for none."""
        object.__setattr__(self, "rulebook", up_to_date(self.rulebook))
        for rule in self.rulebook.rules:
            check_until(self.rulebook.forest, rule.action)

    def choose(self, route: Route, sensed: Sensed, now: Now = None, ground: Map = None) -> SkillCall:
        """The skill for what lies ahead; `now` is the one in use."""
        raw = measured(self.robot, route, sensed, now)
        memory = remembered(now.memory if now is not None else {})
        ruling = self.ruling(self.situation(raw, now, memory), memory)
        action = self.actions.get(ruling.rule or "")
        if action is None or action.skill not in skill_names(self.robot.n):
            return self.fallen_back(route, sensed, now, ruling)
        if not self.is_safe(ruling, action):
            return self.fallen_back(route, sensed, now, ruling, UNSEEN)
        kept = {**applied(action, memory), RULE_IN_USE: str(ruling.rule)}
        call = carry_out(self.robot, action, route, sensed)
        is_firm = ruling.rule in self.firm
        return replace(call, because=self.because(ruling), memory=kept, firm=is_firm, ruled=True)

    def ruling(self, situation: Situation, memory: Mapping[str, Fact]) -> Ruling:
        """The rule for a situation: the one in use until its condition holds, else the first that fires."""
        doing = str(memory.get(RULE_IN_USE, ""))
        action = self.actions.get(doing)
        if goes_on(self.rulebook.forest, action, situation):
            return Ruling(doing, True, True, situation)
        rule, sure = decide(self.compiled, dict(situation.items()))  # pyright: ignore[reportArgumentType]
        return Ruling(rule, sure and rule in self.firm, False, situation)

    def is_safe(self, ruling: Ruling, action: Action) -> bool:
        """Whether a rule may move the robot: only where it was seen right with such a goal. A wish to move is
        not enough."""
        if find_skill(action.skill, self.robot).duty >= 1.0:
            return True
        forest, rule = self.rulebook.forest, self.rulebook[str(ruling.rule)]
        seen = rule.marks_in(CAREFUL).lower if CAREFUL in forest.names else None
        here = ruling.situation[CAREFUL] if CAREFUL in forest.names else None
        return here not in NO_GOAL or (seen is not None and forest[CAREFUL].is_below(str(here), seen))

    def situation(
        self, raw: Mapping[str, float], now: SkillCall | None, memory: Mapping[str, Fact] = NOTHING
    ) -> Situation:
        """The situation in the rulebook's own trees: those of today and those it grew since."""
        return in_trees_of(self.rulebook, named(raw, now), {**memory, **raw})

    def because(self, ruling: Ruling) -> str:
        """Why, as a sentence: the rule and how sure it is."""
        if ruling.kept:
            return f"rule {ruling.rule}: it goes on until {self.actions[str(ruling.rule)].until}"
        certainty = "sure" if ruling.sure else "not seen just like this before"
        return f"rule {ruling.rule}: {certainty}"

    def fallen_back(
        self, route: Route, sensed: Sensed, now: SkillCall | None, ruling: Ruling, because: str = LACKING
    ) -> SkillCall:
        """What the plain rules say, and why they were asked."""
        call = DefaultChooser(self.robot).choose(route, sensed, now)
        asked = "no rule fires" if ruling.rule is None else f"rule {ruling.rule} {because}"
        kept = {name: fact for name, fact in (now.memory if now else {}).items() if name != RULE_IN_USE}
        return replace(call, because=f"{asked}; plainly: {call.because}", memory=kept)

    @cached_property
    def firm(self) -> set[str]:
        """The rules that were right often and widely enough for their word to be taken."""
        return {rule.name for rule in self.rulebook.rules if status(rule) in ("stabilised", "firm")}

    @cached_property
    def compiled(self) -> Compiled:
        return compile_book(self.rulebook)

    @cached_property
    def actions(self) -> dict[str, Action]:
        return {rule.name: rule.action for rule in self.rulebook.rules}


def carry_out(robot: Robot, action: Action, route: Route, sensed: Sensed) -> SkillCall:
    """An action on this robot and route: as fast as wished within its range, slower before the goal.

    The speeds of an action are those of a robot 0.29 m tall [m/s]; a larger one goes faster.
    """
    skill, scale = find_skill(action.skill, robot), speed_scale(robot)
    error = heading_error(route, sensed) if route.path else 0.0
    most = min(action.fastest * scale, fastest(skill, robot))
    speed = min(most, max(approach_speed(robot, route), min(action.slowest * scale, room(robot, route))))
    speed *= max(0.0, math.cos(error)) if skill.way == (1.0, 0.0) else 1.0
    turn = turn_rate(robot, error) if route.path and skill.duty < 1.0 else 0.0
    velocity = (speed * skill.way[0], speed * skill.way[1])
    return SkillCall(skill.name, gait_of(skill, robot), velocity, turn)


def room(robot: Robot, route: Route) -> float:
    """The fastest speed that leaves time to stop at the goal [m/s]."""
    return approach_speed(robot, replace(route, speed=math.inf))


def goes_on(forest: Forest, action: Action | None, situation: Situation) -> bool:
    """Whether an action that was begun goes on: there is somewhere to go, and its condition does not hold."""
    if action is None or not action.until or situation["goal"] in NO_GOAL:
        return False
    tree, mark = condition(action.until)
    here = situation[tree]
    return here is not None and not forest[tree].is_below(here, mark)


def condition(until: str) -> tuple[str, str]:
    """Tree and mark of "TREE is VALUE", or "TREE is VALUE or VALUE", as a mark may name several. Raises
    `WrongUse` for any other text."""
    tree, is_, mark = until.partition(" is ")
    if not is_:
        raise WrongUse(f"{until!r} is no condition; write e.g. 'turn is straight on'")
    return tree, mark


def check_until(forest: Forest, action: Action) -> None:
    """`WrongUse` where an action goes on until something that can never be."""
    if action.until:
        tree, mark = condition(action.until)
        if forest[tree].leaf_set(mark) == forest[tree].leaf_set(ROOT):
            raise WrongUse(f"{action.skill}: until {action.until!r} is true at once")
