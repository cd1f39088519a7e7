"""The page's panels as a person meets them in a browser; what came of it is asked of the server."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from page_fixtures import Line, Studio

pytestmark = pytest.mark.xdist_group("studio")
WAIT = 30_000
"""[ms]"""
STEPS = 4


@pytest.fixture
def page(studio: Studio, plain_browser: Any, line: Line) -> Iterator[Any]:
    """The page, in the hands of who drives; `line` watches."""
    context = plain_browser.new_context(viewport={"width": 1024, "height": 700})
    page = context.new_page()
    page.set_default_timeout(WAIT)
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(studio.address)
    at(page, "take").click()
    at(page, "release").wait_for()
    yield page
    context.close()
    assert not errors, errors


def at(page: Any, name: str) -> Any:
    """An element by its name for tests."""
    return page.locator(f'[data-testid="{name}"]')


def drag(page: Any, name: str, right: float, down: float) -> None:
    """Takes hold of an element and moves it by so many pixels."""
    box = at(page, name).bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + right, y + down, steps=STEPS)
    page.mouse.up()


@contextmanager
def still(page: Any) -> Iterator[None]:
    """Time stands meanwhile, so that what is measured does not change the picture under the pointer."""
    at(page, "pause").click()
    at(page, "resume").wait_for()
    yield
    at(page, "resume").click()


def rules(line: Line, fits: Any) -> dict[str, Any]:
    """The rules, as soon as they are so."""
    return line.until(lambda said: said["say"] == "rules" and fits(said))


def go_trotting(page: Any, line: Line) -> None:
    at(page, "tab-drive").click()
    at(page, "skill-trot").click()
    line.status(lambda said: said["skill"] == "trot")


# --- teaching and rules -----------------------------------------------------------------------------
def test_a_rule_is_taught_seen_and_taken_back(page: Any, line: Line):
    at(page, "tab-teach").click()
    at(page, "tab-rules").click()
    at(page, "right-skill").select_option("pace")
    at(page, "right-speed").fill("9")
    at(page, "right").click()
    assert "m/s" in at(page, "refusal-speed").inner_text()
    at(page, "right-speed").fill("0.3")
    at(page, "right").click()
    at(page, "tried").wait_for()
    assert at(page, "tried").get_attribute("data-followed") == "true"
    assert not line.last["rules"]["rules"], "nothing is learned before it is kept"
    at(page, "keep").click()
    assert [rule["skill"] for rule in rules(line, lambda said: said["rules"])["rules"]] == ["pace"]

    at(page, "rule-pace").click()
    assert at(page, "rule-detail").locator('[data-testid="forest"] [data-testid^="tree-"]').count() > 10
    at(page, "rule-detail").locator('[data-testid="ask-different"]').click()
    assert at(page, "why-answer").inner_text()

    at(page, "take-back").click()
    assert rules(line, lambda said: not said["rules"])["lessons"] == []
    at(page, "no-rules").wait_for()


def test_what_was_not_kept_is_not_learned(page: Any, line: Line):
    at(page, "tab-teach").click()
    at(page, "right-skill").select_option("pronk")
    at(page, "right").click()
    at(page, "drop").click()
    at(page, "tried").wait_for(state="detached")
    at(page, "ok").click()
    learned = rules(line, lambda said: said["lessons"])
    assert len(learned["lessons"]) == 1 and all(rule["skill"] != "pronk" for rule in learned["rules"])
    at(page, "take-back").click()
    rules(line, lambda said: not said["lessons"])


def test_an_apprentice_asks_whether_what_it_is_shown_is_right(page: Any, line: Line):
    at(page, "mode-apprentice").click()
    go_trotting(page, line)
    at(page, "proposed").wait_for()
    at(page, "proposed-keep").click()
    learned = rules(line, lambda said: said["rules"])
    assert [rule["skill"] for rule in learned["rules"]] == ["trot"]
    at(page, "tab-rules").click()
    at(page, "lesson").locator('[data-testid="forget"]').click()
    rules(line, lambda said: not said["rules"])


def test_a_motion_is_composed_and_played_back(page: Any, line: Line):
    at(page, "mode-guide").click()
    at(page, "tab-drive").click()
    at(page, "compose").click()
    line.status(lambda said: said["composing"])
    at(page, "composing").wait_for()
    at(page, "skill-pace").click()
    begun = line.status(lambda said: said["skill"] == "pace")["time"]
    line.status(lambda said: said["time"] > begun + 0.8)
    at(page, "stand").click()
    at(page, "compose").click()
    assert line.status(lambda said: not said["composing"])["composed"] == 2
    at(page, "play").click()
    line.status(lambda said: said["playing"] and said["skill"] == "pace")
    line.status(lambda said: not said["playing"])


# --- curves -----------------------------------------------------------------------------------------
def path_of(line: Line) -> dict[str, Any]:
    return line.done(do="curve", kind="cycle", skill="trot", leg=0)["curve"]


def test_a_point_is_dragged_undone_and_done_again(page: Any, line: Line):
    go_trotting(page, line)
    at(page, "tab-curves").click()
    at(page, "point-path-4").wait_for()
    before = path_of(line)
    with still(page):
        drag(page, "point-path-4", 0, -10)
        at(page, "curve-preview").wait_for()
    assert at(page, "curve-preview").get_attribute("data-fell") == "false"
    now = path_of(line)
    assert now["points"][3][2] > before["points"][3][2] + 0.01
    assert [p for k, p in enumerate(now["points"]) if k != 3] == [
        p for k, p in enumerate(before["points"]) if k != 3
    ]
    line.until(lambda said: not line.last["curve"]["pending"])  # a new cycle has begun since
    page.keyboard.press("Control+z")
    at(page, "curve-redo").and_(page.locator(":enabled")).wait_for()
    assert path_of(line)["points"] == before["points"]
    page.keyboard.press("Control+y")
    at(page, "curve-redo").and_(page.locator(":disabled")).wait_for()
    assert path_of(line)["points"] == now["points"]


def test_a_refused_edit_snaps_back_and_says_why_beside_the_point(page: Any, line: Line):
    go_trotting(page, line)
    at(page, "tab-curves").click()
    at(page, "point-path-4").wait_for()
    before = path_of(line)
    with still(page):
        place = at(page, "point-path-4").bounding_box()
        drag(page, "point-path-4", -30, -400)
        at(page, "refused-point").wait_for()
        assert at(page, "point-path-4").bounding_box() == pytest.approx(place, abs=1.0)
    assert "point 4" in at(page, "refused-reason").inner_text()
    assert path_of(line)["points"] == before["points"]


def test_a_point_is_put_on_the_line_moved_and_taken_out(page: Any, line: Line):
    go_trotting(page, line)
    at(page, "tab-curves").click()
    at(page, "point-height-4").wait_for()
    many = len(path_of(line)["points"])
    with still(page):
        one, other = (at(page, f"point-height-{k}").bounding_box() for k in (3, 4))
        x, y = ((one[side] + other[side]) / 2 + 9 for side in ("x", "y"))
        page.mouse.dblclick(x, y)
        at(page, f"point-height-{many + 1}").wait_for()
        assert len(path_of(line)["points"]) == many, "it counts once it is moved"
        drag(page, "point-height-4", 0, -4)
        at(page, "curve-preview").wait_for()
        assert len(path_of(line)["points"]) == many + 1
        at(page, "point-height-4").click(button="right")
        at(page, f"point-height-{many + 1}").wait_for(state="detached")
    at(page, "curve-state").filter(has_text="seen in physics").wait_for(state="detached")
    assert len(path_of(line)["points"]) == many


def test_fixed_points_stay_and_angles_are_shown_for_each_joint(page: Any, line: Line):
    go_trotting(page, line)
    at(page, "tab-curves").click()
    at(page, "curve-kind-angle").click()
    for joint in ("hip-1", "hip-2", "knee"):
        at(page, f"curve-{joint}").wait_for()
    before = path_of(line)
    with still(page):
        drag(page, "point-knee-1", 0, 20)
    assert at(page, "curve-state").get_attribute("data-edited") == f"{before['edited']}".lower()
    assert path_of(line)["points"] == before["points"]
    at(page, "curve-kind-torque").click()
    assert "no torque profile of trot" in at(page, "curve-missing").inner_text()
    at(page, "curve-kind-cycle").click()


def test_a_step_corrected_at_a_block_is_a_rule_that_says_why(page: Any, line: Line):
    """What the studio is for: to a place that it does not know, over a block, one step corrected."""
    at(page, "release").click()
    line.done(do="take")
    line.done(do="reset", scene="flat", sight="camera")
    line.done(do="place", x=1.3, y=0.0, lx=0.3, ly=2.0, height=0.06)
    line.done(do="go", x=4.0, y=0.0)
    ahead: dict[str, Any] = {"kind": "", "size": 0.0}
    while ahead["kind"] not in ("block", "step up") or ahead["size"] < 0.05:  # until it sees all of it
        line.done(do="resume")
        line.status()
        line.done(do="pause")
        shown = line.done(do="curve", kind="cycle")["curve"]
        ahead = shown["ahead"] or ahead
        assert line.last["status"]["time"] < 30.0, "it comes to the block"
    assert ahead["size"] < 0.08
    at(page, "take").click()
    at(page, "tab-curves").click()
    at(page, "curve-ahead").locator("input").check()
    drag(page, "point-path-4", 0, -25)
    at(page, "curve-learn").click()
    at(page, "curve-learned").wait_for()
    told = line.until(lambda said: said["say"] == "curve" and said["operators"])["operators"]
    assert told[0]["kinds"] == [ahead["kind"]] and told[0]["taught"].startswith("on FL")
    before = line.status()["time"]
    at(page, "resume").click()
    after = line.status(lambda said: said["time"] > before + 6.0, 90.0)
    assert not after["fell"]
    at(page, "curve-save").click()
    assert "over a" in at(page, "curve-said").inner_text()
    at(page, "curve-undo").click()


# --- the map ----------------------------------------------------------------------------------------
def test_the_map_grows_as_the_robot_walks(page: Any, line: Line, studio: Studio):
    at(page, "release").click()
    line.done(do="take")
    line.done(do="reset", scene="blocks", sight="camera")
    at(page, "take").click()
    at(page, "tab-map").click()
    known = at(page, "map-learned")
    known.and_(page.locator(':not([data-known="0"])')).wait_for()
    before = int(known.get_attribute("data-known"))
    go_trotting(page, line)
    line.status(lambda said: said["time"] > 6.0)
    page.wait_for_timeout(1000)
    assert int(known.get_attribute("data-known")) > 1.1 * before
    at(page, "map-fit").click()
    assert at(page, "map-follow").get_attribute("aria-pressed") == "false"
    at(page, "map-layout-over").click()
    at(page, "map-true").wait_for(state="detached")


# --- recordings -------------------------------------------------------------------------------------
def test_a_recording_is_made_listed_taken_home_and_played(page: Any, line: Line, studio: Studio):
    at(page, "tab-recordings").click()
    at(page, "record-turn").click()
    assert line.status(lambda said: said["recorded"] > 0.5)["recording"]
    at(page, "record-turn").click()
    row = at(page, "recording").first
    row.wait_for()
    name = str(row.get_attribute("data-name"))
    with page.expect_download() as begun:
        row.locator('[data-testid="download-npz"]').click()
    assert Path(begun.value.path()).read_bytes() == (studio.folder / name).read_bytes()
    with page.context.expect_page() as opened:
        row.locator('[data-testid="play"]').click()
    replay = opened.value
    replay.set_default_timeout(WAIT)
    at(replay, "controller").wait_for()
    assert Path(name).stem in replay.url


# --- who watches ------------------------------------------------------------------------------------
def test_who_only_watches_changes_nothing(page: Any, line: Line):
    at(page, "release").click()
    at(page, "take").wait_for()
    at(page, "tab-teach").click()
    at(page, "tab-curves").click()
    at(page, "curve-skill").select_option("trot")
    at(page, "point-path-4").wait_for()
    for name in ("ok", "right", "right-skill", "curve-undo", "curve-redo", "curve-save"):
        assert at(page, name).is_disabled(), name
    before = path_of(line)
    drag(page, "point-path-4", 0, -10)
    assert path_of(line)["points"] == before["points"]
    at(page, "tab-rules").click()
    at(page, "ask-why").click()
    assert at(page, "why-answer").inner_text(), "to ask is free"
