"""The numbers of a scene file with their limits: what is beyond them is refused before anything is made."""

from typing import Annotated

import msgspec
from msgspec import Meta

MAX_CORNERS = 200
"""Of one outline, and points of one way."""
MAX_NODES = 1000
"""Of a side of a grid of heights."""
MAX_CONTROLS = 200
"""Control points along a side of a net."""
LONGEST = 100_000.0
"""Nothing happens in a scene later than this [s]: a day and some hours."""

Place = Annotated[float, Meta(ge=-1000.0, le=1000.0)]
Length = Annotated[float, Meta(gt=0.0, le=1000.0)]
Size = Annotated[float, Meta(ge=0.001, le=1000.0)]
"""Nothing that robots meet is smaller than a millimetre [m]."""
Angle = Annotated[float, Meta(ge=-7.0, le=7.0)]
Incline = Annotated[float, Meta(ge=-1.0, le=1.0)]
Base = Annotated[float, Meta(ge=0.0, le=1000.0)]
Spacing = Annotated[float, Meta(ge=0.001, le=100.0)]
Time = Annotated[float, Meta(ge=0.0, le=LONGEST)]
Pace = Annotated[float, Meta(ge=0.001, le=20.0)]
Row = Annotated[list[Place], Meta(min_length=2, max_length=MAX_NODES)]
Controls = Annotated[list[Place], Meta(min_length=2, max_length=MAX_CONTROLS)]
Corners = Annotated[list[tuple[Place, Place]], Meta(min_length=1, max_length=MAX_CORNERS)]


class Strict(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Refuses what it does not know."""
