"""Figure 6.11: navigation plans that are carried out one after the other, and the map that grows by them."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from gaitwright.description.load import load_robot
from gaitwright.ground.outlines import outline_of
from gaitwright.ground.scene import Scene
from gaitwright.ground.solids import Prism
from gaitwright.ground.terrain import Box, Flat
from gaitwright.model.robot import Robot
from gaitwright.reproduce.claim import Claim, Grid, Picture, Reproduction, Say
from gaitwright.reproduce.map_measures import Segments, along, are_known, distances, edges_of, near_share
from gaitwright.reproduce.traversals import Place, Traversal, rims_of, traversed

HIGH = 0.4
"""Of all obstacles [m]."""
BAY = ((2.8, 1.9), (5.1, 1.9), (5.1, 4.5), (2.8, 4.5), (2.8, 4.25), (4.85, 4.25), (4.85, 2.15), (2.8, 2.15))
WEDGES = (((6.6, 3.4), (7.6, 3.7), (7.0, 4.6)), ((1.5, 0.7), (2.3, 0.5), (2.5, 1.2), (1.8, 1.4)))
"""Outlines of prisms [m]."""
BOXES = (
    (6.7, 2.0, 0.3, 1.0, 0.6),
    (4.5, 0.75, -0.1, 0.9, 0.5),
    (1.6, 5.4, 0.5, 0.8, 0.5),
    (5.8, 5.6, 0.0, 0.9, 0.4),
)
"""x, y, yaw and sides [m, rad]."""
BOUNDS = (0.0, 0.0, 9.3, 6.4)
POINTS: Mapping[int, Place] = {1: (0.8, 3.1), 2: (8.5, 3.1), 3: (5.5, 1.2)}
TOUR = (1, 2, 3, 1, 2, 3, 1)
"""Four traversals, of which the last is the first once more, then the second and third once more."""
SHOWN = 4
"""So many are in the figure."""
BETTER, THESIS = "optimistic", "thesis"
"""Strategies of `LearnedMap`."""
NAMES = {BETTER: "our strategy", THESIS: "the thesis's rule"}
OPTIMAL = 1.05
"""A way that is longer than the shortest by no more than this is optimal."""
ALONGSIDE, NEAR = 0.5, 0.25
"""A way is alongside an edge that is nearer than this; a way walked before is nearer than that [m]."""
CLOSE = 0.05
"""As near as its disc allows, to this [m]."""

ABOUT = (
    "Go2 in contact physics, among seven obstacles that it cannot step on, one of them a bay. At first it "
    "knows nothing but the bounds of the field; a camera on its back sees 3.3 m. It is sent from point to "
    "point, four times in succession, from where it came to rest each time; what it learned of the field it"
    " keeps. The fourth traversal repeats the first; after the figure the second and the third are made "
    "once more.",
    "Two strategies begin anew in the same field. The thesis's rule goes along obstacles' edges where the "
    "map is blank and takes the shortest way on the map where it is known. Ours takes the unknown for free,"
    " the shortest way over it, and ways that it has walked where these are hardly longer. Both walk in "
    "physics. The bay is one that the thesis's rule gets out of: it turns close to walls, and turning on "
    "the spot takes more room than the disc that it plans with, so in other fields the robot may have to "
    "stop before a wall.",
    "The thesis draws the terrain on the left and the map on the right; here the map is below.",
)


def reproduce(say: Say) -> Reproduction:
    """The figure, with what the thesis says about it."""
    robot, scene = load_robot("go2"), micro_world()
    runs = {name: traversed(robot, scene, POINTS, TOUR, name, say) for name in (BETTER, THESIS)}
    edges = edges_of(rims_of(robot, scene))
    known = {
        name: [int(are_known(edges, one.known.pieces).sum()) for one in run] for name, run in runs.items()
    }
    claims = [
        growing(known, len(edges)),
        complete(known, len(edges)),
        along_edges(runs, edges),
        always_a_path(runs),
        shorter(runs),
        optimal(runs),
        walked_before(runs),
    ]
    return Reproduction(
        "figure-6.11",
        "Figure 6.11: iteratively executing navigation plans and previewing the updated map",
        ABOUT,
        claims,
        [trip_grid(runs, known)],
        [picture(robot, scene, runs, known, len(edges))],
        {name: [one.plain() for one in run] for name, run in runs.items()},
    )


def micro_world() -> Scene:
    """A field with a bay and other obstacles that are walked around."""
    prisms = tuple(Prism(outline_of(np.array(rim)), HIGH) for rim in (BAY, *WEDGES))
    boxes = tuple(Box(*numbers, HIGH) for numbers in BOXES)
    return Scene("micro-world", Flat(), boxes, BOUNDS, shapes=prisms)


Runs = Mapping[str, Sequence[Traversal]]
"""The traversals of each strategy."""
Known = Mapping[str, Sequence[int]]
"""How many edges were known after each of them."""


# --- claims ----------------------------------------------------------------------------------------
def growing(known: Known, edges: int) -> Claim:
    """Whether the map grows."""
    counts = {name: [0, *numbers[:SHOWN]] for name, numbers in known.items()}
    ours = "; ".join(f"{NAMES[name]}: {', '.join(map(str, some))}" for name, some in counts.items())
    grows = all(some[1] > 0 and some[-1] > some[1] for some in counts.values())
    return Claim(
        "edges that are known at first and after each traversal",
        "none; four learnt on the first, seven more on the next, and so on",
        f"{ours}, of {edges}",
        grows,
        "some on the first, more after the fourth; an edge is known where four fifths of it are",
        {"edges": edges, **{name: list(numbers) for name, numbers in known.items()}},
    )


def complete(known: Known, edges: int) -> Claim:
    """Whether everything becomes known."""
    ours = "; ".join(f"{NAMES[name]}: {numbers[-1]} of {edges}" for name, numbers in known.items())
    return Claim(
        "the whole terrain",
        "is guaranteed to become completely learnt",
        f"after {len(TOUR) - 1} traversals {ours}",
        None,
        "by traversals that lead everywhere; no shortest way leads past the back of every obstacle",
    )


def along_edges(runs: Runs, edges: Segments) -> Claim:
    """How near to edges the first way goes."""
    radius, told, numbers = runs[THESIS][0].known.radius, [], {}
    for name, run in runs.items():
        away = distances(along(run[0].way), edges)
        share = float((away <= ALONGSIDE).mean())
        numbers[name] = {"nearest_m": float(away.min()), "alongside": share}
        told.append(f"{NAMES[name]}: {away.min():.2f} m away, {share:.0%} within {ALONGSIDE:g} m")
    return Claim(
        "the first way, where the map is blank",
        "navigates arbitrarily close to the obstacle's edges, towards a vertex of the one that is faced",
        "; ".join(told),
        numbers[THESIS]["nearest_m"] <= radius + CLOSE,
        f"the thesis's rule comes as near as its disc of {radius:.2f} m allows, to {CLOSE:g} m",
        numbers,
    )


def always_a_path(runs: Runs) -> Claim:
    """Whether every traversal arrived."""
    lost = [
        f"{NAMES[name]}, {one.route[0]} → {one.route[1]}: {one.ended}"
        for name, run in runs.items()
        for one in run
        if not one.arrived
    ]
    total = sum(len(run) for run in runs.values())
    return Claim(
        "a path, if one exists",
        "is always found",
        "; ".join([f"{total - len(lost)} of {total} traversals arrive", *lost]),
        not lost,
        "every traversal of both arrives",
    )


def shorter(runs: Runs) -> Claim:
    """Whether a way that is made again is shorter."""
    pairs = {name: (run[0], run[SHOWN - 1]) for name, run in runs.items()}
    ours = "; ".join(
        f"{NAMES[name]}: {a.length:.2f} m, then {b.length:.2f} m" for name, (a, b) in pairs.items()
    )
    return Claim(
        "from 1 to 2 with an empty map, and again",
        "paths are not necessarily optimal while the map is learnt",
        ours,
        all(b.length < a.length and b.arrived for a, b in pairs.values()),
        f"shorter the second time; the shortest there is has {runs[BETTER][0].shortest:.2f} m",
        {name: [a.length, b.length] for name, (a, b) in pairs.items()},
    )


def optimal(runs: Runs) -> Claim:
    """Whether ways are optimal once the map is known."""
    again = {name: [one.ratio for one in run[SHOWN - 1 :]] for name, run in runs.items()}
    ours = "; ".join(f"{NAMES[name]}: {', '.join(map(times, some))}" for name, some in again.items())
    return Claim(
        "all three routes again, as shares of the shortest ways there are",
        "after this stage the robot traverses along the optimal paths",
        ours,
        all(ratio is not None and ratio <= OPTIMAL for some in again.values() for ratio in some),
        f"at most {OPTIMAL:g}",
        again,
    )


def walked_before(runs: Runs) -> Claim:
    """How much of the fourth way was walked before."""
    share = {
        name: near_share(run[SHOWN - 1].way, [one.way for one in run[: SHOWN - 1]], NEAR)
        for name, run in runs.items()
    }
    return Claim(
        "the fourth way",
        "prefer the paths the robot has traveled on before",
        "; ".join(f"{NAMES[name]}: {part:.0%} of it on ways walked before" for name, part in share.items()),
        min(share.values()) > 0.5,
        f"more than half of it within {NEAR:g} m of them",
        share,
    )


def times(ratio: float | None) -> str:
    """A ratio in words."""
    return "–" if ratio is None else f"{ratio:.2f}"


# --- what is shown ---------------------------------------------------------------------------------
def trip_grid(runs: Runs, known: Known) -> Grid:
    """A line for each traversal."""
    rows = [
        (
            f"{NAMES[name]}, {one.route[0]} → {one.route[1]}",
            f"{one.length:.2f}",
            f"{one.shortest:.2f}",
            times(one.ratio),
            f"{one.seconds:.1f}",
            str(count),
        )
        for name, run in runs.items()
        for one, count in zip(run, known[name], strict=True)
    ]
    head = ("traversal", "walked [m]", "shortest [m]", "ratio", "time [s]", "edges known")
    return Grid("traversals in their order, beside the shortest way that there is", head, rows)


def picture(robot: Robot, scene: Scene, runs: Runs, known: Known, edges: int) -> Picture:
    """Four traversals of each strategy."""

    def draw(path: Path) -> None:
        from gaitwright.reproduce.traversal_sheet import draw_traversals  # noqa: PLC0415 - an extra

        rows = {
            NAMES[name]: [
                (
                    f"{one.route[0]} → {one.route[1]}: {one.length:.1f} m, {times(one.ratio)} × shortest"
                    if one.arrived
                    else f"{one.route[0]} → {one.route[1]}: {one.length:.1f} m, not there",
                    f"the map after it: {count} of {edges} edges",
                    one,
                )
                for one, count in zip(run[:SHOWN], known[name], strict=False)
            ]
            for name, run in runs.items()
        }
        title = "Figure 6.11 anew: navigation plans carried out in succession, and the map after each"
        line = "Go2 walks in contact physics, its camera on; above the terrain and the path, below the map"
        draw_traversals(path, (title, line), (robot, scene, POINTS), rows)

    caption = "Four traversals in succession, by our strategy and by the thesis's rule; the map after each."
    return Picture("figure-6.11.png", caption, draw)
