"""The lap: Measured → Sensed → Route → SkillCall → MotionTarget → MotorCommand. Start reading here.

`think` is one lap through the stages and nothing else; `session.Session` repeats it on a plant.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from time import perf_counter_ns
from types import MappingProxyType
from typing import NamedTuple

from gaitwright.control.alarm import QUIET, Alarm
from gaitwright.control.balance import STEADY, Balance
from gaitwright.control.balance_rules import BalanceRules
from gaitwright.control.comparator import Comparator
from gaitwright.control.handover import begun, softened
from gaitwright.control.kinematic import KinematicController
from gaitwright.control.learned.controller import LearnedController
from gaitwright.control.learned.profile import Profile
from gaitwright.control.numerical import Method, NumericalController
from gaitwright.control.takeover import LEARNED, Takeover
from gaitwright.driving import Driving, Memories, with_gait_in_use
from gaitwright.errors import WrongUse
from gaitwright.gait.coordinator import Coordinator
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle
from gaitwright.gait.operators import Operator
from gaitwright.ground.scene import Scene
from gaitwright.knowledge.rules import Rulebook
from gaitwright.knowledge.trust import Grade
from gaitwright.model.camera import Camera
from gaitwright.model.robot import Robot
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.navigation.navigator import Navigator
from gaitwright.perception.estimated_state import EstimatedState, Sensing
from gaitwright.perception.fault_words import Fault
from gaitwright.perception.known_ground import KnownGround
from gaitwright.perception.seeing import SeeingGround
from gaitwright.perception.told_things import with_things
from gaitwright.perception.watch import Watch
from gaitwright.programmes import Programmed
from gaitwright.signals import (
    GroundMap,
    Measured,
    Mission,
    MotionTarget,
    MotorCommand,
    Route,
    Sensed,
    SkillCall,
)
from gaitwright.skills.chooser import DefaultChooser
from gaitwright.skills.commanded import guarded
from gaitwright.skills.giving_way import GivesWay
from gaitwright.skills.rule_chooser import RuleChooser
from gaitwright.stages import Chooser, Controller, Memory, MotionStage, Navigation, Perception

NO_GRADES: Mapping[str, Grade] = MappingProxyType({})
LOOK_EVERY = 0.1
"""The navigator looks at the route this often [s]."""


@dataclass(frozen=True)
class Brain:
    """The stages of one robot: settings only, nothing that changes while it walks."""

    robot: Robot
    perception: Perception
    navigator: Navigation
    chooser: Chooser
    coordinator: MotionStage
    controllers: dict[str, Controller]
    watch: Watch | None = None
    """Who notices what is broken; `None`: nobody."""
    takeover: Takeover | None = None
    """Who decides who drives in a hybrid; `None`: the numerical controller does."""
    alarm: Alarm | None = None
    """Who notices that the learned controller stumbles; `None`: nobody."""
    balance: Balance | None = None
    """Who answers what is off its profiles by rules; `None`: nobody."""

    @classmethod
    def of(  # noqa: PLR0913 - the door to all settings; most calls name two of these
        cls,
        robot: Robot,
        scene: Scene,
        chooser: Chooser | None = None,
        dt: float = 0.002,
        method: Method = "qp",
        sees: bool = True,
        rulebook: Rulebook | None = None,
        watches: bool = True,
        sensing: Sensing = "true",
        camera: Camera | None = None,
    ) -> "Brain":
        """A brain for a robot in a scene it knows, its torques by the numerical controller.

        `chooser`: by default the plain rules of `skills.chooser`; `dt`: control period [s]; `method`: how
        foot forces are shared, `"qp"` or the thesis's `"lp"`; `sees`: whether feet know the ground ahead;
        `rulebook`: rules that choose the skills in the place of a chooser; `watches`: whether faults of the
        robot are noticed; `sensing`: whether it is told its state or estimates it; `camera`: what it sees
        the ground with, of which it knows nothing else (its plant must have it too: `plant.seeing`).
        """
        if chooser is None:
            chooser = DefaultChooser(robot) if rulebook is None else RuleChooser(robot, rulebook)
        numerical = NumericalController(robot, method)
        perception: Perception
        navigator: Navigation = Navigator(robot)
        if camera is not None:
            perception = SeeingGround.of(scene.bounds, robot, camera, dt if sensing == "estimated" else None)
            navigator = Navigator(robot, perception.noise)
        else:
            known = KnownGround.of(scene, robot, sees)
            told = known if sensing == "true" else EstimatedState(known, robot, dt)
            perception = with_things(told, scene, robot)
        return cls(
            robot,
            perception,
            navigator,
            whole_chooser(chooser, robot, sees),
            Coordinator(robot, dt),
            {
                "numerical": numerical,
                "hybrid": numerical,
                "kinematic": KinematicController(robot),
                "programmed": Programmed(robot),
            },
            Watch(robot, dt) if watches else None,
        )

    def controller(self, driver: str) -> Controller:
        """Who computes the torques. Raises `WrongUse` for a driver that there is not."""
        return self.driving.controller(driver)

    def with_chooser(self, chooser: Chooser) -> "Brain":
        """The same brain with another chooser of skills, held to what the robot can and gives way to."""
        return replace(self, chooser=whole_chooser(chooser, self.robot))

    def with_cycle(self, skill: str, cycle: LegCycle) -> "Brain":
        """The same brain with feet that follow a leg cycle in a skill, whoever computes the torques."""
        assert isinstance(self.coordinator, Coordinator), "a planned climb has no leg cycles"
        coordinator = replace(self.coordinator, cycles={**self.coordinator.cycles, skill: cycle})
        programmed = Programmed(self.robot, dict(coordinator.cycles))
        return replace(
            self, coordinator=coordinator, controllers={**self.controllers, "programmed": programmed}
        )

    def with_profiles(
        self,
        profiles: Mapping[str, Sequence[Profile]],
        grades: Mapping[str, Grade] = NO_GRADES,
        alarmed: bool = False,
    ) -> "Brain":
        """The same brain with a driver `learned`, who plays these profiles by the skill, and in a `hybrid`
        where it knows the case and is trusted with the skill.

        `grades`: how far, by the skill; one without a grade is driven as by a partner. `alarmed`: whether it
        is asked for no velocity while it stumbles. Raises `WrongUse` for profiles of a robot with other legs.
        """
        numerical, coordinator = self.controllers["numerical"], self.coordinator
        assert isinstance(numerical, NumericalController) and isinstance(coordinator, Coordinator)
        learned = LearnedController(self.robot, profiles, numerical)
        controllers = {**self.controllers, LEARNED: learned}
        takeover = Takeover(learned, coordinator.dt, grades) if profiles else None
        alarm = Alarm(self.robot) if profiles and alarmed else None
        return replace(self, controllers=controllers, takeover=takeover, alarm=alarm)

    def with_balance(self, rules: BalanceRules | None) -> "Brain":
        """The same brain with rules of balance for when its profiles are played; `None`: without."""
        learned = self.controllers.get(LEARNED)
        if rules is None or not isinstance(learned, LearnedController):
            return replace(self, balance=None)
        return replace(self, balance=Balance(Comparator(self.robot, learned), rules))

    def with_operators(self, operators: Sequence[Operator]) -> "Brain":
        """The same brain with terrain operators, tried in this order, whoever computes the torques."""
        if not operators:
            return self
        assert isinstance(self.coordinator, Coordinator), "a planned climb has no swings to edit"
        return replace(self, coordinator=replace(self.coordinator, operators=tuple(operators)))

    def with_map(self, known: LearnedMap) -> "Brain":
        """The same brain with what was learned of the ground on earlier trips."""
        return replace(self, navigator=replace(self.explorer, learned=known))

    def with_strategy(self, name: str) -> "Brain":
        """The same brain that chooses its way by another strategy where its map is blank."""
        return replace(self, navigator=replace(self.explorer, strategy=name))

    @property
    def explorer(self) -> Navigator:
        """The navigator of a robot that sees the ground on its way. Raises `WrongUse` where it knows it."""
        if not isinstance(self.navigator, Navigator) or self.navigator.noise is None:
            raise WrongUse("this robot knows the ground: there is nothing to explore")
        return self.navigator

    @cached_property
    def driving(self) -> Driving:
        """Gait and control of this brain."""
        return Driving(self.coordinator, self.controllers, self.takeover, self.alarm, self.balance)

    def begin(
        self, mission: Mission, measured: Measured, phase: float = 0.0, before: "Mind | None" = None
    ) -> "Mind":
        """The mind of a robot that stands as measured and gets a mission.

        `before`: its mind so far, where it is under way: then gait and controller go on as they were.
        """
        sensed, ground, perceived = self.perception.perceive(measured, before and before.memories.perception)
        scan = self.perception.look(ground, sensed)
        remembered = before and before.memories.navigator
        route, travelled = self.navigator.set_out(mission, sensed, ground, scan, remembered)
        call = self.chosen(mission, route, sensed, before and before.call, ground)
        if before is None:
            memories = Memories(perceived, travelled, self.coordinator.begin(sensed, phase))
            return Mind(mission, ground, route, call, memories)
        memories = before.memories._replace(navigator=travelled)  # the next lap perceives what was measured
        return before._replace(mission=mission, ground=ground, route=route, call=call, memories=memories)

    def chosen(
        self, mission: Mission, route: Route, sensed: Sensed, now: SkillCall | None, ground: GroundMap
    ) -> SkillCall:
        """The skill for what lies ahead, with the mission's driver where it names none."""
        call = self.chooser.choose(route, sensed, now, ground)
        return call if call.driver else replace(call, driver=mission.driver)


