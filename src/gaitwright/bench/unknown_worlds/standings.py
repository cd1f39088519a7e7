"""Figures of tours: right answers, trips beside the optimum, sums of first trips beside each other."""

from collections import Counter
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from gaitwright.bench.measurement import Figure, Wanted, at_most, count
from gaitwright.bench.unknown_worlds.families import FAMILIES
from gaitwright.bench.unknown_worlds.tours import Found
from gaitwright.bench.unknown_worlds.walker import ARRIVED, NONE, Trip

DRAWS = 2000
"""Of the bootstrap."""
NEAR = 1.05
"""A trip is near the optimum within this."""


def wrong_answers(found: Sequence[Found], name: str, wanted: Wanted | None) -> Figure:
    """How many worlds a planner was wrong in, against the oracle."""
    wrong = [one for one in found if not one.is_right(name)]
    truths = Counter(one.truth for one in found)
    refused = sum(one.truth == "either" and one.tours[name][0].end == NONE for one in found)
    note = (
        f"{truths['none']} without a way, {sum(one.gap is not None for one in found)} with a gap that "
        f"decides; "
        f"{truths['either']} where either answer is right, {refused} of them refused"
    )
    if wrong:
        note += f"; first: {wrong[0].name} ({wrong[0].kind}, {wrong[0].truth})"
    each = [
        {"world": one.name, "kind": one.kind, "gap": one.gap, "truth": one.truth,
         "ends": [trip.end for trip in one.tours[name]]}
        for one in wrong
    ]  # fmt: skip
    what = f"{name}: worlds with a wrong answer"
    return Figure(what, float(len(wrong)), f"of {len(found)}", wanted, len(found), note, {"wrong": each})


def ratios(found: Sequence[Found], name: str, trip: int) -> dict[str, float]:
    """Travel over the optimum's lower bound on a trip, by world; of worlds with a way in which it arrived."""
    return {
        one.name: one.tours[name][trip].metres / one.optimum.lower
        for one in found
        if one.truth == "way" and len(one.tours[name]) > trip and one.tours[name][trip].end == ARRIVED
    }


def near_optimum(found: Sequence[Found], name: str, trip: int, least: float | None) -> Figure:
    """How many of the trips are near the optimum; one that did not arrive is not."""
    travel = ratios(found, name, trip)
    starts = sum(one.truth == "way" for one in found)
    good = sum(ratio <= NEAR for ratio in travel.values())
    worst = max(travel.items(), key=lambda pair: pair[1], default=("none", float("nan")))
    note = f"worst {worst[1]:.3f} in {worst[0]}" if travel else "none arrived"
    what = f"{name}: trip {trip + 1} ≤ {NEAR} × optimum"
    return count(what, good, starts, least, note, {"by family": by_family(found, travel)})


def mean_travel(found: Sequence[Found], name: str, trip: int, wanted: Wanted | None) -> Figure:
    """Mean of travel over optimum on a trip."""
    travel = ratios(found, name, trip)
    all_of_it = list(travel.values())
    families = by_family(found, travel)
    note = ", ".join(f"{family} {mean:.2f}" for family, mean in families.items())
    return Figure(
        f"{name}: trip {trip + 1} over optimum, mean", mean_of(all_of_it), "×", wanted, len(all_of_it), note,
        {"by family": families, "p90": float(np.quantile(all_of_it, 0.9)) if all_of_it else None},
    )  # fmt: skip


def by_family(found: Sequence[Found], travel: dict[str, float]) -> dict[str, float]:
    """Mean of a number by world, by family."""
    return {
        family: mean_of([travel[one.name] for one in found if one.family == family and one.name in travel])
        for family in FAMILIES
    }


def mean_of(numbers: Sequence[float]) -> float:
    """The mean; NaN of none."""
    return float(np.mean(numbers)) if len(numbers) else float("nan")


def metres(trip: Trip) -> float:
    """What a trip costs in way [m]."""
    return trip.metres


def seconds(trip: Trip) -> float:
    """What a trip costs in time [s]."""
    return trip.seconds


