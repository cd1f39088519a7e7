"""Claim: the studio shows a robot at once, costs little, answers quickly, and lets no stranger in."""

import asyncio
import gzip
import json
import math
import multiprocessing
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.intruders import Address, refused
from gaitwright.bench.measurement import Figure, at_most
from gaitwright.bench.trial import robot_named
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import DT, Session
from gaitwright.signals import Mission
from gaitwright.studio.frames import HEADER, PAUSED, frame_of, row_of
from gaitwright.studio.page_build import ready_page
from gaitwright.studio.setup import DRIVERS, FROM, Ends, Setup

FLEETS = (1, 10, 20)
RATE, SECONDS, QUICK_SECONDS = 60.0, 10.0, 2.0
WATCHERS, TOGGLES, QUICK_TOGGLES = 32, 200, 20
STARTS = 5
TOKEN = "bench"
NOTE = (
    "Streaming: rows of as many walking Go2 go through the server's process to one page, sixty times a "
    "second; its CPU time is that of the whole process. Ages and answers: `gaitwright studio` with a Go2 in "
    "physics, 32 pages that watch, all on this machine. From command to effect: from `pause` or `resume` to "
    "the first frame that has it. First picture: from the command to the first frame that a page gets; "
    "kernels were compiled before. A page counts with its scripts and styles, each gzipped."
)


def measure(context: Context) -> Iterator[Figure]:
    """What streaming costs, how old frames are, how soon a command shows, what is refused."""
    import websockets  # noqa: F401, PLC0415 - says at once where the extra is lacking

    page = ready_page(context.voice.say)
    seconds = QUICK_SECONDS if context.quick else SECONDS
    frames = walked(context, 1.0)
    for robots in FLEETS:
        context.voice.say(f"studio: streaming {robots} robots")
        yield from streaming(frames, robots, seconds, page)
    with tempfile.TemporaryDirectory() as folder:
        context.voice.say("studio: first picture")
        yield first_picture(Path(folder), 2 if context.quick else STARTS)
        with studio(Path(folder)) as address:
            context.voice.say(f"studio: {WATCHERS} pages watch")
            toggles = QUICK_TOGGLES if context.quick else TOGGLES
            yield from asyncio.run(watched(address, toggles))
            context.voice.say("studio: who should not come in")
            yield asyncio.run(refused(address))
    yield bundle(page)


# --- streaming --------------------------------------------------------------------------------------
def walked(context: Context, seconds: float) -> list[list[np.ndarray]]:
    """Rows of walking robots, sixty times a second: one list for each moment, a row for each robot."""
    robot, scene = robot_named("go2"), load_scene("flat")
    rows: list[list[np.ndarray]] = []
    for seed in range(max(FLEETS)):
        session = Session(
            Brain.of(robot, scene), MujocoPlant(robot, scene), Mission(((5.0, 0.0),)), 60.0, seed
        )
        laps = [(session.step(), session.mind.memories) for _ in range(round(seconds / DT))]
        every = round(1.0 / (RATE * DT))
        rows.append([row_of(lap, memories, DRIVERS) for lap, memories in laps[::every] if lap is not None])
    return [list(moment) for moment in zip(*rows, strict=True)]


def streaming(moments: list[list[np.ndarray]], robots: int, seconds: float, page: Path) -> Iterator[Figure]:
    """CPU of the server's process, and bytes to a page."""
    ours, theirs = Ends.pair()
    told, tells = multiprocessing.Pipe(duplex=False)
    process = multiprocessing.get_context("spawn").Process(target=serve_alone, args=(theirs, tells, page))
    process.start()
    port, pid = told.recv(), int(process.pid or 0)
    rows = [moment[:robots] for moment in moments]
    used, received = asyncio.run(streamed(ours, (port, pid), rows, round(seconds * RATE)))
    process.terminate()
    process.join(10.0)
    what = f"streaming {robots} robot{'' if robots == 1 else 's'} at 60 Hz"
    note = f"{len(received)} of {round(seconds * RATE)} frames came"
    yield Figure(f"{what}: server", 100.0 * used / seconds, "% of a core", at_most(5.0), 1, note)
    wanted = at_most(700.0) if robots == max(FLEETS) else None
    yield Figure(f"{what}: to one page", sum(received) / seconds / 1e3, "kB/s", wanted)


async def streamed(
    ends: Ends, server: tuple[int, int], moments: list[list[np.ndarray]], frames: int
) -> tuple[float, list[int]]:
    """Feeds a server on a port, with a process number, and reads as a page: the CPU time [s] that it used,
    and the size of each frame that came."""
    from websockets.asyncio.client import connect  # noqa: PLC0415 - an extra

    port, pid = server
    received: list[int] = []
    async with connect(f"ws://127.0.0.1:{port}/live?token={TOKEN}", max_size=None) as page:

        async def read() -> None:
            async for heard in page:
                if isinstance(heard, bytes):
                    received.append(len(heard))

        reader = asyncio.create_task(read())
        await asyncio.sleep(0.5)
        before, began = cpu_time(pid), time.monotonic()
        for k in range(frames):
            await asyncio.sleep(max(0.0, began + k / RATE - time.monotonic()))
            ends.send_bytes(FROM.pack(0) + frame_of(moments[k % len(moments)], k, paused=False))
        await asyncio.sleep(0.2)
        used = cpu_time(pid) - before
        reader.cancel()
    return used, received