def whole_chooser(chooser: Chooser, robot: Robot, sees: bool = True) -> Chooser:
    """A chooser that is held to what the robot can do, and gives way to what moves."""
    return GivesWay(guarded(chooser, robot, sees), robot)


class Mind(NamedTuple):
    """What a robot knows and remembers from lap to lap.

    A tuple, as `Lap` is, since one of each is made in every lap: a frozen dataclass takes four times as long.
    """

    mission: Mission
    ground: GroundMap
    """What is known of the ground."""
    route: Route
    call: SkillCall
    memories: Memories
    looked_at: float = -math.inf
    """When the navigator last looked [s]."""
    chosen_at: float = -math.inf
    """When the skill was last chosen [s]."""


class Lap(NamedTuple):
    """One tick: what was sensed and what each stage made of it."""

    sensed: Sensed
    route: Route
    call: SkillCall
    target: MotionTarget
    command: MotorCommand
    took: tuple[float, float]
    """Time for the whole tick, and for gait and control in it [µs]."""
    stopped_because: str | None = None
    """Why the run ends with this lap."""
    arrived: bool = False
    fell: bool = False
    faults: tuple[Fault, ...] = ()
    """What was noticed to be broken so far."""

    @property
    def torques(self) -> MotorCommand:
        """The command, by the name it had before motors could be told more than a torque."""
        return self.command


