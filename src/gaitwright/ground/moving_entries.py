"""What a scene file says of a thing that moves, appears or vanishes; and a mover as such an entry again."""

import math
from dataclasses import fields
from typing import Any

import msgspec

from gaitwright.ground.entry_types import Corners, Pace, Strict, Time
from gaitwright.ground.moving import Mover
from gaitwright.ground.terrain import Solid

MOST_MOVERS = 100
"""Physics and camera follow each of them all the time."""


class MovesEntry(Strict, frozen=True, rename={"begins": "from"}):
    """Where a thing goes to from where it stands."""

    along: Corners
    speed: Pace
    begins: Time = 0.0
    loop: bool = False


class Timed(Strict, frozen=True, kw_only=True):
    """What any thing of a scene may have beside its place and size."""

    moves: MovesEntry | None = None
    appears: Time = 0.0
    vanishes: Time | None = None

    @property
    def is_still(self) -> bool:
        """Whether it stands there all the time."""
        return self.moves is None and self.appears == 0.0 and self.vanishes is None

    @property
    def numbers(self) -> dict[str, Any]:
        """Its own fields, those of every thing left out."""
        return {name: value for name, value in msgspec.structs.asdict(self).items() if name not in OF_ALL}

    def mover(self, solid: Solid) -> Mover:
        """What becomes of it; `ValueError` where that is nothing that can be."""
        vanishes = math.inf if self.vanishes is None else self.vanishes
        if vanishes <= self.appears:
            raise ValueError(f"vanishes at {vanishes:g} s and appears at {self.appears:g} s: never there")
        if self.moves is None:
            return Mover(solid, appears=self.appears, vanishes=vanishes)
        go = self.moves
        mover = Mover(solid, tuple(go.along), go.speed, go.begins, go.loop, self.appears, vanishes)
        if mover.gone_at[-1] < 1e-3:
            raise ValueError("moves along no way: all points of it are where it stands")
        return mover


OF_ALL = Timed.__struct_fields__


def outside(mover: Mover, bounds: tuple[float, float, float, float]) -> str | None:
    """Which point of its way lies outside bounds, in words; `None`: none does."""
    x_min, y_min, x_max, y_max = bounds
    for k, (x, y) in enumerate(mover.path if mover.along else ()):
        if not (x_min <= x <= x_max and y_min <= y <= y_max):
            where = f"moves.along[{k - 1}] is" if k else "moves: it begins at"
            return f"{where} [{x:g}, {y:g}], which lies outside bounds {list(bounds)}"
    return None


def entry_of(mover: Mover) -> dict[str, Any]:
    """A mover as the entry of a shape that a scene file has for it."""
    solid = mover.solid
    entry: dict[str, Any] = {"type": type(solid).__name__.lower()}
    entry |= {field.name: getattr(solid, field.name) for field in fields(solid)}  # pyright: ignore
    if mover.along:
        entry["moves"] = {
            "along": mover.along,
            "speed": mover.speed,
            "from": mover.begins,
            "loop": mover.loop,
        }
    if mover.appears > 0.0:
        entry["appears"] = mover.appears
    if math.isfinite(mover.vanishes):
        entry["vanishes"] = mover.vanishes
    return entry
