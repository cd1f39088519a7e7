"""`gaitwright books map`: which places a book knows, how much of them, and one of them from above."""

import json
from argparse import Namespace
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from gaitwright.cli.book_files import skillbook_of
from gaitwright.cli.console import remark, show_table, working
from gaitwright.cli.output import check_picture, write_json
from gaitwright.cli.trips import has
from gaitwright.errors import WrongUse, short, unknown
from gaitwright.learning.map_books import free_ground, learned_map_of, length_of
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.skillbook.map_notes import place_of

HEAD = ("place", "field [m]", "trips", "last [m]", "pieces", "free [m²]", "width [m]")


def run(args: Namespace) -> None:
    """All maps or that of a place; with `--out` one is drawn."""
    path, *asked = args.files
    out = check_picture(args.out)
    maps = {place_of(notes): notes for notes in skillbook_of(path).maps}
    if asked and asked[0] not in maps:
        raise unknown(f"map in {short(path)}", asked[0], maps)
    chosen = asked or list(maps)
    if out is not None and len(chosen) != 1:
        raise WrongUse(f"--out draws one map: name its place, of {', '.join(maps) or 'none'}")
    figures = {place: figures_of(learned_map_of(maps[place])) for place in chosen}
    write_json(args.json, json.dumps({"book": path, "maps": figures}, indent=2, ensure_ascii=False))
    if args.json != "-" and chosen:
        show_table(HEAD, [row_of(place, told) for place, told in figures.items()], right=HEAD[2:])
    if not chosen:
        remark(f"{short(path)} has no maps: `gaitwright mission --sight camera --skillbook` learns them")
    if out is not None:
        draw(learned_map_of(maps[chosen[0]]), chosen[0], Path(out))


def figures_of(learned: LearnedMap) -> dict[str, Any]:
    """A map as plain values."""
    return {
        "bounds": learned.bounds,
        "trips": [round(length_of(way), 3) for way in learned.trips],
        "pieces": len(learned.rows),
        "free_m2": round(free_ground(learned), 2),
        "radius": learned.radius,
        "noise": learned.noise,
        "strategy": learned.strategy,
    }


def row_of(place: str, told: dict[str, Any]) -> Sequence[str]:
    """A line of the table."""
    (x_min, y_min, x_max, y_max), trips = told["bounds"], told["trips"]
    last = f"{trips[-1]:.1f}" if trips else "–"
    counts = str(len(trips)), last, str(told["pieces"]), f"{told['free_m2']:.0f}"
    return place, f"{x_max - x_min:g} × {y_max - y_min:g}", *counts, f"{2.0 * told['radius']:.2f}"


def draw(learned: LearnedMap, place: str, path: Path) -> None:
    """Draws a map."""
    if not has("matplotlib", "the picture", "plot"):
        return
    with working("drawing the map", worth_a_line=None):
        from gaitwright.pictures.learned_map import learned_map_picture  # noqa: PLC0415 - an extra

        learned_map_picture(learned, place, path)
    remark(f"picture: {path}")
