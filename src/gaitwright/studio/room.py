"""What a person asks for → the run, and what is told of it: the studio without a page, a clock or a network.

A `Room` hears messages and says things; whoever runs it (`host`) gives it time. So a test can talk to it
directly.
"""

import math
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from threading import Thread
from time import monotonic
from typing import Any

from gaitwright.errors import WrongUse
from gaitwright.ground.terrain import Box
from gaitwright.navigation.travel import Travel
from gaitwright.record.previews import preview_of
from gaitwright.record.recording import Recorder
from gaitwright.session import DT
from gaitwright.signals import GroundMap
from gaitwright.skillbook.writer import Ledger
from gaitwright.skills.library import skill_names
from gaitwright.studio import messages as m
from gaitwright.studio.composing import Score
from gaitwright.studio.frames import columns_of, frame_of, row_of
from gaitwright.studio.lessons import Lessons
from gaitwright.studio.live_run import LiveRun
from gaitwright.studio.page_build import PAGE
from gaitwright.studio.recordings import Shelf
from gaitwright.studio.replay import TEMPLATE, write_replay
from gaitwright.studio.setup import DRIVERS, Setup
from gaitwright.studio.shown import scan_shown, seen_shown, things_shown, world_shown
from gaitwright.studio.status import status_of

WATCHDOG = 0.3
"""A steering person who was not heard for so long has let go [s]."""
SEES = 6.0
"""So far around the robot what it knows of the ground is shown [m]."""

WENT_ON = 0.25
"""It is shown again where the robot has gone so far [m]."""

Say = Callable[[dict[str, Any]], None]
Answer = dict[str, Any] | None


