"""Cost of transport of every gait over speed: which gait is cheapest at which speed, as a picture."""

from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure
from gaitwright.bench.trial import Trial, robot_named
from gaitwright.skills.library import LIBRARY, fastest

GAITS = ("walk", "trot", "rack", "pace", "run", "pronk", "bound", "gallop", "rotary-gallop")
PICTURE = Path("runs/bench/cost-of-transport.png")
SPEEDS, STARTS, SECONDS = 7, 3, 8.0
SLOWEST = 0.1
"""Slowest speed measured [m/s]."""
HELD = 0.85
"""A start that holds less of its speed does not count."""

Curve = list[tuple[float, float]]


def measure(context: Context) -> Iterator[Figure]:
    """The cheapest speed of every gait, the gait that is cheapest at round speeds, and the picture."""
    robot, curves = robot_named("go2"), {}
    for gait in GAITS:
        most = fastest(LIBRARY[gait], robot)
        speeds = np.linspace(SLOWEST, most, 3 if context.quick else SPEEDS)
        curves[gait] = curve(context, gait, speeds)
    note = picture(curves)
    for gait, points in curves.items():
        if points:
            speed, cost = min(points, key=lambda point: point[1])
            what = f"go2 {gait}: least cost of transport, at {speed:.2f} m/s"
            yield Figure(what, cost, "", None, STARTS, note, {"curve": points})
    turns = changes(curves)
    told = "; ".join(f"from {speed:.2f} m/s {gait}" for speed, gait in turns)
    yield Figure("gaits that are the cheapest at some speed", float(len(turns)), "", None, STARTS, told)


def curve(context: Context, gait: str, speeds: np.ndarray) -> Curve:
    """Speed held and cost at every speed at which all starts go well."""
    points = []
    seeds = context.seeds(STARTS, quick=1)
    for speed in speeds.tolist():
        trials = [Trial("go2", "flat", SECONDS, seed, gait, speed) for seed in seeds]
        outcomes = context.outcomes(f"cost of {gait} at {speed:.2f} m/s", trials)
        if all(o.kept_up and o.held > HELD for o in outcomes):
            points.append((speed, sum(o.report.cost_of_transport for o in outcomes) / len(outcomes)))
    return points


def changes(curves: dict[str, Curve]) -> list[tuple[float, str]]:
    """From which speed on which gait is the cheapest, by straight lines between what was measured."""
    told: list[tuple[float, str]] = []
    for speed in np.arange(SLOWEST, 3.0, 0.05).tolist():
        costs = {
            gait: float(np.interp(speed, [v for v, _ in points], [cost for _, cost in points]))
            for gait, points in curves.items()
            if points and points[0][0] <= speed <= points[-1][0]
        }
        if costs:
            best = min(costs, key=lambda gait: costs[gait])
            if not told or told[-1][1] != best:
                told.append((speed, best))
    return told


def picture(curves: dict[str, Curve]) -> str:
    """Draws the curves, where the extra for that is there; says where, or what it needs."""
    if not find_spec("matplotlib"):
        return "the picture is left out: it needs `pip install 'gaitwright[plot]'`"
    from gaitwright.pictures.cost import cost_picture  # noqa: PLC0415 - an extra, and slow to import

    return f"picture: {cost_picture(curves, PICTURE)}"
