"""Laps ↔ file: every lap of a trip as arrays, and its report (row E1)."""

import json
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from gaitwright.errors import NoRoom
from gaitwright.ground.moving import Mover
from gaitwright.ground.moving_entries import entry_of
from gaitwright.ground.terrain import Box
from gaitwright.locomotion import Lap, Mind
from gaitwright.model.robot import Robot, lists_of
from gaitwright.numerics.geometry import GRAVITY
from gaitwright.perception.fault_words import Fault
from gaitwright.record import metrics as figures
from gaitwright.record.arrangement import Arrangement
from gaitwright.record.channels import SITUATION, STATE, Held, Packer, columns_of, shapes, widths
from gaitwright.record.checked import NAMED, check_rows, header_of, sound_rows
from gaitwright.record.metrics import Report
from gaitwright.record.notes import MOST_LETTERS, MOST_NOTES, WHY, Note
from gaitwright.record.npz import opened, read_blocks, read_header, write_npz
from gaitwright.record.previews import Previewer, read_previews, series_of
from gaitwright.record.rows import BLOCK, Lazy, Table, Writer, filled, first_rows, parts
from gaitwright.skills.vocabulary import RULE_IN_USE

INTERRUPTED = "interrupted"
"""`stopped_because` of a trip that was cut off by the user."""


