"""How the stance feet share a load, told once more in newtons for other solvers: HiGHS and quadprog.

Both are of use to tests and benches only. What they solve is put together from the physics, not from the
rows of our kernels: a slip there would show as a difference here.
"""

from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np
from jaxtyping import Bool, Float

from gaitwright.control.forces import (
    FORCE_WEIGHTS,
    MOMENT_WEIGHTS,
    MOST_NORMAL,
    PYRAMID,
    SMALL,
    SMOOTH,
    contact_frame,
    distribute,
    to_world,
)
from gaitwright.control.inverse_dynamics import Load
from gaitwright.control.linear import Shared, distribute_linear
from gaitwright.control.thesis_program import LinearSettings
from gaitwright.numerics.geometry import GRAVITY

NONE = np.zeros(3)
WAYS = (("highs", True), ("highs", False), ("highs-ipm", True))
"""Methods of HiGHS, and whether to presolve: each is asked where the ones before it could not tell."""
UNDECIDED = 4
"""Status of `scipy.optimize.linprog` where HiGHS ran into numerical difficulties."""
TOLERANCES = {"primal_feasibility_tolerance": 1e-9, "dual_feasibility_tolerance": 1e-9}


@dataclass(frozen=True)
class Task:
    """What a distribution is asked, leg torques `free - push @ force - turn @ moment` included."""

    load: Load
    stance: Bool[np.ndarray, "legs"]
    load_scale: Float[np.ndarray, "legs"]
    """How much of the bound of its normal force a foot may use."""
    friction: Float[np.ndarray, "legs"]
    """Coefficient of friction of each foot."""
    normal_w: Float[np.ndarray, "3"]
    previous_w: Float[np.ndarray, "legs 3"]
    """Foot forces of the last tick [N]."""
    tau_max: Float[np.ndarray, "legs 3"]
    qd: Float[np.ndarray, "legs 3"]
    weight: float
    """[N]"""
    height: float
    """[m]"""

    def linear(self, asked: LinearSettings, hints: np.ndarray | None = None) -> Shared:
        """Our answer by the linear program, from the last basis where `hints` has one."""
        none = np.full(int(asked.components) * self.stance.size + 1, -1)
        return distribute_linear(
            self.packed, self.stance, self.load_scale, self.friction, self.normal_w, self.previous_w,
            self.tau_max, self.weight,
            self.height, self.qd, np.array(asked), none if hints is None else hints,
        )  # fmt: skip

    def quadratic(self) -> tuple[np.ndarray, np.ndarray, int, int]:
        """Our answer by the quadratic program: forces `(legs, 3)` [N], prices, code and culprit."""
        x, prices, code, culprit = distribute(
            self.packed, self.stance, self.load_scale, self.friction, self.normal_w, self.previous_w,
            self.tau_max, self.weight,
            self.height,
        )  # fmt: skip
        return to_world(x, self.stance, contact_frame(self.normal_w), self.weight), prices, code, culprit

    @property
    def packed(self) -> Float[np.ndarray, "numbers"]:
        """The load as kernels read it."""
        return np.concatenate([np.ravel(part) for part in self.load])

    @property
    def down(self) -> np.ndarray:
        """Indices of the legs in stance."""
        return np.flatnonzero(self.stance)

    @property
    def row_scale(self) -> Float[np.ndarray, "6"]:
        """Turns a wrench into shares of the weight, weighted."""
        moments = (w / self.height for w in MOMENT_WEIGHTS)
        return np.array([*FORCE_WEIGHTS, *moments]) / self.weight


def wrench_rows(arm: np.ndarray) -> np.ndarray:
    """Wrench per force at `arm` `(6, 3)`."""
    x, y, z = arm
    return np.vstack([np.eye(3), [[0, -z, y], [z, 0, -x], [-y, x, 0]]])


