"""Requests that a studio should refuse: from elsewhere, without the token, nonsense, from a watcher."""

import http.client
import json
from typing import Any, NamedTuple

import numpy as np

from gaitwright.bench.measurement import Figure, count
from gaitwright.studio.frames import HEADER


class Address(NamedTuple):
    """Where a studio is."""

    place: str
    token: str

    @property
    def live(self) -> str:
        return f"ws://{self.place}/live?token={self.token}"


FOREIGN = ("evil.example", "127.0.0.1.evil.example", "", "[", "10.0.0.1")
NONSENSE = (
    "", "{", "[]", "null", '{"do":"fly"}', '{"do":"go","x":1}', '{"do":"go","x":NaN,"y":0}',
    '{"do":"go","x":1e999,"y":0}', '{"do":"steer","forward":1e300}', '{"do":"go","x":1,"y":0,"z":0}',
    '{"do":"step","ticks":100000000}', '{"do":"pace","factor":0}', '{"do":["go"]}', "\x00", "[" * 30_000,
    '{"do":"reset","robot":"../../etc/passwd"}', '{"do":"skill","name":"' + "x" * 50_000 + '"}',
)  # fmt: skip


async def refused(address: Address) -> Figure:
    """How many of the requests that should be refused are, while the robot stays where it is."""
    from websockets.asyncio.client import connect  # noqa: PLC0415 - an extra

    tries: list[bool] = [answered(address, {"Host": host}) == 403 for host in FOREIGN]
    origins = [f"http://{host}" for host in FOREIGN if host.strip("[")]
    tries += [answered(address, {"Host": address.place, "Origin": origin}) == 403 for origin in origins]
    for settings in ({"origin": "http://evil.example"}, {"additional_headers": {"Host": "evil.example"}}):
        tries.append(await is_shut(address.live, **settings))
    for token in ("", "x", address.token[:-1], address.token + "x"):
        tries.append(await is_shut(f"ws://{address.place}/live?token={token}"))
    async with (
        connect(address.live, max_size=None) as driver,
        connect(address.live, max_size=None) as watcher,
    ):
        before = await standing(driver)
        for text in NONSENSE:
            tries.append(await is_refused(driver, text))
        for text in ('{"do":"go","x":1,"y":0}', '{"do":"push","impulse":1,"direction":0}'):
            tries.append(await is_refused(watcher, text))
        after = await standing(driver)
    tries.append(await is_cut(address.live))
    tries.append(bool(np.linalg.norm(after - before) < 0.01))
    return count("requests refused that should be, the robot stays", sum(tries), len(tries), 1.0, "", {})


def answered(address: Address, headers: dict[str, str]) -> int:
    """How a request for the page is answered."""
    connection = http.client.HTTPConnection(address.place, timeout=10.0)
    connection.putrequest("GET", "/", skip_host=True)
    for name, value in headers.items():
        connection.putheader(name, value)
    connection.endheaders()
    return connection.getresponse().status


async def is_shut(live: str, **settings: Any) -> bool:
    """Whether a connection is refused."""
    from websockets.asyncio.client import connect  # noqa: PLC0415 - an extra
    from websockets.exceptions import WebSocketException  # noqa: PLC0415

    try:
        async with connect(live, **settings) as page:
            await page.recv()
    except (WebSocketException, OSError):
        return True
    return False


async def is_cut(live: str) -> bool:
    """Whether a connection ends that says too much at once."""
    from websockets.asyncio.client import connect  # noqa: PLC0415 - an extra
    from websockets.exceptions import ConnectionClosed  # noqa: PLC0415

    async with connect(live, max_size=None) as page:
        try:
            await page.send("x" * 1_000_000)
            async for _ in page:
                pass
        except ConnectionClosed:
            return True
    return True


async def is_refused(page: Any, text: str) -> bool:
    """Whether what a page says is refused with a sentence."""
    await page.send(text)
    async for heard in page:
        if isinstance(heard, str) and (said := json.loads(heard))["say"] in ("refused", "done"):
            return said["say"] == "refused" and bool(said["because"])
    return False


async def standing(page: Any) -> np.ndarray:
    """Where the robot is [m]."""
    async for heard in page:
        if isinstance(heard, bytes):
            return np.frombuffer(heard[HEADER.size + 4 : HEADER.size + 16], "<f4")
    raise AssertionError("a studio that runs sends frames")
