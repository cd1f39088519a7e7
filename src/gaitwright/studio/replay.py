"""Recordings → one HTML page with all in it, which opens by a double click and can be sent to a colleague.

The page is the studio's own, built as one file; a recording is put into it as JSON: its rows as in `frames`,
but for what no recording tells (where feet should be, and where they are to land), and its world as
`shown.world_shown` has it, both deflated.
"""

import base64
import json
import math
import zlib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from jaxtyping import Float

from gaitwright.errors import WrongUse
from gaitwright.files import fitting, whole
from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Flat
from gaitwright.record.changes import changes_of
from gaitwright.record.notes import DONE
from gaitwright.record.recording import Recording
from gaitwright.record.scene_of import rearranged, scene_of
from gaitwright.studio.frames import columns_of
from gaitwright.studio.setup import who_drives
from gaitwright.studio.shown import things_shown, world_shown

RATE = 50.0
"""Rows per second, and fewer of a trip that is so long that there would be more than `MOST_ROWS`."""
MOST_ROWS = 60_000
MOST_TOGETHER = 20
"""Recordings on one page."""
MOVES = 10.0
"""So many times a second it is said where moving things are."""
T = TypeVar("T")
TEMPLATE, PLACE = "replay.html", '<script type="application/json" id="recording">'

TOLD = (
    "time", "position_w", "orientation_wb", "velocity_w", "angular_velocity_b", "q", "tau", "load", "stance",
    "forces_w", "command", "reference_position_w", "phase", "driver", "power",
)  # fmt: skip
"""Columns of a frame's row that a recording tells."""
OTHERWISE = {"reference_position_w": "target_w"}
"""What a recording calls otherwise."""


def write_replay(
    recording: Recording, path: Path, page: Path, scene: Scene | None = None, others: Sequence[Recording] = ()
) -> Path:
    """Writes a page, complete or not at all. `page`: the folder of the built studio; `scene`: where it was
    recorded, else the one that it names, or a plane where that is not to be had; `others`: recordings that
    are shown on the same ground, from their beginnings on.

    Raises `WrongUse` where the studio was not built, a recording has no tick, or they are not of robots that
    have as many legs.
    """
    text = replay_page(recording, page, scene, others)
    with fitting(path), whole(path) as draft:
        draft.write_text(text, encoding="utf-8")
    return path


def replay_page(
    recording: Recording, page: Path, scene: Scene | None = None, others: Sequence[Recording] = ()
) -> str:
    """The text of a page."""
    template = page / TEMPLATE
    if not template.is_file():
        raise WrongUse("the studio's page is not built: `gaitwright studio` builds it")
    before, mark, after = template.read_text(encoding="utf-8").partition(PLACE)
    assert mark, "the built page has a place for a recording"
    told = replay_data(recording, scene, others)
    data = json.dumps(told, separators=(",", ":"), allow_nan=False)
    harmless = data.replace("<", "\\u003c")  # no name in it ends the data, or opens a comment
    return before + mark + harmless + after


def replay_data(
    recording: Recording, scene: Scene | None = None, others: Sequence[Recording] = ()
) -> dict[str, Any]:
    """All that a page shows of a recording, and of `others` on its ground, as plain JSON values."""
    check_together(recording, others)
    sound = recording.sound()
    ground = scene_shown_of(recording) if scene is None else rearranged(scene, recording)
    robots = [one.robot for one in (recording, *others)]
    world = world_shown(ground, robots, dict(enumerate(ground.boxes)))
    return {
        **story_of(sound),
        "world": pressed(json.dumps(world, allow_nan=False).encode()),
        "columns": told_columns(recording.robot.n),
        "movers": moves_of(sound, ground),
        "others": [story_of(other.sound()) for other in others],
    }


