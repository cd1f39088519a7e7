"""What the file of a recording holds, held against what a recording can be: nothing is believed before."""

from collections.abc import Iterator, Mapping
from dataclasses import fields
from typing import Annotated, Any

import msgspec
import numpy as np
from msgspec import Meta

from gaitwright.errors import printable
from gaitwright.ground.moving_entries import MOST_MOVERS
from gaitwright.ground.scene_entries import BoxShape, ShapeEntry
from gaitwright.model.robot import Robot, robot_of
from gaitwright.perception.fault_words import Fault
from gaitwright.record.channels import MEMORY, MOST_MEMORIES, SITUATION, Held, always, columns_of
from gaitwright.record.notes import MOST_LETTERS, MOST_NOTES, Note

MOST_LEGS = 16
MOST_BOXES = 2500
"""Of a scene that a person arranges."""
LARGEST = 1e6
"""No number of a robot is as large as this, in SI units."""
BLOWN_UP = 1e12
"""A number of a tick beyond this is none any more: the simulation blew up."""
LONGEST_PERIOD = 1000.0
"""Of a gait [s]."""
MOST_POINTS = 100_000
"""Of a route."""

Name = Annotated[str, Meta(min_length=1, max_length=200)]
Names = Annotated[tuple[Name, ...], Meta(max_length=1000)]
Facts = Annotated[dict[Name, Annotated[str, Meta(max_length=1000)] | float], Meta(max_length=1000)]
Lists = Annotated[list[Any], Meta(max_length=MOST_LEGS)]


class Noticed(msgspec.Struct, frozen=True):
    """A `Fault`."""

    kind: Name
    leg: Name | None
    joint: Name | None
    since: float
    noticed: float
    sentence: Annotated[str, Meta(max_length=1000)]
    answer: Name

    @property
    def fault(self) -> Fault:
        """It, in letters that do nothing to a terminal."""
        leg, joint = (None if name is None else printable(name) for name in (self.leg, self.joint))
        words = (printable(text) for text in (self.sentence, self.answer))
        return Fault(printable(self.kind), leg, joint, self.since, self.noticed, *words)


class Noted(msgspec.Struct, frozen=True):
    """A `Note`."""

    time: float
    kind: Name
    sentence: Annotated[str, Meta(max_length=MOST_LETTERS)]

    @property
    def note(self) -> Note:
        """It, in letters that do nothing to a terminal."""
        return Note(self.time, printable(self.kind), printable(self.sentence))


class Header(msgspec.Struct, frozen=True):
    """The JSON beside the channels."""

    scene: Annotated[str, Meta(max_length=1000)]
    seed: int
    dt: Annotated[float, Meta(ge=1e-6, le=10.0)]
    skills: Names
    drivers: Names
    arrived: bool
    fell: bool
    stopped_because: Annotated[str, Meta(max_length=10_000)]
    robot: dict[str, str | float | Lists]
    faults: Annotated[tuple[Noticed, ...], Meta(max_length=100)] = ()
    memories: Annotated[tuple[Facts, ...], Meta(max_length=MOST_MEMORIES)] = ()
    trip: Annotated[int, Meta(ge=1)] | None = None
    movers: Annotated[tuple[ShapeEntry, ...], Meta(max_length=MOST_MOVERS)] = ()
    boxes: Annotated[tuple[BoxShape, ...], Meta(max_length=MOST_BOXES)] | None = None
    notes: Annotated[tuple[Noted, ...], Meta(max_length=MOST_NOTES)] = ()


def header_of(content: bytes) -> tuple[Robot, dict[str, Any]]:
    """The robot of a header, and its other fields. Raises `ValueError` or `TypeError` where it is none."""
    entry = msgspec.json.decode(content, type=Header)
    own = {name: getattr(entry, name) for name in Header.__struct_fields__ if name != "robot"}
    shown = {
        "scene": printable(entry.scene),
        "stopped_because": printable(entry.stopped_because),
        "skills": tuple(map(printable, entry.skills)),
        "drivers": tuple(map(printable, entry.drivers)),
        "memories": tuple(map(held, entry.memories)),
        "faults": tuple(noticed.fault for noticed in entry.faults),
        "movers": tuple(thing.mover(thing.solid()[0]) for thing in entry.movers),
        "boxes": None if entry.boxes is None else tuple(box.solid()[0] for box in entry.boxes),
        "notes": tuple(noted.note for noted in entry.notes),
    }
    robot = robot_of(dict(entry.robot))
    fault = next(faults_of(robot), None)
    if fault:
        raise ValueError(f"its robot has {fault}")
    return robot, own | shown


