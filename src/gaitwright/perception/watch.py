"""Sensed + what was told last → what is believed, and what is broken: by kinematics, torques and load.

While everything fits, what is sensed is believed as it is, to the bit. A foot's sensor that lies is done
without: the load of that foot is then what the leg's torques stand for. Everything else ends the trip.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gaitwright.model.leg import leg_at
from gaitwright.model.robot import Robot, damping_of, friction_of, q_max_of, q_min_of, scales
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import GRAVITY, add, rotation, scale, vec
from gaitwright.numerics.matrices import row as row_of
from gaitwright.numerics.packing import Row
from gaitwright.perception.fault_words import FOOT_FAULTS, Fault, ends_trip, fault_of
from gaitwright.perception.foot_forces import LOAD, balance, base_motion, base_pull, leg_forces
from gaitwright.perception.lateness import compare, new_lag, remember
from gaitwright.perception.readings import (
    REPEAT_ALL,
    REPEAT_BODY,
    REPEAT_JOINT,
    STEADY,
    check_all,
    check_body,
    check_joints,
    repeats,
    spin,
)
from gaitwright.perception.suspicion import (
    CARRIES,
    MARGIN,
    PER_NOISE,
    forget,
    judge_leg,
    misfit,
    verdict,
)
from gaitwright.perception.watch_memory import DEAD_LEG, SENSOR, STUCK, size_of, tables
from gaitwright.signals import Measured, MotionTarget, MotorCommand, Sensed

FILTER = 0.02
"""Time over which forces are averaged [s]."""
BEGINS = 60
"""Nothing is concluded from torques in so many ticks of the start."""
DARK = 0.12
"""Nor for so long after readings stalled [s]."""
BEARABLE = 0.095
"""Readings this late can be walked with, over √(h/g): go2 falls from 10 ticks of 2 ms on, and not at 8."""
AT_STOP = 0.05
"""So near to its end a joint may lean on its stop, or have done so a moment ago [rad]."""
LEAST_LOAD = 0.04
"""A foot that carries less than this by torques, in weights, is taken to be in the air."""

NOTHING, MOTOR_DEAD, LEG_DEAD, MOTOR_STUCK, ENCODER_FROZEN, ENCODER_OFFSET = range(6)
FOOT_OFF, FOOT_ON, IMU_FROZEN, IMU_TILTED, FROZEN, LATE = range(6, 12)

sensed_fields = Sensed.layout.views()
normal_of = MotionTarget.layout.field("normal_w")


@kernel
def look(packed, dt, was, now, pull, asked, told, row):
    """One tick of the watch: changes its memory; (what is found, leg, joint or ticks, since when).

    `packed`: `Robot.packed`; `dt`: control period; `was`, `now`: rows of the `Sensed` before and of this
    one; `pull`: specific force; `asked`, `told`: rows of the `MotionTarget` and the torques in between.
    """
    a, b = sensed_fields(was), sensed_fields(now)
    n, t = b.load.size, b.time
    readings, forces, late = tables(row, n)
    place = remember(late, told)
    found, ticks = check_all(readings, a, b, dt)
    if found != STEADY:
        return (FROZEN if found == REPEAT_ALL else LATE), -1, int(ticks), t - dt * ticks
    if ticks > 0.0:
        late.dark[0] = DARK
        return NOTHING, -1, -1, 0.0
    late.dark[0] = max(0.0, late.dark[0] - dt)
    found, leg, joint = check_sensors(readings, a, b, dt)
    if found != NOTHING:
        return found, leg, joint, t - dt * (readings.same[1] if leg < 0 else readings.same_joint[leg, joint])
    before = rotation(a.orientation_wb)
    motion = base_motion(a, spin(a, b, dt), pull, before, vec(normal_of(asked)))
    gap = weigh(packed, dt, a, b, motion, place, forces, late)
    lag = new_lag(late, dt)
    if lag >= 0:
        for k in range(n):
            forget(forces, k)
        if lag * dt > BEARABLE * pace_of(packed) / GRAVITY:
            return LATE, -1, lag, t - 0.05
    blind = late.ticks[0] < BEGINS or late.dark[0] > 0.0 or late.better[0] > 0.0
    return judge(packed, dt, forces, readings, b, motion[4], gap, blind, t)


@kernel
def pace_of(packed):
    """√(g h) of a `Robot.packed` [m/s]."""
    return scales(packed)[2] * packed[-1]


@kernel
def check_sensors(readings, a, b, dt):
    """What the readings show by themselves: (what is found, leg, joint)."""
    found = check_body(readings, a, b, dt)
    if found != STEADY:
        return (IMU_FROZEN if found == REPEAT_BODY else IMU_TILTED), -1, -1
    same, load, before = readings.same_load, b.load, a.load
    for k in range(load.size):
        same[k] = same[k] + 1.0 if load[k] == before[k] else 0.0
    found, leg, joint = check_joints(readings, a, b, dt)
    if found != STEADY:
        return (ENCODER_FROZEN if found == REPEAT_JOINT else ENCODER_OFFSET), leg, joint
    return NOTHING, -1, -1


@kernel
def weigh(packed, dt, a, b, motion, place, forces, late):
    """Brings forces and balance one tick on; how far the balance is from usual, in weights."""
    _, weight, height = scales(packed)
    damping, friction = damping_of(packed), friction_of(packed)
    share, lag = dt / FILTER, int(late.lag[0])
    force, moment = base_pull(packed, motion[0], motion[1], motion[2])
    need = np.empty(3)
    at = 3 * ((place - lag) % (late.told.shape[1] // 3))
    q, rates, new, load, felt = a.q, a.qd, b.qd, b.load, a.load
    mean, numbers, believed, ring, trusted = (
        forces.mean,
        forces.now,
        forces.believed,
        late.told,
        forces.distrusted,
    )
    for k in range(load.size):
        told = (ring[k, at], ring[k, at + 1], ring[k, at + 2])
        leg, was, new_rates = leg_at(packed, k), row_of(rates, k), row_of(new, k)
        f, m, carried = leg_forces(
            leg,
            damping[k],
            friction[k],
            row_of(q, k),
            was,
            new_rates,
            dt,
            motion,
            told,
            load[k],
            share,
            mean[k],
            numbers[k],
            need,
        )
        believed[k] += 0.5 * (carried - believed[k])
        force, moment = add(force, f), add(moment, m)
        if load[k] == 0.0 and felt[k] == 0.0 and trusted[k] == 0.0:
            compare(late, k, place, need, weight * height)
    calm = forces.worst.max() <= 0.0
    return balance(forces, force, moment, weight, height, share, dt, calm)


@kernel
def judge(packed, dt, forces, readings, b, up, gap, blind, t):
    """What is certain of some leg, as `look` returns it."""
    (_, weight, height), pace = scales(packed), pace_of(packed)
    margin = MARGIN + PER_NOISE * forces.noise[0]
    lack = (
        scale(weight, (forces.lack[0] - forces.usual[0], forces.lack[1] - forces.usual[1],
                       forces.lack[2] - forces.usual[2])),
        scale(weight * height, (forces.lack[3] - forces.usual[3], forces.lack[4] - forces.usual[4],
                                forces.lack[5] - forces.usual[5])),
    )  # fmt: skip
    mean, worst, same, distrusted = forces.mean, forces.worst, readings.same_joint, forces.distrusted
    for k in range(b.load.size):
        foot = mean[k]
        healthy = misfit(vec(foot), up, foot[LOAD]) / weight + gap
        if distrusted[k] > 0.0 or (healthy < margin and worst[k] <= 0.0):
            continue
        if blind or repeats(same, k) or is_at_stop(packed, b.q[k], k):
            forget(forces, k)
            continue
        judge_leg(forces, readings, k, up, lack, healthy, weight, height, pace, margin, t, dt)
        h = verdict(forces, readings.calm, k, dt)
        if h < 0:
            continue
        since = forces.since[k, h]
        if h == SENSOR:
            forces.distrusted[k] = 1.0
            for leg in range(b.load.size):
                forget(forces, leg)
            return (FOOT_OFF if b.load[k] < CARRIES * weight else FOOT_ON), k, -1, since
        if h < DEAD_LEG:
            return MOTOR_DEAD, k, h, since
        return (LEG_DEAD, k, -1, since) if h == DEAD_LEG else (MOTOR_STUCK, k, h - STUCK, since)
    return NOTHING, -1, -1, 0.0


@kernel
def is_at_stop(packed, q, k):
    """Whether a joint of leg k is at its end: the stop bears what its motor does not, and nobody feels how
    much."""
    low, high = q_min_of(packed)[k], q_max_of(packed)[k]
    for j in range(3):  # noqa: SIM110 - a kernel
        if q[j] < low[j] + AT_STOP or q[j] > high[j] - AT_STOP:
            return True
    return False


@kernel
def load_by_torque(row, n, leg, least):
    """Load of a foot by its leg's torques [N]; none where it is less than `least`."""
    _, forces, _ = tables(row, n)
    load = forces.believed[leg]
    return load if load > least else 0.0


