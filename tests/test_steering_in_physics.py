"""A person steers a robot in full physics: it goes as it is told, and not into what stands there."""

import math

import numpy as np
import pytest
import shapely

from gaitwright.errors import WrongUse
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.locomotion import Brain
from gaitwright.missions import Programme, Steering, Stop, Velocity
from gaitwright.model.camera import Camera
from gaitwright.numerics.geometry import heading, rotation
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.plant.seeing import SeeingPlant
from gaitwright.session import Session, record
from gaitwright.signals import Mission
from oracles import robot_called

GO2 = robot_called("go2")
FLAT = load_scene("flat")
WALL = Scene("wall", Flat(), (Box(1.6, 0.0, 0.0, 0.4, 3.0, 0.6),), (-3.0, -4.0, 5.0, 4.0))


def session(scene: Scene, mission: Mission, sees: bool = False, seconds: float = 30.0) -> Session:
    camera = Camera.for_robot(GO2) if sees else None
    plant = MujocoPlant(GO2, scene)
    whole = SeeingPlant(plant, camera, scene) if camera else plant
    return Session(Brain.of(GO2, scene, camera=camera), whole, mission, seconds, 1)


def stepped(run: Session, seconds: float) -> np.ndarray:
    """Place and yaw at every tick of a time."""
    laps = [run.step() for _ in range(round(seconds / run.plant.dt))]
    return np.array(
        [(*lap.sensed.position_w[:2], heading(rotation(lap.sensed.orientation_wb))) for lap in laps]
    )


# --- live -------------------------------------------------------------------------------------------
def test_it_goes_as_a_person_steers_and_at_once() -> None:
    run = session(FLAT, Mission(()))
    stepped(run, 0.5)
    for velocity, skill in (
        ((0.4, 0.0, 0.0), "trot"),
        ((0.2, 0.0, 0.5), "walk"),
        ((-0.2, 0.0, 0.0), "walk-backward"),
        ((0.0, 0.12, 0.0), "walk-sideways"),
        ((0.0, 0.0, -0.8), "turn-in-place"),
    ):
        run.steer(*velocity)
        lap = run.step()
        assert lap.call.skill == skill and (*lap.call.velocity, lap.call.turn) == velocity
        stepped(run, 1.0)
        way = stepped(run, 2.0)
        dx, dy = way[-1, :2] - way[0, :2]
        yaw = float(np.unwrap(way[:, 2])[[0, -1]].mean())
        c, s = math.cos(yaw), math.sin(yaw)
        moved = np.array([c * dx + s * dy, c * dy - s * dx, np.unwrap(way[:, 2])[-1] - way[0, 2]]) / 2.0
        assert moved == pytest.approx(velocity, abs=0.08), skill
    run.steer(0.0)
    still = stepped(run, 1.5)
    assert not run.is_over and np.ptp(still[-100:, :2], axis=0).max() < 0.01


def test_steering_is_no_end_and_a_mission_afterwards_is_its_own_again() -> None:
    run = session(FLAT, Mission(((3.0, 0.0),)))
    stepped(run, 1.0)
    run.steer(0.0, 0.1)
    stepped(run, 2.0)
    assert run.mind.route.path == () and not run.is_over
    x, y = run.measured.position_w[:2]
    run.give(Mission(((float(x) + 0.6, float(y)),)))
    assert record(run).arrived


def test_before_a_wall_it_stands_says_why_and_may_be_steered_away() -> None:
    for sees in (False, True):
        run = session(WALL, Mission(()), sees)
        run.steer(0.4)
        way = stepped(run, 6.0)
        assert run.mind.route.pause is not None and run.mind.route.pause.startswith("something stands ahead")
        assert not run.is_over, "a person is there"
        nose = way[-1, 0] + GO2.trunk[0, 0] + GO2.trunk[1, 0]
        assert 1.4 - 0.35 < nose < 1.4 - 0.01
        run.steer(-0.2)
        back = stepped(run, 2.0)
        assert run.mind.route.pause is None and back[-1, 0] < way[-1, 0] - 0.2


@pytest.mark.parametrize("velocity", [(9.0, 0.0, 0.0), (0.0, math.nan, 0.0), (0.0, 0.0, 50.0)])
def test_what_is_beyond_it_is_refused_and_changes_nothing(velocity: tuple[float, ...]) -> None:
    run = session(FLAT, Mission(()))
    run.steer(0.2)
    before = run.mind
    with pytest.raises(WrongUse):
        run.steer(*velocity)
    assert run.mind is before


# --- written beforehand -----------------------------------------------------------------------------
def test_a_script_that_leads_into_a_wall_ends_before_it() -> None:
    script = Steering((0.0,), (Velocity(0.4),), ends=20.0)
    recording = record(session(WALL, Mission((), guidance=script)))
    assert recording.stopped_because.startswith("stopped: something stands ahead: there is room for")
    assert not recording.fell and not recording.done
    assert recording["position_w"][-1, 0] < 1.4 - GO2.trunk[1, 0]


def test_the_same_script_is_the_same_walk_to_the_bit() -> None:
    script = Steering(
        (0.0, 1.0, 2.0), (Velocity(0.4), Velocity(0.0, 0.1), Velocity(-0.2, 0.0, 0.3)), ends=3.0
    )
    one, two = (record(session(FLAT, Mission((), guidance=script), seconds=3.0)) for _ in range(2))
    assert one["q"].tobytes() == two["q"].tobytes() and one.done
    assert one.stopped_because == "the 3 s asked for are over"


def test_a_programme_is_walked_as_it_is_written() -> None:
    stops = (Stop(1.5, 0.0), Stop(1.5, 1.0, wait=1.5), Stop(0.0, 1.0))
    recording = record(session(FLAT, Mission((), guidance=Programme(stops)), seconds=60.0))
    assert recording.arrived, recording.stopped_because
    line = shapely.LineString(recording["position_w"][:, :2])
    for stop in stops:
        assert line.distance(shapely.Point(stop.x, stop.y)) < 0.1
    near = np.hypot(*(recording["position_w"][:, :2] - (1.5, 1.0)).T) < 0.1
    slow = np.hypot(*recording["velocity_w"][:, :2].T) < 0.05
    assert (near & slow).sum() * recording.dt > 1.0, "it stood where it is to wait"
    straight = shapely.LineString([(0.0, 0.0), *((stop.x, stop.y) for stop in stops)])
    assert max(straight.distance(shapely.Point(place)) for place in recording["position_w"][::50, :2]) < 0.2


def test_what_is_moved_into_a_programme_stops_it() -> None:
    aside = Box(2.0, 2.5, 0.0, 0.4, 0.8, 0.5)
    scene = Scene("yard", Flat(), (aside,), (-3.0, -4.0, 6.0, 4.0))
    for sees in (False, True):
        run = session(scene, Mission((), guidance=Programme((Stop(4.0, 0.0),))), sees)
        stepped(run, 1.0)
        moved = Scene("yard", Flat(), (Box(2.0, 0.0, 0.0, 0.4, 0.8, 0.5),), scene.bounds)
        run.rearrange(moved)
        recording = record(run)
        told = "something stands in the way to (4, 0)" if sees else "straight from here to (4, 0)"
        assert told in recording.stopped_because
        assert recording["position_w"][-1, 0] < 1.8 - GO2.trunk[1, 0]
