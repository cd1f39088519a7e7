"""SkillCall + Sensed → MotionTarget: the joint coordination control of the thesis (rows J1 … J5)."""

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.gait.body_reference import base_reference, pitching, write_body
from gaitwright.gait.clearance import is_on_ground
from gaitwright.gait.command import advance_reference, slew
from gaitwright.gait.contact_plane import advance_ground, plane_normal
from gaitwright.gait.contacts import advance_legs, is_lifting, is_waited_for, shares
from gaitwright.gait.foot_references import feet_in_base, feet_in_world, feet_reference, shank_leans
from gaitwright.gait.grip import feel_grip
from gaitwright.gait.hurry import hurried
from gaitwright.gait.leg_cycles.files import cycle_of
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle, tabulated_legs
from gaitwright.gait.operators import Operator, Packed, packed
from gaitwright.gait.reach_assist import reach_assist
from gaitwright.gait.reference import periodic_reference
from gaitwright.gait.state import STANCE, SWING, GaitMemory, standing, state_of
from gaitwright.gait.transition import has_rhythm_of, is_new, may_start, start_gait
from gaitwright.ground.elevation import BLIND
from gaitwright.model.kinematics import all_angles
from gaitwright.model.robot import Robot, unpacked
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import (
    GRAVITY,
    add,
    heading,
    rotation,
    upright_rotation,
    vec,
)
from gaitwright.numerics.matrices import write
from gaitwright.signals import GRIP, ElevationGrid, Gait, GroundMap, MotionTarget, Sensed, SkillCall

target_fields = MotionTarget.layout.views(raw=True)
sensed_fields = Sensed.layout.views()

CONTACT_THRESHOLD = 0.02
"""A foot that carries this share of the weight is in contact."""


@kernel
def lead(
    numbers,
    height,
    stand,
    threshold,
    table,
    clock,
    offsets,
    cycles,
    terms,
    over,
    imagined,
    leans,
    place,
    heights,
    edges,
    rise,
    friction,
    asked,
    seen,
    dt,
    memory,
    out,
):
    """One tick of joint coordination: changes the row of the memory and writes that of a `MotionTarget`, all
    but its joint angles.

    `numbers`: the packed robot; `height`, `stand`: of its base over ground and foot centres; `threshold`:
    load of a foot in contact [N]; `clock`: (period, duty); `cycles`: the leg cycles, a table a leg;
    `terms`, `over`: the terrain operators; `imagined`: obstacles that legs take for seen [m];
    `leans`: `shank_leans`; `place`, `heights`, `edges`: the `ElevationGrid`; `rise`: the most that
    its ground may step up or down [m]; `friction`: what is known of its grip; `asked`: forward, left, yaw
    rate; `seen`: the row of a `Sensed`.
    """
    model, ground = unpacked(numbers), ElevationGrid(place, heights, edges)
    (period, duty), state = clock, state_of(memory)
    was = state.phase[0]
    _, position, orientation, velocity, _, q, _, load = sensed_fields(seen)
    rotation_wb = rotation(orientation)
    at, v = vec(position), vec(velocity)
    feet_w = feet_in_world(model, rotation_wb, at, q)
    if is_new(state, clock, offsets):
        was = start_gait(state, clock, offsets, cycles, asked, model, rotation_wb, at, feet_w, height)
    period = hurried(period, v, state.command, state.reference_pose[2], height)
    clock = (period, duty)
    phase = state.phase[0]
    step = dt / period if duty < 1.0 else 0.0
    missing = is_waited_for(state, phase, step, duty, offsets, period, dt)
    if not (missing and is_lifting(state, phase, step, duty, offsets)):
        phase = (phase + step) % 1.0
    felt = feet_felt(state, model, ground, feet_w, load > threshold, height)
    feel_grip(state, felt, feet_w, friction, height, dt)
    advance_legs(state, was, phase, period, duty, offsets, felt, feet_w, dt)
    state.phase[0] = phase
    advance_ground(state.slope, state.contact, at, v, 0.5 * period, dt)
    slew(state.command, asked, asked[2], GRAVITY, height, dt)
    advance_reference(state.reference_pose, state.command, at, heading(rotation_wb), height, dt)

    base_p, base_v, base_a, pitch = base_reference(state, table, stand, at, state.reference_pose[2])
    normal = plane_normal(state.slope)
    level = upright_rotation(normal, state.reference_pose[2])
    rotation_d, omega, omega_rate = pitching(level, pitch, state.command[2])
    target = target_fields(out)
    feet = (target.feet_w, target.feet_velocity_w, target.feet_acceleration_w, target.extra_force_w)
    operators = Packed(terms, over)
    feet_reference(
        model, state, clock, cycles, operators, imagined, leans, ground, rise, level, at, v, base_v, feet_w,
        height, *feet,
    )  # fmt: skip
    target.operator[:], target.reach[:] = state.operator, state.reach
    base_p = add(base_p, reach_assist(model, state, rotation_d, base_p, feet_w, duty, height))
    target.phase[0], target.command[:] = phase, state.command
    target.stance[:] = state.mode == STANCE
    target.load_scale[:] = shares(state, phase, period, duty, offsets, missing)
    target.friction[:] = state.grip
    write(target.normal_w, 0, normal)
    write_body(target, base_p, base_v, base_a, rotation_d, omega, omega_rate)


