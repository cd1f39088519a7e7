"""Scenes from above: everything that stands in a scene is drawn, in one picture for many."""

from itertools import pairwise
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from gaitwright.ground.moving import Mover
from gaitwright.ground.outlines import outline_of
from gaitwright.ground.patches import Patch
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.pictures.ground import HIGH, PIT
from gaitwright.pictures.moving import words
from gaitwright.pictures.scenes import draw_scene, scenes_picture, view

STEP = 0.107
ICE = Patch(((0.0, 0.0), (1.0, 0.0), (1.0, 1.0)), 0.2)


def drawn(scene: Scene) -> Axes:
    ax = Figure().add_subplot()
    draw_scene(ax, scene, STEP)
    return ax


def polygons(ax: Axes) -> list[Polygon]:
    return [patch for patch in ax.patches if isinstance(patch, Polygon)]


@pytest.mark.parametrize("name", ["holes:1", "forest", "mixed", "streets:1", "gap"])
def test_every_solid_and_every_hole_is_drawn_where_it_is(name: str) -> None:
    scene = load_scene(name, 2)
    outlines = {outline_of(patch.get_xy()[:-1]) for patch in polygons(drawn(scene))}
    for one in (*scene.holes, *scene.obstacles(STEP)):
        assert outline_of(one.corners()) in outlines
    low = [solid for solid in scene.solids if solid not in scene.obstacles(STEP)]
    assert {outline_of(solid.corners()) for solid in low} <= outlines


def test_what_is_walked_around_is_hatched_and_nothing_else() -> None:
    scene = load_scene("forest", 2)
    hatched = [patch for patch in polygons(drawn(scene)) if patch.get_hatch() == HIGH["hatch"]]
    assert len(hatched) == len(scene.obstacles(STEP)) < len(scene.solids)


def test_start_goal_and_friction_are_told() -> None:
    ax = drawn(Scene("ice", Flat(), patches=(ICE,), start=(1.0, 2.0, 0.0), goal=(5.0, 1.0)))
    places = np.concatenate([np.asarray(points.get_offsets()) for points in ax.collections])
    np.testing.assert_allclose(places, [[1.0, 2.0], [5.0, 1.0]])
    assert any("0.2" in text.get_text() for text in ax.texts)


def test_of_wide_ground_the_part_around_the_start_is_shown() -> None:
    x_min, x_max, y_min, y_max = view(load_scene("flat"))
    assert x_min < 0.0 < x_max and x_max - x_min < 20.0 and y_max - y_min < 20.0
    blocks = load_scene("blocks")
    assert view(blocks) == (blocks.bounds[0], blocks.bounds[2], blocks.bounds[1], blocks.bounds[3])


def test_what_moves_is_drawn_where_it_is_first_with_arrows_along_its_way() -> None:
    scene = load_scene("crossing", 2)
    ax = drawn(scene)
    moving = [patch for patch in polygons(ax) if patch.get_linestyle() == "--"]
    wanted = [outline_of(mover.solid.corners()) for mover in scene.movers]
    assert [outline_of(patch.get_xy()[:-1]) for patch in moving] == wanted
    ways = [line.get_xydata() for line in ax.lines]
    stretches = [pair for mover in scene.movers for pair in pairwise(mover.path)]
    assert len(ways) == len(stretches)
    for way, stretch in zip(ways, stretches, strict=True):
        np.testing.assert_allclose(way, stretch)
    arrows = [text for text in ax.texts if getattr(text, "arrow_patch", None) is not None]
    assert len(arrows) == len(stretches) + 1, "and that of the start"
    assert any("m/s" in text.get_text() for text in ax.texts)


def test_it_is_written_when_a_thing_is_there_and_how_fast_it_goes() -> None:
    box = Box(1.0, 0.0, 0.0, 0.4, 0.4, 0.3)
    assert words(Mover(box, ((2.0, 0.0),), 0.5, begins=2.0)) == "0.5 m/s, from 2 s"
    assert words(Mover(box, appears=3.0)) == "there from 3 s"
    assert words(Mover(box, ((2.0, 0.0),), 0.25, appears=3.0, vanishes=8.0)) == "0.25 m/s, there 3 to 8 s"


def test_more_scenes_make_a_taller_picture(tmp_path: Path) -> None:
    scenes = [load_scene(name, 1) for name in ("holes", "waves", "bugtrap", "slope")]
    one = matplotlib.image.imread(scenes_picture(scenes[:1], STEP, tmp_path / "one.png"))
    four = matplotlib.image.imread(scenes_picture(scenes, STEP, tmp_path / "four.png"))
    assert one.shape[1] == four.shape[1] == 1600
    pit = np.array([int(PIT[k : k + 2], 16) for k in (1, 3, 5)]) / 255.0
    assert (np.abs(one[..., :3] - pit).max(axis=-1) < 0.01).sum() > 200
    assert four.shape[0] > 400 and not list(tmp_path.glob(".*"))
