"""An edit that takes effect at the next cycle, without a leap of any foot."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from gaitwright.control.alarm import Alarm
from gaitwright.control.balance import Balance
from gaitwright.control.takeover import Takeover
from gaitwright.errors import WrongUse
from gaitwright.gait.coordinator import Coordinator, Cycle
from gaitwright.gait.leg_cycles.files import cycle_of
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle, tabulated_legs
from gaitwright.gait.operators import Operator
from gaitwright.gait.state import SWING, GaitState, state_of
from gaitwright.locomotion import Brain
from gaitwright.session import Session
from gaitwright.signals import Gait
from gaitwright.stages import Controller


class Parts(NamedTuple):
    """What edits change in a brain."""

    coordinator: Coordinator
    controllers: dict[str, Controller]
    takeover: Takeover | None
    alarm: Alarm | None
    balance: Balance | None

    @classmethod
    def of(cls, brain: Brain) -> "Parts":
        """Those of a brain. Raises `WrongUse` for one that does not go by leg cycles."""
        if not isinstance(brain.coordinator, Coordinator):
            raise WrongUse("a climb that was planned ahead has no curves to edit")
        return cls(brain.coordinator, brain.controllers, brain.takeover, brain.alarm, brain.balance)

    def within(self, brain: Brain) -> Brain:
        """A brain with these parts."""
        return replace(brain, **self._asdict())


@dataclass(frozen=True)
class Changing(Coordinator):
    """A coordinator amid a change of leg cycles: legs in the air go on along the path they are on."""

    before: Mapping[str, LegCycle] = field(default_factory=dict)
    """Leg cycles by skill, as `cycles` was."""
    late: tuple[bool, ...] = ()
    """Which legs are still in the air."""

    def cycle(self, gait: Gait) -> Cycle:
        """The cycle of a gait, with the older paths of late legs."""
        cycle = super().cycle(gait)
        old = tabulated_legs(self.before.get(gait.name) or cycle_of(gait.name), self.robot.n)
        late = np.array(self.late)[:, None, None]
        return cycle._replace(legs=np.where(late, old, cycle.legs))


class Change:
    """What waits to be changed in a session, and is under way; the newest wish counts."""

    def __init__(self) -> None:
        self.wanted: Parts | None = None
        self.under_way: Parts | None = None
        self.before: Mapping[str, LegCycle] = {}
        self.late: tuple[bool, ...] = ()
        self.phase = 0.0

    @property
    def is_pending(self) -> bool:
        """Whether something was asked for that no leg, or not every leg, follows yet."""
        return self.wanted is not None or self.under_way is not None

    def ask(self, parts: Parts) -> None:
        """These parts from the next cycle on."""
        self.wanted = parts

    def drop(self) -> None:
        """Nothing is waited for any more: the run is over, and the next one begins with all edits."""
        self.wanted = self.under_way = None

    def after(self, session: Session) -> None:
        """Goes on with the change; to be called after every step, and before the first one."""
        if self.is_pending:
            state = session.mind.memories.gait.state
            if self.under_way is None and self.wanted is not None and self.is_time(session, state):
                self.under_way, self.wanted = self.wanted, None
                now = Parts.of(session.brain).coordinator
                self.before, self.late = now.cycles, (True,) * len(state.mode)
                renumber(session, now.operators, self.under_way.coordinator.operators)
            if self.under_way is not None:
                self.go_on(session, state)
        if session.lap is not None:
            self.phase = session.lap.target.phase

    def is_time(self, session: Session, state: GaitState) -> bool:
        """Whether a new cycle begins, or none is under way; a leg that is amid a terrain operator which goes
        is waited for."""
        assert self.wanted is not None
        if session.lap is None or session.is_over or session.closed:
            return True
        now = Parts.of(session.brain).coordinator.operators
        under = {id(now[int(number) - 1]) for number in state.operator if number > 0.0}
        if not under <= {id(one) for one in self.wanted.coordinator.operators}:
            return False
        begins = float(state.phase[0]) < self.phase
        return begins or bool(state.clock[1] >= 1.0)

    def go_on(self, session: Session, state: GaitState) -> None:
        """Gives every leg that is on the ground the new path."""
        assert self.under_way is not None
        late = tuple((self.late & (state.mode == SWING)).tolist())
        if late == self.late and any(late):
            return
        self.late, parts = late, self.under_way
        if any(late):
            fields = ("robot", "dt", "cycles", "operators", "imagined")
            own = {name: getattr(parts.coordinator, name) for name in fields}
            parts = parts._replace(coordinator=Changing(**own, before=self.before, late=late))
        else:
            self.under_way = None
        session.brain = parts.within(session.brain)


def renumber(session: Session, before: Sequence[Operator], after: Sequence[Operator]) -> None:
    """Legs that are amid a terrain operator stay with it where it has another number from now on."""
    memory = session.mind.memories.gait
    if before == after or memory.state.operator.max() <= 0.0:
        return
    places = {id(one): place for place, one in enumerate(after, start=1)}
    row = memory.row.copy()
    numbers = state_of(row).operator
    for leg in np.flatnonzero(numbers > 0.0):
        numbers[leg] = places.get(id(before[int(numbers[leg]) - 1]), 0.0)
    memories = session.mind.memories._replace(gait=memory._replace(row=row))
    session.mind = session.mind._replace(memories=memories)