def saved(
    found: Sequence[Found],
    names: tuple[str, str],
    everyone: tuple[str, ...],
    cost: Callable[[Trip], float],
    most: float,
) -> Figure:
    """Sum of first trips over another planner's, less one, with a bootstrap interval.

    Over the worlds in which everyone arrived; `most`: at most so much is wanted [%].
    """
    common = [one for one in found if one.truth != "none" and one.all_arrived(everyone)]
    pairs = np.array([[cost(one.tours[name][0]) for name in names] for one in common]).reshape(-1, 2)
    what = f"{names[0]}: first trip, {cost.__name__} against {names[1]}"
    if not len(pairs):
        return Figure(what, float("nan"), "%", at_most(most), 0, "nobody arrived")
    low, high = interval(pairs)
    families = {family: off(pairs[[one.family == family for one in common]]) for family in FAMILIES}
    by = ", ".join(f"{family} {share:+.0f}" for family, share in families.items())
    note = f"95 % interval {low:+.1f} … {high:+.1f}; {by}"
    numbers = {"interval": [low, high], "by family": families, "sums": pairs.sum(axis=0).tolist()}
    return Figure(what, off(pairs), "%", at_most(most), len(pairs), note, numbers)


def off(pairs: np.ndarray) -> float:
    """Sum of the first column over that of the second, less one [%]."""
    mine, other = pairs.sum(axis=0)
    return float(100.0 * (mine / other - 1.0)) if other else float("nan")


def interval(pairs: np.ndarray) -> tuple[float, float]:
    """95 % of what `off` is of worlds drawn again from these."""
    rng = np.random.default_rng(1)
    drawn = rng.integers(len(pairs), size=(DRAWS, len(pairs)))
    sums = pairs[drawn].sum(axis=1)
    low, high = np.quantile(100.0 * (sums[:, 0] / sums[:, 1] - 1.0), [0.025, 0.975])
    return float(low), float(high)


def planning(found: Sequence[Found], name: str, wanted: Wanted | None) -> Iterator[Figure]:
    """How long a plan takes while walking, and what a look costs."""
    trips = [trip for one in found for trip in one.tours[name]]
    again = np.array([ms for trip in trips for ms in trip.plans[1:]])
    if not len(again):
        return
    first = sum(len(one.tours[name][0].plans) for one in found) / len(found)
    note = f"p99 {np.quantile(again, 0.99):.2g}, most {again.max():.3g}; {first:.0f} on a first trip"
    numbers = {"p99": float(np.quantile(again, 0.99)), "most": float(again.max())}
    yield Figure(
        f"{name}: re-plan while walking, median",
        float(np.median(again)),
        "ms",
        wanted,
        len(again),
        note,
        numbers,
    )
    looks = sum(trip.looks for trip in trips)
    learning = sum(trip.learning for trip in trips) / looks
    touches = sum(trip.contacts for trip in trips) / len(trips)
    nearest = min(trip.nearest for trip in trips)
    note = f"{touches:.2f} contacts a trip; never nearer than {1e3 * nearest:.1f} mm"
    yield Figure(f"{name}: a look into the map, mean", learning, "ms", None, looks, note)


def promises(found: Sequence[Found], name: str) -> Iterator[Figure]:
    """Whether walked ways are taken only where they are near the shortest, and what is promised."""
    trips = [trip for one in found for trip in one.tours[name]]
    taken = [trip.excess for trip in trips if trip.excess > 0.0]
    yield Figure(
        f"{name}: walked way taken over optimistic, most", max(taken, default=0.0), "×", at_most(NEAR),
        len(taken), f"walked ways on {len(taken)} of {len(trips)} trips",
    )  # fmt: skip
    told = [
        trip.promised / one.optimum.upper
        for one in found
        if one.truth == "way"
        for trip in one.tours[name]
        if trip.promised
    ]
    yield Figure(
        f"{name}: promised at the start over optimum, most", max(told, default=float("nan")), "×", None,
        len(told), "more than 1 is no proof: corners are rounded by chords",
    )  # fmt: skip


def certainty(found: Sequence[Found]) -> Figure:
    """How well the optimum is known."""
    apart = [100.0 * (one.optimum.upper / one.optimum.lower - 1.0) for one in found if one.truth == "way"]
    note = f"mean {mean_of(apart):.2g} %; travel is compared with the lower bound"
    return Figure(
        "optimum: bounds apart, most", max(apart, default=float("nan")), "%", None, len(apart), note
    )


def after_moves(found: Sequence[Found], name: str, trip: int) -> list[Figure]:
    """Answers and travel of the trips after some obstacles moved, against the world as it is then."""
    ends = [(one, later) for one in found for later in one.tours[name][trip:]]
    right = [
        later.end == ARRIVED if one.later == "way" else one.later == "either" or later.end == NONE
        for one, later in ends
    ]
    travel = [
        later.metres / one.later_optimum.lower
        for one, later in ends
        if one.later_optimum is not None and later.end == ARRIVED
    ]
    return [
        count(f"{name}: right answers on trips {trip + 1} and on", sum(right), len(right), None, "", {}),
        Figure(f"{name}: travel then over optimum, mean", mean_of(travel), "×", None, len(travel)),
    ]
