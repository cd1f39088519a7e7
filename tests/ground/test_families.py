"""The random families: free ends, a way as often as the documents say, and harder is harder."""

import numpy as np
import pytest
import shapely

from gaitwright.ground.layouts import BUILDERS
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.scenes_list import DIFFICULTY, OFFERS
from gaitwright.ground.terrain import HeightField

FAMILIES = [name for name, offer in OFFERS.items() if offer[1:] == DIFFICULTY]
HALF_WIDTH = 0.2
"""Of a Go2 with its clearance [m]."""
STEP = 0.107
FREE = 0.5
"""Free ground around the ends, at least [m]."""


def obstacles(scene: Scene) -> shapely.Geometry:
    return shapely.union_all([shapely.Polygon(one.corners()) for one in scene.obstacles(STEP)])


def has_way(scene: Scene, radius: float) -> bool:
    """Whether a disc gets from start to goal, by the free space grown together."""
    free = shapely.box(*scene.bounds).difference(obstacles(scene).buffer(radius))
    ends = [shapely.Point(scene.start[:2]), shapely.Point(scene.goal)]
    return any(all(room.distance(end) < 1e-9 for end in ends) for room in getattr(free, "geoms", [free]))


def test_there_are_twelve() -> None:
    assert len(FAMILIES) == 12 and set(FAMILIES) <= set(BUILDERS)


@pytest.mark.parametrize("name", FAMILIES)
@pytest.mark.parametrize("difficulty", ["0", "0.5", "1"])
def test_start_and_goal_are_free_and_inside(name: str, difficulty: str) -> None:
    for seed in range(4):
        scene = load_scene(f"{name}:{difficulty}", seed)
        around, field = obstacles(scene), shapely.box(*scene.bounds)
        assert scene.goal is not None
        room = 0.4 if name in ("maze", "rooms", "streets") else FREE
        for x, y in (scene.start[:2], scene.goal):
            assert field.contains(shapely.Point(x, y))
            assert not around.intersects(shapely.Point(x, y).buffer(room))
        if not isinstance(scene.surface, HeightField):
            near = np.linspace(-0.3, 0.3, 7)
            for x, y in (scene.start[:2], scene.goal):
                assert np.ptp(np.asarray(scene.height(x + near[None, :], y + near[:, None]))) == 0.0


@pytest.mark.parametrize("name", [name for name in FAMILIES if name != "streets"])
def test_there_is_always_a_way(name: str) -> None:
    for difficulty in ("0", "1"):
        assert all(has_way(load_scene(f"{name}:{difficulty}", seed), HALF_WIDTH) for seed in range(10, 14))


def test_of_the_hardest_streets_one_in_five_is_shut() -> None:
    open_ = [has_way(load_scene("streets:1", seed), HALF_WIDTH) for seed in range(40)]
    assert 0.65 <= np.mean(open_) <= 0.95
    assert all(has_way(load_scene("streets:0", seed), HALF_WIDTH) for seed in range(5))


@pytest.mark.parametrize("name", ["holes", "forest", "rooms", "maze", "bugtrap", "mixed"])
def test_harder_has_more_in_the_way(name: str) -> None:
    lengths = [
        np.mean([obstacles(load_scene(f"{name}:{difficulty}", seed)).length for seed in range(4)])
        for difficulty in ("0", "0.5", "1")
    ]
    assert lengths == sorted(lengths) and lengths[0] < lengths[2]


@pytest.mark.parametrize(("name", "steepest"), [("waves", (6, 18, 28)), ("hills", (7, 22, 35))])
def test_harder_is_steeper(name: str, steepest: tuple) -> None:
    found = []
    for difficulty in ("0", "0.5", "1"):
        fields = [load_scene(f"{name}:{difficulty}", seed).surface for seed in range(5)]
        rise = max(
            np.abs(np.diff(field.heights, axis=axis)).max() / field.spacing
            for field in fields
            for axis in (0, 1)
        )
        found.append(float(np.degrees(np.arctan(rise))))
    assert found == sorted(found) and all(a <= b for a, b in zip(found, steepest, strict=True))


@pytest.mark.parametrize("name", FAMILIES)
def test_every_seed_is_another(name: str) -> None:
    one, other = load_scene(name, 1), load_scene(name, 2)
    x, y = np.meshgrid(np.linspace(-1.0, 9.0, 200), np.linspace(-3.0, 3.0, 120))
    assert np.any(np.asarray(one.at(0.0).height(x, y)) != other.at(0.0).height(x, y))


def test_streets_run_straight_between_their_junctions() -> None:
    scene = load_scene("streets:0", 4)
    houses = obstacles(scene)
    for k in range(5):
        assert not houses.intersects(shapely.LineString([(3.0 * k, -6.0), (3.0 * k, 6.0)]))
        assert not houses.intersects(shapely.LineString([(0.0, 3.0 * k - 6.0), (12.0, 3.0 * k - 6.0)]))
    assert len(scene.shapes) == 16


def room_around_the_start(scene: Scene) -> shapely.Polygon:
    free = shapely.box(*scene.bounds).difference(obstacles(scene).buffer(0.01))
    return next(part for part in getattr(free, "geoms", [free]) if part.contains(shapely.Point(0.0, 0.0)))


def test_only_an_easy_maze_has_loops() -> None:
    """A loop goes around walls that do not hang together with the outer one."""
    assert len(room_around_the_start(load_scene("maze:1", 2)).interiors) == 0
    assert len(room_around_the_start(load_scene("maze:0", 2)).interiors) > 0
