"""Does it run my robot? What its file says, what its motors can do, and trials in simulation (row R2)."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import degrees
from typing import Literal

import numpy as np

from gaitwright.assess.motor_requirements import (
    HOPELESS,
    fastest_supported,
    motor_requirements,
    shortage,
)
from gaitwright.locomotion import Brain
from gaitwright.model.kinematics import HINGES, angles
from gaitwright.model.robot import Robot
from gaitwright.plant.registry import make_plant
from gaitwright.record.recording import INTERRUPTED, Recording
from gaitwright.session import DT, Session, record, scene_for
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill
from gaitwright.skills.library import (
    LIBRARY,
    Skill,
    fastest,
    find_skill,
    gait_of,
    skill_names,
    speed_scale,
)

Verdict = Literal["ok", "limited", "no"]
STARTS, SECONDS = 3, 6.0
"""Starts of each trial, and how long each lasts at a body height of 0.29 m [s]."""
TURN = 0.8
"""Yaw rate at which turning is tried, at a body height of 0.29 m [rad/s]."""
HELD = 0.8
"""A robot that reaches less of the speed asked for than this share does not do what it is asked."""
UNEVEN = 0.02
"""Masses of left and right that differ by more than this share are told."""
ROOMY = math.radians(10.0)
"""A stance nearer than this to a joint limit [rad] has little room."""
ROUND = 2.0 * math.pi * (1.0 - 1e-6)
"""A joint that may turn this far has no limits [rad]."""


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that was looked at."""

    kind: Literal["file", "body", "motors", "trial"]
    what: str
    verdict: Verdict
    sentence: str
    lacks: bool = False
    """Whether motors or joints lack something at the very speed that the skill is meant for."""


@dataclass(frozen=True, slots=True)
class Task:
    """Something to do in simulation: a skill at a velocity (at a body height of 0.29 m)."""

    what: str
    skill: str
    speed: float | None = None
    """Forward [m/s]; `None`: what the skill is meant for."""
    left: float = 0.0
    """To the left [m/s]."""
    turn: float = 0.0
    """Yaw rate [rad/s]."""


TASKS = (
    Task("stand", "stand", 0.0),
    Task("walk", "walk"),
    Task("trot", "trot"),
    Task("turn in place", "turn-in-place", 0.0, turn=TURN),
    Task("trot sideways", "trot", 0.0, left=0.2),
)
AT_LIMITS = " (at the limits of its motors)"
NEEDED = ("stand", "walk", "trot")
"""What a robot must do to be one that we run."""


def suitability(
    robot: Robot,
    notes: Sequence[str] = (),
    tell: Callable[[str], None] | None = None,
    starts: int = STARTS,
    seconds: float = SECONDS,
) -> list[Finding]:
    """Everything that speaks for or against a robot.

    `notes`: what reading its file had to derive (`load_robot_and_notes`); `tell` hears what is being done;
    `starts` and `seconds` [s]: of each trial.
    """
    tell = tell or (lambda _: None)
    found = [*of_file(robot, notes), *of_body(robot)]
    for name in skill_names(robot.n):
        tell(f"what {name} needs")
        found.append(of_motors(robot, find_skill(name, robot)))
    for task in TASKS:
        recordings = []
        for seed in range(starts):
            tell(f"{task.what}: start {seed + 1} of {starts}")
            recordings.append(tried(robot, task, seconds, seed))
        found.append(of_trial(robot, task, recordings))
    return found


def runs(findings: Sequence[Finding]) -> bool:
    """Whether the robot stood, walked and trotted from every start, by motors that can."""
    needed = [finding for finding in trials(findings) if finding.what in NEEDED]
    return all(finding.verdict == "ok" and unable(findings, finding) is None for finding in needed)


def unable(findings: Sequence[Finding], trial: Finding) -> str | None:
    """Why the motors cannot do what was tried, as the check of the motors says; `None` where they can."""
    motors = [finding for finding in of_skill(findings, trial) if finding.verdict == "no"]
    return motors[0].sentence if motors else None


def strained(findings: Sequence[Finding], trial: Finding) -> bool:
    """Whether what was tried asks more of the motors than their limits."""
    return any(finding.lacks for finding in of_skill(findings, trial))


def of_skill(findings: Sequence[Finding], trial: Finding) -> list[Finding]:
    """What the check of the motors found for the skill that was tried."""
    skill = next(task.skill for task in TASKS if task.what == trial.what)
    return [finding for finding in findings if finding.kind == "motors" and finding.what == skill]


