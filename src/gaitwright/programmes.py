"""The driver `programmed`: the joint angles of a gait, worked out when it is first called and then played."""

from dataclasses import dataclass, field

from gaitwright.control.programmed import ProgrammedController
from gaitwright.gait.desired_cycle import Manner, desired_cycle
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle
from gaitwright.model.robot import Robot
from gaitwright.signals import Gait, MotionTarget, MotorCommand, Sensed
from gaitwright.stages import Map, Now

MOST_PROGRAMMES = 64
"""Programmed motions kept; on a long way with changing speeds there is no end of them."""


@dataclass(frozen=True)
class Programmed:
    """Driver `programmed`: every call plays the joint angles of its own undisturbed gait."""

    robot: Robot
    cycles: dict[str, LegCycle] = field(default_factory=dict)
    """Leg cycles by skill, in place of those that come along."""
    known: dict[tuple[Gait, tuple[float, float], float], ProgrammedController] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )
    """Programmes worked out so far: each is a function of its call, so what is here changes no result."""

    def command(
        self, target: MotionTarget, sensed: Sensed, memory: None = None, call: Now = None, ground: Map = None
    ) -> tuple[MotorCommand, None]:
        """What the programme of the call says at the gait's phase."""
        assert call is not None, "a programme belongs to a call"
        return self.programme(call.gait, call.velocity, call.turn).command(target, sensed)

    def programme(self, gait: Gait, velocity: tuple[float, float], turn: float) -> ProgrammedController:
        """The programme of a gait at a velocity [m/s] and yaw rate [rad/s]."""
        motion = gait, velocity, turn
        if motion not in self.known:
            if len(self.known) == MOST_PROGRAMMES:
                self.known.clear()
            cycle = desired_cycle(self.robot, *motion, Manner(cycle=self.cycles.get(gait.name), sways=True))
            self.known[motion] = ProgrammedController(self.robot, cycle.q, cycle.qd, cycle.stance)
        return self.known[motion]
