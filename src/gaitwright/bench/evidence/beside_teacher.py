"""The same starts by the learned controller and by the numerical one that taught it."""

from collections.abc import Callable, Sequence
from dataclasses import replace

from gaitwright.bench.claims.walks import failure
from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, count
from gaitwright.bench.trial import Outcome, Then, Trial

DRIVERS = ("numerical", "learned")
HANDED_OVER = 2.0
"""The numerical controller drives first [s]."""


def handed_over(skill: str, seed: int, seconds: float, scene: str = "flat", at: float = HANDED_OVER) -> Trial:
    """A skill of Go2 at its own speed, driven by the learned controller from some time on [s]."""
    then = Then(skill, at, "learned", same_velocity=True)
    return Trial("go2", scene, seconds, seed, skill, None, None, then=then)


def both(context: Context, what: str, trials: Sequence[Trial]) -> dict[str, list[Outcome]]:
    """The same trials under either driver: from where they are handed over on, or all the way."""
    return {
        driver: context.outcomes(f"{what}, {driver}", [driven_by(driver, trial) for trial in trials])
        for driver in DRIVERS
    }


def driven_by(driver: str, trial: Trial) -> Trial:
    """A trial under a driver; one that is handed over begins as it did."""
    if trial.then is None or not trial.then.driver:
        return replace(trial, driver=driver)
    return replace(trial, then=replace(trial.then, driver=driver))


def went_on(outcome: Outcome) -> bool:
    """Whether a start went on to its end, without a fall."""
    return outcome.kept_up


def survived(
    what: str,
    found: dict[str, list[Outcome]],
    least: float | None = None,
    beside: float | None = None,
    is_good: Callable[[Outcome], bool] = went_on,
) -> Figure:
    """How many were good under the learned controller, beside the numerical one.

    `least`: the share that is wanted; `beside`: or how far it may be below the numerical one's.
    """
    good = {driver: sum(map(is_good, outcomes)) for driver, outcomes in found.items()}
    learned = found["learned"]
    if beside is not None:
        least = max(0.0, good["numerical"] / len(learned) - beside)
    note = f"numerical {good['numerical']} of {len(learned)}"
    bad = [outcome for outcome in learned if not is_good(outcome)]
    if bad:
        first = bad[0].report
        note += f"; {failure(learned) or f'seed {first.seed} did not get there'}"
    every = {driver: [o.plain() for o in outcomes] for driver, outcomes in found.items()}
    return count(what, good["learned"], len(learned), least, note, every)