def trials(findings: Sequence[Finding]) -> list[Finding]:
    """What was tried in simulation."""
    return [finding for finding in findings if finding.kind == "trial"]


def summary(robot: Robot, findings: Sequence[Finding]) -> str:
    """What the robot can do, what it cannot and why, and what its motors are short for, in one sentence."""
    can, cannot = [], []
    for trial in trials(findings):
        lacking = unable(findings, trial)
        if trial.verdict != "ok":
            cannot.append(f"{trial.what}: {trial.sentence}")
        elif lacking:
            cannot.append(f"{trial.what}, though it did in simulation: {lacking}")
        else:
            can.append(trial.what + (AT_LIMITS if strained(findings, trial) else ""))
    done = [what.removesuffix(AT_LIMITS) for what in can]
    rhythms = {rhythm(task.skill) for task in TASKS if task.what in done}
    shown = [name for name in LIBRARY if rhythm(name) in rhythms]
    short = [f.what for f in findings if f.kind == "motors" and f.verdict != "ok" and f.what not in shown]
    parts = [f"{robot.name} can {listed(can)}" if can else f"{robot.name} can do nothing that was tried"]
    parts += [f"it cannot reliably {part}" for part in cannot]
    parts += [f"motors or joints fall short for {listed(short)}"] if short else []
    return "; ".join(parts)


def rhythm(skill: str) -> tuple[float, float, str]:
    """What two skills share that differ in their way or speed only."""
    row = LIBRARY[skill]
    return row.period, row.duty, row.offsets


def listed(words: Sequence[str]) -> str:
    """Words in a row."""
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


# --- the file --------------------------------------------------------------------------------------
def of_file(robot: Robot, notes: Sequence[str]) -> Iterator[Finding]:
    """What the file left open and what was made of it."""
    for note in notes:
        yield Finding("file", "left open", "limited", note)
    if not notes:
        yield Finding(
            "file", "left open", "ok", "torque limits are given, and the stance is within joint limits"
        )
    free = np.all(robot.q_max - robot.q_min > ROUND, axis=0)
    if free.any():
        where = ", ".join(HINGES[joint] for joint in np.flatnonzero(free))
        yield Finding("file", "joint limits", "limited", f"none at {where}: taken as ±180°")
    else:
        yield Finding("file", "joint limits", "ok", "given for all joints")
    if robot.armature.any():
        yield Finding("file", "rotor inertia", "ok", f"up to {robot.armature.max():.3g} kg·m² at a joint")
    else:
        sentence = "none is given: a real robot of geared motors swings its legs more slowly than this one"
        yield Finding("file", "rotor inertia", "limited", sentence)
    yield of_symmetry(robot)


def of_symmetry(robot: Robot) -> Finding:
    """Whether left and right weigh the same."""
    left, right = robot.mass[0::2].sum(axis=1), robot.mass[1::2].sum(axis=1)
    uneven = np.abs(left - right) / np.maximum(left, right)
    pair = int(np.argmax(uneven))
    if uneven[pair] > UNEVEN:
        names = robot.legs[2 * pair], robot.legs[2 * pair + 1]
        sentence = f"{names[0]} weighs {left[pair]:.3g} kg and {names[1]} {right[pair]:.3g} kg"
        return Finding("file", "symmetry", "limited", sentence)
    return Finding("file", "symmetry", "ok", "legs on the left weigh what those on the right do")


# --- the body --------------------------------------------------------------------------------------
def of_body(robot: Robot) -> Iterator[Finding]:
    """Its size, and how it stands."""
    kind = "yaw" if abs(robot.leg_frame[0, 2, 0]) > math.sqrt(0.5) else "abduction"
    size = (
        f"{robot.total_mass:.3g} kg, {robot.mass.sum() / robot.total_mass:.0%} of it in {robot.n} legs of "
        f"{robot.leg_length:.2f} m ({kind} hips); its base stands at {robot.height:.2f} m"
    )
    yield Finding("body", "size", "ok", size)
    yield of_stance(robot)


