"""A session under a person's hands: set up by names, its world rearranged, what became of it kept."""

import math
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import replace
from itertools import chain, count

from gaitwright.description.load import load_robot
from gaitwright.errors import NoRoom, WrongUse, unknown
from gaitwright.ground.moving_entries import MOST_MOVERS
from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Box
from gaitwright.learning.equipped import equipped
from gaitwright.learning.live_sources import Running
from gaitwright.learning.profile_books import playable
from gaitwright.locomotion import Brain, Lap
from gaitwright.missions import Steering
from gaitwright.model.camera import Camera
from gaitwright.model.robot import Robot
from gaitwright.navigation.known_field import is_blocked
from gaitwright.navigation.room_needed import half_width
from gaitwright.navigation.travel import Travel
from gaitwright.perception.known_ground import map_of
from gaitwright.plant.registry import make_plant
from gaitwright.plant.seeing import SeeingPlant
from gaitwright.record.arrangement import Arrangement
from gaitwright.record.checked import MOST_BOXES
from gaitwright.record.notes import Note
from gaitwright.record.recording import Recorder
from gaitwright.record.scene_of import scene_for
from gaitwright.session import DT, Push, Session
from gaitwright.signals import Mission, Sensed
from gaitwright.skillbook.history import names_told
from gaitwright.skillbook.writer import Ledger
from gaitwright.skills.chooser import fixed_skill
from gaitwright.skills.library import check_turn, find_skill
from gaitwright.skills.rule_chooser import RuleChooser
from gaitwright.studio.setup import DRIVERS, Setup

FOR_EVER = 1e9
"""A run in the studio has no end of its own [s]."""
ABORTED = "aborted: the robot is let down"


