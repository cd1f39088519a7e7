"""Claim: in unknown ground the learned map finds a way if there is one, soon the shortest (row V4, V7)."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from time import perf_counter

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, at_most
from gaitwright.bench.unknown_worlds import standings
from gaitwright.bench.unknown_worlds.contestants import (
    A_STAR,
    ANY_ANGLE,
    BASELINES,
    D_STAR,
    LEARNED,
    THESIS,
)
from gaitwright.bench.unknown_worlds.drawn import world
from gaitwright.bench.unknown_worlds.eyes import Camera, look
from gaitwright.bench.unknown_worlds.tours import Asked, Found, load, toured

WORLDS, QUICK = 500, 40
FEW = 60
"""Worlds with noise, and worlds in which things move."""
SEEN, LOOKS = 10, 500
"""The world in which looks are timed, and how many."""
THESIS_EVERY = 4
"""The thesis's rule is tried in every so manyth world of each family: it goes far where there is no way."""
NOTE = (
    "Unknown worlds: 20 × 20 m, forest, rooms, bug traps, mazes, streets in turn, start and goal 9 m "
    "apart or more; of twenty, four are walled in and in three a gap as wide as the disc (0.16 m) −5 … "
    "+15 mm, off the straight line, decides. A camera of 3 m and 90° sees exactly, every 0.1 m and 0.3 "
    "rad. There, back, there, back, there, the map kept. Oracle: shapely's buffers at r and r/cos 15°; "
    "between the two either answer is right. Optimum: tangents among arcs cut by chords, the lower bound. "
    "Grids of 0.1 m, eight neighbours, a link closed only where a walk along it would touch; any-angle is "
    "Theta*, pulled straight. First trips: sums over worlds in which everyone arrived, 95 % by bootstrap; "
    "time at 0.5 m/s and 1 rad/s."
)
PICTURE = Path("runs/bench/unknown_worlds-worlds.png")
FIRST_TRIPS = (
    (standings.metres, A_STAR, -5.0),
    (standings.metres, D_STAR, -5.0),
    (standings.metres, ANY_ANGLE, 0.0),
    (standings.seconds, A_STAR, -15.0),
    (standings.seconds, ANY_ANGLE, -4.0),
)
"""What is compared, with whom, and at most so much is wanted [%]."""


def measure(context: Context) -> Iterator[Figure]:
    """Right answers, travel, time and plans of everyone."""
    everyone = (LEARNED, *BASELINES)
    load(everyone)  # compiles before workers would, side by side
    asked = [Asked(context.seed, number, everyone) for number in numbers(context)]
    found = context.each("unknown worlds", toured, asked)
    yield from of_learned_map(found, everyone)
    yield from of_thesis(context, asked)
    yield from of_noise(context, asked)
    for name in BASELINES:
        yield standings.wrong_answers(found, name, None)
        for trip in (0, 3):
            yield standings.mean_travel(found, name, trip, None)
        yield from standings.planning(found, name, None)
    yield expansions(found)
    yield standings.certainty(found)
    yield looks(context)
    yield drawn(context, everyone)


def numbers(context: Context) -> range:
    """Of the worlds."""
    return range(QUICK if context.quick else WORLDS)


def of_learned_map(found: Sequence[Found], everyone: tuple[str, ...]) -> Iterator[Figure]:
    """The figures that are wanted."""
    yield standings.wrong_answers(found, LEARNED, at_most(0.0))
    for trip in range(5):
        yield standings.mean_travel(found, LEARNED, trip, at_most(1.01) if trip == 3 else None)
    yield standings.near_optimum(found, LEARNED, 3, 0.99)
    yield standings.near_optimum(found, LEARNED, 4, 0.995)
    yield from standings.promises(found, LEARNED)
    for cost, other, most in FIRST_TRIPS:
        yield standings.saved(found, (LEARNED, other), everyone, cost, most)
    yield from standings.planning(found, LEARNED, at_most(1.0))


def of_thesis(context: Context, asked: Sequence[Asked]) -> Iterator[Figure]:
    """The thesis's own rule, beside it."""
    some = [replace(one, planners=(LEARNED, THESIS)) for one in asked if one.number // 5 % THESIS_EVERY == 2]
    found = context.each("unknown worlds, the thesis's rule", toured, some)
    yield standings.wrong_answers(found, THESIS, None)
    for trip in (0, 3):
        yield standings.mean_travel(found, THESIS, trip, None)
    yield standings.saved(found, (LEARNED, THESIS), (LEARNED, THESIS), standings.metres, 0.0)


def of_noise(context: Context, asked: Sequence[Asked]) -> Iterator[Figure]:
    """Noise of the camera, and obstacles that move; shown only."""
    some = [replace(one, planners=(LEARNED,), trips=4) for one in asked[: FEW if not context.quick else 10]]
    kinds = {"noise of 2 cm, 30 % left out": {"has_noise": True}, "a quarter moved": {"moves_after": 2}}
    for what, how in kinds.items():
        found = context.each(f"unknown worlds, {what}", toured, [replace(one, **how) for one in some])
        if "has_noise" in how:
            figures = [
                standings.wrong_answers(found, LEARNED, None),
                standings.mean_travel(found, LEARNED, 0, None),
            ]
        else:
            figures = standings.after_moves(found, LEARNED, how["moves_after"])
        yield from (replace(figure, what=f"{figure.what}, {what}") for figure in figures)


def expansions(found: Sequence[Found]) -> Figure:
    """What mending a search saves."""
    both = [one for one in found if one.all_arrived((D_STAR, A_STAR))]
    mended, anew = (
        sum(trip.expanded for one in both for trip in one.tours[name]) for name in (D_STAR, A_STAR)
    )
    what, note = f"{D_STAR}: nodes expanded over those of {A_STAR}", f"{mended} and {anew} over all trips"
    return Figure(what, mended / anew if anew else float("nan"), "×", None, len(both), note)


def looks(context: Context) -> Figure:
    """How long the simulated eye takes."""
    here = world(context.seed, SEEN)
    took = []
    for turn in range(LOOKS):
        began = perf_counter()
        look(here, here.start, 0.1 * turn, Camera())
        took.append(1e3 * (perf_counter() - began))
    note = f"{len(here.edges)} edges, p99 {np.quantile(took, 0.99):.2g} ms"
    return Figure("eyes: one look, median", float(np.median(took)), "ms", at_most(0.1), LOOKS, note)


def drawn(context: Context, everyone: tuple[str, ...]) -> Figure:
    """A picture of a first trip in a world of each family."""
    what = "unknown worlds: a picture of first trips"
    if not find_spec("matplotlib"):
        return Figure(what, float("nan"), "", None, 0, "it needs `pip install 'gaitwright[plot]'`")
    from gaitwright.bench.unknown_worlds.drawing import draw  # noqa: PLC0415 - an extra, and slow to import

    worlds = draw(context.seed, everyone, PICTURE)
    return Figure(what, float(worlds), "worlds", None, worlds, f"picture: {PICTURE}")
