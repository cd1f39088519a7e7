"""Measured and MotorCommand as a robot that is not in order has them: broken parts, noise, bias, delay.

A `FaultyPlant` stands before any simulated plant and changes what goes in and comes out. What is true stays
in `truth`: what a robot does is judged by that, not by what its sensors say.
"""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from jaxtyping import Float

from gaitwright.dynamics.joint_inertia import all_joint_inertias
from gaitwright.errors import WrongUse, unknown
from gaitwright.ground.scene import Scene
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, quaternion_of, rotation
from gaitwright.plant.imperfections import Imperfections
from gaitwright.plant.names import FAULTS, JOINTS, OF_A_JOINT, OF_A_LEG
from gaitwright.signals import Measured, MotorCommand, Sensed
from gaitwright.stages import SimulatedPlant

OFFSET = 0.2
"""What a sensor of a joint, or the attitude, reads too much [rad]."""
LATE = 20
"""Ticks by which readings are late."""
HELD = (0.1, 0.5)
"""Stiffness and damping that hold a stuck joint, as shares of what a tick can bear, I / dt² and I / dt."""
SHOWS = (0.1, 0.05)
"""A breakdown shows where a torque is off by this share of its limit, a load by this one of the weight."""
SHOWN = 10
"""For so many ticks."""
OF_A_SENSOR = tuple(kind for kind in FAULTS if not kind.startswith(("motor", "leg")))
"""Kinds that change what is read, not what is done."""
WHERE = Sensed.layout


@dataclass(frozen=True, slots=True)
class Breakdown:
    """Something that fails at a time, for good."""

    kind: str
    """A name of `plant.names.FAULTS`."""
    leg: int | None = None
    joint: int | None = None
    """Where the kind names one."""
    at: float = 0.0
    """[s]"""

    def names(self, robot: Robot) -> tuple[str, str | None, str | None]:
        """Kind, leg and joint as a person calls them."""
        leg = None if self.leg is None else robot.legs[self.leg]
        return self.kind, leg, None if self.joint is None else JOINTS[self.joint]


def breakdown(robot: Robot, kind: str, leg: str = "", joint: str = "", at: float = 0.0) -> Breakdown:
    """A breakdown by the names of its leg and joint. Raises `WrongUse` for what there is not."""
    if kind not in FAULTS:
        raise unknown("fault", kind, FAULTS)
    wants_leg, wants_joint = kind in OF_A_LEG + OF_A_JOINT, kind in OF_A_JOINT
    if bool(leg) != wants_leg or bool(joint) != wants_joint:
        form = kind + ":LEG" * wants_leg + ":JOINT" * wants_joint
        raise WrongUse(f"fault {kind!r} is written {form}@T, e.g. {example(robot, kind)}")
    if wants_leg and leg not in robot.legs:
        raise unknown(f"leg of {robot.name}", leg, robot.legs)
    if wants_joint and joint not in JOINTS:
        raise unknown("joint of a leg", joint, JOINTS)
    return Breakdown(kind, robot.legs.index(leg) if leg else None, JOINTS.index(joint) if joint else None, at)


def example(robot: Robot, kind: str) -> str:
    """How a fault of that kind is written."""
    leg = f":{robot.legs[0]}" if kind in OF_A_LEG + OF_A_JOINT else ""
    return f"{kind}{leg}{':knee' if kind in OF_A_JOINT else ''}@2"