def check_together(recording: Recording, others: Sequence[Recording]) -> None:
    """Raises `WrongUse` for recordings that cannot be shown on one page."""
    if len(others) >= MOST_TOGETHER:
        raise WrongUse(f"{1 + len(others)} recordings on one page; there can be {MOST_TOGETHER}")
    for one in others:
        if one.robot.n != recording.robot.n:
            raise WrongUse(
                f"{one.robot.name} has {one.robot.n} legs, and {recording.robot.name} {recording.robot.n}: "
                "recordings on one page are of robots with as many"
            )


def story_of(recording: Recording) -> dict[str, Any]:
    """What happened to one robot. Raises `WrongUse` where nothing did."""
    if not len(recording):
        raise WrongUse("this recording has no moment to show")
    step = max(1, round(1.0 / (RATE * recording.dt)), math.ceil(len(recording) / MOST_ROWS))
    rows = rows_of(recording, step)
    return {
        "title": f"{recording.robot.name} in {recording.scene or 'a scene'}: {recording.stopped_because}",
        "drivers": [who_drives(driver) for driver in recording.drivers],
        "rate": 1.0 / (step * recording.dt),
        "count": len(rows),
        "rows": pressed(np.ascontiguousarray(rows, "<f4").tobytes()),
        "events": list(events_of(recording)),
        "notes": [note._asdict() for note in recording.notes if note.kind in DONE],
        "report": finite(asdict(recording.report())),
    }


def scene_shown_of(recording: Recording) -> Scene:
    """The scene that a recording names, with what moved in it; a plane where it is not to be had."""
    scene = scene_of(recording)
    return rearranged(Scene(recording.scene, Flat()), recording) if isinstance(scene, str) else scene


def told_columns(legs: int) -> list[dict[str, str | int]]:
    """Names and sizes of the columns of a row, in order."""
    return [column for column in columns_of(legs) if column["name"] in TOLD]


def rows_of(recording: Recording, step: int) -> Float[np.ndarray, "moments width"]:
    """Every `step`-th tick."""
    columns = []
    for column in told_columns(recording.robot.n):
        name = str(column["name"])
        if name == "power":
            columns.append(np.abs(recording["tau"] * recording["qd"])[::step].sum(axis=1)[:, None])
        else:
            channel = recording[OTHERWISE.get(name, name)][::step]
            columns.append(channel.reshape(len(channel), -1))
    return np.concatenate(columns, axis=1).astype(np.float32)


def pressed(plain: bytes) -> str:
    """Base64 of what is left of bytes when they are deflated."""
    press = zlib.compressobj(9, zlib.DEFLATED, -zlib.MAX_WBITS)
    return base64.b64encode(press.compress(plain) + press.flush()).decode()


def events_of(recording: Recording) -> Iterator[dict[str, Any]]:
    """When skill, driver or rule changed, and to what."""
    for change in changes_of(recording):
        by_rule = f"rule {change.rule}" if change.rule else ""
        yield change._asdict() | {"driver": who_drives(change.driver), "because": change.because or by_rule}


def moves_of(recording: Recording, scene: Scene) -> list[dict[str, Any]]:
    """Where moving things were, some times a second."""
    if not scene.movers:
        return []
    step = max(1, round(1.0 / (MOVES * recording.dt)), math.ceil(len(recording) / MOST_ROWS))
    times = recording["time"][::step].tolist()
    there = ((time, scene.at(time)) for time in times)
    told = ((time, things_shown(now, now.things)["things"]) for time, now in there)
    return [{"time": time, "things": things} for time, things in changed(told)]


def changed(told: Iterable[tuple[float, T]]) -> Iterator[tuple[float, T]]:
    """Of what is told time after time, what is not as it was."""
    before = None
    for time, now in told:
        if now != before:
            yield time, now
        before = now


def finite(value: Any) -> Any:
    """A value of JSON whose numbers are all numbers; `None` for those that are none."""
    if isinstance(value, dict):
        return {name: finite(one) for name, one in value.items()}
    if isinstance(value, list | tuple):
        return [finite(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
