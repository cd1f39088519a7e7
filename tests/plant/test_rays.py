"""What MuJoCo's rays meet from above is as high as the scene says, to less than a millimetre, everywhere."""

import mujoco
import numpy as np
import pytest
import shapely

from gaitwright.ground.holes import Hole, dug
from gaitwright.ground.outlines import outline_of, regular
from gaitwright.ground.patches import Patch
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.solids import Cylinder, Prism, Pyramid, Sphere, Wedge
from gaitwright.ground.terrain import Box, Flat, Slope, Solid, Surface
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.plant.mujoco.world import Placed, build_world
from gaitwright.signals import MotorCommand
from robots_by_hand import dog

BENT = ((3.0, -3.0), (5.0, -3.0), (5.0, -1.0), (4.0, -2.2), (3.0, -1.0))
SHAPES: tuple[Solid, ...] = (
    Cylinder(1.0, 1.0, 0.4, 0.3),
    Pyramid(3.0, 1.0, 0.3, 1.2, 0.8, 0.4),
    Pyramid(5.0, 1.0, -0.7, 1.2, 1.0, 0.3, 0.4),
    Wedge(7.0, 1.0, 2.0, 1.5, 0.8, 0.4),
    Sphere(1.0, -2.0, 0.6, 0.3),
    Sphere(-2.0, 2.0, 0.3, 0.5),
    Prism(BENT, 0.25),
    Prism(((-2.0, -2.0), (-1.0, -2.0), (-1.5, -1.0)), 0.5, base=0.1),
    Box(0.0, -3.0, 0.4, 0.5, 0.3, 0.2),
)
HOLES = (
    Hole(outline_of(regular(2.0, 0.0, 0.4, 24)), 0.3),
    Hole(((4.0, -1.0), (5.0, -1.0), (5.0, 1.0), (4.0, 1.0)), 0.2),
    Hole(((4.5, -0.5), (7.0, -0.5), (7.0, 0.5), (4.5, 0.5)), 0.4),
    Hole(BENT, 0.1),
    Hole(((-1.0, 2.0), (0.0, 2.0), (0.0, 9.0), (-1.0, 9.0)), 0.5),
)
SURFACES = (Flat(), Slope(0.15, -0.1), load_scene("rough:0.08", 2).surface)
SAME = 1e-3
"""Physics and law agree to this [m]."""


def met(scene: Scene, places: np.ndarray) -> np.ndarray:
    """Heights that rays straight down meet in the physics [m]."""
    model = build_world([Placed(dog())], scene)
    data = mujoco.MjData(model)
    data.qpos[:2] = -500.0
    mujoco.mj_forward(model, data)
    geom, down = np.zeros(1, dtype=np.int32), np.array([0.0, 0.0, -1.0])
    from_above = np.column_stack([places, np.full(len(places), 50.0)])
    return np.array(
        [50.0 - mujoco.mj_ray(model, data, start, down, None, 1, -1, geom) for start in from_above]
    )


def places_in(scene: Scene, count: int, rng: np.random.Generator) -> np.ndarray:
    x_min, y_min, x_max, y_max = scene.bounds
    return rng.uniform((x_min, y_min), (x_max, y_max), (count, 2))


@pytest.mark.parametrize("surface", SURFACES, ids=lambda s: type(s).__name__)
@pytest.mark.parametrize("holes", [(), HOLES], ids=["whole", "holes"])
def test_rays_meet_every_primitive_where_the_scene_has_it(
    surface: Surface, holes: tuple, rng: np.random.Generator
) -> None:
    scene = Scene("all", dug(surface, holes), (), shapes=SHAPES, holes=holes)
    places = places_in(scene, 1500, rng)
    np.testing.assert_allclose(met(scene, places), scene.height(*places.T), atol=SAME)


@pytest.mark.parametrize(
    "name", ["holes", "trench", "hills", "forest", "streets", "maze", "bugtrap", "mixed"]
)
def test_rays_meet_the_ground_of_the_families(name: str, rng: np.random.Generator) -> None:
    scene = load_scene(name, 3)
    places = places_in(scene, 400, rng)
    np.testing.assert_allclose(met(scene, places), scene.height(*places.T), atol=SAME)


@pytest.mark.parametrize("surface", SURFACES[:2], ids=lambda s: type(s).__name__)
def test_rays_a_millimetre_beside_an_outline_meet_what_is_on_that_side(surface: Surface) -> None:
    scene = Scene("all", dug(surface, HOLES[:1]), (), shapes=SHAPES[-3:], holes=HOLES[:1])
    for outline in (*(shape.corners() for shape in SHAPES[-3:]), HOLES[0].corners()):
        ring = shapely.LinearRing(outline)
        along = (np.arange(40) + 0.5) / 40 * ring.length
        for aside in (-1e-3, 1e-3):
            beside = shapely.LinearRing(shapely.Polygon(outline).buffer(aside, join_style="mitre").exterior)
            places = shapely.get_coordinates(
                shapely.line_interpolate_point(
                    beside, shapely.line_locate_point(beside, shapely.line_interpolate_point(ring, along))
                )
            )
            np.testing.assert_allclose(met(scene, places), scene.height(*places.T), atol=SAME)


def test_feet_have_the_friction_of_their_places() -> None:
    robot = dog()
    ice = Patch(((0.0, -9.0), (9.0, -9.0), (9.0, 9.0), (0.0, 9.0)), 0.15)
    scene = Scene("half ice", Flat(), patches=(ice,))
    plant = MujocoPlant(robot, scene)
    plant.reset(vary=False)
    still = MotorCommand(np.zeros((robot.n, 3)), np.zeros((robot.n, 3)))
    plant.step(still)
    plant.step(still)
    contacts = {
        plant.model.geom(int(pair.max())).name: friction
        for pair, friction in zip(plant.data.contact.geom, plant.data.contact.friction[:, 0], strict=True)
    }
    assert {name: contacts[name] for name in contacts if name.endswith("_foot")} == pytest.approx(
        {"FL_foot": 0.15, "FR_foot": 0.15, "RL_foot": 0.8, "RR_foot": 0.8}
    )


def test_the_last_patch_counts_where_several_lie() -> None:
    square = ((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0))
    inner = ((1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0))
    scene = Scene("mats", Flat(), patches=(Patch(square, 0.3), Patch(inner, 1.1)), friction=0.6)
    x, y = np.array([-0.5, 0.5, 1.5]), np.array([0.5, 0.5, 1.5])
    np.testing.assert_array_equal(scene.friction_at(x, y), [0.6, 0.3, 1.1])
    assert float(scene.friction_at(0.5, 0.5)) == 0.3
    assert float(Scene("plain", Flat(), friction=0.6).friction_at(0.5, 0.5)) == 0.6
