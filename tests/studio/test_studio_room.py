"""A room without a page: what is asked is done, and what cannot be is refused and changes nothing."""

import json
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from rooms import kept, laps, opened, settle

from gaitwright.errors import GaitwrightError, NoRoom, WrongUse
from gaitwright.record.metrics import digest
from gaitwright.record.recording import load
from gaitwright.record.rows import Writer
from gaitwright.skills.giving_way import GivesWay
from gaitwright.skills.library import speed_scale
from gaitwright.studio import messages as m
from gaitwright.studio.frames import LAYOUT, columns_of, row_of
from gaitwright.studio.live_run import LiveRun
from gaitwright.studio.room import Room
from gaitwright.studio.setup import DRIVERS, Setup


@pytest.fixture
def room(tmp_path: Path, said: list[dict]) -> Iterator[Room]:
    with opened(tmp_path, said) as room:
        yield room


def place(room: Room) -> np.ndarray:
    return room.run.sensed.position_w.copy()


# --- where to go ------------------------------------------------------------------------------------
def test_it_stands_and_waits_until_somebody_says_more(room: Room):
    laps(room, 1.0)
    assert room.status()["skill"] == "stand" and room.status()["over"] is None
    assert np.linalg.norm(place(room)[:2]) < 0.2


def test_it_goes_to_a_place_and_waits_there_for_another(room: Room):
    room.hears(m.Go(x=0.8, y=0.0))
    laps(room, 8.0)
    status = room.status()
    assert status["arrived"] and status["over"] is None and status["skill"] == "stand"
    assert math.dist(place(room)[:2], (0.8, 0.0)) < 0.4
    room.hears(m.Go(x=0.0, y=0.0))
    assert room.status()["goal"] == [0.0, 0.0] and not room.status()["arrived"]


def test_places_are_gone_to_one_after_the_other(room: Room):
    room.hears(m.Go(x=1.0, y=0.0))
    room.hears(m.Go(x=1.0, y=1.0, then=True))
    assert room.run.session.mind.mission.waypoints == ((1.0, 0.0), (1.0, 1.0))


def test_it_goes_as_a_person_steers_and_stands_when_she_is_not_heard(room: Room, monkeypatch):
    now = [100.0]
    monkeypatch.setattr("gaitwright.studio.driving_desk.monotonic", lambda: now[0])
    room.hears(m.Steer(forward=0.3))
    laps(room, 1.5)
    assert place(room)[0] > 0.1
    now[0] += 0.2
    room.driving.watch_over()
    assert room.status()["skill"] != "stand"
    now[0] += 0.2
    room.driving.watch_over()
    laps(room, 0.1)
    assert room.status()["skill"] == "stand"


def test_a_skill_is_held_until_rules_choose_again(room: Room):
    room.hears(m.Skill(name="pace", speed=0.4))
    laps(room, 1.0)
    assert room.status()["skill"] == room.status()["held"] == "pace"
    room.hears(m.Skill(name=""))
    laps(room, 1.0)
    assert not room.status()["held"] and room.status()["skill"] != "pace"


@pytest.mark.parametrize("driver", ["programmed", "kinematic", "numerical", "hybrid"])
def test_every_driver_takes_over_while_it_walks(room: Room, driver: str):
    room.hears(m.Skill(name="walk"))
    laps(room, 0.5)
    room.hears(m.Drive(driver=driver))
    laps(room, 0.1)
    has_joints = "numerical" if driver == "hybrid" else driver
    assert room.status()["driver"] == driver and room.status()["controller"] == has_joints
    assert room.ticks[has_joints] > 0


@pytest.mark.parametrize(
    ("message", "sentence"),
    [
        (m.Go(x=99.0, y=0.0), "outside the field"),
        (m.Steer(forward=9.0), "m/s"),
        (m.Skill(name="fly"), "no skill 'fly'"),
        (m.Skill(name="walk", speed=5.0), "walk"),
        (m.Drive(driver="learned"), "there is no driver learned here"),
        (m.Drive(driver="nobody"), "no driver 'nobody'"),
        (m.Reset(scene="nowhere"), "no scene 'nowhere'"),
        (m.Reset(robot="/etc/passwd"), "no robot '/etc/passwd'"),
        (m.Reset(scene="/etc/passwd.json"), "no scene '/etc/passwd.json'"),
        (m.PlaceBox(x=0.0, y=0.1, lx=0.3, ly=0.3, height=0.2), "the robot is there"),
        (m.Move(thing=999, x=0.0, y=0.0), "no box 999"),
        (m.Step(ticks=5), "pause first"),
        (m.Record(on=False), "nothing is recorded"),
        (m.Keep(), "nothing to keep"),
        (m.Forget(), "nothing was taught"),
        (m.Right(skill="walk", about="nonsense"), "no number 'nonsense'"),
    ],
)
def test_what_cannot_be_done_changes_nothing(room: Room, message: m.Message, sentence: str):
    laps(room, 0.1)
    before, mission = room.status(), room.run.session.mind.mission
    with pytest.raises(GaitwrightError, match=sentence):
        room.hears(message)
    assert room.status() == before and room.run.session.mind.mission == mission