@dataclass(frozen=True, eq=False)
class Recording:
    """Every lap of a trip as arrays, one row per tick.

    `recording[channel]` is a whole channel in memory. `recording.channel(channel)[ticks]` reads only those
    ticks of it, which is how to go through a trip of hours.
    """

    robot: Robot
    scene: str
    seed: int
    dt: float
    skills: tuple[str, ...]
    """Names that the numbers in channel `skill` stand for."""
    drivers: tuple[str, ...]
    data: Float[np.ndarray, "ticks width"] | Table
    """All numbers, in the order of `channels.widths`; those of a long trip are in a file."""
    arrived: bool
    fell: bool
    stopped_because: str
    faults: tuple[Fault, ...] = ()
    """What was noticed to be broken."""
    memories: tuple[Held, ...] = ()
    """Working memories that the numbers in channel `memory` stand for."""
    trip: int | None = None
    """Ticks of the trip, where the robot was let down after it; `None`: all of them."""
    movers: tuple[Mover, ...] = ()
    """What moved, appeared or vanished in the scene that the run began in: how, and when."""
    previews: Float[np.ndarray, "moments numbers"] | Table | None = None
    """What the terrain scanner held some times a second (`record.previews`); `None`: nobody asked for it."""
    boxes: tuple[Box, ...] | None = None
    """Those that stood there all the time, where a person had them moved; `None`: those of the scene."""
    notes: tuple[Note, ...] = ()
    """Why it did what it did, and what a person did meanwhile."""

    def __len__(self) -> int:
        """Number of ticks."""
        return len(self.data)

    def __getitem__(self, channel: str) -> np.ndarray:
        """A channel `(ticks, width)`; those of one number are `(ticks,)`."""
        return self.channel(channel)[:]

    def channel(self, channel: str) -> Lazy:
        """A channel of which only those ticks are read that are taken."""
        places = columns_of(self.robot.n)
        if channel not in places:
            raise KeyError(f"no channel {channel!r}; there is: {', '.join(places)}")
        place = places[channel]
        if place.stop - place.start == 1:
            return Lazy(len(self), lambda ticks: self.data[ticks, place][:, 0])
        return Lazy(len(self), lambda ticks: self.data[ticks, place])

    def at(self, channel: str, tick: int) -> np.ndarray:
        """The numbers of a channel at a tick, counted from the start."""
        return np.array(self.channel(channel)[tick : tick + 1][0])

    @property
    def done(self) -> bool:
        """Whether the robot did what it was asked: it came to its goal, or walked for the time asked for."""
        return self.arrived or self.stopped_because.endswith("asked for are over")

    def moved(self) -> Float[np.ndarray, "ticks 3"]:
        """Velocity forward and left [m/s] and yaw rate [rad/s], in the heading frame."""
        return filled(self.motion())

    def motion(self) -> Lazy:
        """As `moved`, worked out for the ticks that are taken."""
        orientation, velocity = self.channel("orientation_wb"), self.channel("velocity_w")

        def of(ticks: slice) -> np.ndarray:
            first = max(0, ticks.start - 1)  # rates need a tick on both sides
            seen = slice(first, ticks.stop + 1)
            moved = figures.in_heading_frame(orientation[seen], velocity[seen], self.dt)
            return moved[ticks.start - first : ticks.stop - first]

        return Lazy(len(self), of)

    def sound(self) -> "Recording":
        """The part in which every number is one: what figures are made of when a simulation blew up."""
        good = [sound_rows(self.data[part, :], self.robot.n) for part in parts(len(self), BLOCK)]
        if all(kept.all() for kept in good):
            return self
        writer = Writer(self.data.shape[1])
        for part, kept in zip(parts(len(self), BLOCK), good, strict=True):
            writer.extend(self.data[part, :][kept])
        return replace(self, data=writer.table())

    def report(self) -> Report:
        """The figures of this trip; it must have a tick."""
        trip = self.of_trip()
        state_hash = figures.digest(trip.channel(name) for name in STATE)
        return trip.sound().figures(state_hash)

    def of_trip(self) -> "Recording":
        """The recording without what came after the trip."""
        if self.trip is None or self.trip >= len(self):
            return self
        return replace(self, data=first_rows(self.data, self.trip), trip=None)

    def figures(self, state_hash: str) -> Report:
        """The figures where every number is one."""
        duration = float(self.at("time", len(self) - 1) - self.at("time", 0))
        distance = figures.travelled(self.channel("position_w"))
        roll, pitch = (float(angle.std()) for angle in figures.attitude(self.channel("orientation_wb")))
        skill, driver = self.channel("skill"), self["driver"]
        error, yaw_error = figures.command_errors(
            self.motion(), self.channel("command"), skill, self.channel("period"), self.dt
        )
        weight = self.robot.total_mass * GRAVITY
        work = figures.joint_work(self.channel("tau"), self.channel("qd"), self.dt)
        cost = work / (weight * distance) if distance > 0.1 * self.robot.body_length else 0.0
        upright = figures.uprightness(self.fell, roll, pitch)
        return Report(
            robot=self.robot.name,
            scene=self.scene,
            arrived=self.arrived,
            falls=int(self.fell),
            duration_s=duration,
            distance_m=distance,
            speed_mean_mps=distance / duration if duration else 0.0,
            velocity_error_mps=error,
            yaw_rate_error_radps=yaw_error,
            cost_of_transport=cost,
            roll_std_rad=roll,
            pitch_std_rad=pitch,
            driver_share={name: float((driver == i).mean()) for i, name in enumerate(self.drivers)},
            tick_us=figures.tick_times(self.channel("took"), driver, self.drivers),
            skills=[self.skills[int(self.at("skill", start))] for start, _ in figures.stretches(skill)],
            desirability=figures.desirability(upright, error, self.done, cost, self.robot.height),
            stopped_because=self.stopped_because,
            seed=self.seed,
            state_hash=state_hash,
            faults=[asdict(fault) for fault in self.faults],
            energy_j_per_m=cost * weight,
        )

    def save(self, path: str | Path) -> Path:
        """Writes the recording as one `.npz` (arrays and a JSON header, no pickle), whole or not at all."""
        channels = {name: self.channel(name) for name in widths(self.robot.n)}
        if self.previews is not None:
            channels |= series_of(self.previews, self.robot.n)
        write_npz(Path(path), json.dumps(self.header()).encode(), channels)
        return Path(path)

    def header(self) -> dict[str, Any]:
        """All but the arrays, as plain JSON values."""
        own = {name: getattr(self, name) for name in HEADER}
        own["faults"] = [asdict(fault) for fault in self.faults]
        own["memories"] = [dict(held) for held in self.memories]
        own["movers"] = [entry_of(mover) for mover in self.movers]
        own["notes"] = [note._asdict() for note in self.notes]
        if self.boxes is not None:
            own["boxes"] = [entry_of(Mover(box)) for box in self.boxes]
        return own | {"robot": lists_of(self.robot)}


