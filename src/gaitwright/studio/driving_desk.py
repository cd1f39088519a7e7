"""Where a person says where to go, by which skill, and who drives; a composed motion is played here too."""

from collections.abc import Callable
from time import monotonic
from typing import Any

from gaitwright.errors import WrongUse
from gaitwright.studio import messages as m
from gaitwright.studio.composing import Score
from gaitwright.studio.live_run import LiveRun
from gaitwright.studio.teaching_desk import TeachingDesk

WATCHDOG = 0.3
"""A steering person who was not heard for so long has let go [s]."""


class DrivingDesk:
    """Who steers, when she was heard last, and what she composes. `teaching` hears what she shows."""

    run: LiveRun

    def __init__(self, teaching: TeachingDesk, say: Callable[[dict[str, Any]], None]) -> None:
        self.teaching, self.say = teaching, say
        self.mode: m.Mode = "plan"
        self.score = Score()
        self.does: dict[type[m.Message], Callable[[Any], dict[str, Any] | None]] = {
            m.Go: self.go, m.Steer: self.steer, m.Stand: self.stand, m.Skill: self.skill,
            m.Drive: self.drive, m.SetMode: self.set_mode, m.Abort: self.abort, m.Push: self.push,
            m.Compose: self.compose, m.Play: self.play,
        }  # fmt: skip

    def attend(self, run: LiveRun) -> None:
        """From now on it is about this run; a motion that was composed can be played in it, too."""
        if self.score.begun is not None:
            self.score.end(self.run.time)
        self.score.stop()
        self.run = run
        self.steered_at: float | None = None
        """When the person who steers was heard last; `None`: nobody steers."""

    def status(self) -> dict[str, Any]:
        """What is so now."""
        score, now = self.score, self.run.time
        return {
            "mode": self.mode,
            "composing": score.begun is not None,
            "playing": score.is_playing,
            "composed": len(score.words),
            "composed_seconds": round(score.seconds(now), 2),
            "played_seconds": round(score.played(now), 2),
        }

    # --- time ---------------------------------------------------------------------------------------
    def watch_over(self) -> None:
        """Stops a robot whose steering person is gone."""
        is_heard = self.steered_at is None or monotonic() - self.steered_at <= WATCHDOG
        if not is_heard and not self.score.is_playing and self.run.over is None:
            self.stand(m.Stand())
            self.score.hear(self.run.time, m.Stand())

    def after(self) -> None:
        """To be called after every lap: does what a composed motion asks for now; what cannot be done ends
        it. At its end the robot stands, unless it is on its way to a goal."""
        if self.run.over is not None:
            self.score.stop()
        if not self.score.is_playing:
            return
        for message in self.score.due(self.run.time):
            try:
                self.does[type(message)](message)
            except WrongUse as error:
                self.score.stop()
                self.say({"say": "remark", "sentence": f"the motion ends here: {error}"})
                return
        if self.score.is_played(self.run.time):
            self.score.stop()
            if not isinstance(self.score.words[-1][1], m.Go):
                self.stand(m.Stand())
            self.say({"say": "remark", "sentence": "the motion was played"})

    # --- what is asked ------------------------------------------------------------------------------
    def go(self, said: m.Go) -> None:
        self.steered_at = None
        self.run.go(said.x, said.y, said.then)
        self.run.note("mode", f"{'then ' if said.then else ''}to ({said.x:.2f}, {said.y:.2f})")

    def steer(self, said: m.Steer) -> None:
        self.run.steer(said.forward, said.left, said.turn)
        if self.steered_at is None:
            self.run.note("mode", "a person steers")
        self.steered_at = monotonic()

    def stand(self, said: m.Stand) -> None:
        self.steered_at = None
        self.run.steer(0.0, 0.0, 0.0)

    def skill(self, said: m.Skill) -> None:
        self.steered_at = None
        if not said.name:
            self.run.let_choose()
            self.run.note("mode", "rules choose")
            return
        shown = self.shown(said) if self.mode == "apprentice" else None
        self.run.hold(said.name, said.speed)
        self.run.note("mode", f"skill {said.name} is held")
        if shown is not None:
            self.teaching.propose(shown)

    def shown(self, said: m.Skill) -> dict[str, Any] | None:
        """What it would do to learn what she does here, which may be right here: she says whether. Where it
        cannot be a lesson it is done all the same."""
        try:
            return self.teaching.right(m.Right(skill=said.name, speed=said.speed))
        except WrongUse as error:
            self.say({"say": "remark", "sentence": f"this is no lesson: {error}"})
            return None

    def drive(self, said: m.Drive) -> None:
        self.run.drive(said.driver)
        self.run.note("mode", f"driver {said.driver}")

    def set_mode(self, said: m.SetMode) -> None:
        self.mode = said.mode
        self.run.note("mode", f"mode {said.mode}")

    def abort(self, said: m.Abort) -> None:
        self.steered_at = None
        self.score.stop()
        self.run.note("mode", "aborted")
        self.run.abort()

    def push(self, said: m.Push) -> None:
        self.run.push(said.impulse, said.direction)
        self.run.note("world", f"pushed by {said.impulse:.2f} N·s/kg")

    def compose(self, said: m.Compose) -> dict[str, Any] | None:
        self.run.note("mode", "a motion is composed" if said.on else "the motion is whole")
        if said.on:
            self.score.begin(self.run.time)
            return None
        return {"words": self.score.end(self.run.time)}

    def play(self, said: m.Play) -> dict[str, Any]:
        self.run.check_going()
        seconds = self.score.play(self.run.time)
        self.run.note("mode", f"the motion is played, {seconds:.1f} s")
        return {"seconds": seconds}
