"""Figures 6.9 and 6.10: strides, terrain curves and what is claimed of them, on curves made by hand and on a
short walk."""

import json
from pathlib import Path

import numpy as np
import pytest

from gaitwright import reproduce
from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.reproduce.figure_6_9 import BLOCKS, LATER, OBSTACLES, stood_on, too_wide
from gaitwright.reproduce.seen_walk import FootPaths, SeenWalk, TerrainCurve, leans, paths_as_plain, seen_walk
from gaitwright.reproduce.side_views import draw_side_views
from gaitwright.reproduce.stride_claims import (
    balance_claim,
    curve_claim,
    hind_claim,
    order_claim,
    rests_claim,
    room_claim,
    stride_grid,
    tracking_claim,
)
from gaitwright.reproduce.strides import ALONG, OFF, ONTO, OVER, Stride, strides_of
from gaitwright.reproduce.terrain_curve import agreement, rests, seen_at
from gaitwright.signals import Mission
from oracles import robot_called

ABOVE = 0.03
"""Room that the feet made here keep over an obstacle [m]."""


def bar(x: np.ndarray, start: float = 0.08, end: float = 0.12, high: float = 0.05) -> np.ndarray:
    """The ground with a bar across the way."""
    return np.where((x >= start) & (x <= end), high, 0.0)


def boxed(ground=bar, leg: int = 0, top: float = 0.05 + ABOVE) -> Stride:
    """A stride of 20 cm that goes up, forward and down."""
    up = np.column_stack([np.zeros(20), np.linspace(0.0, top, 20)])
    forward = np.column_stack([np.linspace(0.0, 0.2, 60), np.full(60, top)])
    low = float(ground(np.array([0.2]))[0])
    down = np.column_stack([np.full(20, 0.2), np.linspace(top, low, 20)])
    x, z = np.concatenate([up, forward, down]).T
    return Stride(leg, x, z, ground(x))


def dragged(leg: int = 0) -> Stride:
    """A stride that rises all the way and drops at the end: it goes through the bar."""
    x = np.linspace(0.0, 0.2, 100)
    return Stride(leg, x, np.where(x < 0.2, 0.4 * x, 0.0), bar(x))


def step(x: np.ndarray) -> np.ndarray:
    return np.where(x >= 0.1, 0.05, 0.0)


# --- strides ---------------------------------------------------------------------------------------
def test_a_stride_is_told_by_the_edges_under_it():
    assert boxed().does == OVER
    assert boxed(step).does == ONTO
    assert boxed(lambda x: 0.05 - step(x)).does == OFF
    assert boxed(np.zeros_like).does == ALONG
    assert boxed(lambda x: 0.3 * x).does == ALONG  # a slope has no edge


def test_room_and_corners_of_a_stride():
    stride = boxed()
    assert stride.room == pytest.approx(ABOVE)
    b, c = stride.corners
    assert stride.z[b] > 0.05 >= stride.z[b - 1]  # B: free of what is in the way
    assert stride.z[c] >= 0.9 * stride.z.max() > stride.z[c + 1]  # C: from here on it comes down
    assert stride.forward == pytest.approx((0.0, 1.0))
    assert np.isnan(boxed(np.zeros_like).room)
    assert dragged().room < 0.0


def test_strides_are_those_that_were_made_whole():
    n = 100
    x = np.linspace(0.0, 1.0, n)
    z = np.zeros(n)
    swings = np.zeros(n)
    for start, end, high in ((0, 10, 0.1), (20, 40, 0.1), (50, 70, 0.005), (80, 100, 0.1)):
        swings[start:end], z[start:end] = 1.0, high
    touches = np.zeros(n)
    touches[30] = 1.0
    raised = np.where(x > 0.35, 1.0, 0.0)
    paths = FootPaths(
        np.stack([x, np.zeros(n), z], axis=1)[:, None], *(a[:, None] for a in (swings, touches, raised))
    )
    (stride,) = strides_of(paths, Flat(), [0])  # begun before, hardly lifted, not ended: no strides
    assert stride.raised and stride.hit
    assert stride.x[[0, -1]] == pytest.approx(x[[19, 40]])
    quiet = paths._replace(touches=np.roll(paths.touches, 9, axis=0))  # as it lands
    assert not strides_of(quiet, Flat(), [0])[0].hit


