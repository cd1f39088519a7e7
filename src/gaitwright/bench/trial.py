"""One simulation from plain values to its figures: what a worker is given, and what it hands back."""

import math
from dataclasses import asdict, dataclass, replace
from functools import lru_cache
from pathlib import Path
from time import perf_counter, process_time
from typing import Any

import numpy as np

from gaitwright.bench.evidence.played_without import LeftOut, PlayedWithout
from gaitwright.bench.witness import Change, Seen, Witness
from gaitwright.control.learned.controller import LearnedController
from gaitwright.control.learned.profile import Profile
from gaitwright.control.numerical import Method
from gaitwright.control.takeover import LEARNED
from gaitwright.description.load import load_robot
from gaitwright.gait.operators import Operator
from gaitwright.ground.scene import Scene
from gaitwright.learning.operator_lessons import shown
from gaitwright.learning.profile_lessons import taught
from gaitwright.locomotion import Brain
from gaitwright.model.perturb import perturbed
from gaitwright.model.robot import Robot
from gaitwright.perception.estimated_state import Sensing
from gaitwright.plant.faults import Breakdown, FaultyPlant
from gaitwright.plant.imperfections import Imperfections
from gaitwright.plant.registry import make_plant
from gaitwright.record.metrics import Report
from gaitwright.record.recording import INTERRUPTED, Recording
from gaitwright.session import DT, Push, Session, record, scene_for
from gaitwright.signals import Mission, Route, Sensed, SkillCall
from gaitwright.skills.chooser import fixed_skill
from gaitwright.stages import Map, Now

STILL = 0.01
"""Velocities below this are not asked for [m/s, rad/s]."""


@dataclass(frozen=True, slots=True)
class Then:
    """A skill that follows another one, at the velocity it is meant for."""

    skill: str
    at: float
    """[s]"""
    driver: str = ""
    """Who drives it; empty: as before."""
    same_velocity: bool = False
    """Whether it goes on at the velocity so far."""


@dataclass(frozen=True, slots=True)
class Trial:
    """One robot in one scene from one start: a skill held for a time, or a mission where there is a goal."""

    robot: str
    """Name or file; with `~7` after it the robot with its sizes perturbed by that seed."""
    scene: str
    seconds: float
    seed: int
    """Varies the start."""
    skill: str = "trot"
    speed: float | None = 0.0
    """[m/s]; `None`: what the skill is meant for."""
    turn: float | None = 0.0
    """[rad/s]; `None`: what the skill is meant for."""
    lateral: float = 0.0
    """To the left [m/s]."""
    then: "Then | None" = None
    """Another skill from some time on."""
    goal: tuple[float, float] | None = None
    """[m]"""
    method: Method = "qp"
    push: Push | None = None
    plant: str = "mujoco"
    driver: str = "numerical"
    faults: tuple[Breakdown, ...] = ()
    """What breaks."""
    imperfections: Imperfections | None = None
    """How far readings are from the truth."""
    change: Change | None = None
    """How the robot differs from what its brain knows of it."""
    lowers: bool = False
    """Whether it is let down at the end."""
    sensing: Sensing = "true"
    """Whether it is told its state, or estimates it."""
    without: LeftOut | None = None
    """What the learned controller is to do without."""
    operators: bool = False
    """Whether it gets over obstacles by what the numerical controller showed on one leg."""
    alarmed: bool = False
    """Whether the learned controller is asked for no velocity while it stumbles."""

    @property
    def is_imperfect(self) -> bool:
        """Whether readings or motors are not what they should be."""
        return bool(self.faults) or self.imperfections is not None

    @property
    def name(self) -> str:
        """The robot's name."""
        return Path(self.robot).stem


@dataclass(frozen=True)
class Outcome:
    """What became of a trial."""

    kept_up: bool
    """Whether it went on to its end, without a fall."""
    off_goal: float
    """How far from the goal it ended [body lengths]; from its start where there was no goal."""
    held: float
    """Share of the velocity asked for that was held in the second half; 1 where none was asked for."""
    beyond: float
    """Farthest that any joint went beyond its limits [°]; negative where it stayed within."""
    report: Report
    cpu_s: float
    wall_s: float
    seen: Seen | None = None
    """What became of it in truth, where something breaks."""

    def plain(self) -> dict[str, Any]:
        """As plain JSON values, without the times of ticks: workers disturb each other."""
        report = asdict(self.report)
        del report["tick_us"]
        return report | {
            "kept_up": self.kept_up,
            "off_goal_body_lengths": self.off_goal,
            "held_share": self.held,
            "beyond_limits_deg": self.beyond,
            "cpu_s": self.cpu_s,
        }


