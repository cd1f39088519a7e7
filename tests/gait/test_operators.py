"""Terrain operators: which obstacle is ahead of a leg, which one answers it, and what that does to a foot."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.errors import WrongUse
from gaitwright.gait.coordinator import Coordinator
from gaitwright.gait.leg_cycles.leg_cycle import BINS
from gaitwright.gait.obstacle import ahead_of, enhance, obstacle_over, operator_for, reach_needed
from gaitwright.gait.operators import KINDS, SHARES, Operator, packed
from gaitwright.gait.state import SWING
from gaitwright.ground.elevation import BLIND, elevation_grid, height_at
from gaitwright.ground.scene import Box, Scene, load_scene
from gaitwright.ground.terrain import Flat
from gaitwright.locomotion import Brain
from gaitwright.plant.registry import make_plant
from gaitwright.session import DT, Session
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill
from oracles import robot_called

DOG = robot_called("go2")
H, R = DOG.height, 0.02
S = np.linspace(0.0, 1.0, SHARES)
HUMP = np.stack([np.zeros(SHARES), np.sin(np.pi * S) ** 2], axis=1)
HUMP[[0, -1]] = 0.0


def operator(
    name: str = "over", kinds: tuple[str, ...] = KINDS[:3], largest: float = 0.1, **others
) -> Operator:
    force = np.tile([0.0, 30.0, 100.0], (SHARES, 1))
    return Operator(name, kinds, largest, HUMP, others.pop("force", force), 0.2, **others)


def ground_of(*boxes: Box):
    return elevation_grid(Scene("boxes", Flat(), boxes, (-1.0, -1.0, 3.0, 1.0)), DOG)


def from_to(ground, x: float, way: float):
    """Where a foot stands that left at x, and where it goes."""
    origin = np.array([x, 0.0, height_at(ground, x, 0.0) + R])
    return ahead_of(ground, origin, x + way, 0.0, R, H)


# --- what is ahead -----------------------------------------------------------------------------------
def test_obstacles_are_told_apart() -> None:
    block = ground_of(Box(1.0, 0.0, 0.0, 0.10, 1.5, 0.06))
    kind, size = from_to(block, 0.88, 0.24)
    assert KINDS[kind] == "block" and size == pytest.approx(0.06, abs=0.005)
    wide = ground_of(Box(1.5, 0.0, 0.0, 1.0, 1.5, 0.06))
    kind, size = from_to(wide, 0.85, 0.3)
    assert KINDS[kind] == "step up" and size == pytest.approx(0.06, abs=0.002)
    kind, size = from_to(wide, 1.85, 0.3)
    assert KINDS[kind] == "step down" and size == pytest.approx(0.06, abs=0.002)
    islands = ground_of(Box(0.0, 0.0, 0.0, 2.0, 1.5, 0.5), Box(2.15, 0.0, 0.0, 2.0, 1.5, 0.5))
    kind, size = from_to(islands, 0.9, 0.3)
    assert KINDS[kind] == "hole" and size == pytest.approx(0.15, abs=0.05)
    ramp = elevation_grid(load_scene("ramp:15"), DOG)
    kind, size = from_to(ramp, 1.6, 0.2)
    assert KINDS[kind] == "slope" and size == pytest.approx(np.tan(np.radians(15.0)), abs=0.02)
    assert from_to(block, 0.3, 0.2)[0] == -1 and from_to(BLIND, 0.3, 0.2)[0] == -1


def test_the_first_operator_that_serves_a_kind_and_size_answers() -> None:
    small, large = operator("small", largest=0.05), operator("large", largest=0.1)
    hole = operator("hole", ("hole",), 0.2)
    terms = packed((small, large, hole)).terms
    assert operator_for(terms, 0, 0.04) == 0 and operator_for(terms, 0, 0.08) == 1
    assert operator_for(terms, 0, 0.12) == -1 and operator_for(terms, 3, 0.12) == 2
    assert operator_for(packed((large, small)).terms, 0, 0.04) == 0, "in the order in which they stand"


@given(high=st.floats(0.03, 0.09), x=st.floats(0.80, 0.95))
def test_a_foot_clears_what_its_operator_is_applied_to(high: float, x: float) -> None:
    ground = ground_of(Box(1.0, 0.0, 0.0, 0.08, 1.5, high))
    table, way = packed((operator(),)).tables[0], 0.30
    cycle = np.zeros((BINS + 1, 6))
    cycle[:, 0] = np.linspace(0.0, 1.0, BINS + 1)
    origin = np.array([x, 0.0, R])
    reach = reach_needed(ground, origin, x + way, 0.0, R, R, 1.0, cycle, table, H)
    assert 0.0 <= obstacle_over(ground, origin, x + way, 0.0, R, R) <= high + 1e-9
    for k in range(0, BINS + 1, 4):
        if table[k, 3] > 0.3 and reach < 0.44 * H:
            assert reach * table[k, 3] >= height_at(ground, x + way * cycle[k, 0], 0.0) - 0.01


@given(reach=st.floats(0.0, 0.1), s=st.floats(0.0, 1.0), duration=st.floats(0.1, 0.4))
def test_velocity_and_acceleration_are_those_of_the_path(reach: float, s: float, duration: float) -> None:
    table, e = packed((operator(),)).tables[0], 1e-3

    def at(share: float):
        p, v, a = np.zeros(3), np.zeros(3), np.zeros(3)
        force = enhance(table, reach, share, duration, 0.2, 0.3, 0.0, p, v, a)
        return p, v, force

    s = min(max(s, 2 * e), 1 - 2 * e)
    (before, _, _), (after, _, _), (_, v, force) = at(s - e), at(s + e), at(s)
    assert v == pytest.approx(
        (after - before) / (2 * e * duration), rel=0.05, abs=0.1 * reach / duration + 1e-3
    )
    assert force == pytest.approx(reach * (0.2 / duration) ** 2 * np.array([0.0, 30.0, 100.0]))


# --- in a walking robot --------------------------------------------------------------------------------
def laps(operators, imagined=(), scene: str | Scene = "flat", seconds: float = 2.0, x: float = 0.0):
    ground = load_scene(scene) if isinstance(scene, str) else scene
    brain = Brain.of(DOG, ground, fixed_skill(DOG, "trot", None, 0.0, None, "numerical"), DT, watches=False)
    brain = brain.with_operators(operators)
    assert isinstance(brain.coordinator, Coordinator)
    brain = replace(brain, coordinator=replace(brain.coordinator, imagined=imagined))
    session = Session(brain, make_plant("mujoco", DOG, ground, DT), Mission(()), seconds, 0)
    for lap in session:
        yield lap, session.mind.memories.gait.state


def test_an_imagined_obstacle_raises_one_leg_by_its_size_and_tells_its_force() -> None:
    highest, forces = np.zeros(4), np.zeros((4, 3))
    for lap, state in laps((operator(),), (0.0, 0.05, 0.0, 0.0)):
        up = lap.target.feet_w[:, 2] - state.origin[:, 2]
        highest = np.where(state.mode == SWING, np.maximum(highest, up), highest)
        forces += lap.target.extra_force_w
    assert highest[1] - highest[0] == pytest.approx(0.05, abs=0.004)
    assert highest[2:] == pytest.approx(highest[0], abs=0.004)
    assert not forces[[0, 2, 3]].any() and forces[1, 2] > 0.0
    assert forces[1, 1] < 0.0, "a right leg is the mirror of a left one"


def test_without_operators_nothing_is_told_and_the_leg_cycle_is_raised() -> None:
    raised = [lap.target for lap, _ in laps((), (0.0, 0.05, 0.0, 0.0))]
    assert not any(t.operator.any() or t.extra_force_w.any() for t in raised)
    assert max(t.feet_w[1, 2] for t in raised) > max(t.feet_w[0, 2] for t in raised) + 0.04


def test_an_obstacle_is_answered_by_an_operator_or_said_to_be_beyond_them() -> None:
    scene = Scene("step", Flat(), (Box(2.0, 0.0, 0.0, 2.4, 1.5, 0.08),), (-2.0, -1.0, 4.0, 1.0))
    for largest, number in ((0.1, 1.0), (0.01, -1.0)):
        seen = {
            float(k)
            for lap, _ in laps((operator(largest=largest),), (), scene, 3.5)
            for k in lap.target.operator
        }
        assert seen == {0.0, number}


# --- what is none --------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("others", "told"),
    [
        ({"kinds": ("wall",)}, "is for wall; there are: block"),
        ({"kinds": ()}, "is for nothing"),
        ({"largest": 0.0}, "at no size"),
        ({"largest": float("nan")}, "at no size"),
        ({"path": HUMP + 0.1}, "where it leaves or meets the ground"),
        ({"path": 1000.0 * HUMP}, "by more than"),
        ({"path": np.full((SHARES, 2), np.nan)}, "not finite"),
        ({"path": HUMP[:5], "force": np.zeros((5, 3))}, "has not the 33 rows"),
        ({"landing": 9.0}, "by more than"),
        ({"force": np.full((SHARES, 3), 1e6)}, "N per metre"),
    ],
)
def test_what_leaps_is_no_operator(others: dict, told: str) -> None:
    with pytest.raises(WrongUse, match=told):
        replace(operator(), **others)
