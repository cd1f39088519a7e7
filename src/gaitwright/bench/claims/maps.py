"""Claim: a map of polygons answers at once, and searches on streets look at little (rows V4, V5)."""

from collections.abc import Iterator

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.known_maps import ours, peers
from gaitwright.bench.evidence.street_searches import street_figures
from gaitwright.bench.measurement import Figure

NOTE = (
    "Maps: star-shaped polygons of 3 to 8 corners, 0.5 to 2 m from their middles, one for each 50 m², "
    "some of which overlap; ways between random places for a disc of 0.16 m. A map finds the links of a "
    "corner when a search first goes on from it, and keeps them. Peers plan for a point among the same "
    "polygons, grown by shapely (mitred, so their ways are a little longer) and joined where they overlap, "
    "in an environment of their own; their graphs are whole before they are asked. Streets: 100 × 100, "
    "blocks of 50 to 150 m, a fifth of all parts blocked; the searches in breadth count streets, the "
    "others metres."
)


def measure(context: Context) -> Iterator[Figure]:
    """Building, asking, and expansions."""
    for count in (200,) if context.quick else (200, 2000):
        context.voice.say(f"maps: {count} polygons")
        yield from ours(context, count)
    if not context.quick:
        yield from peers(context)
    context.voice.say("maps: streets")
    yield from street_figures(context)
