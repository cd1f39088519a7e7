"""What a person asks for → the run, and what is told of it: the studio without a page, a clock or a network.

A `Room` hears messages and says things; whoever runs it (`host`) gives it time. So a test can talk to it
directly. What is asked is done at desks, one for each kind of thing; a desk says what it `does`, and attends
to the run that is under way.
"""

import math
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol

from gaitwright.errors import WrongUse
from gaitwright.ground.scenes_list import scene_names
from gaitwright.model.catalogue import robot_names
from gaitwright.navigation.travel import Travel
from gaitwright.record.previews import preview_of
from gaitwright.signals import GroundMap
from gaitwright.skillbook.writer import Ledger
from gaitwright.skills.library import skill_names
from gaitwright.studio import messages as m
from gaitwright.studio.curve_desk import CurveDesk
from gaitwright.studio.driving_desk import DrivingDesk
from gaitwright.studio.frames import columns_of, frame_of, row_of
from gaitwright.studio.live_run import LiveRun
from gaitwright.studio.names_asked import setup_asked
from gaitwright.studio.recording_desk import RecordingDesk
from gaitwright.studio.setup import DRIVERS, Setup, who_drives
from gaitwright.studio.shown import boxes_shown, scan_shown, seen_shown, things_shown, world_shown
from gaitwright.studio.status import status_of
from gaitwright.studio.teaching_desk import TeachingDesk
from gaitwright.studio.world_desk import WorldDesk

SEES = 6.0
"""So far around the robot what it knows of the ground is shown [m]."""
WENT_ON = 0.25
"""It is shown again where the robot has gone so far [m]."""

Say = Callable[[dict[str, Any]], None]
Answer = dict[str, Any] | None


class Desk(Protocol):
    """Where some kind of thing is done."""

    does: dict[type[m.Message], Callable[[Any], Answer]]

    def attend(self, run: LiveRun) -> None:
        """From now on it is about this run."""
        ...


class Room:
    """A run, a book's pupil, and the person who drives them. `say` is told what everybody should know."""

    def __init__(self, setup: Setup, ledger: Ledger, folder: Path, say: Say) -> None:
        self.own, self.ledger, self.say = setup, ledger, say
        self.paused, self.pace = False, 1.0
        self.teaching = TeachingDesk(ledger, say)
        self.driving = DrivingDesk(self.teaching, say)
        self.recording = RecordingDesk(folder, say)
        self.curves = CurveDesk(ledger, folder, say)
        self.world = WorldDesk(self.say_boxes)
        desks: tuple[Desk, ...] = (self.driving, self.teaching, self.curves, self.recording, self.world)
        self.desks = desks
        self.does: dict[type[m.Message], Callable[[Any], Answer]] = {
            m.Pause: self.pause, m.Resume: self.resume, m.Step: self.step, m.Pace: self.set_pace,
            m.Reset: self.reset,
        }  # fmt: skip
        for desk in desks:
            self.does |= desk.does
        self.begin(LiveRun(setup, ledger))

    def begin(self, run: LiveRun) -> None:
        """From now on it is about this run."""
        self.run = run
        self.ticks = Counter[str]()
        self.shown: tuple[GroundMap | None, tuple[float, float]] = None, (0.0, 0.0)
        """What was known of the ground when it was shown last, and where the robot was."""
        for desk in self.desks:
            desk.attend(self.run)

    def hears(self, message: m.Message) -> Answer:
        """Does what is asked; what is answered beside that it is done. Raises `GaitwrightError`."""
        if type(message) not in self.does:
            raise WrongUse(f"{message.__struct_config__.tag} is not done here")
        self.driving.score.check(message)
        answer = self.does[type(message)](message)
        self.driving.score.hear(self.run.time, message)
        return answer

    def close(self) -> None:
        """Motors off; what was recorded is kept."""
        self.recording.close()
        self.run.session.close()

    # --- time ---------------------------------------------------------------------------------------
    def lap(self) -> bool:
        """One control period; whether there was one."""
        lap = self.run.step()
        recorder = self.run.recorder
        if recorder is not None and recorder.no_room is not None:
            self.say({"say": "remark", "sentence": f"the recording ends here: {recorder.no_room}"})
            self.recording.end()
        if lap is None:
            return False
        self.ticks[who_drives(lap.call.driver or self.run.driver)] += 1
        self.driving.after()
        self.curves.after()
        return True

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

    def reset(self, said: m.Reset) -> Answer:
        """Another run; where there cannot be one, the one before goes on (`WrongUse`, `BadFile`)."""
        run = LiveRun(setup_asked(said, self.run.setup, self.own), self.ledger)
        kept = self.recording.end()
        self.run.session.close()
        self.begin(run)
        self.lap()  # so that there is something to be seen, also while time stands
        self.welcome()
        return kept

    # --- what is said -------------------------------------------------------------------------------
    def welcome(self) -> None:
        """Says all that one who comes in has to know."""
        self.run.warm_up()
        self.teaching.warm_up()
        legs = self.run.robot.n
        choices = {
            "drivers": list(DRIVERS),
            "modes": list(m.MODES),
            "skills": list(skill_names(legs)),
            "robots": list(robot_names()),
            "forms": self.recording.forms,
            "scenes": [{"name": name, "about": about} for name, about in scene_names().items()],
        }
        self.say({"say": "hello", "version": 1, "columns": columns_of(legs), "choices": choices})
        self.say_world()
        self.teaching.say_rules()
        self.say(self.status())

    def frame(self, sequence: int) -> bytes | None:
        """What is drawn now; `None` before the first lap."""
        lap, memories = self.run.lap, self.run.session.mind.memories
        if lap is None:
            return None
        return frame_of([row_of(lap, memories, DRIVERS)], sequence, self.paused)

    def status(self) -> dict[str, Any]:
        """What is so now."""
        self.recording.after()
        own = {"paused": self.paused, "pace": self.pace, **self.driving.status()}
        return status_of(self.run, self.ticks) | own

    def say_world(self) -> None:
        self.say(world_shown(self.run.scene, [self.run.robot], self.run.boxes))
        self.say_boxes()

    def say_boxes(self) -> None:
        """Where the boxes are, without all the rest of the world."""
        self.say({"say": "boxes", "boxes": boxes_shown(self.run.scene, self.run.boxes)})

    def say_scan(self) -> None:
        """What the terrain scanner holds, and where moving things are."""
        lap = self.run.lap
        if lap is None or not lap.sensed.is_finite():
            return
        now = self.run.scene.at(self.run.time)
        self.say(scan_shown(preview_of(self.run.robot, lap, self.run.session.mind), now))
        if self.run.scene.movers:
            self.say(things_shown(now, now.things))

    def say_seen(self) -> None:
        """What the robot knows of the ground, where that is more than before, or it went on a little."""
        mind = self.run.session.mind
        if not self.run.sensed.is_finite():
            return
        x, y, _ = self.run.sensed.position_w.tolist()
        if self.shown[0] is mind.ground and math.dist(self.shown[1], (x, y)) < WENT_ON:
            return
        self.shown = mind.ground, (x, y)
        travel = mind.memories.navigator
        learned = travel if isinstance(travel, Travel) and self.run.setup.sight == "camera" else None
        self.say(seen_shown(mind.ground, learned, (x, y), SEES))
