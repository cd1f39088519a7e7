"""How much of its torque a learned controller plays back, skill by skill."""

from collections.abc import Iterator, Sequence

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure, at_least
from gaitwright.bench.trial import profile_of, robot_named
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain
from gaitwright.plant.registry import make_plant
from gaitwright.session import DT, Session
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill

SECONDS, FROM = 6.0, 3.0
"""[s]; what comes before is the start."""
LOOSE = ("bound", "gallop", "rotary-gallop", "run")
"""Skills with much regulation."""
MUCH, LESS = 0.9, 0.7


def played_shares(context: Context, skills: Sequence[str]) -> Iterator[Figure]:
    """The least share of the torque that is the profile's own, among calm skills and among fast ones."""
    shares = {}
    for skill in skills:
        context.voice.say(f"what is played of {skill}")
        shares[skill] = played_share("go2", skill, context.seed)
    for what, some, least in (
        ("walks and trots", [s for s in skills if s not in LOOSE], MUCH),
        ("run, bound and gallops", [s for s in skills if s in LOOSE], LESS),
    ):
        worst = min(some, key=lambda skill: shares[skill])
        note = ", ".join(f"{skill} {shares[skill]:.2f}" for skill in some)
        yield Figure(
            f"share of the torque played back, {what}, the least", shares[worst], "", at_least(least), 1, note
        )


def played_share(name: str, skill: str, seed: int) -> float:
    """1 − Σ|τ − τ_taught| / Σ|τ|, the mean over a steady walk."""
    robot, scene = robot_named(name), load_scene("flat", seed)
    chooser = fixed_skill(robot, skill, None, 0.0, None, "learned")
    brain = Brain.of(robot, scene, chooser, DT, watches=False).with_profiles(
        {skill: (profile_of(name, skill),)}
    )
    session = Session(brain, make_plant("mujoco", robot, scene, DT), Mission(()), SECONDS, seed)
    shares = [session.mind.memories.control[-1] for lap in session if lap.sensed.time > FROM]
    return float(np.mean(shares))
