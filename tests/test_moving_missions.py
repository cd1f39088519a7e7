"""Robots among things that move give way in time, say so, go on and arrive, told of them or seeing them."""

import numpy as np
import pytest

from gaitwright.bench.claims.moving import without_way
from gaitwright.bench.evidence.touches import Touches
from gaitwright.ground.moving import Mover
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.solids import Cylinder
from gaitwright.ground.terrain import Box, Flat
from gaitwright.locomotion import LOOK_EVERY, Brain, Lap
from gaitwright.model.camera import Camera
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.plant.seeing import SeeingPlant
from gaitwright.session import Session
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill
from oracles import robot_called

GO2 = robot_called("go2")
CAMERA = Camera.for_robot(GO2)
BOUNDS = (-2.0, -4.0, 7.0, 4.0)
ACROSS = Mover(Box(2.2, 2.3, 0.4, 0.6, 0.5, 0.6), ((2.2, -3.0),), 0.5)
"""Comes from the left and would meet who goes along x at 0.4 m/s: it is in the middle at 4.6 s."""
HEAD_ON = Mover(Cylinder(5.0, 0.0, 0.25, 0.6), ((-1.0, 0.0),), 0.4)


def mission(
    *movers: Mover, camera: Camera | None = None, gives_way: bool = True, goal=(4.5, 0.0), seed: int = 1
) -> tuple[list[Lap], Touches]:
    """A whole trip, and what was touched in it."""
    scene = Scene("yard", Flat(), (), BOUNDS, movers=movers)
    brain = Brain.of(GO2, scene, camera=camera)
    touched = Touches(MujocoPlant(GO2, scene))
    plant = touched if camera is None else SeeingPlant(touched, camera, scene)
    brain = brain if gives_way else without_way(brain)
    return list(Session(brain, plant, Mission((goal,)), 60.0, seed)), touched


@pytest.mark.parametrize("camera", [None, CAMERA], ids=["told", "seen"])
@pytest.mark.parametrize(
    ("mover", "side"), [(ACROSS, "the left"), (HEAD_ON, "ahead")], ids=["across", "head-on"]
)
def test_it_gives_way_says_so_and_arrives_untouched(mover: Mover, side: str, camera: Camera | None) -> None:
    laps, touched = mission(mover, camera=camera)
    assert laps[-1].arrived, laps[-1].stopped_because
    assert touched.touches == []
    said = {lap.call.because.partition(":")[0] for lap in laps if lap.call.yields}
    assert f"gives way to what comes from {side}" in said
    first = next(k for k, lap in enumerate(laps) if lap.call.yields)
    assert not any(lap.call.yields for lap in laps[-500:]) and first < len(laps) - 1500, "it went on"


@pytest.mark.parametrize("camera", [None, CAMERA], ids=["told", "seen"])
def test_without_giving_way_it_is_met(camera: Camera | None) -> None:
    laps, touched = mission(ACROSS, camera=camera, gives_way=False)
    assert touched.touches or not laps[-1].arrived


@pytest.mark.parametrize("appears", [1.013, 1.57])
def test_it_acts_at_the_next_look_and_not_at_the_end_of_a_cycle(appears: float) -> None:
    """Something comes out of nowhere, near by and fast."""
    comes = Mover(
        Box(1.0, 1.0, 0.0, 0.5, 0.5, 0.5), ((1.0, 1.0 - 0.6 * appears), (1.0, -3.0)), 0.6, appears=appears
    )
    laps, _ = mission(comes)
    first = next(lap.sensed.time for lap in laps if lap.call.yields)
    assert appears <= first <= appears + 2.0 * LOOK_EVERY + 1e-6


def test_a_skill_that_is_held_gives_way_too() -> None:
    scene = Scene(
        "yard", Flat(), (), BOUNDS, movers=(Mover(Box(2.2, 2.4, 0.0, 0.5, 0.5, 0.6), ((2.2, -3.0),), 0.5),)
    )
    chooser = fixed_skill(GO2, "trot", 0.4, 0.0, 0.0, "numerical")
    session = Session(Brain.of(GO2, scene, chooser), MujocoPlant(GO2, scene), Mission(()), 9.0, 1)
    laps = list(session)
    assert any(lap.call.yields for lap in laps) and not laps[-1].call.yields
    assert laps[-1].stopped_because == "the 9 s asked for are over"


def test_who_gives_way_for_long_is_not_stuck() -> None:
    """A long thing creeps by, before which it has to wait for more than the time that counts as stuck."""
    train = Mover(Box(1.6, 2.0, 0.0, 0.4, 4.5, 0.6), ((1.6, -3.9),), 0.22)
    laps, touched = mission(train, goal=(3.5, 0.0))
    assert laps[-1].arrived and not touched.touches, laps[-1].stopped_because
    waits = [lap.sensed.time for lap in laps if lap.call.yields]
    assert waits[-1] - waits[0] > 15.0


@pytest.mark.parametrize("name", ["forest", "rooms"])
def test_where_nothing_moves_a_robot_that_sees_walks_as_if_nothing_could(name: str) -> None:
    ways = []
    for gives_way in (True, False):
        scene = load_scene(name, 2)
        brain = Brain.of(GO2, scene, camera=CAMERA)
        plant = SeeingPlant(MujocoPlant(GO2, scene), CAMERA, scene)
        session = Session(brain if gives_way else without_way(brain), plant, Mission((scene.goal,)), 6.0, 2)
        ways.append(np.array([lap.sensed.row for lap in session]))
    np.testing.assert_array_equal(*ways)
