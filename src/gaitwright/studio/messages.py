"""What a page may say: each message as a value, checked; whatever else comes is refused with a sentence.

A message is a JSON object whose field `do` names it; where it has an `id`, it is answered. docs/studio.md
says what a person does with them.
"""

import math
from typing import Annotated, Literal, TypeVar

import msgspec
from msgspec import Meta

from gaitwright.errors import WrongUse

MOST_BYTES = 65_536
"""A longer message is no message."""
Place = Annotated[float, Meta(ge=-10_000.0, le=10_000.0)]
"""World [m]."""
Rate = Annotated[float, Meta(ge=-100.0, le=100.0)]
"""[m/s] or [rad/s]"""
Angle = Annotated[float, Meta(ge=-2.0 * math.pi, le=2.0 * math.pi)]
Length = Annotated[float, Meta(ge=0.001, le=100.0)]
Name = Annotated[str, Meta(max_length=200)]
Number = Annotated[float, Meta(ge=-1e6, le=1e6)]
Points = Annotated[list[Annotated[list[Number], Meta(min_length=3, max_length=4)]], Meta(max_length=128)]
Value = TypeVar("Value")
Mode = Literal["guide", "apprentice", "plan"]
MODES: tuple[Mode, ...] = ("guide", "apprentice", "plan")


class Message(msgspec.Struct, forbid_unknown_fields=True, kw_only=True, tag_field="do", tag=str.lower):
    """What every message may carry."""

    id: Annotated[int, Meta(ge=0, lt=2**53)] | None = None
    """Of who asks: it is in the answer."""


class Anyone(Message):
    """What one who only watches may say too."""


# --- where to go ------------------------------------------------------------------------------------
class Go(Message):
    """To a place; with `then`, after those that were given before."""

    x: Place
    y: Place
    then: bool = False


class Steer(Message):
    """A velocity, in the robot's heading frame; it holds for the watchdog's time."""

    forward: Rate
    left: Rate = 0.0
    turn: Rate = 0.0


class Stand(Message):
    """To stand where it is."""


class Skill(Message):
    """One skill, held at a speed [m/s]; with no name rules choose again."""

    name: Name
    speed: Rate | None = None


class Drive(Message):
    """Who computes the torques."""

    driver: Name


class SetMode(Message, tag="mode"):
    """What a person is here for."""

    mode: Mode


class Compose(Message):
    """To begin a motion that is noted as it is asked for, or to end it."""

    on: bool


class Play(Message):
    """The motion that was composed, from now on."""


# --- time -------------------------------------------------------------------------------------------
class Pause(Message):
    """Time stands."""


class Resume(Message):
    """Time goes on."""


class Step(Message):
    """So many control periods, while time stands."""

    ticks: Annotated[int, Meta(ge=1, le=5000)] = 1


class Pace(Message):
    """Simulated seconds per second."""

    factor: Annotated[float, Meta(ge=0.05, le=4.0)]


class Abort(Message):
    """The robot comes to a stand, is let down, and its motors go off."""


class Reset(Message):
    """From the start; what is left out stays as it is."""

    robot: Name | None = None
    scene: Name | None = None
    seed: Annotated[int, Meta(ge=0, lt=2**31)] | None = None
    sight: Literal["known", "camera"] | None = None
    driver: Name | None = None


# --- the world --------------------------------------------------------------------------------------
class Push(Message):
    """A push on the body: impulse per mass [N·s/kg], direction in the world [rad]."""

    impulse: Annotated[float, Meta(ge=0.0, le=20.0)]
    direction: Angle


class PlaceBox(Message, tag="place"):
    """A box on the ground: its middle, sides, height [m] and turn [rad]."""

    x: Place
    y: Place
    lx: Length
    ly: Length
    height: Length
    yaw: Angle = 0.0


class Move(Message):
    """A box to another place."""

    thing: Annotated[int, Meta(ge=0)]
    x: Place
    y: Place
    yaw: Angle | None = None


class Remove(Message):
    """A box is taken away."""

    thing: Annotated[int, Meta(ge=0)]


# --- who drives the page, and what is kept ----------------------------------------------------------
class Take(Anyone):
    """To be the one who drives."""


class Release(Message):
    """To drive no more."""


class Record(Message):
    """To begin a recording, or to end and keep it."""

    on: bool


class Recordings(Anyone):
    """Which recordings there are."""


# --- teaching ---------------------------------------------------------------------------------------
class Right(Message):
    """What would be right here, at a speed [m/s]; nothing is learned before `keep`."""

    skill: Name
    speed: Rate | None = None
    about: Name = ""
    name: Name = ""


class Ok(Message):
    """What it does here is right: learned at once."""


class Keep(Message):
    """What was tried is learned; refused where it is another lesson than the one named."""

    lesson: Name = ""


class Back(Message):
    """What was tried is not learned."""


class Forget(Message):
    """A lesson is taken back; with no name the last one."""

    lesson: Name = ""


class Why(Anyone):
    """Why it does what it does, or why a rule does not fire; in `brief` only what fires, and in what
    situation."""

    rule: Name = ""
    brief: bool = False


class Order(Message):
    """Rule `rule` before rule `before` where both could fire."""

    rule: Name
    before: Name


# --- curves -----------------------------------------------------------------------------------------
Kind = Literal["cycle", "torque", "angle"]


class Curve(Anyone):
    """A curve of a skill to look at, of the one in use where none is named; `leg` counts from 0."""

    kind: Kind
    skill: Name = ""
    leg: Annotated[int, Meta(ge=0, le=16)] = 0


class Edit(Message):
    """Other points for a curve: seen in physics, and taken on at the next cycle, or refused. With `obstacle`
    a leg cycle is how its foot gets over what is ahead of it: a rule for every leg and skill."""

    kind: Kind
    skill: Name
    leg: Annotated[int, Meta(ge=0, le=16)]
    points: Points
    mirror: bool = True
    obstacle: bool = False


class Undo(Message):
    """The last edit is taken back."""


class Redo(Message):
    """And done again."""


class Save(Message):
    """Edits are kept: of torques in the skillbook, of leg cycles in files."""


def kinds(of: type[Message]) -> list[type[Message]]:
    """All messages there are, by the order above."""
    return [kind for one in of.__subclasses__() for kind in (kinds(one) or [one])]


WORDS: dict[str, type[Message]] = {str(kind.__struct_config__.tag): kind for kind in kinds(Message)}
"""Messages by what they ask to do."""


class Word(msgspec.Struct):
    """As much of a message as says which it is."""

    do: Name
    id: int | None = None


def message_of(text: str | bytes) -> Message:
    """The message in a text. Raises `WrongUse` that says what is wrong with it, or what there is."""
    if len(text) > MOST_BYTES:
        raise WrongUse(f"a message has at most {MOST_BYTES} bytes, not {len(text)}")
    word = decoded(text, Word)
    if word.do not in WORDS:
        raise WrongUse(f"there is nothing called {word.do!r} to do; there is: {', '.join(WORDS)}")
    return decoded(text, WORDS[word.do])


def id_of(text: str | bytes) -> int | None:
    """The number by which an answer is awaited, of whatever came."""
    try:
        return msgspec.json.decode(text, type=Word).id
    except (msgspec.DecodeError, UnicodeError):
        return None


def decoded(text: str | bytes, kind: type[Value]) -> Value:
    """A value of a kind in JSON. Raises `WrongUse`."""
    try:
        return msgspec.json.decode(text, type=kind)
    except (msgspec.DecodeError, UnicodeError) as error:
        raise WrongUse(f"this is no message: {str(error)[:300]}") from None