class LiveRun:
    """One robot in one scene, and a book that it goes by and learns into."""

    def __init__(self, setup: Setup, ledger: Ledger) -> None:
        """Sets it up; the robot stands and waits. Raises `WrongUse` or `BadFile` for what cannot be had."""
        check_known("driver", setup.driver, DRIVERS)
        self.setup, self.ledger = setup, ledger
        self.over: str | None = None
        """Why the run is over; `None` while it goes on."""
        self.robot: Robot = load_robot(setup.robot)
        self.scene: Scene = scene_for(self.robot, setup.scene, setup.seed)
        self.boxes = dict(enumerate(self.scene.boxes))
        self.profiles = (
            playable(ledger.book, self.robot, str(ledger.path)).profiles if self.has_profiles else {}
        )
        self.session = self.begun()
        self.held: str = ""
        """The skill that a person holds; empty: rules choose."""
        self.recorder: Recorder | None = None
        self.name = run_name(f"{self.scene.name} (seed {setup.seed})", names_told(ledger.book.steps))
        """What lessons say of where they were given."""
        self.lesson = Running(self.session, self.name)
        self.lap: Lap | None = None
        """The last one."""
        self.lowering: Iterator[Lap] | None = None
        """What is left of letting the robot down."""

    @property
    def has_profiles(self) -> bool:
        """Whether the book has torque profiles of this robot."""
        book = self.ledger.book
        return bool(book.profiles) and book.robot == self.robot.name

    @property
    def sensed(self) -> Sensed:
        """The robot's state at the last lap, or at the start."""
        return self.session.measured if self.lap is None else self.lap.sensed

    @property
    def time(self) -> float:
        return self.sensed.time

    def begun(self) -> Session:
        """The session at its start: the robot stands until somebody says more."""
        x, y, _ = self.scene.start
        if is_blocked(map_of(self.scene.at(0.0), self.robot), half_width(self.robot), (x, y)):
            raise WrongUse(f"the start ({x:g}, {y:g}) is on an obstacle of scene {self.scene.name}")
        camera = Camera.for_robot(self.robot) if self.setup.sight == "camera" else None
        chooser = RuleChooser(self.robot, self.ledger.book.rulebook)
        brain = Brain.of(self.robot, self.scene, chooser, DT, camera=camera)
        brain = equipped(brain, self.ledger.book, self.profiles, str(self.ledger.path))
        check_driver(brain, self.setup.driver)
        plant = make_plant("mujoco", self.robot, self.scene, DT)
        whole = plant if camera is None else SeeingPlant(plant, camera, self.scene)
        mission = Mission((), driver=self.setup.driver)
        session = Session(brain, whole, mission, FOR_EVER, self.setup.seed, lowers=True, attended=True)
        session.steer(0.0)
        return session

    def warm_up(self) -> None:
        """Plans a way and does not go it: what is compiled at a first time is compiled now, and not when a
        person waits for it."""
        session, (x, y, _) = self.session, self.sensed.position_w.tolist()
        ahead = Mission(((x + 0.5, y),), driver=self.driver)
        session.brain.begin(ahead, session.measured, before=session.mind)

    def step(self) -> Lap | None:
        """One lap; `None` where the run is over and the robot was let down."""
        lap = self.session.step() if self.lowering is None else next(self.lowering, None)
        if self.held and self.session.outcome is not None:
            self.let_choose()
        if lap is not None:
            self.lap = lap
            self.keep(lap)
            if self.over is None and lap.stopped_because is not None:
                self.end(lap.stopped_because)
        return lap

    def keep(self, lap: Lap) -> None:
        """A lap joins what is recorded; where there is no room for it, `recorder.no_room` says so."""
        if self.recorder is not None:
            with suppress(NoRoom):
                self.recorder.add(lap, self.session.mind if self.lowering is None else None)

    def end(self, because: str) -> None:
        """The run is over; a robot that is on its feet is let down."""
        self.over, self.lowering = because, self.session.lower()
        if self.recorder is not None:
            self.recorder.end_trip()

    def record(self) -> None:
        """Laps from the next one on, and what a person does meanwhile, are kept in a `recorder`."""
        self.recorder = Recorder(self.robot, self.scene.name, self.setup.seed, DT, self.scene.movers)
        most = MOST_MOVERS - len(self.scene.movers)
        self.recorder.arrangement = Arrangement(self.scene.boxes, self.time, most)

    def note(self, kind: str, sentence: str) -> None:
        """Something that a person did, for who looks at a recording (`record.notes`)."""
        if self.recorder is not None:
            self.recorder.note(Note(self.time, kind, sentence))

    # --- where to go --------------------------------------------------------------------------------
    def go(self, x: float, y: float, then: bool) -> None:
        """To a place of the field [m]; with `then` after the places that are left."""
        self.check_going()
        self.check_on("the goal", x, y)
        travel = self.session.mind.memories.navigator
        before = travel.left if then and isinstance(travel, Travel) else ()
        if self.held:
            self.let_choose()
        self.session.give(Mission((*before, (x, y)), driver=self.driver))

    def steer(self, forward: float, left: float, turn: float) -> None:
        """A person's velocity, in the heading frame [m/s, m/s, rad/s], until another one. Raises `WrongUse`
        for one that is beyond the robot."""
        self.check_going()
        if self.held:
            self.let_choose()
        guidance = self.session.mind.mission.guidance
        if isinstance(guidance, Steering) and guidance.velocities == ((forward, left, turn),):
            return  # asked again, so that somebody is heard
        self.session.steer(forward, left, turn)

    def abort(self) -> None:
        """The robot comes to a stand and is let down; its motors go off."""
        if self.over is None:
            self.end(ABORTED)

    @property
    def driver(self) -> str:
        """Who was asked to drive."""
        return self.session.mind.mission.driver

    def drive(self, driver: str) -> None:
        """Another driver from the next lap on."""
        check_known("driver", driver, DRIVERS)
        check_driver(self.session.brain, driver)
        self.session.drive(driver)
        self.setup = replace(self.setup, driver=driver)

    def hold(self, skill: str, speed: float | None) -> None:
        """One skill, at a speed [m/s], straight on, until somebody says more."""
        self.check_going()
        chooser = fixed_skill(self.robot, skill, speed, 0.0, None, "")
        check_turn(find_skill(skill, self.robot), self.robot, chooser.skill_call.turn)
        self.session.give(Mission((), driver=self.driver))
        self.session.choose_by(chooser)
        self.held = skill

    def let_choose(self) -> None:
        """Rules choose the skills again."""
        self.held = ""
        self.lesson.drive_by(self.ledger.book.rulebook)

    def push(self, impulse: float, direction: float) -> None:
        """A push now; `direction` in the world [rad]."""
        self.check_going()
        from_ahead = math.degrees(direction) - math.degrees(self.yaw)
        self.session.push(Push(impulse, from_ahead, at=0.0))

    @property
    def yaw(self) -> float:
        """Where the robot looks, in the world [rad]."""
        w, x, y, z = self.sensed.orientation_wb.tolist()
        return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))

    # --- the world ----------------------------------------------------------------------------------
    def place(self, box: Box) -> int:
        """Puts a box into the scene; its number. Raises `WrongUse` where it would be in the robot."""
        if len(self.boxes) >= MOST_BOXES:
            raise WrongUse(f"a scene in the studio has at most {MOST_BOXES} boxes")
        number = max(self.boxes, default=-1) + 1
        self.arrange({**self.boxes, number: box}, box)
        return number

    def move(self, number: int, x: float, y: float, yaw: float | None) -> None:
        """Takes a box to another place."""
        box = self.box(number)
        moved = replace(box, x=x, y=y, yaw=box.yaw if yaw is None else yaw)
        self.arrange({**self.boxes, number: moved}, moved)

    def remove(self, number: int) -> None:
        """Takes a box away. Raises `WrongUse` where the robot stands on it."""
        self.check_clear(self.box(number))
        self.arrange({name: box for name, box in self.boxes.items() if name != number})

    def box(self, number: int) -> Box:
        if number not in self.boxes:
            raise WrongUse(f"there is no box {number} in the scene")
        return self.boxes[number]

    def arrange(self, boxes: dict[int, Box], new: Box | None = None) -> None:
        """The scene with other boxes."""
        if new is not None:
            self.check_on("the box", new.x, new.y)
            self.check_clear(new)
        scene = replace(self.scene, boxes=tuple(boxes.values()))
        self.session.rearrange(scene)
        self.scene, self.boxes = scene, boxes
        if self.recorder is not None and self.recorder.arrangement is not None:
            self.recorder.arrangement.rearranged(scene.boxes, self.time)

    def check_going(self) -> None:
        """Raises `WrongUse` where the run is over."""
        if self.over is not None:
            raise WrongUse(f"the run is over, {self.over}: a reset begins another")

    def check_clear(self, box: Box) -> None:
        """Raises `WrongUse` for a box that is where the robot is."""
        x, y = self.sensed.position_w[:2].tolist()
        room = 0.6 * self.robot.body_length + half_width(self.robot)
        dx, dy = x - box.x, y - box.y
        c, s = math.cos(box.yaw), math.sin(box.yaw)
        off = max(abs(c * dx + s * dy) - box.lx / 2, 0.0), max(abs(c * dy - s * dx) - box.ly / 2, 0.0)
        if math.hypot(*off) < room:
            raise WrongUse(f"the robot is there: a box keeps {room:.2f} m from its middle")

    def check_on(self, what: str, x: float, y: float) -> None:
        """Raises `WrongUse` for a place outside the field."""
        x_min, y_min, x_max, y_max = self.scene.bounds
        if not (x_min < x < x_max and y_min < y < y_max):
            raise WrongUse(
                f"{what} ({x:.2f}, {y:.2f}) lies outside the field, which goes from ({x_min:g}, {y_min:g}) "
                f"to ({x_max:g}, {y_max:g})"
            )


def run_name(name: str, told: Iterable[str]) -> str:
    """A name for a run after which no lesson of the book is called, so that lessons of it get their own."""
    known = {id.rpartition(" at ")[0] for id in told}
    names = chain([name], (f"{name}, run {k}" for k in count(2)))
    return next(one for one in names if one not in known)


def check_known(what: str, asked: str, known: tuple[str, ...]) -> None:
    """Raises `WrongUse` for a name that there is not."""
    if asked not in known:
        raise unknown(what, asked, known)


def check_driver(brain: Brain, driver: str) -> None:
    """Raises `WrongUse` for a driver that this brain has not, and says how to get it."""
    if driver not in brain.controllers:
        raise WrongUse(
            f"there is no driver {driver} here: it plays the profiles of a skillbook, and this one has none "
            f"of {brain.robot.name}; `gaitwright teach --lesson profiles` makes them"
        )