def serve_alone(ends: Ends, tells: Connection, page: Path) -> None:
    """The studio's server in a process of its own, its robots elsewhere."""
    from gaitwright.studio.robot_process import RobotProcess  # noqa: PLC0415 - in this process alone
    from gaitwright.studio.serving import Serving, bound, served  # noqa: PLC0415

    class Elsewhere(RobotProcess):
        """A robot whose other end is in another process already."""

        def begin(self) -> None:
            self.ends = ends

    with bound("127.0.0.1", 0) as place:
        tells.send(place.getsockname()[1])
        robot, what = Elsewhere(Setup(), Path(), Path()), Serving(Path(), page, token=TOKEN)
        asyncio.run(served(robot, what, place))


def cpu_time(pid: int) -> float:
    """What a process has used so far [s]; NaN where the system does not tell it so."""
    try:
        fields = Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    except OSError:
        return math.nan
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


# --- a studio that runs -----------------------------------------------------------------------------
@contextmanager
def studio(folder: Path) -> Iterator[Address]:
    """`gaitwright studio`, until it is no longer needed."""
    command = [sys.executable, "-m", "gaitwright", "studio", "--no-browser", "--port", "0", "--scene", "flat"]
    options = ["--out", str(folder), "--json", "-"]
    with subprocess.Popen([*command, *options], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        said = urlsplit(json.loads(process.stdout.readline())["address"])
        try:
            yield Address(said.netloc, said.query.partition("=")[2])
        finally:
            process.terminate()
            process.wait(20.0)


def first_picture(folder: Path, starts: int) -> Figure:
    """From the command to the first frame at a page [s]."""
    each = []
    with studio(folder) as address:  # one that does not count: what was never compiled is compiled
        asyncio.run(first_frame(address))
    for _ in range(starts):
        began = time.monotonic()
        with studio(folder) as address:
            asyncio.run(first_frame(address))
            each.append(time.monotonic() - began)
    worst = max(each)
    return Figure(
        "first picture after the command, longest", worst, "s", at_most(3.0), starts, "", {"each": each}
    )


async def first_frame(address: Address) -> None:
    """Waits for the first frame."""
    from websockets.asyncio.client import connect  # noqa: PLC0415 - an extra

    async with connect(address.live, max_size=None) as page:
        async for heard in page:
            if isinstance(heard, bytes):
                return


async def watched(address: Address, toggles: int) -> Iterator[Figure]:
    """How old frames are when they reach a page of many, and how soon a driver's command shows [ms]."""
    from websockets.asyncio.client import connect  # noqa: PLC0415 - an extra

    ages: list[float] = []

    async def watch() -> None:
        async with connect(address.live, max_size=None) as page:
            async for heard in page:
                if isinstance(heard, bytes):
                    ages.append(1e3 * (time.time() - HEADER.unpack_from(heard)[4]))

    async with connect(address.live, max_size=None) as driver:
        await until_frame(driver, paused=False)
        await driver.send(json.dumps({"do": "steer", "forward": 0.0}))
        watchers = [asyncio.create_task(watch()) for _ in range(WATCHERS - 1)]
        await asyncio.sleep(2.0)
        ages.clear()
        effects = [await effect_of(driver, paused=k % 2 == 0) for k in range(2 * (toggles // 2))]
        for watcher in watchers:
            watcher.cancel()
    return iter(
        [
            percentiles(f"{WATCHERS} pages: age of a frame, p99", ages, 100.0),
            percentiles("driver's command to its effect, p99", effects, 50.0),
        ]
    )


def percentiles(what: str, each: list[float], most: float) -> Figure:
    """The 99th percentile [ms], with the middle and the longest beside it."""
    middle, high = np.percentile(each, [50, 99])
    note = f"median {middle:.1f}, longest {max(each):.1f}"
    return Figure(what, float(high), "ms", at_most(most), len(each), note)


async def effect_of(driver: Any, paused: bool) -> float:
    """From a command to the first frame that has its effect [ms]."""
    await asyncio.sleep(0.02 + 0.02 * np.random.default_rng().uniform())
    began = time.monotonic()
    await driver.send(json.dumps({"do": "pause" if paused else "resume"}))
    await until_frame(driver, paused)
    return 1e3 * (time.monotonic() - began)


async def until_frame(page: Any, paused: bool) -> None:
    """Reads to a frame in which time stands, or runs."""
    async for heard in page:
        if isinstance(heard, bytes) and bool(HEADER.unpack_from(heard)[1] & PAUSED) == paused:
            return


# --- the page ---------------------------------------------------------------------------------------
def bundle(page: Path) -> Figure:
    """What a browser fetches to show the page [kB], pressed."""
    parts = [path for path in page.rglob("*") if path.suffix in (".html", ".js", ".css", ".woff2", ".svg")]
    sizes = {
        path.name: len(gzip.compress(path.read_bytes())) / 1e3 for path in parts if path.name != "replay.html"
    }
    return Figure("page, gzipped", sum(sizes.values()), "kB", at_most(400.0), 1, "", sizes)