# --- quadratic, by quadprog ------------------------------------------------------------------------
def by_quadprog(task: Task) -> Float[np.ndarray, "legs 3"] | None:
    """Foot forces [N] of the quadratic program; `None` where no forces keep the limits."""
    W, m = task.weight, len(task.down)
    rows, least = limits_of(task)
    A = task.row_scale[:, None] * np.hstack([wrench_rows(arm) for arm in task.load.arm[task.down]])
    b = task.row_scale * task.load.wrench
    hessian = A.T @ A + (SMALL + SMOOTH) / W**2 * np.eye(3 * m)
    linear = A.T @ b + SMOOTH / W**2 * task.previous_w[task.down].ravel()
    try:
        found = import_module("quadprog").solve_qp(W**2 * hessian, W**2 * linear, rows.T, least)[0]
    except ValueError as no:
        if "inconsistent" not in str(no):
            raise
        return None
    out = np.zeros(task.previous_w.shape)
    out[task.down] = found.reshape(-1, 3)
    return out


def limits_of(task: Task) -> tuple[np.ndarray, np.ndarray]:
    """Rows and least values of the limits: rows @ forces ≥ least."""
    t1, t2, n = contact_frame(task.normal_w)
    rows, least = [], []
    for k, leg in enumerate(task.down):
        sides = [(n, 0.0), (-n, -MOST_NORMAL * task.load_scale[leg] * task.weight)]
        sides += [(PYRAMID * task.friction[leg] * n - s * t, 0.0) for t in (t1, t2) for s in (1, -1)]
        for push, free, most in zip(task.load.push[leg], task.load.free[leg], task.tau_max[leg], strict=True):
            sides += [(s * push, s * free - most) for s in (1, -1)]
        for normal, bound in sides:
            row = np.zeros((len(task.down), 3))
            row[k] = normal
            rows.append(row.ravel())
            least.append(bound)
    return np.array(rows), np.array(least)


# --- linear, by HiGHS ------------------------------------------------------------------------------
class Program:
    """A linear program put together quantity by quantity, in newtons and newton-metres."""

    def __init__(self, unknowns: int) -> None:
        self.unknowns = unknowns
        self.upper: list[tuple[np.ndarray, int | None, float]] = []
        """row · x ≤ bound, less an unknown of its own where there is one."""
        self.equal: list[tuple[np.ndarray, float]] = []
        self.cost, self.constant = np.zeros(unknowns), 0.0
        self.extra_cost: list[float] = []

    def at_most(self, row: np.ndarray, bound: float, less: int | None = None) -> None:
        self.upper.append((row, less, bound))

    def another(self, price: float) -> int:
        """One more unknown, at least 0, with a price."""
        self.extra_cost.append(price)
        return len(self.extra_cost) - 1

    def pay(self, row: np.ndarray, value: float, price: float) -> None:
        """Adds price times |row · x − value|."""
        size = self.another(price)
        self.at_most(row, value, size)
        self.at_most(-row, -value, size)

    def solve(self) -> Any:
        """What `scipy.optimize.linprog` finds, its objective with the constant."""
        more = len(self.extra_cost)
        rows = np.zeros((len(self.upper), self.unknowns + more))
        for r, (row, less, _) in enumerate(self.upper):
            rows[r, : self.unknowns] = row
            if less is not None:
                rows[r, self.unknowns + less] = -1.0
        cost, upper = [*self.cost, *self.extra_cost], [bound for *_, bound in self.upper]
        A = np.array([np.concatenate([row, np.zeros(more)]) for row, _ in self.equal]) if self.equal else None
        b = [value for _, value in self.equal] if self.equal else None
        bounds = [(None, None)] * self.unknowns + [(0, None)] * more

        def ask(method: str, presolve: bool) -> Any:
            options = {"presolve": presolve} | TOLERANCES
            linprog = import_module("scipy.optimize").linprog
            return linprog(cost, rows, upper, A, b, bounds, method=method, options=options)

        best = ask(*WAYS[0])
        for way in WAYS[1:]:
            if best.status == UNDECIDED:
                best = ask(*way)
        if best.success:
            best.fun += self.constant
        return best


