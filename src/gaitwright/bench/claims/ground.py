"""Claim: Go2 trots and walks, blind, up and down slopes and over rough ground without a fall."""

from collections.abc import Iterator

from gaitwright.bench.claims.walks import Walk, measure_walks
from gaitwright.bench.context import Context
from gaitwright.bench.measurement import Figure

SCENES = ("slope:15", "slope:-15", "rough:0.05")
GAITS = (("trot", 0.4), ("walk", 0.25))
WALKS = tuple(
    Walk("go2", skill, speed, seconds=20.0, starts=10, scene=scene)
    for scene in SCENES
    for skill, speed in GAITS
)
"""The seed of a start draws the rough ground as well."""


def measure(context: Context) -> Iterator[Figure]:
    """The figures of walks on uneven ground."""
    return measure_walks(context, WALKS)
