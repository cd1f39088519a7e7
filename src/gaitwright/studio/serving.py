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
from dataclasses import dataclass
from pathlib import Path

import uvicorn

from gaitwright.errors import BadFile, GaitwrightError, WrongUse
from gaitwright.studio.hub import Hub
from gaitwright.studio.messages import MOST_BYTES
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


def serve(what: Serving, opened: Callable[[str], None]) -> None:
    """Serves until it is interrupted. `opened` is told the address as soon as pages can be asked for.

    Raises `WrongUse` where the port is taken, and what the robot's process raised where it could not begin.
    """
    token = what.token or secrets.token_urlsafe(18)
    with bound(what.address, what.port) as place:
        port = place.getsockname()[1]
        ours, theirs = Ends.pair()
        context = multiprocessing.get_context("spawn")
        arguments = (theirs, what.setup, str(what.book), str(what.folder), what.begins)
        process = context.Process(target=begin, args=arguments, daemon=True)
        process.start()
        for end in theirs:
            end.close()
        try:
            name = f"[{what.address}]" if ":" in what.address else what.address
            opened(f"http://{name}:{port}/?token={token}")
            hub = until_told(served(what, token, ours, place))
        finally:
            ours.tells.close()
            process.join(SETTLES)  # it keeps what was recorded
            if process.is_alive():
                process.terminate()
    if hub is not None and hub.closed and "hello" not in hub.last:
        raise ended(hub.last["closed"])


def until_told(serving: Coroutine[None, None, Hub]) -> Hub | None:
    """Serves until Ctrl-C, or until it is asked to end; `None` then."""
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        return asyncio.run(serving)
    except KeyboardInterrupt:
        return None


async def served(what: Serving, token: str, pipe: Ends, place: socket.socket) -> Hub:
    """Serves on a socket, with the host at the other end of a pipe, until that ends or cannot begin."""

    def ask(who: int, text: bytes) -> None:
        with suppress(OSError):  # the host is gone: what it said last tells so
            pipe.send_bytes(FROM.pack(who) + text)

    hub = Hub(ask)
    loop = asyncio.get_running_loop()
    hosts = LOOPBACK | {what.address}
    app = application(hub, what.page, Shelf(what.folder), token, hosts)
    config = uvicorn.Config(app, log_level="warning", ws_max_size=MOST_BYTES, timeout_graceful_shutdown=1)
    server = uvicorn.Server(config)

    def told(who: int, said: bytes) -> None:
        hub.told(who, said)
        server.should_exit = server.should_exit or (hub.closed and "hello" not in hub.last)

    threading.Thread(target=listen, args=(pipe, loop, told), daemon=True).start()
    await server.serve([place])
    return hub


def ended(said: str) -> GaitwrightError:
    """The error that ended the robot's process before it had begun."""
    told = json.loads(said)
    kinds = {kind.exit_code: kind for kind in (WrongUse, BadFile)}
    return kinds.get(told.get("code", 0), GaitwrightError)(told["because"])


def listen(pipe: Ends, loop: asyncio.AbstractEventLoop, told: Callable[[int, bytes], None]) -> None:
    """Hands on what the host says, and that it is gone."""
    with suppress(RuntimeError):  # the loop is closed: nobody listens any more
        try:
            while True:
                said = pipe.recv_bytes()
                (who,) = FROM.unpack_from(said)
                loop.call_soon_threadsafe(told, who, said[FROM.size :])
        except (EOFError, OSError):
            loop.call_soon_threadsafe(told, EVERYBODY, CLOSED)


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