HEADER = ("scene", "seed", "dt", "skills", "drivers", "arrived", "fell", "stopped_because", "trip")
"""Fields of a recording that its file holds as they are."""


class Recorder:
    """Collects laps; what is old goes to a file as a trip grows long."""

    def __init__(
        self, robot: Robot, scene: str, seed: int, dt: float, movers: tuple[Mover, ...] = ()
    ) -> None:
        self.robot, self.scene, self.seed, self.dt = robot, scene, seed, dt
        self.movers = movers
        self.packer = Packer(robot.n)
        self.writer = Writer(sum(widths(robot.n).values()))
        self.previewer = Previewer(robot)
        self.last: Lap | None = None
        self.laps = 0
        self.trip: int | None = None
        self.no_room: str | None = None
        self.arrangement: Arrangement | None = None
        """The boxes, where a person may move them."""
        self.notes: list[Note] = []
        self.known: tuple[str, str, object] | None = None
        """Skill, driver and rule whose reason was noted last."""

    def note(self, note: Note) -> None:
        """Something that is told in words; of very many the first ones."""
        if len(self.notes) < MOST_NOTES:
            self.notes.append(note)

    def add(self, lap: Lap, mind: Mind | None = None) -> None:
        """Takes one lap, and what the terrain scanner holds after it where the mind that it left is told.

        Raises `NoRoom` where the disk is full: the trip has to end, and nothing is lost.
        """
        self.last, self.laps = lap, self.laps + 1
        decided = lap.call.skill, lap.call.driver, lap.call.memory.get(RULE_IN_USE)
        if decided != self.known:
            self.known = decided
            self.note(Note(float(lap.sensed.time), WHY, lap.call.because[:MOST_LETTERS]))
        try:
            self.writer.add(self.packer.row(lap))
            if mind is not None:
                self.previewer.add(lap, mind)
        except NoRoom as error:
            self.no_room = str(error)
            raise

    def end_trip(self) -> None:
        """What comes now belongs to the trip no more."""
        self.trip = self.laps

    def finish(self) -> Recording:
        """The recording of what was taken so far."""
        last, arranged = self.last, self.arrangement
        return Recording(
            self.robot,
            self.scene,
            self.seed,
            self.dt,
            tuple(self.packer.skills),
            tuple(self.packer.drivers),
            self.writer.table(),
            arrived=last is not None and last.arrived,
            fell=last is not None and last.fell,
            stopped_because=(last.stopped_because if last else None) or self.no_room or INTERRUPTED,
            faults=last.faults if last else (),
            memories=tuple(self.packer.memories),
            trip=self.trip if self.trip != self.laps else None,
            movers=(*self.movers, *(arranged.movers if arranged else ())),
            previews=self.previewer.rows(),
            boxes=arranged.still if arranged else None,
            notes=tuple(self.notes),
        )


# --- files ------------------------------------------------------------------------------------------
def load(path: str | Path) -> Recording:
    """The recording in a file. Raises `BadFile` where the file is not one, or holds what none can."""
    sound = False
    with opened(Path(path)) as archive:
        robot, own = header_of(read_header(archive))
        known = {name: len(own[names]) for name, names in NAMED.items()}
        writer = Writer(sum(widths(robot.n).values()))
        for block in read_blocks(archive, shapes(robot.n), optional=SITUATION):
            check_rows(block, robot.n, known)
            sound = sound or bool(sound_rows(block, robot.n).any())
            writer.extend(block)
        if not sound:
            raise ValueError("none of its ticks holds only numbers")
        previews = read_previews(archive, robot.n)
        return Recording(robot=robot, data=writer.table(), previews=previews, **own)
