"""Who watches and who drives: what the host says goes to all, what a driver asks goes to the host.

Latest wins: of frames, and of each kind of thing that is said to everybody, one who reads slowly gets the
newest and never a queue of old ones. Answers to what one asked are kept, up to `MOST_ANSWERS`. Of the ground
the robot knows what is around it and pages gather that, so one who comes later is told what was seen before,
piece by piece, and after all else.
"""

import asyncio
import itertools
import json
import math
from collections.abc import Callable
from time import monotonic
from typing import Any

from gaitwright.errors import WrongUse
from gaitwright.studio.messages import Anyone, Release, Reset, Take, id_of, message_of

MOST_ANSWERS, MOST_WATCHERS = 256, 64
KINDS = (
    "waits", "hello", "world", "boxes", "rules", "status", "scan", "seen", "moved", "curve", "tried",
    "closed",
)  # fmt: skip
"""Of what is said to everybody, one who comes later is told the last of each of these, in this order."""
OF_A_RUN = ("scan", "seen", "moved", "tried")
APART, MOST_PAST = 4.0, 60
"""What was seen of the ground is kept for every so many metres of the way, of so many places (13 MB)."""
RATE, BURST = 60.0, 120.0
"""So much may a page ask in a second, and at once: thrice what a held key does."""
HANGS = 30.0
"""A robot's process that has said nothing for so long may be given up [s]."""


class Member:
    """One page: what it is still to be told."""

    def __init__(self, number: int) -> None:
        self.number = number
        self.news = asyncio.Event()
        self.frame: bytes | None = None
        self.said: dict[str, str] = {}
        self.answers: list[str] = []
        self.past: list[str] = []
        """What was seen of the ground before."""
        self.may_ask, self.asked_at = BURST, monotonic()

    def asks(self) -> None:
        """Counts what it asks. Raises `WrongUse` where that is too much."""
        now = monotonic()
        self.may_ask = min(BURST, self.may_ask + RATE * (now - self.asked_at))
        self.asked_at = now
        if self.may_ask < 1.0:
            raise WrongUse(f"a page may ask {RATE:g} things a second")
        self.may_ask -= 1.0

    def take(self) -> list[str | bytes]:
        """What there is; of what was seen before one piece at a time, what is seen now after that."""
        seen = self.said.pop("seen", None)
        texts: list[str | bytes] = [*self.answers, *self.said.values()]
        frames = [] if self.frame is None else [self.frame]
        self.answers, self.said, self.frame = [], {}, None
        self.news.clear()
        if self.past and seen is not None:
            self.said["seen"] = seen
            self.news.set()
            return [*texts, *frames, self.past.pop(0)]
        return [*texts, *frames, *([] if seen is None else [seen])]


