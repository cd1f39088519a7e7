"""One command: the host's process, the server, and the address to open."""

import asyncio
import json
import secrets
import signal
import socket
import threading
from collections.abc import Callable, Coroutine
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from functools import partial
from ipaddress import ip_address
from pathlib import Path

import uvicorn

from gaitwright.errors import BadFile, GaitwrightError, WrongUse
from gaitwright.studio.hub import Hub
from gaitwright.studio.messages import MOST_BYTES, Reset
from gaitwright.studio.names_asked import setup_asked
from gaitwright.studio.recordings import Shelf
from gaitwright.studio.robot_process import RobotProcess
from gaitwright.studio.server import LOOPBACK, application
from gaitwright.studio.setup import EVERYBODY, FROM, Ends, Gone

CLOSED = b'{"say":"closed","because":"the process with the robot has ended unexpectedly"}'


@dataclass(frozen=True)
class Serving:
    """What is served, and where."""

    folder: Path
    """For recordings."""
    page: Path
    """Folder of the built page."""
    address: str = "127.0.0.1"
    port: int = 0
    """0: any that is free."""
    token: str = field(default_factory=lambda: secrets.token_urlsafe(18))
    ticket: str = field(default_factory=lambda: secrets.token_urlsafe(18))
    """Lets a browser in once."""


def serve(robot: RobotProcess, what: Serving, opened: Callable[[str, str], None]) -> None:
    """Serves until it is interrupted. `opened` is told the address as soon as pages can be asked for, and one
    that is good once.

    Raises `WrongUse` where the port is taken or the address is none of a machine, and what the robot's
    process raised where it could not begin.
    """
    check_address(what.address)
    with bound(what.address, what.port) as place:
        name = f"[{what.address}]" if ":" in what.address else what.address
        where = f"http://{name}:{place.getsockname()[1]}"
        opened(f"{where}/?token={what.token}", f"{where}/open/{what.ticket}")
        hub = until_told(served(robot, what, place))
    if hub is not None and hub.closed and "hello" not in hub.last:
        raise ended(hub.last["closed"])


def until_told(serving: Coroutine[None, None, Hub]) -> Hub | None:
    """Serves until Ctrl-C, or until it is asked to end; `None` then."""
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        return asyncio.run(serving)
    except KeyboardInterrupt:
        return None


async def served(robot: RobotProcess, what: Serving, place: socket.socket) -> Hub:
    """Serves on a socket, until it is told to end or the robot's process cannot begin."""
    loop = asyncio.get_running_loop()
    own, runs = robot.setup, 0

    def told(run: int, who: int, said: bytes) -> None:
        if run != runs:  # of one that was given up
            return
        hub.told(who, said)
        robot.has_begun = robot.has_begun or "hello" in hub.last
        server.should_exit = server.should_exit or (hub.closed and not robot.has_begun)

    def attend() -> None:
        nonlocal runs
        runs += 1
        listening = robot.ends, loop, partial(told, runs)
        threading.Thread(target=listen, args=listening, daemon=True).start()

    def restart(said: Reset) -> None:
        last = replace(own, **hub.setup)  # as it was, not as it could not be begun
        robot.again(setup_asked(said, last, own))
        attend()

    hub = Hub(robot.ask, restart)
    hosts = LOOPBACK | {what.address.lower()}
    app = application(hub, what.page, Shelf(what.folder), what.token, hosts, what.ticket)
    config = uvicorn.Config(
        app, log_level="warning", lifespan="off", ws_max_size=MOST_BYTES, timeout_graceful_shutdown=1
    )
    server = uvicorn.Server(config)
    attend()
    await server.serve([place])
    return hub


def ended(said: str) -> GaitwrightError:
    """The error that ended the robot's process before it had begun."""
    told = json.loads(said)
    kinds = {kind.exit_code: kind for kind in (WrongUse, BadFile)}
    return kinds.get(told.get("code", 0), GaitwrightError)(told["because"])


def listen(pipe: Ends, loop: asyncio.AbstractEventLoop, told: Callable[[int, bytes], None]) -> None:
    """Hands on what the host says, and that it is gone. It listens to the end, also when nobody else does any
    more: who writes into a full pipe waits, and could not end."""

    def hand_on(who: int, said: bytes) -> None:
        with suppress(RuntimeError):  # the loop is closed
            loop.call_soon_threadsafe(told, who, said)

    try:
        while True:
            said = pipe.recv_bytes()
            (who,) = FROM.unpack_from(said)
            hand_on(who, said[FROM.size :])
    except Gone:
        hand_on(EVERYBODY, CLOSED)


def check_address(address: str) -> None:
    """Raises `WrongUse` for one that stands for all of a machine's: nobody could be called by it."""
    with suppress(ValueError):
        if ip_address(address).is_unspecified:
            raise WrongUse(
                f"--host {address} stands for every address of this machine; name the one that others reach "
                "it by, or stay on 127.0.0.1 and come through `ssh -L`"
            )


@contextmanager
def bound(address: str, port: int):
    """A socket on an address of this machine. Raises `WrongUse` where it cannot be had."""
    family = socket.AF_INET6 if ":" in address else socket.AF_INET
    with socket.socket(family, socket.SOCK_STREAM) as place:
        place.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            place.bind((address, port))
            place.listen()  # who asks before the server runs is served when it does
        except (OSError, OverflowError) as error:
            raise WrongUse(
                f"{address} port {port} cannot be served on: {error}; name another --port"
            ) from None
        yield place