class Room:
    """A run, a book's pupil, and the person who drives them. `say` is told what everybody should know."""

    def __init__(self, setup: Setup, ledger: Ledger, folder: Path, say: Say) -> None:
        self.ledger, self.say = ledger, say
        self.lessons = Lessons(ledger)
        self.shelf = Shelf(folder)
        self.mode: m.Mode = "plan"
        self.paused, self.pace = False, 1.0
        self.writer: Thread | None = None
        """Who writes the last recording as a page."""
        self.steered_at: float | None = None
        """When the person who steers was heard last; `None`: nobody steers."""
        self.begin(setup)
        self.does: dict[type[m.Message], Callable[[Any], Answer]] = {
            m.Go: self.go, m.Steer: self.steer, m.Stand: self.stand, m.Skill: self.skill,
            m.Drive: self.drive, m.SetMode: self.set_mode, m.Pause: self.pause, m.Resume: self.resume,
            m.Step: self.step, m.Pace: self.set_pace, m.Abort: self.abort, m.Reset: self.reset,
            m.Push: self.push, m.PlaceBox: self.place, m.Move: self.move, m.Remove: self.remove,
            m.Record: self.record, m.Recordings: self.recordings, m.Right: self.right, m.Ok: self.ok,
            m.Keep: self.keep, m.Back: self.back, m.Forget: self.forget, m.Why: self.why,
            m.Order: self.order, m.Compose: self.compose, m.Play: self.play,
        }  # fmt: skip

    def begin(self, setup: Setup) -> None:
        """A run from its start. Raises `WrongUse` or `BadFile`; then the one before goes on."""
        run = LiveRun(setup, self.ledger)
        self.run, self.ticks, self.score = run, Counter[str](), Score()
        self.steered_at = None
        self.shown: tuple[GroundMap | None, tuple[float, float]] = None, (0.0, 0.0)
        """What was known of the ground when it was shown last, and where the robot was."""

    def welcome(self) -> None:
        """Says all that one who comes in has to know."""
        self.lessons.warm_up(self.run.lesson)
        run = self.run
        self.say(
            {
                "say": "hello",
                "version": 1,
                "columns": columns_of(run.robot.n),
                "choices": {
                    "drivers": list(DRIVERS),
                    "modes": list(m.MODES),
                    "skills": list(skill_names(run.robot.n)),
                },
            }
        )
        self.say_world()
        self.say(self.lessons.rules_shown())
        self.say(self.status())

    def hears(self, message: m.Message) -> Answer:
        """Does what is asked; what is answered beside that it is done. Raises `GaitwrightError`."""
        if type(message) not in self.does:
            raise WrongUse(f"{message.__struct_config__.tag} is not done here")
        answer = self.does[type(message)](message)
        self.score.hear(self.run.time, message)
        return answer

    # --- time ---------------------------------------------------------------------------------------
    def lap(self) -> bool:
        """One control period; whether there was one."""
        lap = self.run.step()
        if lap is None:
            return False
        self.ticks[lap.call.driver or self.run.driver] += 1
        if self.score.playing:
            self.play_on()
        return True

    def play_on(self) -> None:
        """Does what a composed motion asks for now; what cannot be done ends it."""
        for message in self.score.due(self.run.time):
            try:
                self.does[type(message)](message)
            except WrongUse as error:
                self.score.playing = []
                self.say({"say": "remark", "sentence": f"the motion ends here: {error}"})
        if not self.score.playing:
            self.say({"say": "remark", "sentence": "the motion was played"})

    def watch_over(self) -> None:
        """Stops a robot whose steering person is gone."""
        if self.score.playing:
            return
        if self.steered_at is not None and monotonic() - self.steered_at > WATCHDOG:
            self.stand(None)

    def frame(self, sequence: int) -> bytes | None:
        """What is drawn now; `None` before the first lap."""
        lap, memories = self.run.lap, self.run.session.mind.memories
        if lap is None:
            return None
        row = row_of(lap, memories, DRIVERS)
        return frame_of([row], sequence, self.paused)

    def status(self) -> dict[str, Any]:
        """What is so now."""
        composing, playing = self.score.begun is not None, bool(self.score.playing)
        own = {"mode": self.mode, "paused": self.paused, "pace": self.pace}
        own |= {"composing": composing, "playing": playing, "composed": len(self.score.words)}
        return status_of(self.run, self.ticks) | own

    def say_world(self) -> None:
        self.say(world_shown(self.run.scene, [self.run.robot], self.run.boxes))

    def say_scan(self) -> None:
        """What the terrain scanner holds, and where moving things are."""
        lap = self.run.lap
        if lap is None or not lap.sensed.is_finite():
            return
        preview = preview_of(self.run.robot, lap, self.run.session.mind)
        self.say(scan_shown(preview, self.run.scene.at(self.run.time)))
        if self.run.scene.movers:
            now = self.run.scene.at(self.run.time)
            self.say(things_shown(now, now.things))

    def say_seen(self) -> None:
        """What the robot knows of the ground, where that is more than before, or it went on a little."""
        mind = self.run.session.mind
        x, y, _ = self.run.sensed.position_w.tolist()
        if self.shown[0] is mind.ground and math.dist(self.shown[1], (x, y)) < WENT_ON:
            return
        self.shown = mind.ground, (x, y)
        travel = mind.memories.navigator
        learned = travel if isinstance(travel, Travel) and self.run.setup.sight == "camera" else None
        self.say(seen_shown(mind.ground, learned, (x, y), SEES))

    # --- where to go --------------------------------------------------------------------------------
    def go(self, said: m.Go) -> None:
        self.steered_at = None
        self.run.go(said.x, said.y, said.then)

    def steer(self, said: m.Steer) -> None:
        self.run.steer(said.forward, said.left, said.turn)
        self.steered_at = monotonic()

    def stand(self, said: m.Stand | None) -> None:
        self.steered_at = None
        self.run.steer(0.0, 0.0, 0.0)

    def skill(self, said: m.Skill) -> None:
        self.steered_at = None
        if not said.name:
            self.run.let_choose()
            return
        proposed = None
        if self.mode == "apprentice":  # what she does here may be right here: she says whether
            proposed = self.lessons.right(m.Right(skill=said.name), self.run.lesson)
        self.run.hold(said.name, said.speed)
        if proposed is not None:
            self.say(proposed | {"proposed": True})

    def drive(self, said: m.Drive) -> None:
        self.run.drive(said.driver)

    def set_mode(self, said: m.SetMode) -> None:
        self.mode = said.mode

    def push(self, said: m.Push) -> None:
        self.run.push(said.impulse, said.direction)

    def compose(self, said: m.Compose) -> Answer:
        if said.on:
            self.score.begin(self.run.time)
            return None
        return {"words": self.score.end()}

    def play(self, said: m.Play) -> Answer:
        return {"seconds": self.score.play(self.run.time)}

    # --- time, by message ---------------------------------------------------------------------------
    def pause(self, said: m.Pause) -> None:
        self.paused = True

    def resume(self, said: m.Resume) -> None:
        self.paused = False

    def step(self, said: m.Step) -> None:
        if not self.paused:
            raise WrongUse("time runs: pause first, then go on step by step")
        for _ in range(said.ticks):
            if not self.lap():
                break

    def set_pace(self, said: m.Pace) -> None:
        self.pace = said.factor

    def abort(self, said: m.Abort) -> None:
        self.steered_at = None
        self.run.abort()

    def reset(self, said: m.Reset) -> None:
        asked = {name: getattr(said, name) for name in ("robot", "scene", "seed", "sight", "driver")}
        given = {name: value for name, value in asked.items() if value is not None}
        self.end_recording()
        self.begin(replace(self.run.setup, **given))
        self.welcome()

    # --- the world ----------------------------------------------------------------------------------
    def place(self, said: m.PlaceBox) -> Answer:
        number = self.run.place(Box(said.x, said.y, said.yaw, said.lx, said.ly, said.height))
        self.say_world()
        return {"thing": number}

    def move(self, said: m.Move) -> None:
        self.run.move(said.thing, said.x, said.y, said.yaw)
        self.say_world()

    def remove(self, said: m.Remove) -> None:
        self.run.remove(said.thing)
        self.say_world()

    # --- recordings ---------------------------------------------------------------------------------
    def record(self, said: m.Record) -> Answer:
        if said.on == (self.run.recorder is not None):
            raise WrongUse("it is recorded already" if said.on else "nothing is recorded now")
        if said.on:
            self.run.recorder = Recorder(
                self.run.robot, self.run.scene.name, self.run.setup.seed, DT, self.run.scene.movers
            )
            return None
        return self.end_recording()

    def end_recording(self) -> Answer:
        """Keeps what was recorded so far, if anything."""
        recorder, self.run.recorder = self.run.recorder, None
        if recorder is None or not recorder.laps:
            return None
        recording = recorder.finish()
        name = self.shelf.keep(recording, self.run.robot.name)
        if (PAGE / TEMPLATE).is_file():  # beside it, as a page, while the robot goes on
            where = self.shelf.folder / f"{name}.html"
            self.writer = Thread(target=write_replay, args=(recording, where, PAGE, self.run.scene))
            self.writer.start()
        return {"recording": f"{name}.npz"}

    def recordings(self, said: m.Recordings) -> Answer:
        return {"recordings": self.shelf.listed()}

    # --- teaching -----------------------------------------------------------------------------------
    def right(self, said: m.Right) -> Answer:
        return self.lessons.right(said, self.run.lesson)

    def order(self, said: m.Order) -> Answer:
        return self.lessons.order(said.rule, said.before, self.run.lesson)

    def ok(self, said: m.Ok) -> Answer:
        return self.learned(self.lessons.ok(self.run.lesson))

    def keep(self, said: m.Keep) -> Answer:
        return self.learned(self.lessons.keep(self.run.lesson))

    def learned(self, lesson: str) -> Answer:
        """Rules choose the skills, by what was learned just now."""
        self.run.held = ""
        self.say(self.lessons.rules_shown())
        return {"lesson": lesson}

    def back(self, said: m.Back) -> None:
        self.lessons.back()

    def forget(self, said: m.Forget) -> Answer:
        return self.learned(self.lessons.forget(said.lesson, self.run.lesson))

    def why(self, said: m.Why) -> Answer:
        return {"sentences": self.lessons.why(said.rule, self.run.lesson)}

    # --- the end ------------------------------------------------------------------------------------
    def close(self) -> None:
        """Motors off; what was recorded is kept."""
        self.end_recording()
        self.run.session.close()
        if self.writer is not None:
            self.writer.join()
