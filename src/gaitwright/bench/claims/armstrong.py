"""Claim: the Armstrong plant keeps the laws of mechanics, and robots stand and walk on it."""

from collections.abc import Iterator

from gaitwright.bench.claims.walks import Walk, measure_walks
from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, Wanted, at_most
from gaitwright.description.load import load_robot
from gaitwright.dynamics.tree import Tree, ball_tree
from gaitwright.plant.armstrong.drift import free_motion_drift, refresh_error

STEPS = (0.001, 0.005, 0.01)
"""Steps of the free motion [s]."""
WANTED = {
    "euler": at_most(1e-2),
    "semi-implicit": at_most(1e-2),
    "rk4": at_most(1.5e-10),
    "adaptive": at_most(2e-5),
}
"""What the energy may drift by at the shortest step, as a share of itself.

Guards against a change for the worse: two to five times the largest drift of the starts 0 to 3 (4.3e-3,
4.2e-3, 3.2e-11, 3.8e-6). A single start may drift ten times less.
"""
MOMENTUM = at_most(1e-8)
"""What the momentum may drift by with RK4 at the shortest step [N·s]: four times the largest of those."""
REFRESH = (2, 5, 10, 20)
WALKS = (
    Walk("thesis", "stand", 0.0, seconds=20.0, starts=10, plant="armstrong", roll=2.5),
    Walk("thesis", "walk", 0.5, seconds=20.0, starts=10, plant="armstrong", velocity=0.05, roll=2.5),
    Walk("go2", "trot", 0.4, seconds=10.0, starts=10, plant="armstrong", velocity=0.02, least=None),
)
NOTE = (
    "Free motion: the thesis's robot with ball joints, turning at about 1 rad/s for 3 s without gravity or "
    "torque. Drift: energy as a share of itself; beside it momentum [N·s] and angular momentum as a share. "
    "Integrator `adaptive` chooses its own steps; the one given is the first. "
    "Slow coefficients: held for so many steps of 1 ms (RK4), the largest angle between a link and the same "
    "link with fresh ones after 1 s."
)


def measure(context: Context) -> Iterator[Figure]:
    """Drift of every integrator, what old coefficients cost, and walks on the plant."""
    context.voice.say("armstrong: free motion")
    tree, _ = ball_tree(load_robot("thesis"))
    for integrator, wanted in WANTED.items():
        for dt in STEPS:
            energy, momentum = drift(tree, integrator, dt, wanted if dt == STEPS[0] else None, context.seed)
            yield energy
            if integrator == "rk4" and dt == STEPS[0]:
                yield momentum
    for refresh in REFRESH:
        angle = refresh_error(tree, refresh, seed=context.seed)
        yield Figure(f"slow coefficients at every {refresh}. step: angle after 1 s", angle, "rad")
    yield from measure_walks(context, WALKS)


def drift(tree: Tree, integrator: str, dt: float, wanted: Wanted | None, seed: int) -> tuple[Figure, Figure]:
    """What a free omega gains or loses in 3 s: of its energy, and of its momentum."""
    energy, linear, angular = free_motion_drift(tree, integrator, dt, seed=seed)
    note = f"momentum {linear:.1e} N·s, angular {angular:.1e}"
    what = f"free motion, {integrator}, {1e3 * dt:g} ms: drift of the"
    return (
        Figure(f"{what} energy", abs(energy), "", wanted, 1, note),
        Figure(f"{what} momentum", linear, "N·s", MOMENTUM),
    )