class FaultyPlant:
    """A simulated plant with breakdowns, whose readings are imperfect."""

    def __init__(
        self,
        plant: SimulatedPlant,
        robot: Robot,
        breakdowns: Sequence[Breakdown] = (),
        imperfections: Imperfections | None = None,
    ) -> None:
        self.plant, self.robot, self.dt = plant, robot, plant.dt
        self.breakdowns = tuple(breakdowns)
        self.imperfections = imperfections or Imperfections()
        self.truth = self.told = plant.reset(0, vary=False)
        self.asked: MotorCommand | None = None
        """The last command."""
        self.begin(0)

    @property
    def scene(self) -> Scene:
        """Where the robot is."""
        return self.plant.scene

    def begin(self, seed: int) -> None:
        """Draws what is drawn once, and forgets what was."""
        self.random = np.random.default_rng([seed, 2])
        signs = self.random.choice([-1.0, 1.0], size=(self.robot.n, 3))
        self.angle_bias = self.imperfections.angle_bias * signs
        towards = self.random.uniform(0.0, 2.0 * np.pi)
        self.tilt = self.imperfections.attitude_bias * np.array([np.cos(towards), np.sin(towards)])
        self.spin_bias, self.force_bias = (
            bias * self.random.choice([-1.0, 1.0], size=3)
            for bias in (self.imperfections.spin_bias, self.imperfections.force_bias)
        )
        self.old: deque[Measured] = deque(maxlen=1 + max(LATE, self.imperfections.late))
        self.late, self.kept = self.imperfections.late, {}
        self.differs: dict[Breakdown, int] = {}
        self.shown: dict[Breakdown, float] = {}
        """When a breakdown first made a difference worth speaking of [s]."""

    def reset(self, seed: int = 0, vary: bool = True) -> Measured:
        """The robot at its start, as its sensors have it."""
        self.truth = self.plant.reset(seed, vary)
        self.begin(seed)
        return self.read()

    def step(self, command: MotorCommand) -> Measured:
        """One control period under what the motors make of a command."""
        now, self.asked = self.truth.time, command
        due = [one for one in self.breakdowns if now >= one.at - 1e-9]
        for one in due:
            broken = self.driven(command, one)
            if one.kind not in OF_A_SENSOR:
                self.count(one, now, self.differ(command, broken))
            command = broken
        self.truth = self.plant.step(command)
        return self.read()

    def push(self, force_w: tuple[float, float, float]) -> None:
        """A force [N] on the base's centre of mass from now on, world axes."""
        self.plant.push(force_w)

    def rearrange(self, scene: Scene) -> None:
        """Another arrangement of what stands around the robot."""
        self.plant.rearrange(scene)

    # --- motors --------------------------------------------------------------------------------------
    def driven(self, command: MotorCommand, one: Breakdown) -> MotorCommand:
        """What the motors make of a command with one breakdown."""
        if one.kind == "motor-dead":
            return without(command, (one.leg, one.joint))
        if one.kind == "leg-dead":
            return without(command, (one.leg, slice(None)))
        if one.kind == "motor-stuck":
            return self.held(without(command, (one.leg, one.joint)), one)
        return command

    def held(self, command: MotorCommand, one: Breakdown) -> MotorCommand:
        """A joint that is held where it stuck, with all the torque that its motor has."""
        where, q = (one.leg, one.joint), self.kept.setdefault(one, self.truth.q)
        inertia = all_joint_inertias(self.robot, q)[where]
        gains = filled_gains(command, self.truth)
        gains["q"][where], gains["qd"][where] = q[where], 0.0
        gains["kp"][where] = HELD[0] * inertia / self.dt**2
        gains["kd"][where] = HELD[1] * inertia / self.dt
        return replace(command, **gains)

    def count(self, one: Breakdown, now: float, differs: bool) -> None:
        """Counts for how many ticks a breakdown has made a difference; `SHOWN` of them show it."""
        self.differs[one] = self.differs.get(one, 0) + 1 if differs else 0
        if self.differs[one] == SHOWN and one not in self.shown:
            self.shown[one] = now - (SHOWN - 1) * self.dt

    def differ(self, told: MotorCommand, given: MotorCommand) -> bool:
        """Whether motors give torques that are clearly others than they were told."""
        if told is given:
            return False
        at, limit = (self.truth.q, self.truth.qd), self.robot.tau_max
        both = [command.given(*at, limit) for command in (told, given)]
        return bool((np.abs(both[1] - both[0]) > SHOWS[0] * limit).any())

    # --- sensors -------------------------------------------------------------------------------------
    def read(self) -> Measured:
        """What the sensors make of the truth."""
        now, told = self.truth.time, self.noisy(self.truth)
        due = [one for one in self.breakdowns if now >= one.at - 1e-9]
        for one in due:
            wrong = self.misread(told, one)
            if one.kind in OF_A_SENSOR:
                least = SHOWS[1] * self.robot.total_mass * GRAVITY if one.kind in OF_A_LEG else -1.0
                self.count(one, now, float(np.abs(wrong.load - told.load).max()) > least)
            told = wrong
        most = max([LATE if one.kind == "late" else 0 for one in due] + [self.imperfections.late])
        self.late = min(most, self.late + 1)  # a stream that stalls, then goes on as late as that
        self.old.append(told)
        told = self.old[max(0, len(self.old) - 1 - self.late)]
        self.told = told if self.late == 0 else changed(told, time=now)
        return self.told

    def noisy(self, true: Measured) -> Measured:
        """The truth with noise and bias."""
        off, draw = self.imperfections, self.random.uniform
        if off == Imperfections(late=off.late):
            return true
        tilt = self.tilt + off.attitude * draw(-1.0, 1.0, 2)
        spin = self.spin_bias + off.spin * draw(-1.0, 1.0, 3)
        told = changed(
            true,
            q=true.q + self.angle_bias + off.angle * draw(-1.0, 1.0, true.q.shape),
            qd=true.qd + off.rate * draw(-1.0, 1.0, true.q.shape),
            velocity_w=true.velocity_w + off.velocity * draw(-1.0, 1.0, 3),
            angular_velocity_b=true.angular_velocity_b + spin,
            orientation_wb=tilted(true.orientation_wb, tilt),
        )
        if off.load:
            share = off.load * self.robot.total_mass * GRAVITY / self.robot.n
            load = np.where(true.load > 0.0, true.load + share * draw(-1.0, 1.0, true.load.shape), 0.0)
            told = changed(told, load=np.maximum(load, 0.0))
        return self.felt(told, true)

    def felt(self, told: Measured, true: Measured) -> Measured:
        """A reading with what the accelerometer makes of the truth."""
        off = self.imperfections
        if not (off.force or off.force_bias):
            return told
        noise = self.force_bias + off.force * self.random.uniform(-1.0, 1.0, 3)
        x, y, z = (float(part) for part in true.specific_force_b + noise)
        return Measured.of_row(told.row, time=told.time, specific_force_b=(x, y, z))

    def misread(self, told: Measured, one: Breakdown) -> Measured:
        """A reading with one breakdown."""
        if one.kind == "frozen":
            return changed(self.kept.setdefault(one, told), time=told.time)
        if one.kind == "encoder-frozen":
            q, qd = told.q.copy(), told.qd.copy()
            q[one.leg, one.joint] = self.kept.setdefault(one, q[one.leg, one.joint])
            qd[one.leg, one.joint] = 0.0
            return changed(told, q=q, qd=qd)
        if one.kind == "encoder-offset":
            q = told.q.copy()
            q[one.leg, one.joint] += OFFSET
            return changed(told, q=q)
        if one.kind in ("foot-off", "foot-on"):
            load = told.load.copy()
            load[one.leg] = 0.0 if one.kind == "foot-off" else 0.25 * self.robot.total_mass * GRAVITY
            return changed(told, load=load)
        if one.kind == "imu-frozen":
            return frozen_body(told, self.kept.setdefault(one, told))
        if one.kind == "imu-tilted":
            return changed(told, orientation_wb=tilted(told.orientation_wb, np.array([OFFSET, 0.0])))
        return told


