"""Who is tried in unknown worlds: the learned map, and the planners that it is compared with."""

from collections.abc import Callable

from gaitwright.bench.unknown_worlds.baselines import AStar, DStarLite, ThetaStar
from gaitwright.bench.unknown_worlds.walker import Planner
from gaitwright.bench.unknown_worlds.world import BOUNDS, RADIUS
from gaitwright.navigation.learned_map import LearnedMap

LEARNED, THESIS = "learned map", "the thesis's rule"
A_STAR, ANY_ANGLE, D_STAR = "A*", "any-angle A*", "D* Lite"

BASELINES: dict[str, Callable[[], Planner]] = {A_STAR: AStar, ANY_ANGLE: ThetaStar, D_STAR: DStarLite}
"""Each makes a planner that knows nothing."""
STRATEGIES = {LEARNED: "optimistic", THESIS: "thesis"}
"""Of the learned map."""


def planner(name: str) -> Planner:
    """A contestant that knows nothing."""
    if name in BASELINES:
        return BASELINES[name]()
    return LearnedMap.of(BOUNDS, RADIUS, STRATEGIES[name])