def seen_by(measured: Measured, sensed: Sensed, before: Row) -> Row:
    """What the watch goes by: readings as they are, and of an estimated state what the body believes; its
    attitude repeats where the gyroscope does."""
    if sensed is measured:
        return measured.row
    now, where = sensed.row.copy(), Sensed.layout.slices(len(sensed.load))
    for name in ("qd", "angular_velocity_b"):
        now[where[name]] = measured.row[where[name]]
    spin, attitude = where["angular_velocity_b"], where["orientation_wb"]
    if (now[spin] == before[spin]).all():
        now[attitude] = before[attitude]
    return now


class WatchMemory(NamedTuple):
    """What the watch remembers."""

    row: Row
    """The tables of `watch_memory`."""
    seen: Row
    """The last reading."""
    faults: tuple[Fault, ...] = ()
    asked: Row | None = None
    """The last `MotionTarget`."""
    told: Row | None = None
    """The last command, torques first."""


@dataclass(frozen=True)
class Watch:
    """Watches one robot."""

    robot: Robot
    dt: float
    """Control period [s]."""

    def check(
        self, measured: Measured, sensed: Sensed, memory: WatchMemory | None
    ) -> tuple[Sensed, WatchMemory]:
        """What is believed of a reading, and the memory, with all faults that were noticed so far."""
        now = measured.row if memory is None else seen_by(measured, sensed, memory.seen)
        if memory is None:
            return sensed, WatchMemory(np.zeros(size_of(self.robot.n)), now)
        if ends_trip(memory.faults) or memory.told is None:
            return sensed, memory
        row, faults = memory.row.copy(), memory.faults
        kind, leg, joint, since = look(
            self.robot.packed,
            self.dt,
            memory.seen,
            now,
            measured.specific_force_b,
            memory.asked,
            memory.told,
            row,
        )
        if kind != NOTHING:
            fault = fault_of(self.robot, kind, leg, joint, since, measured.time, self.dt)
            faults = (*faults, fault)
        if faults:
            sensed = self.believed(sensed, row, faults)
        return sensed, WatchMemory(row, now, faults)

    def heard(
        self, memory: WatchMemory, target: MotionTarget, command: MotorCommand, sensed: Sensed
    ) -> WatchMemory:
        """The memory with what was asked and told in this tick."""
        told = command.row
        if command.kp is not None or command.kd is not None:
            told = command.given(sensed.q, sensed.qd, self.robot.tau_max).ravel()
        return WatchMemory(memory.row, memory.seen, memory.faults, target.row, told)

    def believed(self, sensed: Sensed, row: Row, faults: tuple[Fault, ...]) -> Sensed:
        """What is sensed, with the load by torques where a foot's sensor lies."""
        n, least = self.robot.n, LEAST_LOAD * self.robot.total_mass * GRAVITY
        load = sensed.load.copy()
        for fault in faults:
            if fault.kind in FOOT_FAULTS and fault.leg is not None:
                leg = self.robot.legs.index(fault.leg)
                load[leg] = load_by_torque(row, n, leg, least)
        seen = sensed.row.copy()
        seen[-n:] = load
        return Sensed.of_row(seen, time=float(seen[0]))