# --- what is claimed of them -----------------------------------------------------------------------
def test_feet_that_go_over_agree_and_one_that_goes_through_does_not():
    assert room_claim([boxed(), boxed(step)], "free").agrees
    claim = room_claim([boxed(), dragged()], "free")
    assert claim.agrees is False and claim.numbers["strides"] == 2


def test_the_order_is_up_forward_down():
    assert order_claim([boxed(), boxed(step), dragged()]).agrees  # by the medians
    assert order_claim([dragged()]).agrees is False


def test_hind_feet_are_judged_alone():
    robot = robot_called("go2")
    assert hind_claim([dragged(0), boxed(leg=2)], robot).agrees
    assert hind_claim([boxed(), dragged(2)], robot).agrees is False


def test_a_walk_that_ended_before_it_met_anything_agrees_with_nothing():
    robot, along = robot_called("go2"), [boxed(np.zeros_like)]
    found = (room_claim(along, ""), order_claim(along), hind_claim(along, robot), tracking_claim(along))
    assert [claim.agrees for claim in found] == 4 * [False]


def test_a_foot_that_stays_up_behind_an_obstacle_does_not_track_the_ground():
    usual = [boxed(np.zeros_like, top=0.07) for _ in range(4)]
    assert tracking_claim([*usual, boxed(), boxed(np.zeros_like, top=0.072)]).agrees
    assert tracking_claim([*usual, boxed(), boxed(np.zeros_like, top=0.09)]).agrees is False


def test_who_stands_on_what():
    robot = robot_called("go2")

    def ends(leg: int, place: int) -> Stride:
        x = OBSTACLES[place][0] + (0.0 if robot.nominal_feet[leg, 1] > 0.0 else LATER)
        onto = boxed(step, leg)
        return Stride(leg, onto.x + x - 0.2, onto.z, onto.ground)

    assert stood_on(ends(0, 2), True) == 2 and stood_on(ends(1, 4), False) == 4
    assert stood_on(ends(1, 4), True) is None
    all_of_them = [ends(leg, place) for leg in range(4) for place in BLOCKS]
    assert too_wide([*all_of_them, boxed()], robot).agrees
    assert too_wide([*all_of_them[1:], boxed()], robot).agrees is False


# --- the terrain curve -----------------------------------------------------------------------------
def curve(seen, true=bar) -> TerrainCurve:
    x = np.arange(-0.2, 0.4, 0.01)
    return TerrainCurve(0.0, x, seen(x), true(x))


def test_a_curve_agrees_with_itself_and_edges_are_told_by_their_place():
    exact = agreement(curve(bar), (-0.2, 0.4))
    assert exact.known == 1.0 and exact.off.max() == 0.0 and exact.edges.max() == 0.0
    late = agreement(curve(lambda x: bar(x - 0.03)), (-0.2, 0.4))
    assert late.off.max() == 0.0  # beside an edge no height is compared
    assert late.edges == pytest.approx([0.025, 0.025])  # the interval of the curve in which it breaks is 1 cm
    high = agreement(curve(lambda x: bar(x) + 0.02), (-0.2, 0.4))
    assert high.off == pytest.approx(0.02)


def test_what_a_curve_does_not_know_is_no_error_and_an_edge_that_it_lacks_is_one():
    hidden = agreement(curve(lambda x: np.where((x > 0.07) & (x < 0.16), np.nan, bar(x))), (-0.2, 0.4))
    assert hidden.known < 1.0 and hidden.off.max() == 0.0 and np.isnan(hidden.edges).all()
    behind = agreement(curve(lambda x: np.where((x > 0.125) & (x < 0.16), np.nan, bar(x))), (-0.2, 0.4))
    assert behind.edges == pytest.approx([0.0, 0.0])  # it lies where nothing was seen
    assert np.isnan(agreement(curve(np.zeros_like), (-0.2, 0.4)).edges).all()


