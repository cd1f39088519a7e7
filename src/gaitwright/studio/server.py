"""The studio's one port: the page, its live connection, recordings to take home (Starlette).

Whoever asks must name this machine as the host, come from the studio's own page where a browser says where it
comes from, and know the token, which only the address has that `gaitwright studio` prints. A browser that it
opens is given a ticket instead, which is good once: what a program is called with, others can read.
"""

import asyncio
import hashlib
import hmac
import sys
from pathlib import Path
from urllib.parse import urlsplit

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.requests import HTTPConnection, Request
from starlette.responses import FileResponse, RedirectResponse, Response
from starlette.routing import Mount, Route, WebSocketRoute
from starlette.staticfiles import StaticFiles
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect

from gaitwright.errors import WrongUse
from gaitwright.studio.hub import Hub, Member
from gaitwright.studio.recordings import Shelf

LOOPBACK = frozenset({"127.0.0.1", "localhost", "::1"})
POLICY = (
    "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "media-src 'self' blob:; connect-src 'self'; frame-ancestors 'none'; base-uri 'none'"
)
REPLAY_POLICY = (
    "sandbox allow-scripts allow-downloads; default-src 'none'; script-src 'unsafe-inline'; "
    "style-src 'unsafe-inline'; img-src data: blob:; media-src blob:; frame-ancestors 'none'; base-uri 'none'"
)
"""A replay has its script inside: it may run, but as a page from nowhere, that reaches nothing."""
SECURITY = b"content-security-policy"
HEADERS = [
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"cache-control", b"no-cache"),
]
NO_ENTRY, DENIED, FULL = 403, 4403, 4429
"""Answers: of HTTP, and of a socket that is closed before it opens, or at once."""
MOST_REASON = 120
"""Letters; what closes a socket has little room."""


def application(
    hub: Hub, page: Path, shelf: Shelf, token: str, hosts: frozenset[str] = LOOPBACK, ticket: str = ""
) -> ASGIApp:
    """The studio as a web application. `hosts`: by what names it may be called; `ticket`: for one browser."""
    tickets = {ticket} - {""}
    making = asyncio.Lock()

    async def index(request: Request) -> Response:
        return FileResponse(page / "index.html")

    async def let_in(request: Request) -> Response:
        if request.path_params["ticket"] not in tickets:
            raise HTTPException(NO_ENTRY, "this was good once: the address that is printed is good for ever")
        tickets.clear()
        return RedirectResponse(f"/?token={token}", 303)

    async def recording(request: Request) -> Response:
        check_token(request, token)
        name = request.path_params["name"]
        try:
            path = await taken_home(shelf, name, making)
        except WrongUse as error:
            raise HTTPException(404, str(error)) from None
        if path.suffix == ".html":  # it has a script inside, which finds no token where it is shown
            return RedirectResponse(f"/shown/{signed(token, name)}/{name}", 303)
        return FileResponse(path)

    async def shown(request: Request) -> Response:
        name = request.path_params["name"]
        if not same(request.path_params["ticket"], signed(token, name)) or not shelf.has(name):
            raise HTTPException(NO_ENTRY, "there is no such replay: open it from the studio's page")
        return FileResponse(shelf.path(name), headers={SECURITY.decode(): REPLAY_POLICY})

    async def live(socket: WebSocket) -> None:
        if not same(socket.query_params.get("token", ""), token):
            await socket.close(DENIED)
            return
        await socket.accept()
        try:
            member = hub.enter()
        except WrongUse as error:
            await socket.close(FULL, str(error)[:MOST_REASON])
            return
        await converse(hub, member, socket)

    routes = [
        Route("/", index),
        Route("/open/{ticket}", let_in),
        Route("/recordings/{name}", recording),
        Route("/shown/{ticket}/{name}", shown),
        WebSocketRoute("/live", live),
        Mount("/", StaticFiles(directory=page)),
    ]
    return Guarded(Starlette(routes=routes), hosts)


