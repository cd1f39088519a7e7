"""Figure 6.9: feet among small obstacles, on a straight walk, analysed off-line."""

from collections.abc import Sequence
from pathlib import Path

from gaitwright.description.load import load_robot
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle
from gaitwright.gait.operators import Operator
from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.learning.operator_lessons import Edit, learned_from
from gaitwright.model.robot import Robot
from gaitwright.reproduce.claim import Claim, Picture, Reproduction, Say
from gaitwright.reproduce.seen_walk import ANALYSED, SeenWalk, paths_as_plain, seen_walk
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
from gaitwright.reproduce.strides import BREAK, ONTO, OVER, Stride, strides_of
from gaitwright.signals import Mission

OBSTACLES = ((0.9, 0.04, 0.03), (1.6, 0.05, 0.05), (2.3, 0.32, 0.06), (3.05, 0.05, 0.07), (3.75, 0.40, 0.04))
"""x of the middle, length along x and height of those before the left feet [m]: three bars, two blocks."""
BLOCKS = (2, 4)
"""Which of them are too wide to be stepped over."""
LATER, WIDE = 0.27, 0.3
"""Those before the right feet come so much later; how wide each is [m]."""
BOUNDS, GOAL = (-1.0, -1.5, 6.0, 1.5), (4.6, 0.0)
SPEED, SECONDS = 0.25, 40.0
SHOWN_BY, SHOWN_IN, SHOWN_SIZE = "FL", "walk", 0.065
"""The edit: of which leg, in which skill, over an obstacle of which height [m]."""
EDITED = (
    (0.0, -0.5, 0.0),
    (0.15, -0.49, 0.17),
    (0.3, -0.38, 0.33),
    (0.45, -0.02, 0.35),
    (0.58, 0.33, 0.33),
    (0.72, 0.46, 0.21),
    (0.86, 0.495, 0.08),
    (1.0, 0.5, 0.0),
)
"""The foot's path in it, up, then forward, then down: points of a leg cycle."""

ABOUT = (
    "Go2 in contact physics, walking straight ahead at 0.25 m/s over level ground beset with bars of 3, 5 "
    "and 7 cm and blocks of 6 and 4 cm, other ones before the left feet than before the right. It knows "
    "nothing of them: a camera on its back looks ten times a second. How a leg gets over an obstacle is one"
    " rule of type III, learned from one edit in the manner of figure 5.2 on one leg in level walk, and "
    "applied to every leg.",
    ANALYSED,
)


def reproduce(say: Say) -> Reproduction:
    """The figure, with what the thesis says about it."""
    robot = load_robot("go2")
    say("an edit on one leg, in physics")
    operator = taught(robot)
    say("a straight walk over small obstacles")
    walk = seen_walk(robot, field(), Mission((GOAL,), SPEED), SECONDS, operators=(operator,))
    strides = strides_of(walk.feet, walk.scene, range(robot.n))
    claims = [
        room_claim(strides, "the leg is moved upward until the path is free from it"),
        order_claim(strides),
        too_wide(strides, robot),
        tracking_claim(strides),
        hind_claim(strides, robot),
        curve_claim(walk),
        rests_claim(walk),
        balance_claim(walk, "straight line walking; the body is regulated as a swinging leg lands"),
    ]
    return Reproduction(
        "figure-6.9",
        "Figure 6.9: obstacle avoidance, off-line analysis",
        ABOUT,
        claims,
        [stride_grid(strides, robot)],
        [picture(walk, strides)],
        paths_as_plain(walk),
    )


def field() -> Scene:
    """Level ground with small obstacles across the way of either side's feet."""
    boxes = [
        Box(x + later, side, 0.0, long, WIDE, high)
        for x, long, high in OBSTACLES
        for side, later in ((0.2, 0.0), (-0.2, LATER))
    ]
    return Scene("small obstacles", Flat(), tuple(boxes), BOUNDS)


def taught(robot: Robot) -> Operator:
    """What a leg does about an obstacle, from one edit of a person's on one leg."""
    cycle = LegCycle("up, forward, down", EDITED)
    return learned_from(Edit(robot, SHOWN_SIZE, SHOWN_IN, SHOWN_BY, cycle=cycle), "over an obstacle")


# --- claims ----------------------------------------------------------------------------------------
def too_wide(strides: Sequence[Stride], robot: Robot) -> Claim:
    """Whether legs land on what is too wide to step over, and go over the rest."""
    over = sum(stride.does == OVER for stride in strides)
    is_left = [float(y) > 0.0 for y in robot.nominal_feet[:, 1]]
    stood = {(stride.leg, stood_on(stride, is_left[stride.leg])) for stride in strides}
    on_blocks = {(leg, k) for leg in range(robot.n) for k in BLOCKS}
    on_bars = {(leg, k) for leg, k in stood if k is not None} - on_blocks
    return Claim(
        "an obstacle that is too wide",
        "the leg will land on top of it",
        f"of 4 feet on {len(BLOCKS)} blocks each {len(stood & on_blocks)} stand on top; {over} strides go "
        f"over a bar, {len(on_bars)} end on one",
        on_blocks <= stood and over > 0,
        "every foot on top of every block, and bars stepped over",
        {"on_blocks": len(stood & on_blocks), "over_bars": over, "on_bars": len(on_bars)},
    )


def stood_on(stride: Stride, left: bool) -> int | None:
    """Number of the obstacle on which a stride ends."""
    x = stride.x[-1] - (0.0 if left else LATER)
    ends = (k for k, (middle, long, _) in enumerate(OBSTACLES) if abs(x - middle) <= long / 2)
    return next(ends, None) if stride.ground[-1] > BREAK else None


# --- the picture -----------------------------------------------------------------------------------
def picture(walk: SeenWalk, strides: Sequence[Stride]) -> Picture:
    """Both sides, and a stride over a bar and one onto a block from close by."""

    def draw(path: Path) -> None:
        from gaitwright.reproduce.side_views import draw_side_views  # noqa: PLC0415 - an extra

        title = "Figure 6.9 anew: feet among small obstacles, off-line analysis"
        line = "Go2 walks straight at 0.25 m/s, its camera on; heights are drawn twice as large as lengths"
        closer = [
            (f"{walk.robot.legs[0]} {what}, heights as lengths", stride)
            for what, does in (("over a bar", OVER), ("onto a block", ONTO))
            for stride in highest(strides, does)
        ]
        draw_side_views(path, (title, line), walk, closer)

    caption = "Terrain curves as scanned, and the trajectories of the feet; below two strides close by."
    return Picture("figure-6.9.png", caption, draw)


def highest(strides: Sequence[Stride], does: str) -> list[Stride]:
    """The stride of the front left foot over or onto the highest thing; none where it came to none."""
    own = [stride for stride in strides if stride.leg == 0 and stride.does == does]
    return sorted(own, key=lambda stride: -float(stride.ground.max()))[:1]
