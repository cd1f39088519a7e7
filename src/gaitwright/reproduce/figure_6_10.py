"""Figure 6.10: feet on climbing strides over smooth ground and steps, analysed off-line."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from gaitwright.description.load import load_robot
from gaitwright.ground.scene import Scene
from gaitwright.ground.splines import spline_field
from gaitwright.ground.terrain import Box
from gaitwright.model.robot import Robot
from gaitwright.reproduce.claim import Claim, Picture, Reproduction, Say
from gaitwright.reproduce.seen_walk import ANALYSED, SeenWalk, leans, paths_as_plain, seen_walk
from gaitwright.reproduce.stride_claims import (
    NEAR,
    balance_claim,
    curve_claim,
    mm,
    order_claim,
    rests_claim,
    room_claim,
    stride_grid,
)
from gaitwright.reproduce.strides import ONTO, Stride, strides_of
from gaitwright.reproduce.terrain_curve import rests
from gaitwright.signals import Mission, Route, Sensed, SkillCall
from gaitwright.skills.chooser import DefaultChooser
from gaitwright.skills.library import find_skill, gait_of
from gaitwright.stages import Map, Now

SPACING = 0.3
"""Of the control points, in both directions [m]."""
LEVEL = 8
"""Control points of level ground before the hill, the first one at the rear end of the net."""
HILL = (0.07, 0.16, 0.20, 0.14, 0.08, 0.08, 0.08, 0.08, 0.08, 0.08, 0.08, 0.04)
"""Heights of the control points along x behind them [m]: a hill, and a plateau that steps stand on."""
STEPS = ((1.1, 0.08), (0.5, 0.16))
"""Length along x and height over the plateau of the blocks that lie on each other [m]."""
MIDDLE, ACROSS = 3.0, 1.2
"""x of their middle, and their width [m]."""
NET = (-1.5, -3.0, 21, 28)
"""x and y of the first control point [m], rows and columns."""
BOUNDS, GOAL = (-1.0, -1.5, 6.0, 1.5), (5.0, 0.0)
SPEED, SECONDS = 0.2, 60.0
LEANS = 5.0
"""The body leans as the ground under its feet does within this, in the mean [°]."""

ABOUT = (
    "Go2 in contact physics, on climbing strides at 0.2 m/s straight over a surface from Cardinal splines, "
    "as in figure 6.4: a hill of 20 cm, and a plateau on which blocks make two steps of 8 cm up and two "
    "down. It knows nothing of them: a camera on its back looks ten times a second. The leg cycle of these "
    "strides goes up, forward and down; the numerical controller raises it where the ground asks for it.",
    ANALYSED,
)


def reproduce(say: Say) -> Reproduction:
    """The figure, with what the thesis says about it."""
    robot = load_robot("go2")
    say("climbing strides over a hill and steps")
    walk = seen_walk(robot, field(), Mission((GOAL,), SPEED), SECONDS, ClimbingStrides(robot))
    strides = strides_of(walk.feet, walk.scene, range(robot.n))
    onto = [stride for stride in strides if stride.does == ONTO]
    return Reproduction(
        "figure-6.10",
        "Figure 6.10: stepping onto obstacles, off-line analysis",
        ABOUT,
        [
            on_top(walk),
            room_claim(strides, "the robot tries to overcome it by stepping on top of it"),
            order_claim(strides),
            leaning(walk),
            curve_claim(walk),
            rests_claim(walk),
            balance_claim(walk, "it maintains its balance without changing its heading direction"),
        ],
        [stride_grid(strides, robot)],
        [picture(walk, onto)],
        paths_as_plain(walk),
    )


def field() -> Scene:
    """A hill from Cardinal splines, and steps up and down behind it."""
    x, y, rows, columns = NET
    heights = np.zeros(columns)
    heights[LEVEL : LEVEL + len(HILL)] = HILL
    ground = spline_field(x, y, SPACING, np.tile(heights, (rows, 1)))
    boxes = tuple(Box(MIDDLE, 0.0, 0.0, long, ACROSS, high) for long, high in STEPS)
    return Scene("hill and steps", ground, boxes, BOUNDS)


@dataclass(frozen=True)
class ClimbingStrides:
    """A chooser that climbs where the plain one would walk."""

    robot: Robot

    def choose(self, route: Route, sensed: Sensed, now: Now = None, ground: Map = None) -> SkillCall:
        """The plain choice, in climbing strides."""
        call = DefaultChooser(self.robot).choose(route, sensed, now, ground)
        if call.skill != "walk":
            return call
        return replace(call, skill="climb", gait=gait_of(find_skill("climb", self.robot), self.robot))


# --- claims ----------------------------------------------------------------------------------------
def on_top(walk: SeenWalk) -> Claim:
    """Whether every foot stood on top of the highest step."""
    long, high = STEPS[-1]
    level = float(walk.scene.surface.height(MIDDLE, 0.0))
    counts = []
    for leg in range(walk.robot.n):
        x, z = rests(walk.feet, leg).T
        counts.append(int(((np.abs(x - MIDDLE) <= long / 2) & (np.abs(z - level - high) <= NEAR)).sum()))
    return Claim(
        "small obstacles, of which the robot makes use",
        "small obstacles that the robot can step on top of",
        f"footholds on the highest step, {high:g} m above the plateau: "
        + ", ".join(f"{name} {count}" for name, count in zip(walk.robot.legs, counts, strict=True)),
        all(counts),
        f"every foot stands on it, within {mm(NEAR)} of its height",
        {"footholds": counts},
    )


def leaning(walk: SeenWalk) -> Claim:
    """Whether the body leans as the ground under it does, and keeps its height over it."""
    _, ground, body, over = leans(walk)
    off = float(np.abs(body - ground).mean())
    return Claim(
        "the body",
        "adjusting its body orientation",
        f"the ground between hind and front feet leans from {ground.min():.0f}° to {ground.max():.0f}°, "
        f"the body from {body.min():.0f}° to {body.max():.0f}°, {off:.1f}° apart in the mean; it is "
        f"{mm(over.min())} to {mm(over.max())} over that ground",
        off <= LEANS,
        f"within {LEANS:g}° in the mean",
        {"mean_off_deg": off, "over_m": [float(over.min()), float(over.max())]},
    )


# --- the picture -----------------------------------------------------------------------------------
def picture(walk: SeenWalk, onto: Sequence[Stride]) -> Picture:
    """Both sides, and the steps up of both front feet from close by."""

    def draw(path: Path) -> None:
        from gaitwright.reproduce.side_views import draw_side_views  # noqa: PLC0415 - an extra

        title = "Figure 6.10 anew: climbing strides over a hill and steps, off-line analysis"
        line = "Go2 climbs at 0.2 m/s, its camera on; heights are drawn twice as large as lengths"
        closer = [
            (f"{walk.robot.legs[leg]} onto the first step, heights as lengths", stride)
            for leg in (0, 1)
            for stride in [one for one in onto if one.leg == leg][:1]
        ]
        draw_side_views(path, (title, line), walk, closer, leaning=True)

    caption = "Terrain curve as scanned, the left feet and the body; how it leans; below the first steps up."
    return Picture("figure-6.10.png", caption, draw)
