"""The page in a real browser: what a person does there, and what the robot then does."""

import io
import math
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import numpy as np
import pytest
from page_fixtures import Line, Studio, begun, close
from PIL import Image

pytestmark = pytest.mark.xdist_group("studio")


@pytest.fixture(scope="module")
def opened(studio: Studio, browser: Any) -> Iterator[tuple[Any, list[str]]]:
    """The page, open, and what went wrong in it."""
    errors: list[str] = []
    page = browser.new_page(viewport={"width": 1000, "height": 700})
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(studio.address)
    page.get_by_test_id("skill-rules").wait_for()
    yield page, errors
    page.close()


@pytest.fixture
def watch(studio: Studio) -> Iterator[Line]:
    """One who sees what the server says, after it was told to begin anew."""
    watch = begun(studio, "flat")
    yield watch
    close(watch.socket)


@pytest.fixture
def page(opened: tuple[Any, list[str]], watch: Line) -> Iterator[Any]:
    """The page, whose person drives."""
    page, errors = opened
    page.get_by_test_id("take").click()
    page.get_by_test_id("release").wait_for()
    yield page
    assert not errors


def pixels(page: Any) -> np.ndarray:
    """What the views show."""
    picture = page.get_by_test_id("canvas").screenshot()
    return np.asarray(Image.open(io.BytesIO(picture)).convert("RGB"), dtype=float)


def open_panel(page: Any, name: str) -> None:
    page.get_by_test_id(f"tab-{name}").click()
    page.get_by_test_id(f"panel-{name}").wait_for()


def test_the_robot_is_drawn_and_moves(page: Any, watch: Line):
    page.wait_for_function("document.querySelector('[data-testid=time]').textContent.match(/[1-9]/)")
    before = pixels(page)
    assert len(np.unique(before.reshape(-1, 3), axis=0)) > 500, "more than a plain background"
    page.get_by_test_id("skill-pronk").click()
    watch.status(lambda said: said["skill"] == "pronk")
    page.wait_for_timeout(700)
    assert np.abs(pixels(page) - before).mean() > 0.5


def test_a_click_on_the_ground_sends_it_there(page: Any, watch: Line):
    box = page.get_by_test_id("canvas").bounding_box()
    for _ in range(10):  # until the ground is drawn there is nothing to click on
        page.mouse.click(box["x"] + 0.3 * box["width"], box["y"] + 0.32 * box["height"])
        with suppress(AssertionError):
            watch.status(lambda said: said["goal"], 2.0)
            break
    said = watch.last["status"]
    assert said["route"] and 0.5 < math.dist((0.0, 0.0), said["goal"]) < 100.0
    assert watch.status(lambda said: said["skill"] != "stand")["controller"] == "numerical"


def test_held_keys_drive_and_who_lets_go_stops(page: Any, watch: Line):
    page.mouse.move(500.0, 300.0)
    page.keyboard.down("w")
    assert watch.status(lambda said: said["velocity"][0] > 0.1)["because"] == "as a person steers"
    page.keyboard.up("w")
    watch.status(lambda said: said["skill"] == "stand", 3.0)


def test_time_stands_and_goes_on_step_by_step(page: Any, watch: Line):
    page.get_by_test_id("pause").click()
    before = watch.status(lambda said: said["paused"])["time"]
    page.get_by_test_id("step-25").click()
    assert watch.status(lambda said: said["time"] > before)["time"] == pytest.approx(before + 0.05, abs=1e-6)
    page.get_by_test_id("resume").click()
    watch.status(lambda said: not said["paused"] and said["time"] > before + 0.1)


def test_a_second_page_watches_and_takes_over(page: Any, watch: Line, studio: Studio, browser: Any):
    second = browser.new_page(viewport={"width": 800, "height": 600})
    second.goto(studio.address)
    second.get_by_test_id("take").click()
    page.get_by_test_id("take").wait_for()
    second.get_by_test_id("skill-trot").click()
    watch.status(lambda said: said["skill"] == "trot")
    second.close()


def test_a_recording_is_made_and_scrubbed(page: Any, watch: Line, studio: Studio, browser: Any):
    open_panel(page, "drive")
    page.get_by_test_id("skill-walk").click()
    page.get_by_test_id("record").click()
    watch.status(lambda said: said["recording"])
    page.wait_for_timeout(1500)
    page.get_by_test_id("record").click()
    kept = watch.until(lambda said: said["say"] == "recordings")["names"]
    made = next(one["name"] for one in kept if one["name"].endswith("npz"))
    html = studio.folder / made.replace(".npz", ".html")
    for _ in range(100):
        if html.is_file():
            break
        page.wait_for_timeout(100)
    replay = browser.new_page(viewport={"width": 1000, "height": 700})
    errors: list[str] = []
    replay.on("pageerror", lambda error: errors.append(str(error)))
    replay.goto(html.as_uri())
    track = replay.get_by_test_id("track")
    track.wait_for()
    box = track.bounding_box()
    replay.mouse.click(box["x"] + 0.75 * box["width"], box["y"] + 0.5 * box["height"])
    told = replay.get_by_test_id("time").text_content()
    shown, whole = (float(part.strip(" s")) for part in told.split("/"))
    assert 0.6 * whole < shown < 0.9 * whole and whole > 1.0
    assert not errors
    replay.close()
