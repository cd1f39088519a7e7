"""In physics a robot that sees goes round pits, and says where a ditch leaves no way."""

import shapely

from gaitwright.ground.holes import Hole, dug
from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Flat
from gaitwright.locomotion import Brain
from gaitwright.model.camera import Camera
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.plant.seeing import SeeingPlant
from gaitwright.session import Session
from gaitwright.signals import Mission
from oracles import robot_called

GO2 = robot_called("go2")
CAMERA = Camera.for_robot(GO2)
BOUNDS = (-2.0, -3.0, 7.0, 3.0)


def trip(*outlines) -> tuple[str, float, list[shapely.Point]]:
    """How a mission to (5.5, 0) ends, its time [s] and where it led, over level ground with holes in it."""
    holes = [Hole(outline, 0.3) for outline in outlines]
    scene = Scene("pits", dug(Flat(), holes), holes=tuple(holes), bounds=BOUNDS)
    plant = SeeingPlant(MujocoPlant(GO2, scene), CAMERA, scene)
    session = Session(Brain.of(GO2, scene, camera=CAMERA), plant, Mission(((5.5, 0.0),)), 90.0, 1)
    places = [shapely.Point(lap.sensed.position_w[:2]) for lap in session]
    assert session.lap is not None
    return session.lap.stopped_because, session.lap.sensed.time, places


def rectangle(x0: float, y0: float, x1: float, y1: float) -> tuple[tuple[float, float], ...]:
    return (x0, y0), (x1, y0), (x1, y1), (x0, y1)


def test_a_pit_is_walked_around() -> None:
    pit = rectangle(2.0, -1.0, 3.2, 0.8)
    why, time, places = trip(pit)
    assert why == "arrived at the goal" and time < 40.0
    assert min(shapely.Polygon(pit).distance(place) for place in places[::20]) > 0.1


def test_over_a_ditch_leads_a_bridge() -> None:
    why, _, places = trip(rectangle(2.0, -3.0, 2.6, 0.6), rectangle(2.0, 1.8, 2.6, 3.0))
    assert why == "arrived at the goal"
    at_the_ditch = [place.y for place in places if 2.1 < place.x < 2.5]
    assert min(at_the_ditch) > 0.6 and max(at_the_ditch) < 1.8


def test_where_a_ditch_goes_right_across_it_says_that_there_is_no_way() -> None:
    why, time, places = trip(rectangle(2.0, -3.0, 2.6, 3.0))
    assert why == "there is no way to the goal: to (5.5, 0) leads no way" and time < 80.0
    assert max(place.x for place in places) < 1.95
