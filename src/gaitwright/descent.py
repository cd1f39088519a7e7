"""After a trip: the robot comes to a stand, is let down, and its motors go off.

It belongs to no trip: a report says nothing of it, a recording shows it. Where something is broken that
nobody can walk with, it is let down at once, on dampers alone.
"""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from gaitwright.control.lowering import Lowering
from gaitwright.locomotion import Brain, Lap, Mind, think
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.perception.fault_words import ends_trip
from gaitwright.signals import Measured
from gaitwright.skills.chooser import fixed_skill
from gaitwright.stages import Plant
from gaitwright.termination import STILL

STOPS = 3.0
"""A robot may take so long to come to a stand, times √(height / 1 m) [s]."""
SKILL = "lie-down"
"""What a recording calls it."""


def can_descend(lap: Lap, measured: Measured) -> bool:
    """Whether there is a robot on its feet that can be let down."""
    return not lap.fell and measured.is_finite() and bool(np.isfinite(lap.command.tau).all())


def descent(brain: Brain, plant: Plant, mind: Mind, last: Lap, measured: Measured) -> Iterator[Lap]:
    """Steps a plant until the robot lies; its laps say what the `last` one of the trip says of its end."""
    stops = () if ends_trip(last.faults) else stopping(brain, plant, mind, last, measured)
    for lap, then in stops:
        last, measured = lap, then
        yield lap
    way = Lowering(brain.robot, plant.dt, measured, last.command, limp=ends_trip(last.faults))
    call, begun = replace(last.call, skill=SKILL), measured.time
    while (passed := measured.time - begun) < way.lasts and measured.is_finite():
        told = way.command(passed)
        given = way.given(told, measured)
        yield last._replace(sensed=measured, call=call, command=given, took=(0.0, 0.0))
        measured = plant.step(told)


def stopping(
    brain: Brain, plant: Plant, mind: Mind, last: Lap, measured: Measured
) -> Iterator[tuple[Lap, Measured]]:
    """Laps, each with what is measured after it, in which a robot comes to stand on all its feet."""
    stand = fixed_skill(brain.robot, "stand", 0.0, 0.0, 0.0, last.call.driver)
    brain, mind = replace(brain, chooser=stand), mind._replace(chosen_at=-math.inf)
    slow = STILL * math.sqrt(GRAVITY * brain.robot.height)
    until = measured.time + STOPS * math.sqrt(brain.robot.height)
    while measured.time < until and measured.is_finite():
        lap, mind = think(brain, mind, measured)
        stands = lap.target.stance.all() and math.hypot(*lap.sensed.velocity_w[:2]) < slow
        if not (stands or ends_trip(lap.faults)):
            measured = plant.step(lap.command)
        ending = {"stopped_because": last.stopped_because, "arrived": last.arrived, "fell": last.fell}
        yield lap._replace(took=(0.0, 0.0), **ending), measured
        if stands or ends_trip(lap.faults):
            return