def simulate(trial: Trial) -> Outcome:
    """Runs one trial; the same trial gives the same outcome in any process."""
    robot = robot_named(trial.robot)
    change = trial.change or Change()
    robot = change.known(robot)
    scene = scene_for(robot, trial.scene, trial.seed)
    brain = brain_for(trial, robot, scene)
    plant = Witness(make_plant(trial.plant, change.real(robot), scene, DT), robot)
    whole = (
        FaultyPlant(plant, robot, trial.faults, trial.imperfections) if trial.is_imperfect else plant.plant
    )
    mission = Mission(() if trial.goal is None else (trial.goal,), driver=trial.driver)
    cpu, wall = process_time(), perf_counter()
    session = Session(brain, whole, mission, trial.seconds, trial.seed, lowers=trial.lowers)
    if trial.push:
        session.push(trial.push)
    recording = record(session, trial.seed, scene.name)
    cpu, wall = process_time() - cpu, perf_counter() - wall
    if recording.stopped_because == INTERRUPTED:
        raise KeyboardInterrupt
    where = recording.of_trip()["position_w"][:, :2]
    target = where[0] if trial.goal is None else trial.goal
    off = math.dist(where[-1], target) / robot.body_length
    kept_up = recording.done and not recording.fell
    seen = plant.seen(whole.shown, whole.asked) if isinstance(whole, FaultyPlant) else None
    limits = beyond_limits(recording)
    return Outcome(kept_up, off, held(recording.of_trip()), limits, recording.report(), cpu, wall, seen)


def held(recording: Recording) -> float:
    """Share of the velocity asked for that the second half of a trip held, the worse of speed and turn."""
    half = len(recording) // 2
    moved, asked = recording.moved()[half:].mean(axis=0), recording["command"][half:].mean(axis=0)
    speed, shares = float(np.hypot(*asked[:2])), []
    if speed > STILL:
        shares.append(float(moved[:2] @ asked[:2]) / speed**2)
    if abs(asked[2]) > STILL:
        shares.append(float(moved[2] / asked[2]))
    return min(shares, default=1.0)


def beyond_limits(recording: Recording) -> float:
    """Farthest that any joint went beyond its limits [°]."""
    robot = recording.robot
    q = recording["q"].reshape(-1, robot.n, 3)
    return math.degrees(float(np.maximum(robot.q_min - q, q - robot.q_max).max()))


@lru_cache
def robot_named(asked: str) -> Robot:
    """A robot, read once in a process; `name~seed`: perturbed."""
    name, _, seed = asked.partition("~")
    return perturbed(robot_named(name), int(seed)) if seed else load_robot(name)


def brain_for(trial: Trial, robot: Robot, scene: Scene) -> Brain:
    """The brain that the trial asks for."""
    chooser = None
    if trial.goal is None:
        chooser = fixed_skill(robot, trial.skill, trial.speed, trial.lateral, trial.turn, trial.driver)
        if trial.then is not None:
            chooser = InTurn(chooser.skill_call, second_call(trial, robot), trial.then.at)
    brain = Brain.of(robot, scene, chooser, DT, trial.method, sensing=trial.sensing)
    if "learned" not in (trial.driver, trial.then and trial.then.driver):
        return brain
    first = profile_of(trial.robot, trial.skill, trial.speed, trial.turn)
    profiles = {trial.skill: (first,)}
    if trial.then and trial.then.skill != trial.skill:
        profiles[trial.then.skill] = (profile_of(trial.robot, trial.then.skill),)
    brain = brain.with_profiles(profiles, alarmed=trial.alarmed)
    brain = brain.with_operators(operators_of(trial.robot)) if trial.operators else brain
    learned = brain.controller(LEARNED)
    if trial.without is None or not isinstance(learned, LearnedController):
        return brain
    return replace(brain, controllers={**brain.controllers, LEARNED: PlayedWithout(learned, trial.without)})


def second_call(trial: Trial, robot: Robot) -> SkillCall:
    """What follows the skill of a trial."""
    assert trial.then is not None
    then, driver = trial.then, trial.then.driver or trial.driver
    if then.same_velocity:
        return fixed_skill(robot, then.skill, trial.speed, trial.lateral, trial.turn, driver).skill_call
    return fixed_skill(robot, then.skill, None, 0.0, None, driver).skill_call


@lru_cache
def profile_of(asked: str, skill: str, speed: float | None = None, turn: float | None = None) -> Profile:
    """The profile of a skill at a velocity, or as it is meant, taught once in a process."""
    return taught(robot_named(asked), skill, speed, turn)


@lru_cache
def operators_of(asked: str) -> tuple[Operator, ...]:
    """The terrain operators that the numerical controller shows unasked, taught once in a process."""
    return shown(robot_named(asked))


@dataclass(frozen=True)
class InTurn:
    """A chooser that holds one skill, and from some time on another one."""

    first: SkillCall
    second: SkillCall
    at: float

    def choose(self, route: Route, sensed: Sensed, now: Now = None, ground: Map = None) -> SkillCall:
        return self.first if sensed.time < self.at else self.second