def test_where_a_foot_rests():
    place = np.zeros((30, 1, 3))
    place[:, 0, 0] = np.repeat([0.0, 0.5, 1.0], 10)
    place[:, 0, 2] = np.repeat([0.02, 0.3, 0.05], 10)
    place[20:25, 0, 2] = -0.02  # as it lands it sinks in
    swings = np.repeat([0.0, 1.0, 0.0], 10)[:, None]
    feet = FootPaths(place, swings, 0.0 * swings, 0.0 * swings)
    assert rests(feet, 0) == pytest.approx(np.array([[0.0, 0.02], [1.0, 0.05]]))
    assert seen_at(curve(bar), np.array([0.1, 0.101, 0.3])) == pytest.approx([0.05, 0.05, 0.0])


# --- the figures -----------------------------------------------------------------------------------
@pytest.mark.parametrize("name", ["figure-6.9", "figure-6.10"])
def test_a_figure_is_walked_anew_and_all_that_is_claimed_agrees(name: str, tmp_path: Path):
    assert reproduce.run([name], str(tmp_path), str(tmp_path / "all.json")) == 0
    assert (tmp_path / f"{name}.png").read_bytes().startswith(b"\x89PNG")
    (figure,) = json.loads((tmp_path / "all.json").read_text(encoding="utf-8"))["reproduced"]
    assert {claim["verdict"] for claim in figure["claims"]} == {"agrees"}
    assert figure["numbers"]["feet"]["FL"]["x"][-1] > 4.0


# --- a short walk ----------------------------------------------------------------------------------
@pytest.fixture(scope="module")
def walk() -> SeenWalk:
    robot = robot_called("go2")
    scene = Scene("a step", Flat(), (Box(0.8, 0.0, 0.0, 0.3, 1.0, 0.05),), (-1.0, -1.0, 2.5, 1.0))
    return seen_walk(robot, scene, Mission(((1.4, 0.0),), 0.25), 20.0)


def test_a_walk_is_seen_and_its_feet_are_followed(walk: SeenWalk):
    assert walk.recording.arrived
    strides = strides_of(walk.feet, walk.scene, range(4))
    assert {stride.does for stride in strides} == {ALONG, ONTO, OFF}
    assert all(claim.agrees for claim in (curve_claim(walk), rests_claim(walk), balance_claim(walk, "")))
    assert room_claim(strides, "").agrees
    lean = leans(walk)
    assert abs(lean.ground[0]) < 1e-9 and lean.ground.max() > 5.0  # up the step
    assert abs(lean.over[0] - walk.robot.height) < 0.02
    counts = [int(row[1]) for row in stride_grid(strides, walk.robot).rows]
    assert min(counts) > 5


def test_a_curve_that_was_scanned_elsewhere_differs(walk: SeenWalk):
    moved = tuple(one._replace(seen=np.roll(one.seen, 8)) for one in walk.curves)
    elsewhere = SeenWalk(walk.scene, walk.recording, (moved[0], moved[1]), walk.feet)
    assert curve_claim(elsewhere).agrees is False


def test_a_walk_is_drawn_and_written_down(walk: SeenWalk, tmp_path: Path):
    closer = [("a stride", stride) for stride in strides_of(walk.feet, walk.scene, [0])[:2]]
    for leaning in (False, True):
        draw_side_views(tmp_path / "a.png", ("title", "line"), walk, closer, leaning)
        assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    plain = paths_as_plain(walk)
    assert list(plain["feet"]) == ["FL", "FR", "RL", "RR"]
    assert len(plain["curves"]["left"]["x"]) == len(plain["curves"]["left"]["seen"])
    assert None in plain["curves"]["left"]["seen"]  # what lies behind the start was never seen