# --- time -------------------------------------------------------------------------------------------
def test_time_goes_on_step_by_step_where_it_stands(room: Room):
    laps(room, 0.1)
    room.hears(m.Pause())
    before = room.run.time
    room.hears(m.Step(ticks=5))
    assert room.run.time == pytest.approx(before + 0.01)


def test_an_aborted_robot_comes_down_and_its_motors_go_off(room: Room):
    room.hears(m.Skill(name="walk"))
    laps(room, 1.0)
    high = place(room)[2]
    room.hears(m.Abort())
    laps(room, 8.0)
    assert "aborted" in room.status()["over"] and not room.status()["fell"]
    for message in (m.Go(x=1.0, y=0.0), m.Steer(forward=0.2), m.Skill(name="walk"), m.Stand()):
        with pytest.raises(WrongUse, match="a reset begins another"):
            room.hears(message)
    room.driving.watch_over()
    assert place(room)[2] < 0.6 * high
    assert room.run.session.closed


def test_the_same_words_make_the_same_run(room: Room):
    def run() -> str:
        room.hears(m.Reset(seed=4, driver="numerical"))
        room.hears(m.Go(x=1.0, y=0.0))
        rows = []
        for _ in range(300):
            room.lap()
            assert room.run.lap is not None
            rows.append(row_of(room.run.lap, room.run.session.mind.memories, DRIVERS))
        return digest([np.array(rows)])

    assert run() == run()


# --- the world --------------------------------------------------------------------------------------
def test_a_box_is_placed_moved_and_taken_away_while_it_walks(room: Room, said: list[dict]):
    room.hears(m.Go(x=4.0, y=0.0))
    laps(room, 0.5)
    number = room.hears(m.PlaceBox(x=2.0, y=0.0, lx=0.4, ly=1.0, height=0.6))["thing"]
    shown = {box["id"]: box for box in said[-1]["boxes"]}
    assert shown[number]["z"] == pytest.approx(0.3)
    laps(room, 0.2)
    assert any(abs(y) > 0.4 for _, y in room.status()["route"]), "it goes round the box"
    room.hears(m.Move(thing=number, x=2.0, y=3.0))
    laps(room, 0.2)
    assert room.run.boxes[number].y == 3.0
    room.hears(m.Remove(thing=number))
    assert number not in {box["id"] for box in said[-1]["boxes"]}


def test_a_push_is_felt(room: Room):
    laps(room, 0.2)
    room.hears(m.Push(impulse=0.4, direction=math.pi / 2))
    laps(room, 0.1)
    assert room.run.sensed.velocity_w[1] > 0.1


@pytest.mark.parametrize(
    ("setup", "sentence"),
    [
        (Setup(robot="none.xml"), "none.xml"),
        (Setup(driver="learned"), "no driver learned here"),
        (Setup(driver="nobody"), "no driver 'nobody'"),
        (Setup(scene="nowhere"), "no scene 'nowhere'"),
    ],
)
def test_what_there_is_not_cannot_be_begun(room: Room, setup: Setup, sentence: str):
    with pytest.raises(GaitwrightError, match=sentence):
        LiveRun(setup, room.ledger)


# --- what is kept -----------------------------------------------------------------------------------
def test_a_recording_holds_what_happened_between_on_and_off(room: Room):
    room.hears(m.Record(on=True))
    laps(room, 0.4)
    path = kept(room)
    assert len(load(path)) == 200
    assert path.name in [one["name"] for one in room.hears(m.Recordings())["recordings"]]


def test_a_recording_that_cannot_be_written_is_not_lost(room: Room, said: list[dict], tmp_path: Path):
    folder, good = tmp_path / "no-folder", room.recording.shelf.folder
    folder.write_text("in the way")
    room.recording.shelf.folder = folder
    room.hears(m.Record(on=True))
    laps(room, 0.2)
    room.hears(m.Record(on=False))
    settle(room)
    room.status()
    assert any("could not be written" in str(one.get("sentence")) for one in said)
    room.recording.shelf.folder = good
    room.hears(m.Record(on=True))
    laps(room, 0.1)
    kept(room)
    lengths = sorted(len(load(path)) for path in good.glob("*.npz"))
    assert lengths == [50, 100], "the next one takes the other along"


def test_a_disk_that_is_full_ends_the_recording_and_not_the_run(
    room: Room, said: list[dict], monkeypatch: pytest.MonkeyPatch
):
    room.hears(m.Record(on=True))
    laps(room, 0.1)

    def full(*_: object) -> None:
        raise NoRoom("no space left")

    monkeypatch.setattr(Writer, "add", full)
    laps(room, 0.1)
    assert room.status()["recording"] is False and room.status()["over"] is None
    assert any("no space left" in str(one.get("sentence")) for one in said)


def test_a_reset_that_cannot_be_had_changes_nothing(room: Room):
    room.hears(m.Record(on=True))
    laps(room, 0.1)
    before = room.run
    with pytest.raises(WrongUse, match="no driver learned"):
        room.hears(m.Reset(driver="learned"))
    assert room.run is before and room.status()["recording"] and room.lap()