def without(command: MotorCommand, where: tuple[Any, Any]) -> MotorCommand:
    """A command with some motors off."""
    off = {}
    for name in ("tau", "kp", "kd"):
        value = getattr(command, name)
        if value is not None:
            off[name] = value.copy()
            off[name][where] = 0.0
    return replace(command, **off)


def filled_gains(command: MotorCommand, now: Sensed) -> dict[str, np.ndarray]:
    """What a command says of angles, rates and gains, as arrays that may be changed."""
    nothing = np.zeros_like(now.q)
    start = {"q": now.q, "qd": nothing, "kp": nothing, "kd": nothing}
    told = {name: getattr(command, name) for name in start}
    return {
        name: (start[name] if value is None else np.asarray(value)).copy() for name, value in told.items()
    }


def changed(told: Measured, **fields: Any) -> Measured:
    """A reading with other values in some fields."""
    row = told.row.copy()
    where = WHERE.slices(len(told.load))
    for name, value in fields.items():
        row[where[name]] = np.ravel(value)
    return Measured.of_row(row, time=float(row[0]), specific_force_b=told.specific_force_b)


def frozen_body(told: Measured, before: Measured) -> Measured:
    """A reading with what the inertial unit said before."""
    turned = changed(told, orientation_wb=before.orientation_wb, angular_velocity_b=before.angular_velocity_b)
    return Measured.of_row(turned.row, time=turned.time, specific_force_b=before.specific_force_b)


def tilted(orientation_wb: Float[np.ndarray, "4"], tilt: Float[np.ndarray, "2"]) -> Float[np.ndarray, "4"]:
    """An orientation with more roll and pitch, about axes of the base [rad]."""
    angle = float(np.hypot(*tilt))
    if angle == 0.0:
        return orientation_wb
    half = np.sin(0.5 * angle) / angle
    turn = rotation(np.array([np.cos(0.5 * angle), half * tilt[0], half * tilt[1], 0.0]))
    return quaternion_of(rotation(orientation_wb) @ turn)
