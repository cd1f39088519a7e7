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
    chosen = {place: learned_map_of(maps[place]) for place in asked or maps}
    if out is not None and len(chosen) != 1:
        raise WrongUse(f"--out draws one map: name its place, of {', '.join(maps) or 'none'}")
    figures = {"book": path, "maps": {place: figures_of(learned) for place, learned in chosen.items()}}
    write_json(args.json, json.dumps(figures, indent=2, ensure_ascii=False))
    if args.json != "-" and chosen:
        show_table(HEAD, [row_of(place, learned) for place, learned in chosen.items()], right=HEAD[2:])
    if not chosen:
        remark(f"{short(path)} has no maps: `gaitwright mission --sight camera --skillbook` learns them")
    if out is not None:
        draw(chosen, Path(out))


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


def row_of(place: str, learned: LearnedMap) -> Sequence[str]:
    """A line of the table."""
    x_min, y_min, x_max, y_max = learned.bounds
    field = f"{x_max - x_min:g} × {y_max - y_min:g}"
    last = f"{length_of(learned.trips[-1]):.1f}" if learned.trips else "–"
    counts = str(len(learned.trips)), last, str(len(learned.rows)), f"{free_ground(learned):.0f}"
    return place, field, *counts, f"{2.0 * learned.radius:.2f}"


def draw(chosen: dict[str, LearnedMap], path: Path) -> None:
    """Draws the one map that was chosen."""
    if not has("matplotlib", "the picture", "plot"):
        return
    ((place, learned),) = chosen.items()
    with working("drawing the map", worth_a_line=None):
        from gaitwright.pictures.learned_map import learned_map_picture  # noqa: PLC0415 - an extra

        learned_map_picture(learned, place, path)
    remark(f"picture: {path}")