@dataclass(frozen=True)
class Foot:
    """Rows of one stance foot over all unknowns: force and moment of every foot, in weights, world axes."""

    place: int
    feet: int

    def row(self, force: np.ndarray, moment: np.ndarray) -> np.ndarray:
        """force · f + moment · m, f in weights, m in weights × height."""
        out = np.zeros((self.feet, 2, 3))
        out[self.place] = force, moment
        return out.ravel()


def by_highs(task: Task, asked: LinearSettings) -> Any:
    """The thesis's program by HiGHS: an `OptimizeResult`, `status` 0 solved, 2 infeasible."""
    program = Program(6 * len(task.down))
    balance(program, task, asked)
    peak = program.another(0.0 if asked.literal else 1.0 - asked.xi)
    for k, leg in enumerate(task.down):
        foot = Foot(k, len(task.down))
        contact(program, task, asked, foot, int(leg), peak)
        motors(program, task, asked, foot, int(leg))
    return program.solve()


def balance(program: Program, task: Task, asked: LinearSettings) -> None:
    """The wrench of the feet is the one wanted, or misses it at a price."""
    rows = np.zeros((6, len(task.down), 2, 3))
    for k, arm in enumerate(task.load.arm[task.down]):
        rows[:, k, 0] = task.weight * wrench_rows(arm)
        rows[3:, k, 1] = task.weight * task.height * np.eye(3)
    rows *= task.row_scale[:, None, None, None]
    wanted = task.row_scale * task.load.wrench
    soft = np.isfinite(asked.unmet)
    if len(task.down) < 3 and asked.components == 3 and soft:
        # What point feet span of it.
        forces = rows[:, :, 0].reshape(6, -1)
        wanted = forces @ np.linalg.pinv(forces, rcond=1e-9) @ wanted
    for row, value in zip(rows.reshape(6, -1), wanted, strict=True):
        if soft:
            program.pay(row, value, asked.unmet)
        else:
            program.equal.append((row, value))


def contact(program: Program, task: Task, asked: LinearSettings, foot: Foot, leg: int, peak: int) -> None:
    """A foot pushes, does not slip, tip or twist, and changes its force at a price."""
    axes = contact_frame(task.normal_w)
    normal = foot.row(axes[2], NONE)
    program.at_most(-normal, 0.0)
    program.at_most(normal, asked.most_normal * task.load_scale[leg])
    if asked.literal:
        program.cost += (1.0 - asked.xi) * normal
    else:
        program.at_most(normal, 0.0, peak)
    width = min(asked.friction, PYRAMID * task.friction[leg])
    levers = np.array([asked.roll_lever, asked.pitch_lever, asked.twist_lever])
    levers *= (asked.components == 6) / task.height
    for axis, lever in zip(axes, levers, strict=True):
        program.pay(foot.row(axis, NONE), axis @ task.previous_w[leg] / task.weight, asked.change)
        for sign in (1.0, -1.0):
            program.at_most(foot.row(NONE, sign * axis) - lever * normal, 0.0)
            if not np.array_equal(axis, axes[2]):
                program.at_most(foot.row(sign * axis, NONE) - width * normal, 0.0)


def motors(program: Program, task: Task, asked: LinearSettings, foot: Foot, leg: int) -> None:
    """A leg's torques keep their limits, and their power has a price."""
    W, h = task.weight, task.height
    for j in range(3):
        limit, free = task.tau_max[leg, j], task.load.free[leg, j]
        tau = -foot.row(W * task.load.push[leg, j], W * h * task.load.turn[leg, j])
        program.at_most(tau / limit, 1.0 - free / limit)
        program.at_most(-tau / limit, 1.0 + free / limit)
        power = asked.xi * task.qd[leg, j] / (W * np.sqrt(GRAVITY * h))
        if asked.literal:
            program.cost += power * tau
            program.constant += power * free
        else:
            program.pay(power * tau, -power * free, 1.0)


def missing() -> str:
    """Which of the two cannot be asked here, as a sentence; empty where both can."""
    absent = [name for name in ("scipy", "quadprog") if not find_spec(name)]
    return f"{' and '.join(absent)} not installed: of the tests only" if absent else ""