def test_a_reset_shows_the_robot_also_while_time_stands(room: Room):
    laps(room, 0.2)
    room.hears(m.Pause())
    room.hears(m.Reset(scene="flat"))
    assert room.frame(0) is not None and room.run.time < 0.01 and room.paused


def test_a_goal_after_others_comes_after_those_that_are_left(room: Room):
    room.hears(m.Reset(scene="flat"))
    room.hears(m.Go(x=0.4, y=0.0))
    room.hears(m.Go(x=1.2, y=0.0, then=True))
    while room.run.sensed.position_w[0] < 0.7:
        laps(room, 0.1)
    room.hears(m.Go(x=1.2, y=0.8, then=True))
    assert room.run.session.mind.mission.waypoints == ((1.2, 0.0), (1.2, 0.8))


def test_a_robot_gives_way_whoever_chose_its_skill(room: Room):
    room.hears(m.Skill(name="walk"))
    assert isinstance(room.run.session.brain.chooser, GivesWay)
    room.hears(m.Skill(name=""))
    assert isinstance(room.run.session.brain.chooser, GivesWay)


def test_a_run_that_ends_on_its_feet_is_let_down(room: Room):
    room.hears(m.Reset(scene="flat"))
    session = room.run.session
    session.termination.ends = room.run.time + 0.2
    laps(room, 10.0)
    assert "over" in room.status()["over"] and session.closed
    assert room.run.sensed.position_w[2] < 0.6 * room.run.robot.height


def test_what_is_kept_is_the_lesson_that_was_seen(room: Room):
    laps(room, 0.1)
    first = room.hears(m.Right(skill="pace"))["lesson"]
    laps(room, 0.1)
    second = room.hears(m.Right(skill="walk"))["lesson"]
    with pytest.raises(WrongUse, match="by now"):
        room.hears(m.Keep(lesson=first))
    assert room.hears(m.Keep(lesson=second))["lesson"] == second


def test_the_same_moment_of_another_run_is_another_lesson(room: Room):
    first = room.hears(m.Right(skill="pace"))["lesson"]
    room.hears(m.Keep())
    room.hears(m.Reset(seed=0))
    second = room.hears(m.Ok())["lesson"]
    assert first.startswith("blocks (seed 0) at 0.00") and second.startswith("blocks (seed 0), run 2 at 0.00")


def test_a_speed_that_is_shown_is_the_one_that_is_learned(room: Room):
    room.hears(m.Reset(robot="thesis", scene="flat"))
    scale = speed_scale(room.run.robot)
    assert abs(scale - 1.0) > 0.05
    sentence = room.hears(m.Right(skill="trot", speed=0.3 * scale))["sentence"]
    assert "0.3" in sentence


def test_a_lesson_is_tried_first_and_in_the_book_once_it_is_kept(room: Room, said: list[dict]):
    room.hears(m.Reset(scene="flat"))
    room.hears(m.Go(x=3.0, y=0.0))
    laps(room, 0.6)
    tried = room.hears(m.Right(skill="pace"))
    assert tried["followed"] and "pace" in tried["sentence"]
    assert not room.ledger.book.rulebook.rules, "nothing is learned yet"
    lesson = room.hears(m.Keep())["lesson"]
    assert [rule["skill"] for rule in said[-1]["rules"]] == ["pace"]
    laps(room, 1.0)
    status = room.status()
    assert status["skill"] == "pace" and status["rule"] == "pace"
    assert any("pace" in sentence for sentence in room.hears(m.Why())["sentences"])
    with pytest.raises(WrongUse, match="nothing to keep"):
        room.hears(m.Keep())
    assert room.hears(m.Forget(lesson=lesson))["lesson"] == lesson
    laps(room, 1.0)
    assert room.status()["skill"] != "pace"


# --- what is shown ----------------------------------------------------------------------------------
@pytest.mark.parametrize("sight", ["known", "camera"])
@pytest.mark.parametrize("scene", ["stairs", "holes", "crossing"])
def test_all_that_is_said_is_json_with_numbers(room: Room, said: list[dict], scene: str, sight: str):
    room.hears(m.Reset(scene=scene, sight=sight))
    laps(room, 0.3)
    for say in (room.say_scan, room.say_seen):
        say()
    said.append(room.status())
    for message in said:
        json.dumps(message, allow_nan=False)
    kinds = {message["say"] for message in said}
    assert kinds >= {"hello", "world", "rules", "scan", "seen", "status"}


def test_a_row_has_its_columns(room: Room):
    laps(room, 0.1)
    frame = room.frame(3)
    assert frame is not None and room.run.lap is not None
    assert sum(int(column["size"]) for column in columns_of(4)) == LAYOUT.size(4)
    row = np.frombuffer(frame[24:], "<f4")
    where = LAYOUT.slices(4)
    assert row[where["position_w"]] == pytest.approx(room.run.lap.sensed.position_w, abs=1e-6)
    assert row[where["q"]] == pytest.approx(room.run.lap.sensed.q.ravel(), abs=1e-6)
    assert np.isfinite(np.delete(row, where["footholds_w"])).all()
