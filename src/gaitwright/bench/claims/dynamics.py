"""Claim: our dynamics are exact, and no slower than Pinocchio's, called from Python in the same run."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from statistics import median
from time import perf_counter_ns

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.dynamics_agreement import (
    any_state,
    armstrong_agreement,
    closed_form_agreement,
    direct_agreement,
    inverse_agreement,
    pinocchio_state,
)
from gaitwright.bench.evidence.oracles import ball_model, hinge_model, pinocchio
from gaitwright.bench.measurement import Figure, Wanted, at_most
from gaitwright.description.load import load_robot
from gaitwright.dynamics.armstrong import packed_accelerations
from gaitwright.dynamics.newton_euler import dynamics_of
from gaitwright.dynamics.tree import ball_rotations, ball_tree, packed
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, rotation

ROUNDS, CALLS = 200, 100
QUICK_ROUNDS = 20
NOTE = (
    "Dynamics: every round times each contender once, from Python, in turns; a ratio is the median of the "
    "ratios of all rounds. Ours gives wrench, torques, feet and Jacobians in one call; Pinocchio's RNEA "
    "gives wrench and torques. Pinocchio is a test dependency: without it ratios are missing."
)

Calls = Mapping[str, Callable[[], object]]


def measure(context: Context) -> Iterator[Figure]:
    """Ratios of times, growth with the number of legs, and agreement on random states."""
    pin = pinocchio()
    rounds = QUICK_ROUNDS if context.quick else ROUNDS
    go2, thesis = load_robot("go2"), load_robot("thesis")
    context.voice.say("dynamics: timing")
    yield from inverse(pin, go2, rounds)
    yield from direct(pin, thesis, rounds)
    yield growth(rounds)
    context.voice.say("dynamics: comparing answers")
    robots = (go2, thesis, load_robot("hexapod"))
    for robot in robots:
        yield closed_form_agreement(robot, context.seed)
    if pin is None:
        return
    for robot in robots:
        yield inverse_agreement(pin, robot, context.seed)
    yield direct_agreement(pin, go2, context.seed)
    yield from armstrong_agreement(pin, thesis, context.seed)


def inverse(pin, robot: Robot, rounds: int) -> Iterator[Figure]:
    """Inverse dynamics with feet and Jacobians over Pinocchio's recursion alone."""
    state = any_state(robot, np.random.default_rng(0))
    calls: dict[str, Callable[[], object]] = {"ours": lambda: dynamics_of(robot.packed, state)}
    if pin:
        model = hinge_model(robot)
        data, q, v, a = model.createData(), *pinocchio_state(robot, state)
        calls["theirs"] = lambda: pin.rnea(model, data, q, v, a)
    what = f"{robot.name}: inverse dynamics with feet and Jacobians over Pinocchio's RNEA"
    yield from compared(what, calls, rounds, at_most(1.0))


def direct(pin, robot: Robot, rounds: int) -> Iterator[Figure]:
    """Armstrong's recursion over Pinocchio's articulated bodies, on the same ball-jointed tree."""
    tree, _ = ball_tree(robot)
    n = tree.mass.size
    rng = np.random.default_rng(0)
    R = ball_rotations(robot, rotation(rng.normal(size=4)), rng.uniform(-1.0, 1.0, (robot.n, 3)))
    numbers, motion = packed(tree), np.concatenate([R.ravel(), rng.normal(size=3 * n)])
    load = np.concatenate([rng.normal(size=9 * n), [0.0, 0.0, -GRAVITY]])
    calls: dict[str, Callable[[], object]] = {"ours": lambda: packed_accelerations(numbers, motion, load)}
    if pin:
        model = ball_model(tree, load[-3:])
        data, q, v = model.createData(), pin.randomConfiguration(bounded(model)), rng.normal(size=model.nv)
        tau = rng.normal(size=model.nv)
        calls["theirs"] = lambda: pin.aba(model, data, q, v, tau)
    what = f"{robot.name}, {n} links: Armstrong's recursion over Pinocchio's ABA"
    yield from compared(what, calls, rounds, at_most(1.0))


def bounded(model):
    """The model with places from which a configuration can be drawn."""
    model.lowerPositionLimit[:3], model.upperPositionLimit[:3] = -1.0, 1.0
    return model


def growth(rounds: int) -> Figure:
    """What eight legs cost over four."""
    four = load_robot("go2")
    eight = with_twice_the_legs(four)
    states = {robot.n: any_state(robot, np.random.default_rng(0)) for robot in (four, eight)}
    times = interleaved(
        {
            "four": lambda: dynamics_of(four.packed, states[4]),
            "eight": lambda: dynamics_of(eight.packed, states[8]),
        },
        rounds,
    )
    each = [b / a for a, b in zip(times["four"], times["eight"], strict=True)]
    return Figure("dynamics of eight legs over four", median(each), "×", at_most(2.5), rounds)


def with_twice_the_legs(robot: Robot) -> Robot:
    """A robot that has every leg of another one twice."""
    own = {name: getattr(robot, name) for name in robot.arrays._fields[3:-1]}
    twice = {name: np.concatenate([value, value]) for name, value in own.items()}
    limits = {
        name: np.tile(getattr(robot, name), (2, 1)) for name in ("damping", "friction", "q_min", "q_max")
    }
    return replace(robot, legs=(*robot.legs, *(f"{leg}2" for leg in robot.legs)), **twice, **limits)


# --- timing ----------------------------------------------------------------------------------------
def interleaved(calls: Calls, rounds: int) -> dict[str, list[float]]:
    """µs per call of every contender in every round, the order turned round each time."""
    for call in calls.values():
        call()
    times: dict[str, list[float]] = {name: [] for name in calls}
    for number in range(rounds):
        for name in list(calls)[:: 1 if number % 2 else -1]:
            call, began = calls[name], perf_counter_ns()
            for _ in range(CALLS):
                call()
            times[name].append((perf_counter_ns() - began) / 1e3 / CALLS)
    return times


def compared(what: str, calls: Calls, rounds: int, wanted: Wanted) -> Iterator[Figure]:
    """Our time in µs, and the ratio where the peer is there."""
    times = interleaved(calls, rounds)
    ours = median(times["ours"])
    if "theirs" not in times:
        yield Figure(what, float("nan"), "×", wanted, 0, f"ours {ours:.1f} µs; Pinocchio is not installed")
        return
    each = [a / b for a, b in zip(times["ours"], times["theirs"], strict=True)]
    note = f"{ours:.1f} µs over {median(times['theirs']):.1f} µs"
    yield Figure(what, median(each), "×", wanted, rounds, note, {"each_round": each})
