"""Who watches and who drives, without a network: what is told to whom, in which order, and how much."""

import json
from typing import Any

import pytest

from gaitwright.errors import WrongUse
from gaitwright.studio import hub as hubs
from gaitwright.studio.hub import BURST, Hub
from gaitwright.studio.messages import Reset

STATUS = {"say": "status", "driver": "hybrid", "setup": {"robot": "go2", "scene": "flat", "seed": 3}}


class Host:
    """Notes what it is asked, and how often it is begun again."""

    def __init__(self) -> None:
        self.asked: list[bytes] = []
        self.begun: list[Reset] = []
        self.refuses = ""

    def ask(self, who: int, text: bytes) -> None:
        self.asked.append(text)

    def restart(self, said: Reset) -> None:
        if self.refuses:
            raise WrongUse(self.refuses)
        self.begun.append(said)


@pytest.fixture
def host() -> Host:
    return Host()


@pytest.fixture
def hub(host: Host) -> Hub:
    return Hub(host.ask, host.restart)


def tell(hub: Hub, **said: Any) -> None:
    hub.told(0, json.dumps(said).encode())


def heard(member: hubs.Member) -> list[dict[str, Any]]:
    """All that a page is told, turn by turn, until there is no more."""
    said: list[dict[str, Any]] = []
    while member.news.is_set():
        said += [json.loads(one) for one in member.take() if isinstance(one, str)]
    return said


def refusals(member: hubs.Member) -> list[str]:
    return [one["because"] for one in heard(member) if one["say"] == "refused"]


def test_who_comes_later_is_told_of_the_ground_that_was_seen_before(hub: Hub):
    def learned() -> list[float]:
        said = heard(hub.enter())
        kinds = [one["say"] for one in said]
        assert kinds.count("world") == 1 and kinds.index("world") < kinds.index("seen")
        return [one["x"] for one in said if one["say"] == "seen"]

    tell(hub, say="hello")
    tell(hub, say="world")
    for x in (0.0, 0.5, 4.5, 9.0, 0.7):
        tell(hub, say="seen", x=x, y=0.0)
    assert learned() == [4.5, 9.0, 0.7], "one for each place, and the last one last"
    tell(hub, say="hello")
    tell(hub, say="world")
    tell(hub, say="seen", x=1.0, y=1.0)
    assert learned() == [1.0], "another run has learned nothing yet"


def test_the_robot_is_shown_before_the_ground_of_long_ago(hub: Hub):
    tell(hub, say="hello")
    for x in range(0, 80, 5):
        tell(hub, say="seen", x=float(x), y=0.0)
    hub.told(0, b"\x01frame")
    member = hub.enter()
    first = member.take()
    assert b"\x01frame" in first and sum('"seen"' in one for one in first if isinstance(one, str)) == 1
    hub.told(0, b"\x01newer")
    assert b"\x01newer" in member.take(), "the next frame does not wait for all of it either"


def test_of_a_very_long_way_the_oldest_places_are_forgotten(hub: Hub):
    for x in range(0, 4000, 4):
        tell(hub, say="seen", x=float(x), y=0.0)
    assert len(hub.past) == hubs.MOST_PAST and (999, 0) in hub.past and (0, 0) not in hub.past


def test_a_page_that_asks_without_end_is_not_heard(hub: Hub, host: Host):
    member = hub.enter()
    for _ in range(int(BURST) + 50):
        hub.hears(member, '{"do": "why"}')
    assert len(host.asked) <= BURST + 5
    refused = refusals(member)
    assert len(refused) >= 45 and "things a second" in refused[0]


def test_an_ended_run_is_begun_again_once_and_as_it_was(hub: Hub, host: Host):
    member = hub.enter()
    hub.told(0, json.dumps(STATUS).encode())
    tell(hub, say="closed", because="it broke")
    hub.hears(member, '{"do": "stand", "id": 1}')
    assert "a reset begins another" in refusals(member)[0]
    host.refuses = "no robot 'x'"
    hub.hears(member, '{"do": "reset", "robot": "x", "id": 2}')
    assert hub.closed and "no robot" in refusals(member)[0]
    host.refuses = ""
    hub.hears(member, '{"do": "reset", "id": 3}')
    assert len(host.begun) == 1 and not hub.closed
    assert hub.setup == {"robot": "go2", "scene": "flat", "seed": 3, "driver": "hybrid"}


def test_one_that_hangs_may_be_given_up(hub: Hub, host: Host, monkeypatch: pytest.MonkeyPatch):
    member = hub.enter()
    hub.told(0, json.dumps(STATUS).encode())
    hub.hears(member, '{"do": "reset"}')
    assert not host.begun and len(host.asked) == 1, "who answers does it"
    later = hub.heard_at + hubs.HANGS + 1.0
    monkeypatch.setattr(hubs, "monotonic", lambda: later)
    hub.hears(member, '{"do": "reset"}')
    assert len(host.begun) == 1
