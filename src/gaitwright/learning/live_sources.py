"""What a person teaches at: a mission that runs, or one that was recorded; both are gone through in time."""

import numpy as np

from gaitwright.errors import WrongUse
from gaitwright.knowledge.rules import Rulebook
from gaitwright.learning.decision_point import decision_point
from gaitwright.learning.live import Seen
from gaitwright.model.robot import Robot
from gaitwright.record.moment import call_at, route_at, sensed_at
from gaitwright.record.recording import Recording
from gaitwright.session import Session
from gaitwright.signals import Route, Sensed, SkillCall
from gaitwright.skills.measured import measured
from gaitwright.skills.rule_chooser import RuleChooser

EVERY = 0.2
"""Moments are looked at this often [s]."""


class Running:
    """A mission that runs: the rules drive it, and drive it on by what is kept."""

    def __init__(self, session: Session, name: str) -> None:
        self.session, self.name = session, name

    @property
    def time(self) -> float:
        return self.session.measured.time

    @property
    def over(self) -> str:
        lap = self.session.lap
        return (lap.stopped_because or "") if lap is not None else ""

    def go(self, seconds: float, until_change: bool) -> list[Seen]:
        passed, end, skill = [], self.time + seconds, self.session.mind.call.skill
        next_look = self.time + EVERY
        while not self.over and self.time < end - 1e-9:
            lap = self.session.step()
            if lap is None:
                break
            if self.time >= next_look - 1e-9:
                next_look += EVERY
                passed.append(self.here())
            if until_change and lap.call.skill != skill:
                break
        return passed

    def here(self) -> Seen:
        mind, brain, lap = self.session.mind, self.session.brain, self.session.lap
        first = brain.perception.perceive(self.session.measured, None)[0] if lap is None else lap.sensed
        return seen_at(self.name, self.time, brain.robot, mind.route, first, mind.call)

    def drive_by(self, rulebook: Rulebook) -> None:
        self.session.choose_by(RuleChooser(self.session.brain.robot, rulebook))


class Played:
    """A mission that was recorded: it stays as it was, whatever is taught.

    Raises `WrongUse` for a recording that does not tell what its robot saw.
    """

    def __init__(self, recording: Recording, name: str) -> None:
        self.played, self.name = recording.of_trip().sound(), name
        self.times = np.array(self.played["time"])
        if not len(self.times) or route_at(self.played, 0) is None:
            raise WrongUse(f"{name} is no recording of a mission with what its robot saw on the way")
        self.tick = 0

    @property
    def time(self) -> float:
        return float(self.times[self.tick])

    @property
    def over(self) -> str:
        return "the recording ends here" if self.tick == len(self.times) - 1 else ""

    def go(self, seconds: float, until_change: bool) -> list[Seen]:
        passed, begin, skill = [], self.time, self.here().skill
        while not self.over and self.time < begin + seconds - 1e-9:
            self.tick = int(min(np.searchsorted(self.times, self.time + EVERY - 1e-9), len(self.times) - 1))
            passed.append(self.here())
            if until_change and passed[-1].skill != skill:
                break
        return passed

    def at(self, time: float) -> None:
        """To the recorded moment nearest to a time [s]. Raises `WrongUse` for one that was not recorded."""
        if not self.times[0] <= time <= self.times[-1]:
            raise WrongUse(f"{time:g} s: the recording goes from {self.times[0]:g} to {self.times[-1]:g} s")
        self.tick = int(np.abs(self.times - time).argmin())

    def here(self) -> Seen:
        route, sensed = route_at(self.played, self.tick), sensed_at(self.played, self.tick)
        assert route is not None, "checked when it was opened"
        call = call_at(self.played, self.tick)
        return seen_at(self.name, self.time, self.played.robot, route, sensed, call)

    def drive_by(self, rulebook: Rulebook) -> None:
        """Nothing: what was recorded stays as it was."""


def seen_at(name: str, time: float, robot: Robot, route: Route, sensed: Sensed, call: SkillCall) -> Seen:
    """A moment as a pupil is asked about it: what was measured, and what the robot has been doing."""
    raw = measured(robot, route, sensed, call)
    return Seen(time, decision_point(f"{name} at {time:.2f} s", raw, call), call.skill)