async def taken_home(shelf: Shelf, name: str, making: asyncio.Lock) -> Path:
    """A recording in the form that its name asks for, made of the recording itself where it is not there yet.

    Another process makes it, so that frames go on, one at a time. Raises `WrongUse` where there is no such
    recording.
    """
    if shelf.has(name):
        return shelf.path(name)
    source, out = shelf.path(f"{Path(name).stem}.npz"), shelf.place(name)
    async with making:
        if not shelf.has(name):  # it was asked for twice
            await made(source, out)
    return shelf.path(name)


async def made(source: Path, out: Path) -> None:
    """Makes another form of a recording. Raises `WrongUse` where it cannot be made."""
    command = [sys.executable, "-P", "-m", "gaitwright", "replay", str(source), "--out", str(out)]
    nobody = asyncio.subprocess.DEVNULL
    process = await asyncio.create_subprocess_exec(*command, stdout=nobody, stderr=asyncio.subprocess.PIPE)
    _, said = await process.communicate()
    if process.returncode:
        raise WrongUse(said.decode(errors="replace").strip()[-300:])


async def converse(hub: Hub, member: Member, socket: WebSocket) -> None:
    """Tells a page what there is to tell and hears it, until it is gone."""
    teller = asyncio.create_task(tell(member, socket))
    try:
        while True:
            message = await socket.receive()
            if message["type"] == "websocket.disconnect":
                break
            hub.hears(member, message.get("text") or message.get("bytes") or "")
    except (WebSocketDisconnect, RuntimeError):
        pass
    finally:
        teller.cancel()
        hub.leave(member)


async def tell(member: Member, socket: WebSocket) -> None:
    """Sends what is new, as fast as the page takes it."""
    try:
        while True:
            await member.news.wait()
            for one in member.take():
                await (socket.send_text(one) if isinstance(one, str) else socket.send_bytes(one))
    except (WebSocketDisconnect, RuntimeError):
        pass


def check_token(request: HTTPConnection, token: str) -> None:
    """Refuses who does not know the token."""
    if not same(request.query_params.get("token", ""), token):
        raise HTTPException(NO_ENTRY, "the address lacks the token that `gaitwright studio` printed")


def same(one: str, other: str) -> bool:
    """Whether two secrets are the same, found out in a time that says nothing."""
    return hmac.compare_digest(one.encode(), other.encode())


def signed(token: str, name: str) -> str:
    """What lets one see one recording, and nothing else."""
    return hmac.new(token.encode(), name.encode(), hashlib.sha256).hexdigest()


class Guarded:
    """An application behind a look at where a request comes from and where it means to go."""

    def __init__(self, app: ASGIApp, hosts: frozenset[str]) -> None:
        self.app, self.hosts = app, hosts

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
            return
        headers = {name.lower(): value.decode("latin-1") for name, value in scope["headers"]}
        if not self.is_welcome(headers.get(b"host", ""), headers.get(b"origin")):
            await self.refuse(scope, receive, send)
            return

        async def with_headers(message) -> None:
            if message["type"] == "http.response.start":
                own = message["headers"]
                has_policy = any(name == SECURITY for name, _ in own)
                policy = [] if has_policy else [(SECURITY, POLICY.encode())]
                message["headers"] = [*own, *policy, *HEADERS]
            await send(message)

        await self.app(scope, receive, with_headers)

    def is_welcome(self, host: str, origin: str | None) -> bool:
        """Whether a host is this one by a name that it has, and an origin, where there is one, its page."""
        try:
            name = urlsplit(f"//{host}").hostname
            came_from = None if origin is None else urlsplit(origin)
        except ValueError:
            return False
        if name not in self.hosts:
            return False
        return came_from is None or (came_from.scheme in ("http", "https") and came_from.netloc == host)

    async def refuse(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "websocket":
            await send({"type": "websocket.close", "code": DENIED})
            return
        said = "this request names another host, or comes from another page, than the studio's"
        await Response(said, NO_ENTRY)(scope, receive, send)
