"""Claim: a robot that only has its sensors walks as one that is told its state."""

from collections.abc import Iterator
from dataclasses import replace

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.beside_teacher import both, handed_over, survived
from gaitwright.bench.measurement import Figure
from gaitwright.bench.trial import Push
from gaitwright.plant.imperfections import NOISE

STARTS = 20
ROWS = (
    ("trot", "flat", None, 0.98),
    ("walk", "flat", None, 0.98),
    ("pronk", "flat", None, 0.98),
    ("trot", "slope:10", None, 0.98),
    ("trot", "slope:-10", None, 0.98),
    ("trot", "rough:0.05", None, 0.98),
    ("trot", "flat", Push(0.9, 90.0, 3.0), 0.98),
    ("gallop", "flat", None, 0.85),
    ("run", "flat", None, 0.85),
)
"""Skill, scene, push, and the share that must go to the end."""
NOTE = (
    "State estimated from encoders, gyroscope, accelerometer and foot loads, each as noisy as policies of "
    "legged_gym are trained with; nothing else is told but where it starts. The numerical controller drives "
    "two seconds, then the learned one; beside it the numerical one goes on."
)


def measure(context: Context) -> Iterator[Figure]:
    """Starts that go to the end, by either driver."""
    seconds = context.seconds(8.0, 5.0)
    for skill, scene, push, least in ROWS[:2] if context.quick else ROWS:
        trials = [
            replace(
                handed_over(skill, seed, seconds, scene),
                imperfections=NOISE["legged-gym"],
                sensing="estimated",
                push=push,
            )
            for seed in context.seeds(STARTS)
        ]
        what = f"{skill} on {scene}" + (f", pushed {push.impulse:g} N·s/kg sideways" if push else "")
        yield survived(f"go2 {what}: {seconds:g} s", both(context, what, trials), least)
