"""Ways into the studio beside its printed address: what is good once, and what opens one replay alone."""

import asyncio
from pathlib import Path

import pytest

from gaitwright.errors import WrongUse
from gaitwright.studio.hub import Hub
from gaitwright.studio.recordings import Shelf
from gaitwright.studio.server import application
from gaitwright.studio.serving import bound, check_address

TOKEN, NAME = "the token", "2026-01-01_go2.html"


@pytest.fixture
def app(tmp_path: Path):
    page = tmp_path / "page"
    page.mkdir()
    (page / "index.html").write_text("the page")
    (tmp_path / NAME).write_text("a replay")
    hub = Hub(lambda who, text: None, lambda said: None)
    return application(hub, page, Shelf(tmp_path), TOKEN, ticket="once")


def get(app, path: str) -> tuple[int, dict[str, str], str]:
    """Status, headers and text of what is answered to a request."""
    place, _, query = path.partition("?")
    scope = {
        "type": "http", "method": "GET", "path": place, "raw_path": place.encode(), "root_path": "",
        "query_string": query.encode(), "headers": [(b"host", b"127.0.0.1:1")], "scheme": "http",
        "http_version": "1.1", "server": ("127.0.0.1", 1), "client": ("127.0.0.1", 2),
    }  # fmt: skip
    sent = []

    async def receive() -> dict:
        await asyncio.Event().wait()  # nothing more is said, and nobody hangs up
        return {}

    async def send(message: dict) -> None:
        sent.append(message)

    asyncio.run(app(scope, receive, send))
    headers = {name.decode(): value.decode() for name, value in sent[0]["headers"]}
    return sent[0]["status"], headers, b"".join(one.get("body", b"") for one in sent[1:]).decode()


def test_a_ticket_lets_in_once(app):
    status, headers, _ = get(app, "/open/once")
    assert status == 303 and headers["location"] in ("/?token=the token", "/?token=the%20token")
    status, headers, said = get(app, "/open/once")
    assert status == 403 and "good once" in said and TOKEN not in str(headers)
    assert get(app, "/open/")[0] == 404


def test_a_replay_is_shown_where_it_finds_no_token(app):
    assert get(app, f"/recordings/{NAME}")[0] == 403
    status, headers, _ = get(app, f"/recordings/{NAME}?token={TOKEN.replace(' ', '%20')}")
    place = headers["location"]
    assert status == 303 and "token" not in place
    status, headers, text = get(app, place)
    assert (status, text) == (200, "a replay") and headers["content-security-policy"].startswith("sandbox")
    for other in (place.replace("2026", "2025"), f"/shown/x/{NAME}", f"/shown/é/{NAME}"):
        assert get(app, other)[0] == 403


@pytest.mark.parametrize("address", ["0.0.0.0", "::", "0:0::0"])
def test_an_address_that_nobody_can_be_called_by_is_refused(address: str):
    with pytest.raises(WrongUse, match="ssh -L"):
        check_address(address)


@pytest.mark.parametrize("address", ["127.0.0.1", "192.168.1.5", "robot.local", "::1"])
def test_others_may_be_served_on(address: str):
    check_address(address)


def test_an_address_of_another_machine_cannot_be_served_on():
    with pytest.raises(WrongUse, match=r"1\.2\.3\.4 port 0 cannot be served on"), bound("1.2.3.4", 0):
        pass
