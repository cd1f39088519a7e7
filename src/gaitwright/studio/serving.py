"""One command: the host's process, the server, and the address to open."""

import asyncio
import json
import multiprocessing
import secrets
import signal
import socket
import threading
from collections.abc import Callable, Coroutine
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path

import uvicorn

from gaitwright.errors import BadFile, GaitwrightError, WrongUse
from gaitwright.studio.hub import Hub
from gaitwright.studio.messages import MOST_BYTES, Reset
from gaitwright.studio.recordings import Shelf
from gaitwright.studio.server import LOOPBACK, application
from gaitwright.studio.setup import EVERYBODY, FROM, Ends, Setup, begin

SETTLES = 10.0
"""The robot's process may take so long to end [s]."""
CLOSED = b'{"say":"closed","because":"the process with the robot has ended unexpectedly"}'


@dataclass(frozen=True)
class Serving:
    """What is served, and where."""

    setup: Setup
    book: Path
    folder: Path
    """For recordings."""
    page: Path
    """Folder of the built page."""
    address: str = "127.0.0.1"
    port: int = 0
    """0: any that is free."""
    token: str = ""
    """Empty: one is made."""
    begins: bool = False
    """Whether a book that is not there is begun."""


class Robot:
    """The process with the robot: begun, talked to, begun anew, ended."""

    def __init__(self, what: Serving) -> None:
        self.what, self.setup = what, what.setup
        self.begin()

    def begin(self) -> None:
        """A run from its start."""
        self.ends, theirs = Ends.pair()
        book, folder = str(self.what.book), str(self.what.folder)
        arguments = (theirs, self.setup, book, folder, self.what.begins)
        context = multiprocessing.get_context("spawn")
        self.process = context.Process(target=begin, args=arguments, daemon=True)
        self.process.start()
        for end in theirs:
            end.close()

    def again(self, said: Reset) -> None:
        """Another run in the place of one that has ended."""
        self.end()
        given = {name: getattr(said, name) for name in self.setup.__slots__}
        self.setup = replace(self.setup, **{name: of for name, of in given.items() if of is not None})
        self.begin()

    def ask(self, who: int, text: bytes) -> None:
        """Hands on what a page asks."""
        with suppress(OSError):  # it is gone: what it said last tells so
            self.ends.send_bytes(FROM.pack(who) + text)

    def end(self) -> None:
        """Ends it; it keeps what was recorded."""
        self.ends.tells.close()
        self.process.join(SETTLES)
        if self.process.is_alive():
            self.process.terminate()


def serve(what: Serving, opened: Callable[[str], None]) -> None:
    """Serves until it is interrupted. `opened` is told the address as soon as pages can be asked for.

    Raises `WrongUse` where the port is taken, and what the robot's process raised where it could not begin.
    """
    token = what.token or secrets.token_urlsafe(18)
    robot = Robot(what)
    try:
        with bound(what.address, what.port) as place:
            name = f"[{what.address}]" if ":" in what.address else what.address
            opened(f"http://{name}:{place.getsockname()[1]}/?token={token}")
            hub = until_told(served(what, token, robot, place))
    finally:
        robot.end()
    if hub is not None and hub.closed and "hello" not in hub.last:
        raise ended(hub.last["closed"])


def until_told(serving: Coroutine[None, None, Hub]) -> Hub | None:
    """Serves until Ctrl-C, or until it is asked to end; `None` then."""
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        return asyncio.run(serving)
    except KeyboardInterrupt:
        return None


async def served(what: Serving, token: str, robot: Robot, place: socket.socket) -> Hub:
    """Serves on a socket, until it is told to end or the robot's process cannot begin."""
    loop = asyncio.get_running_loop()
    began = False

    def told(who: int, said: bytes) -> None:
        nonlocal began
        hub.told(who, said)
        began = began or "hello" in hub.last
        server.should_exit = server.should_exit or (hub.closed and not began)

    def attend() -> None:
        threading.Thread(target=listen, args=(robot.ends, loop, told), daemon=True).start()

    def restart(said: Reset) -> None:
        robot.again(said)
        attend()

    hub = Hub(robot.ask, restart)
    app = application(hub, what.page, Shelf(what.folder), token, LOOPBACK | {what.address})
    config = uvicorn.Config(app, log_level="warning", ws_max_size=MOST_BYTES, timeout_graceful_shutdown=1)
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
    except (EOFError, OSError):
        hand_on(EVERYBODY, CLOSED)


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