class Hub:
    """All pages of a studio. `ask` hands a message of one of them to the host; `restart` begins another run
    where that has ended."""

    def __init__(self, ask: Callable[[int, bytes], None], restart: Callable[[Reset], None]) -> None:
        self.ask, self.restart = ask, restart
        self.members: dict[int, Member] = {}
        self.driver: int | None = None
        self.last: dict[str, str] = {}
        self.last_frame: bytes | None = None
        self.past: dict[tuple[int, int], str] = {}
        """What was seen of the ground, by where that was."""
        self.setup: dict[str, Any] = {}
        """What the last run is of, or was."""
        self.heard_at = monotonic()
        self.numbers = itertools.count(1)
        self.closed = False
        """Whether the host is gone."""

    # --- coming and going ---------------------------------------------------------------------------
    def enter(self) -> Member:
        """A page comes; the first one drives. Raises `WrongUse` where there is no more room."""
        if len(self.members) >= MOST_WATCHERS:
            raise WrongUse(f"{MOST_WATCHERS} pages are open, and that is all there is room for")
        member = Member(next(self.numbers))
        self.members[member.number] = member
        if self.driver is None:
            self.driver = member.number
        self.tell_roles()
        member.said |= {kind: self.last[kind] for kind in KINDS if kind in self.last}
        member.past = [seen for seen in self.past.values() if seen is not self.last.get("seen")]
        member.frame = self.last_frame
        return member

    def leave(self, member: Member) -> None:
        """A page is gone; a driver who leaves lets go."""
        self.members.pop(member.number, None)
        if self.driver == member.number:
            self.driver = None
        self.tell_roles()

    def tell_roles(self) -> None:
        """Says to each who drives."""
        told = {"say": "role", "watchers": len(self.members) - 1, "has_driver": self.driver is not None}
        for member in self.members.values():
            role = "driver" if member.number == self.driver else "watcher"
            member.said["role"] = json.dumps(told | {"role": role})
            member.news.set()

    # --- what is asked ------------------------------------------------------------------------------
    def hears(self, member: Member, text: str | bytes) -> None:
        """What a page asks goes to the host, unless it may not."""
        try:
            member.asks()
            message = message_of(text)
            if isinstance(message, Take | Release):
                self.hand_over(member, isinstance(message, Take))
                self.answer(member.number, json.dumps({"say": "done", "id": message.id}))
                return
            if member.number != self.driver and not isinstance(message, Anyone):
                raise WrongUse("somebody else drives: take over first")
            if self.closed and not isinstance(message, Reset):
                raise WrongUse("the run has ended: a reset begins another")
            if isinstance(message, Reset) and (self.closed or self.hangs):
                self.begin_again(member, message)
            else:
                self.ask(member.number, text.encode() if isinstance(text, str) else text)
        except WrongUse as error:
            refused = {"say": "refused", "id": id_of(text), "because": str(error)}
            self.answer(member.number, json.dumps(refused))

    @property
    def hangs(self) -> bool:
        """Whether a run that had begun has said nothing for long."""
        return "status" in self.last and monotonic() - self.heard_at > HANGS

    def begin_again(self, member: Member, message: Reset) -> None:
        """Another run in the place of one that has ended. Raises `WrongUse` where it may not be had."""
        self.restart(message)
        self.closed, self.last, self.heard_at = False, {}, monotonic()
        self.answer(member.number, json.dumps({"say": "done", "id": message.id}))

    def hand_over(self, member: Member, takes: bool) -> None:
        """One takes the wheel, or lets it go."""
        if takes:
            self.driver = member.number
        elif self.driver == member.number:
            self.driver = None
        self.tell_roles()

    # --- what is said -------------------------------------------------------------------------------
    def told(self, who: int, what: bytes) -> None:
        """What the host says, to one or to all."""
        self.heard_at = monotonic()
        if not what.startswith(b"{"):
            self.last_frame = what
            for member in self.members.values():
                member.frame = what
                member.news.set()
            return
        text = what.decode()
        if who:
            self.answer(who, text)
            return
        said = json.loads(text)
        kind = str(said["say"])
        if kind == "hello":
            self.forget_run()
        if kind == "closed" and self.closed:
            return  # what it said itself says more
        self.last[kind] = text
        self.remember(kind, said, text)
        self.closed = self.closed or kind == "closed"
        for member in self.members.values():
            member.said.pop(kind, None)  # it stands behind what was said before it
            member.said[kind] = text
            member.news.set()

    def forget_run(self) -> None:
        """Another run begins: nobody is told of the one before any more."""
        self.past = {}
        for told in (self.last, *(member.said for member in self.members.values())):
            for kind in OF_A_RUN:
                told.pop(kind, None)
        for member in self.members.values():
            member.past = []

    def remember(self, kind: str, said: dict[str, Any], text: str) -> None:
        """Keeps what was seen of the ground, and what the run is of."""
        if kind == "status":
            self.setup = said["setup"] | {"driver": said["driver"]}
        elif kind == "seen":
            place = math.floor(said["x"] / APART), math.floor(said["y"] / APART)
            self.past.pop(place, None)
            self.past[place] = text
            if len(self.past) > MOST_PAST:
                del self.past[next(iter(self.past))]

    def answer(self, who: int, text: str) -> None:
        """Something to one page, if it is still there."""
        member = self.members.get(who)
        if member is not None and len(member.answers) < MOST_ANSWERS:
            member.answers.append(text)
            member.news.set()