def of_stance(robot: Robot) -> Finding:
    """How near the nominal stance is to joint limits, and how level its feet are."""
    q, _ = angles(robot, robot.nominal_feet)
    room = np.minimum(q - robot.q_min, robot.q_max - q)
    leg, joint = (int(i) for i in np.unravel_index(np.argmin(room), room.shape))
    where = f"the {HINGES[joint]} of {robot.legs[leg]}"
    depths = robot.foot_radius - robot.nominal_feet[:, 2]
    if np.ptp(depths) > UNEVEN * robot.height:
        sentence = (
            f"its feet are {np.ptp(depths):.3f} m from being level: front and rear legs differ in length"
        )
        return Finding("body", "stance", "limited", sentence)
    if room[leg, joint] < 0.0:
        sentence = f"{where} stands {degrees(-room[leg, joint]):.0f}° beyond its limit"
        return Finding("body", "stance", "no", sentence)
    verdict = "ok" if room[leg, joint] > ROOMY else "limited"
    return Finding(
        "body", "stance", verdict, f"{where} is nearest to a limit, {degrees(room[leg, joint]):.0f}°"
    )


# --- the motors ------------------------------------------------------------------------------------
def of_motors(robot: Robot, skill: Skill) -> Finding:
    """What a skill needs at the speed it is meant for, and how fast motors and legs let the robot go."""
    gait, scale = gait_of(skill, robot), speed_scale(robot)
    how = ((skill.speed * scale, 0.0), TURN / scale if skill.name == "turn" else 0.0)
    missing = shortage(robot, gait, *how)
    if missing is not None:
        # A body that stands has no momentum to get over what is missing.
        hopeless = gait.duty >= 1.0 or shortage(robot, gait, *how, leeway=HOPELESS) is not None
        return Finding("motors", skill.name, "no" if hopeless else "limited", missing, lacks=True)
    found = motor_requirements(robot, gait, *how)
    share = f"{found.what} takes up to {found.load:.0%} of a motor's torque"
    share += "" if robot.rate_max is None else f" and {found.haste.max():.0%} of its speed"
    if skill.fastest == 0.0 or skill.name == "turn":
        return Finding("motors", skill.name, "ok", share)
    most = fastest_supported(robot, skill)
    offered = fastest(skill, robot)
    if most.speed >= offered:
        return Finding(
            "motors", skill.name, "ok", f"{share}; all of the {offered:.2f} m/s offered is within it"
        )
    if math.isnan(most.speed):
        return Finding("motors", skill.name, "limited", f"{share}, but {most.limit}")
    there = shortage(robot, gait, (offered, 0.0)) or most.limit
    return Finding("motors", skill.name, "limited", f"{share}, at most {most.speed:.2f} m/s: {there}")


# --- the trials ------------------------------------------------------------------------------------
def tried(robot: Robot, task: Task, seconds: float, seed: int) -> Recording:
    """One start of a task on flat ground; its time and speeds grow with the robot's size."""
    scale = speed_scale(robot)
    scene = scene_for(robot, "flat", seed)
    speed = None if task.speed is None else task.speed * scale
    chooser = fixed_skill(robot, task.skill, speed, task.left * scale, task.turn / scale, "numerical")
    plant = make_plant("mujoco", robot, scene, DT)
    session = Session(Brain.of(robot, scene, chooser, DT), plant, Mission(()), seconds * scale, seed)
    recording = record(session, seed, scene.name)
    if recording.stopped_because == INTERRUPTED:
        raise KeyboardInterrupt
    return recording


def of_trial(robot: Robot, task: Task, recordings: Sequence[Recording]) -> Finding:
    """How many starts went to their end, and the speed that they reached."""
    good = [recording for recording in recordings if recording.done and not recording.fell]
    starts = f"{len(good)} of {len(recordings)} starts"
    if len(good) < len(recordings):
        why = next(recording.stopped_because for recording in recordings if recording not in good)
        return Finding("trial", task.what, "limited" if good else "no", f"{starts}; {why}")
    if task.skill == "stand":
        return Finding("trial", task.what, "ok", starts)
    asked = np.array([LIBRARY[task.skill].speed if task.speed is None else task.speed, task.left, task.turn])
    scale = speed_scale(robot)
    asked *= [scale, scale, 1.0 / scale]
    along = int(np.argmax(np.abs(asked)))
    held = float(np.mean([r.moved()[len(r) // 2 :, along].mean() for r in good]))
    unit = "rad/s" if along == 2 else "m/s"
    sentence = f"{starts}; {held:.2f} of {asked[along]:.2f} {unit}"
    return Finding("trial", task.what, "ok" if held >= HELD * asked[along] else "limited", sentence)
