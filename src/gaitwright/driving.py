"""SkillCall + Sensed → MotionTarget + MotorCommand: gait, who drives, and control, in one tick.

In the order of the data flow they come one by one; where profiles are played, gait and control are one
compiled call (`one_call`), with the same outcome.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

from gaitwright.control.alarm import QUIET, Alarm, Heard
from gaitwright.control.balance import STEADY, Balance, Balanced
from gaitwright.control.handover import Handover
from gaitwright.control.learned.controller import LearnedController
from gaitwright.control.takeover import HYBRID, LEARNED, UNDECIDED, Drive, Takeover
from gaitwright.errors import unknown
from gaitwright.gait.coordinator import Coordinator
from gaitwright.one_call import OneCall
from gaitwright.perception.watch import WatchMemory
from gaitwright.signals import Gait, GroundMap, MotionTarget, MotorCommand, Sensed, SkillCall
from gaitwright.stages import Controller, Memory, MotionStage


class Memories(NamedTuple):
    """What each stage handed back for the next lap."""

    perception: Memory
    navigator: Memory
    gait: Memory
    control: Memory = None
    controller: Controller | None = None
    """Whose memory `control` is: another one begins anew."""
    watch: WatchMemory | None = None
    command: MotorCommand | None = None
    """The last one: another driver goes on from it."""
    change: Handover | None = None
    """The change of driver that is under way."""
    drive: Drive = UNDECIDED
    """Who drives, in a hybrid."""
    alarm: Heard = QUIET
    balance: Balanced = STEADY


Driven = tuple[SkillCall, MotionTarget, Memory, Drive, Controller, MotorCommand, Memory]
"""What gait and control made of a call: the call with who drives it, the target, the gait's memory, who
drives, the controller, its command and memory. A plain tuple, as one is made in every lap."""


@dataclass(frozen=True)
class Driving:
    """Gait and control of one robot."""

    coordinator: MotionStage
    controllers: Mapping[str, Controller]
    takeover: Takeover | None
    """Who decides who drives in a hybrid; `None`: the numerical controller does."""
    alarm: Alarm | None = None
    """Who asks a robot that stumbles to go no farther; `None`: nobody."""
    balance: Balance | None = None
    """Who answers what is off by rules; `None`: nobody."""

    def controller(self, driver: str) -> Controller:
        """Who computes the torques. Raises `WrongUse` for a driver that there is not."""
        if driver not in self.controllers:
            raise unknown("driver", driver, self.controllers)
        return self.controllers[driver]

    @cached_property
    def one_call(self) -> OneCall | None:
        """Gait and learned controller in one; `None` where either is another one, or nothing was taught."""
        coordinator, learned = self.coordinator, self.controllers.get(LEARNED)
        if type(coordinator) is not Coordinator or type(learned) is not LearnedController:
            return None
        return OneCall(coordinator, learned)

    def tick(self, before: Memories, call: SkillCall, sensed: Sensed, ground: GroundMap) -> Driven:
        """One tick. `before`: what each stage handed back in the one before."""
        wanted = call if self.balance is None else self.balance.answered(call, before.balance)
        if LEARNED in (call.driver, before.drive.driver) and not before.alarm.rings:
            driven = self.at_once(before, call, wanted, sensed, ground)
            if driven is not None:
                return driven
        return self.one_by_one(before, call, wanted, sensed, ground)

    def one_by_one(
        self, before: Memories, call: SkillCall, wanted: SkillCall, sensed: Sensed, ground: GroundMap
    ) -> Driven:
        """Gait, then who drives, then control. `wanted`: the call as balance has the gait asked for it."""
        wanted = wanted if self.alarm is None else self.alarm.calmed(wanted, before.alarm)
        target, gait = self.coordinator.move(before.gait, wanted, sensed, ground)
        used = with_gait_in_use(call, gait)
        drive = self.driver_of(call, used.gait, target, sensed.time, before)
        call = drive.call or call
        controller = self.controller(call.driver)
        own = before.control if before.controller is controller else None
        command, control = controller.command(target, sensed, own, used, ground)
        return call, target, gait, drive, controller, command, control

    def driver_of(
        self, call: SkillCall, gait: Gait, target: MotionTarget, time: float, before: Memories
    ) -> Drive:
        """Who drives a call, in a hybrid; else nothing is decided."""
        if self.takeover is None or call.driver != HYBRID:
            return UNDECIDED
        if before.alarm.rings:
            return self.takeover.kept(call, before.drive)
        return self.takeover.decide(call, gait, target, time, before.drive, before.control)

    def at_once(
        self, before: Memories, call: SkillCall, wanted: SkillCall, sensed: Sensed, ground: GroundMap
    ) -> Driven | None:
        """The same in one compiled call; `None` where somebody else drives than the learned controller.

        In a hybrid it is taken to go on where it drove the tick before, and then decided.
        """
        one, takeover, drive = self.one_call, self.takeover, UNDECIDED
        if one is None or call.driver not in (LEARNED, HYBRID):
            return None
        tick = one.tick(before.gait, wanted, sensed, ground)
        if tick is None:
            return None
        target, gait, command, played, is_known = tick
        if call.driver == HYBRID:
            if takeover is None or gait.gait is None:
                return None
            is_known = is_known and takeover.trusts(call, gait.gait)
            drive = takeover.decided(call, gait.gait, is_known, sensed.time, before.drive, before.control)
            if drive.driver != LEARNED:
                return None
        return drive.call or call, target, gait, drive, one.learned, command, played


def with_gait_in_use(call: SkillCall, memory: Memory) -> SkillCall:
    """The call with the gait that the legs are in: the coordinator may hold an older one for a while."""
    used = getattr(memory, "gait", None)
    return call if used is None or used is call.gait else replace(call, gait=used)