def held(facts: Facts) -> Held:
    """A working memory, in letters that do nothing to a terminal."""
    shown = ((name, printable(fact) if isinstance(fact, str) else fact) for name, fact in facts.items())
    return tuple(sorted((printable(name), fact) for name, fact in shown))


NAMED = {"skill": "skills", "driver": "drivers", MEMORY: "memories"}
"""The channels whose numbers stand for something in the header, and its field."""


def faults_of(robot: Robot) -> Iterator[str]:
    """What keeps plain numbers from being a robot."""
    if not 1 <= robot.n <= MOST_LEGS or not all(isinstance(leg, str) for leg in robot.legs):
        yield f"no 1 to {MOST_LEGS} legs"
    if not isinstance(robot.name, str) or isinstance(robot.base_mass, str):
        yield "a name that is none, or a mass that is none"
    for field in fields(Robot):
        value, dims = getattr(robot, field.name), getattr(field.type, "dim_str", None)
        if dims is None:
            continue
        shape = tuple(robot.n if size == "legs" else int(size) for size in dims.split())
        numbers = isinstance(value, np.ndarray) and value.dtype.kind in "if" and value.shape == shape
        if not numbers or not (np.abs(value) < LARGEST).all():
            yield f"no {' × '.join(map(str, shape))} numbers as its {field.name}"
    if not (0.0 < robot.base_mass < LARGEST and (robot.mass >= 0.0).all() and robot.height > 0.0):
        yield "masses or a height that are not positive"


def sound_rows(rows: np.ndarray, legs: int) -> np.ndarray:
    """Which rows `(rows, width)` hold numbers only, those of the situation apart."""
    with np.errstate(invalid="ignore"):
        return np.all(np.abs(rows[:, : always(legs)]) < BLOWN_UP, axis=1)


def check_rows(rows: np.ndarray, legs: int, named: Mapping[str, int]) -> None:
    """Raises `ValueError` for a row that names a skill, driver or memory that there is not; `named` says how
    many there are. Only what is remembered may not be told."""
    places = columns_of(legs)

    def column(name: str) -> np.ndarray:
        return rows[:, places[name]][:, 0]

    for name, known in named.items():
        numbers = column(name)
        numbers = numbers[~np.isnan(numbers)] if name in SITUATION else numbers
        wrong = numbers[~((numbers >= 0) & (numbers < known) & (numbers == np.floor(numbers)))]
        if len(wrong):
            raise ValueError(f"it has {known} names of {name}s, and a tick with number {wrong[0]:g}")
    period = column("period")
    if not ((period > 0.0) & (period <= LONGEST_PERIOD)).all():
        raise ValueError(f"the period of a gait is not between 0 and {LONGEST_PERIOD:g} s")
    check_situation(rows, legs)


def check_situation(rows: np.ndarray, legs: int) -> None:
    """Raises `ValueError` for a route or a look ahead that is none. NaN is what was not known, and only what
    stands in the way may be endlessly far."""
    places = columns_of(legs)
    for name in SITUATION:
        values = rows[:, places[name]]
        endless = (values == np.inf) & (name == "scan_obstacle")
        if not (np.isnan(values) | (np.abs(values) < BLOWN_UP) | endless).all():
            raise ValueError(f"channel {name} holds what is no number")
    points, left, following = (rows[:, places[f"route_{name}"]] for name in ("points", "remaining", "next"))
    known = ~np.isnan(points[:, 0])
    if not ((points[known] >= 0) & (points[known] <= MOST_POINTS)).all():
        raise ValueError(f"a route has not 0 to {MOST_POINTS} points")
    if np.isnan(left[known]).any() or np.isnan(following[known & (points[:, 0] > 0)]).any():
        raise ValueError("a route has points, and none of them is told")
