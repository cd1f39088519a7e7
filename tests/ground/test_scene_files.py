"""Scene files: that of the documents, every entry, and a sentence for what is mended or wrong."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from gaitwright.errors import BadFile
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.scenes_list import OFFERS
from gaitwright.ground.solids import Cylinder, Prism, Pyramid, Sphere, Wedge
from gaitwright.ground.splines import spline_field
from gaitwright.ground.terrain import Box

DOCUMENT = (Path(__file__).parents[2] / "docs" / "scenes.md").read_text(encoding="utf-8")
NET = [[0.0, 0.1, 0.0, 0.2], [0.1, 0.3, 0.1, 0.0], [0.0, 0.1, 0.2, 0.1], [0.0, 0.0, 0.1, 0.0]]
SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1]]


def loaded(folder: Path, **scene) -> Scene:
    path = folder / "yard.json"
    path.write_text(json.dumps(scene))
    return load_scene(str(path))


def test_the_example_of_the_documents_is_a_scene(tmp_path: Path) -> None:
    example = json.loads(re.search(r"```json\n(.*?)```", DOCUMENT, re.DOTALL)[1])
    scene = loaded(tmp_path, **example)
    assert scene.name == "yard" and scene.goal == (9.0, 0.0) and scene.notes == ()
    kinds = [type(solid) for solid in scene.solids]
    assert kinds == [Box, Cylinder, Pyramid, Wedge, Box, Sphere, Prism]
    assert len(scene.holes) == 2 and scene.patches[0].friction == 0.2


def test_every_family_is_in_the_documents() -> None:
    for name, offer in OFFERS.items():
        if offer.takes == "a difficulty":
            assert f"| `{name}` |" in DOCUMENT


def test_entries_are_the_primitives_they_name(tmp_path: Path) -> None:
    scene = loaded(
        tmp_path,
        shapes=[
            {"type": "cylinder", "x": 1, "y": 2, "radius": 0.3, "height": 0.4, "base": 0.1},
            {"type": "pyramid", "x": 1, "y": 2, "lx": 1, "ly": 2, "height": 0.4, "yaw": 0.5, "top": 0.3},
            {"type": "wedge", "x": 1, "y": 2, "lx": 1, "ly": 2, "height": 0.4, "yaw": 0.5},
            {"type": "sphere", "x": 1, "y": 2, "radius": 0.3},
            {"type": "prism", "outline": SQUARE, "height": 0.4},
            {
                "type": "prism",
                "outline": {"type": "rectangle", "x": 0, "y": 0, "lx": 2, "ly": 1},
                "height": 1,
            },
        ],
    )
    assert scene.shapes[:4] == (
        Cylinder(1.0, 2.0, 0.3, 0.4, 0.1),
        Pyramid(1.0, 2.0, 0.5, 1.0, 2.0, 0.4, 0.3),
        Wedge(1.0, 2.0, 0.5, 1.0, 2.0, 0.4),
        Sphere(1.0, 2.0, 0.3, 0.3),
    )
    assert scene.shapes[4] == Prism(((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)), 0.4)
    assert scene.shapes[5].extent() == (-1.0, -0.5, 1.0, 0.5)


@pytest.mark.parametrize(("kind", "tension"), [("cardinal", 0.4), ("bezier", None)])
def test_nets_are_smooth_ground(tmp_path: Path, kind: str, tension: float | None) -> None:
    entry = {"type": kind, "x_min": -1, "y_min": 0, "spacing": 0.5, "heights": NET}
    entry |= {} if tension is None else {"tension": tension}
    scene = loaded(tmp_path, surface=entry, bounds=[-1, 0, 0.5, 1.5], start=[0, 1, 0])
    wanted = spline_field(-1.0, 0.0, 0.5, np.array(NET), tension)
    np.testing.assert_array_equal(scene.surface.heights, wanted.heights)


def test_a_height_map_is_named_from_the_files_folder(tmp_path: Path) -> None:
    (tmp_path / "maps").mkdir()
    Image.fromarray(np.array([[0, 255], [0, 0]], dtype=np.uint8)).save(tmp_path / "maps" / "hill.png")
    surface = {"type": "image", "file": "maps/hill.png", "across": 2, "relief": 0.5, "x_min": 1, "y_min": -1}
    scene = loaded(tmp_path, surface=surface)
    assert float(scene.height(3.0, 1.0)) == 0.5 and float(scene.height(3.0, -1.0)) == 0.0


@pytest.mark.parametrize("name", ["../hill.png", "/etc/passwd", "a/../../hill.png", "link.png"])
def test_no_height_map_comes_from_outside_the_folder(tmp_path: Path, name: str) -> None:
    Image.fromarray(np.zeros((3, 3), dtype=np.uint8)).save(tmp_path / "hill.png")
    inner = tmp_path / "inner"
    inner.mkdir()
    (inner / "link.png").symlink_to(tmp_path / "hill.png")
    with pytest.raises(BadFile, match="lies outside the folder of the scene file"):
        loaded(inner, surface={"type": "image", "file": name, "across": 2, "relief": 1})


def test_what_was_mended_is_told(tmp_path: Path) -> None:
    scene = loaded(
        tmp_path,
        shapes=[{"type": "prism", "outline": [*SQUARE, SQUARE[0]], "height": 1}],
        holes=[
            {"outline": {"type": "circle", "x": 3, "y": 0, "radius": 0.5}, "depth": 0.2},
            {"outline": {"type": "rectangle", "x": 3, "y": 0, "lx": 1, "ly": 1}, "depth": 0.3},
            {"outline": [[90, 0], [91, 0], [91, 1]], "depth": 0.3},
        ],
    )
    assert scene.notes == (
        "shapes[0]: 1 corner repeated or within 1 mm of the next left out",
        "holes[2] lies outside the bounds",
        "holes[1] overlaps holes[0]: where both are the deeper one counts",
    )
    assert float(scene.height(3.0, 0.0)) == -0.3


def test_holes_in_a_field_have_walls_as_wide_as_its_cells_and_that_is_told(tmp_path: Path) -> None:
    surface = {"type": "heights", "x_min": -4, "y_min": -4, "spacing": 0.1, "heights": [[0.0] * 90] * 90}
    scene = loaded(tmp_path, surface=surface, holes=[{"outline": SQUARE, "depth": 0.2}])
    assert scene.notes == ("the walls of its holes are 0.1 m wide, as the cells of its heights are",)
    assert float(scene.height(0.5, 0.5)) == pytest.approx(-0.2) and float(scene.height(1.3, 0.5)) == 0.0


def prism(*corners) -> dict:
    return {"shapes": [{"type": "prism", "outline": corners, "height": 1}]}


def net(kind: str, heights: list, **more) -> dict:
    return {"surface": {"type": kind, **WAVY, "heights": heights, **more}}


ROUND = {"type": "circle", "x": 0, "y": 0, "radius": 1}
AT = {"x": 0, "y": 0}
WAVY = {"x_min": 0, "y_min": 0, "spacing": 1}


@pytest.mark.parametrize(
    ("scene", "told"),
    [
        ({"shapes": [{"type": "cone"}]}, "shapes[0].type is 'cone'"),
        ({"shapes": [{"type": "cylinder", **AT, "radius": 0, "height": 1}]}, "shapes[0].radius is 0"),
        ({"shapes": [{"type": "pyramid", **AT, "lx": 1, "ly": 1, "height": 1, "top": 1}]}, "top is 1"),
        ({"shapes": [{"type": "sphere", **AT, "radius": 1, "height": 3}]}, "at most twice that"),
        (prism([0, 0], [1, 1], [1, 0], [0, 1]), "crosses itself"),
        (prism([0, 0], [1, 1], [2, 2]), "shapes[0] has no area"),
        ({"holes": [{"outline": [[0, 0], [1, 1]], "depth": 1}]}, "holes[0] has 2 different corners"),
        ({"holes": [{"outline": SQUARE, "depth": -1}]}, "holes[0].depth is -1"),
        ({"holes": [{"outline": ROUND, "depth": 1}] * 201}, "length <= 200"),
        ({"patches": [{"outline": SQUARE, "friction": 0}]}, "patches[0].friction is 0"),
        (net("bezier", [[0] * 5] * 4), "4 rows of 5: Bézier patches take 4, 7, 10"),
        (net("cardinal", [[0, 1], [0, 1, 2]]), "rows of different lengths"),
        (net("cardinal", [[0, 1]] * 2, tension=2), "surface.tension is 2"),
        (
            net("cardinal", [[0] * 200] * 200, spacing=100),
            "sampled at 12737 × 12737 nodes, and takes at most 4,000,000",
        ),
        ({"surface": {"type": "image", "file": "no.png", "across": 1, "relief": 1}}, "No such file"),
        ({"surface": {"type": "image", "file": "a\0b", "across": 1, "relief": 1}}, "surface.file is"),
        ({"goal": [50, 0]}, "goal is [50.0, 0.0], which lies outside bounds"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told(tmp_path: Path, scene: dict, told: str) -> None:
    with pytest.raises(BadFile) as error:
        loaded(tmp_path, **scene)
    assert told in str(error.value)


def test_holes_of_too_many_corners_together_are_refused(tmp_path: Path) -> None:
    ring = [[float(np.cos(a)), float(np.sin(a))] for a in np.linspace(0, 6.2, 200)]
    with pytest.raises(BadFile, match="have 4200 corners together, and may have 4000"):
        loaded(tmp_path, holes=[{"outline": ring, "depth": 0.1}] * 21)
