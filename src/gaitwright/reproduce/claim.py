"""What a reproduction holds: claims of the thesis with ours beside them, grids of numbers, pictures."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

Say = Callable[[str], None]
"""Told what is being done."""


@dataclass(frozen=True)
class Claim:
    """One thing the thesis says, and what we get."""

    what: str
    thesis: str
    """As printed there."""
    ours: str
    """As computed here."""
    agrees: bool | None
    """`None` where the two cannot agree, or could not differ; `because` says why."""
    because: str = ""
    """How it was judged; for what cannot agree, why."""
    numbers: Mapping[str, Any] = field(default_factory=dict)
    """Every number behind it, as plain JSON values."""

    @property
    def verdict(self) -> str:
        """agrees, DIFFERS, or cannot."""
        return {True: "agrees", False: "DIFFERS", None: "cannot"}[self.agrees]

    def plain(self) -> dict[str, Any]:
        """As plain JSON values."""
        return {
            "what": self.what,
            "thesis": self.thesis,
            "ours": self.ours,
            "verdict": self.verdict,
            "because": self.because,
            "numbers": dict(self.numbers),
        }


@dataclass(frozen=True)
class Grid:
    """Numbers in rows and columns, as text."""

    title: str
    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    left: int = 1
    """So many columns are flush left, the others flush right."""
    together: int = 1
    """So many of the others belong together: a screen that is too narrow for all does not part them."""


@dataclass(frozen=True)
class Picture:
    """A picture that can be drawn into a file."""

    name: str
    """Of its file."""
    caption: str
    draw: Callable[[Path], None]


@dataclass(frozen=True)
class Reproduction:
    """A table or figure of the thesis, computed anew."""

    name: str
    title: str
    about: Sequence[str]
    """Paragraphs: what was computed, and what has to be known to read it."""
    claims: Sequence[Claim]
    grids: Sequence[Grid] = ()
    pictures: Sequence[Picture] = ()
    numbers: Mapping[str, Any] = field(default_factory=dict)
    """What the grids and pictures show, as plain JSON values."""

    @property
    def agrees(self) -> bool:
        """Whether every claim agrees that can."""
        return all(claim.agrees is not False for claim in self.claims)

    def plain(self) -> dict[str, Any]:
        """As plain JSON values."""
        return {
            "name": self.name,
            "title": self.title,
            "about": list(self.about),
            "agrees": self.agrees,
            "claims": [claim.plain() for claim in self.claims],
            "numbers": dict(self.numbers),
        }
