"""Where there is no room to turn, a robot in physics goes to where there is some, and touches nothing."""

from dataclasses import replace

import mujoco
import pytest

from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.locomotion import Brain, Lap
from gaitwright.model.camera import Camera
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.plant.seeing import SeeingPlant
from gaitwright.session import Session
from gaitwright.signals import Mission
from oracles import robot_called

GO2 = robot_called("go2")
CAMERA = Camera.for_robot(GO2)
HIGH, THIN = 0.6, 0.1


def walls_along(x0: float, x1: float, width: float) -> tuple[Box, ...]:
    """Walls on both sides of a corridor along x."""
    y, middle = 0.5 * (width + THIN), 0.5 * (x0 + x1)
    return tuple(Box(middle, s * y, 0.0, x1 - x0, THIN, HIGH) for s in (1, -1))


def dead_end(x0: float, x1: float, width: float) -> tuple[Box, ...]:
    """A corridor that is open at x0 and shut at x1."""
    return *walls_along(x0, x1, width), Box(x1 + 0.5 * THIN, 0.0, 0.0, THIN, width + 2.0 * THIN, HIGH)


def touched(plant: MujocoPlant) -> set[str]:
    """The robot's parts that touch what stands on the ground, by MuJoCo's contacts."""
    model, parts = plant.model, set()
    for contact in plant.data.contact[: plant.data.ncon]:
        geoms = (contact.geom1, contact.geom2)
        bodies = [model.geom_bodyid[geom] for geom in geoms]
        if (bodies[0] == 0) == (bodies[1] == 0) or abs(contact.frame[2]) > 0.7:
            continue  # no contact with the world, or one with the ground
        parts.add(mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_GEOM, geoms[int(bodies[0] == 0)]) or "part")
    return parts


def crossing(
    scene: Scene,
    goal: tuple[float, float],
    camera: Camera | None,
    makes_room: bool = True,
    seconds: float = 90.0,
) -> tuple[Lap, set[str], list[str]]:
    """The last lap, what touched something on the way, and the skills in their order."""
    plant, brain = MujocoPlant(GO2, scene), Brain.of(GO2, scene, camera=camera)
    brain = replace(brain, navigator=replace(brain.navigator, makes_room=makes_room))
    whole = plant if camera is None else SeeingPlant(plant, camera, scene)
    session, parts, skills = Session(brain, whole, Mission((goal,)), seconds, seed=1), set(), [""]
    for lap in session:
        parts |= touched(plant)
        if lap.call.skill != skills[-1]:
            skills.append(lap.call.skill)
    return session.lap, parts, skills[1:]


@pytest.mark.parametrize("width", [0.5])
def test_out_of_a_dead_end_that_it_did_not_see_it_backs_and_touches_nothing(width: float) -> None:
    """A corridor deeper than the camera sees, too narrow to turn round in; the goal lies behind its end."""
    trap = Scene("trap", Flat(), dead_end(1.0, 5.5, width), (-3.0, -4.0, 9.0, 4.0))
    lap, parts, skills = crossing(trap, (7.0, 0.0), CAMERA)
    assert lap.arrived, lap.stopped_because
    assert parts == set() and "walk-backward" in skills


def test_without_care_for_room_it_scrapes_along_the_walls() -> None:
    """What the care is for, and that touching is noticed here."""
    trap = Scene("trap", Flat(), dead_end(1.0, 5.5, 0.6), (-3.0, -4.0, 9.0, 4.0))
    _, parts, skills = crossing(trap, (7.0, 0.0), CAMERA, makes_room=False, seconds=15.0)
    assert parts and "walk-backward" not in skills


def test_that_begins_in_a_dead_end_it_backs_out_over_known_ground() -> None:
    inside = Scene("inside", Flat(), dead_end(-1.0, 2.0, 0.6), (-4.0, -4.0, 9.0, 4.0), start=(1.2, 0.0, 0.0))
    lap, parts, skills = crossing(inside, (5.0, 0.0), None)
    assert lap.arrived, lap.stopped_because
    assert parts == set() and skills[0] == "walk-backward"


@pytest.mark.parametrize("goal", [(0.0, 2.5), (-2.5, 0.1)])
def test_beside_a_wall_it_turns_without_touching_it(goal: tuple[float, float]) -> None:
    wall = Scene("wall", Flat(), (Box(0.0, -0.27, 0.0, 6.0, THIN, HIGH),), (-4.0, -4.0, 4.0, 4.0))
    lap, parts, _ = crossing(wall, goal, None)
    assert lap.arrived, lap.stopped_because
    assert parts == set()


def corner(width: float) -> tuple[Box, ...]:
    """A corridor along x that turns to the left, the only way through a wall across the field."""
    end, far = 4.0, 2.5
    return (
        Box(2.5, -0.5 * (width + THIN), 0.0, 3.0, THIN, HIGH),
        Box(2.5 - 0.5 * width, 0.5 * (width + THIN), 0.0, 3.0 - width, THIN, HIGH),
        Box(end + 0.5 * THIN, 0.5 * (far - THIN), 0.0, THIN, far + width + THIN, HIGH),
        Box(end - width - 0.5 * THIN, 0.5 * (width + far), 0.0, THIN, far, HIGH),
        *(Box(1.05, s * (3.0 + 0.5 * width + THIN), 0.0, THIN, 6.0, HIGH) for s in (1, -1)),
    )


def test_round_a_narrow_corner_it_turns_as_it_goes_on() -> None:
    width = 0.62
    bend = Scene("bend", Flat(), corner(width), (-3.0, -4.0, 9.0, 6.0))
    lap, parts, skills = crossing(bend, (4.0 - 0.5 * width, 4.5), None)
    assert lap.arrived, lap.stopped_because
    assert parts == set() and "walk-backward" not in skills


def test_round_a_corner_that_it_does_not_get_round_it_says_so() -> None:
    """A disc of half its width gets round, its length does not: it tries once more, and says so."""
    width = 0.45
    bend = Scene("bend", Flat(), corner(width), (-3.0, -4.0, 9.0, 6.0))
    lap, _, _ = crossing(bend, (4.0 - 0.5 * width, 4.5), None)
    assert lap.stopped_because.startswith("stopped: there is no room to turn at (3.")