@kernel
def coordinate(
    numbers,
    height,
    stand,
    threshold,
    table,
    clock,
    offsets,
    cycles,
    terms,
    over,
    imagined,
    leans,
    place,
    heights,
    edges,
    rise,
    friction,
    asked,
    seen,
    dt,
    memory,
    out,
):
    """`lead`, and the joint angles that realise it."""
    lead(
        numbers, height, stand, threshold, table, clock, offsets, cycles, terms, over, imagined, leans, place,
        heights, edges, rise, friction, asked, seen, dt, memory, out,
    )  # fmt: skip
    write_angles(numbers, out)


@kernel
def write_angles(numbers, out):
    """Writes the joint angles into the row of a `MotionTarget` that has all else."""
    model, target = unpacked(numbers), target_fields(out)
    in_base = feet_in_base(target.rotation_wb, vec(target.position_w), target.feet_w)
    target.q[:], _ = all_angles(model.hip, model.leg_frame, model.offset, model.sign, model.branch, in_base)


@kernel
def feet_felt(state, model, ground, feet_w, loaded, height):
    """Feet that are on the ground: those that are loaded, and in a swing only where there is ground."""
    for leg in range(loaded.size):
        if state.mode[leg] == SWING:
            loaded[leg] &= is_on_ground(ground, feet_w[leg], model.foot_radius[leg], height)
    return loaded


class Cycle(NamedTuple):
    """A gait as the kernel reads it."""

    clock: tuple[float, float]
    """Period [s] and duty factor."""
    offsets: Float[np.ndarray, "legs"]
    table: Float[np.ndarray, "bins 9"]
    """The periodic reference."""
    legs: Float[np.ndarray, "legs samples 6"]
    """The leg cycles."""


@dataclass(frozen=True)
class Coordinator:
    """Turns skill calls into targets for body, feet and joints of one robot."""

    robot: Robot
    dt: float
    """Control period [s]."""
    cycles: dict[str, LegCycle] = field(default_factory=dict)
    """Leg cycles by skill, in place of those that come along."""
    operators: tuple[Operator, ...] = ()
    """Terrain operators, in the order in which they are tried."""
    imagined: tuple[float, ...] = ()
    """Obstacles that the legs take for seen, one per leg [m]: to teach and try operators with."""
    known: dict[Gait, Cycle] = field(default_factory=dict, init=False, repr=False, compare=False)
    """Cycles worked out so far: each is a function of its gait, so what is here changes no result."""

    def begin(self, sensed: Sensed, phase: float = 0.0) -> GaitMemory:
        """The memory of a robot that stands as sensed and will start its first gait at `phase`."""
        turn = rotation(sensed.orientation_wb)
        feet_w = feet_in_world(self.robot.arrays, turn, tuple(sensed.position_w), sensed.q)
        return standing(feet_w, sensed.position_w, heading(turn), phase)

    def move(
        self, memory: GaitMemory, call: SkillCall, sensed: Sensed, ground: GroundMap | None = None
    ) -> tuple[MotionTarget, GaitMemory]:
        """What body, feet and joints should do now, and the memory for the next tick."""
        robot = self.robot
        grid, rise, friction = self.underfoot(ground)
        gait = self.possible(memory, call, sensed)
        cycle = self.cycle(gait)
        row, out = memory.row.copy(), np.empty(self.width)
        coordinate(
            robot.packed,
            robot.height,
            robot.stand,
            self.threshold,
            cycle.table,
            cycle.clock,
            cycle.offsets,
            cycle.legs,
            *self.operators_packed,
            self.imagined_sizes,
            self.leans,
            *grid,
            rise,
            friction,
            (call.velocity[0], call.velocity[1], call.turn),
            sensed.row,
            self.dt,
            row,
            out,
        )
        return MotionTarget.of_row(out), GaitMemory(row, gait)

    def underfoot(self, ground: GroundMap | None) -> tuple[ElevationGrid, float, float]:
        """What feet know of the ground: heights, the most that it steps up or down [m], and its friction."""
        if ground is None:
            return BLIND, self.robot.step_limit, GRIP
        return ground.footholds, ground.step, ground.friction

    def possible(self, memory: GaitMemory, call: SkillCall, sensed: Sensed) -> Gait:
        """The gait that is asked for, or the one in use as long as the robot is too fast for it."""
        asked, now = call.gait, memory.gait
        if now is None or asked is now or has_rhythm_of(asked, now):
            return asked
        speed = math.hypot(sensed.velocity_w[0], sensed.velocity_w[1])
        return asked if may_start(asked, speed, self.robot.height) else now

    @cached_property
    def operators_packed(self) -> Packed:
        """The terrain operators as kernels read them."""
        return packed(self.operators)

    @cached_property
    def imagined_sizes(self) -> Float[np.ndarray, "legs"]:
        return np.array(self.imagined or (0.0,) * self.robot.n)

    @cached_property
    def width(self) -> int:
        """Numbers in the row of a `MotionTarget`."""
        return MotionTarget.layout.size(self.robot.n)

    @cached_property
    def threshold(self) -> float:
        """Load of a foot that is in contact [N]."""
        return CONTACT_THRESHOLD * GRAVITY * self.robot.total_mass

    @cached_property
    def leans(self) -> Float[np.ndarray, "legs 2"]:
        """How far each shank leans per height in the nominal stance, base axes."""
        return shank_leans(self.robot)

    def cycle(self, gait: Gait) -> Cycle:
        """The cycle of `gait`, worked out at its first use."""
        cycle = self.known.get(gait)
        if cycle is None:
            table = periodic_reference(self.robot, gait)
            legs = tabulated_legs(self.cycles.get(gait.name) or cycle_of(gait.name), self.robot.n)
            cycle = self.known[gait] = Cycle((gait.period, gait.duty), np.array(gait.offsets), table, legs)
        return cycle