def think(brain: Brain, mind: Mind, measured: Measured) -> tuple[Lap, Mind]:
    """One lap from what is measured to a command, in the order of the data flow."""
    began = perf_counter_ns()
    sensed, ground, perceived = brain.perception.perceive(measured, mind.memories.perception)
    watch, watched = brain.watch, mind.memories.watch
    if watch is not None:
        sensed, watched = watch.check(measured, sensed, watched)
    mind, travelled = plan_and_choose(brain, mind, sensed, ground)
    before, alarm, handed = mind.memories, brain.alarm, perf_counter_ns()
    driven = brain.driving.tick(before, mind.call, sensed, ground)
    call, target, gait, drive, controller, command, control = driven
    change = before.change
    if before.controller is not controller:
        change = begun(before.command, command, sensed.time)
    if change is not None:
        command, change = softened(command, change, sensed.time, brain.robot.tau_max)
    done = perf_counter_ns()
    lap = Lap(sensed, mind.route, call, target, command, ((done - began) / 1e3, (done - handed) / 1e3))
    if watch is not None and watched is not None:
        watched = watch.heard(watched, target, command, sensed)
        lap = lap._replace(faults=watched.faults) if watched.faults else lap
    heard, steady = QUIET, STEADY
    if alarm is not None and call.driver == LEARNED:
        heard = alarm.listen(target, sensed, before.alarm)
    if brain.balance is not None and call.driver == LEARNED:
        steady = brain.balance.watch(with_gait_in_use(call, gait).gait, target, sensed, before.balance)
    after = (perceived, travelled, gait, control, controller, watched, command, change, drive, heard, steady)
    memories = Memories(*after)
    return lap, Mind(mind.mission, ground, mind.route, mind.call, memories, mind.looked_at, mind.chosen_at)


def plan_and_choose(brain: Brain, mind: Mind, sensed: Sensed, ground: GroundMap) -> tuple[Mind, Memory]:
    """The slower stages: the navigator looks a few times a second and where more of the ground is known, the
    chooser at every cycle and event."""
    now, looked_at, travelled = sensed.time, mind.looked_at, mind.memories.navigator
    route, old, event = mind.route, mind.route, ground.obstacles is not mind.ground.obstacles
    if event or ground.sight is not mind.ground.sight or now - looked_at >= LOOK_EVERY - 1e-9:
        scan = brain.perception.look(ground, sensed) if route.path else None
        onwards = replace(route, blocked=mind.call.blocked) if mind.call.blocked else route
        route, travelled = brain.navigator.plan(onwards, sensed, ground, scan, travelled)
        looked_at, event = now, event or bool(ground.moving)
    event = event or (route is not old and route.is_other_than(old))
    if not event and now - mind.chosen_at < mind.call.gait.period - 1e-9:
        return mind if route is old else mind._replace(route=route, looked_at=looked_at), travelled
    call = brain.chosen(mind.mission, route, sensed, mind.call, ground)
    return mind._replace(route=route, call=call, looked_at=looked_at, chosen_at=now), travelled
