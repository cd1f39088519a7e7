"""Height maps: grey PNGs become ground; whatever is none is told before it is decoded."""

import io
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from gaitwright.errors import BadFile, WrongUse
from gaitwright.ground.grey_png import grey_of
from gaitwright.ground.height_map import height_map
from gaitwright.ground.scene import load_scene

GREY = np.arange(12, dtype=np.uint8).reshape(3, 4) * 20


def saved(folder: Path, pixels: np.ndarray, name: str = "hill.png", **how) -> Path:
    path = folder / name
    Image.fromarray(pixels, **how).save(path)
    return path


@pytest.mark.parametrize(("kind", "white"), [(np.uint8, 255), (np.uint16, 65535)])
def test_black_is_low_and_the_top_row_is_far_ahead_of_y(tmp_path: Path, kind: type, white: int) -> None:
    pixels = (np.linspace(0, 1, 12).reshape(3, 4) * white).astype(kind)
    path = saved(tmp_path, pixels)
    field = height_map(path, across=6.0, relief=0.5, corner=(-1.0, 2.0))
    assert (field.x_min, field.y_min, field.x_max, field.y_max) == (-1.0, 2.0, 5.0, 6.0)
    assert float(field.height(-1.0, 6.0)) == 0.0 and float(field.height(5.0, 2.0)) == 0.5
    np.testing.assert_allclose(field.heights[::-1] / 0.5, pixels / white)


def test_a_picture_is_a_scene_by_its_name(tmp_path: Path) -> None:
    path = saved(tmp_path, GREY)
    scene = load_scene(f"{path}:9:2")
    assert scene.bounds == (-4.5, -3.0, 4.5, 3.0) and scene.name == "hill"
    np.testing.assert_allclose(scene.height(4.5, -3.0), 2.0 * 220 / 255)
    np.testing.assert_allclose(scene.height(0.0, 0.0), 2.0 * 110 / 255)
    assert load_scene(str(path)).bounds[2] == 7.0
    for wrong in (f"{path}:0", f"{path}:wide", f"{path}:9:nan"):
        with pytest.raises(WrongUse, match="expected metres from"):
            load_scene(wrong)


def colours(folder: Path) -> Path:
    return saved(folder, np.zeros((3, 4, 3), dtype=np.uint8))


def with_alpha(folder: Path) -> Path:
    return saved(folder, np.zeros((3, 4, 2), dtype=np.uint8), mode="LA")


def jpeg(folder: Path) -> Path:
    out = io.BytesIO()
    Image.fromarray(GREY).save(out, format="JPEG")
    (folder / "hill.png").write_bytes(out.getvalue())
    return folder / "hill.png"


def two_colours(folder: Path) -> Path:
    Image.fromarray(GREY).convert("1").save(folder / "hill.png")
    return folder / "hill.png"


def one_column(folder: Path) -> Path:
    return saved(folder, GREY[:, :1].copy())


def bomb(folder: Path) -> Path:
    """A kilobyte that says it is 100,000 × 100,000 pixels."""
    path = saved(folder, GREY)
    content = bytearray(path.read_bytes())
    content[16:24] = (100_000).to_bytes(4) * 2
    content[29:33] = zlib.crc32(content[12:29]).to_bytes(4)
    path.write_bytes(content)
    return path


def too_wide(folder: Path) -> Path:
    return saved(folder, np.zeros((2, 5000), dtype=np.uint8))


def cut_off(folder: Path) -> Path:
    path = saved(folder, np.random.default_rng(0).integers(0, 255, (50, 50), dtype=np.uint8))
    path.write_bytes(path.read_bytes()[:1000])
    return path


@pytest.mark.parametrize(
    ("make", "told"),
    [
        (colours, "kind RGB: a height map is grey"),
        (with_alpha, "kind LA: a height map is grey"),
        (two_colours, "kind 1: a height map is grey"),
        (jpeg, "is no PNG picture"),
        (one_column, "has 1 × 3 pixels: a height map has two or more of each"),
        (bomb, "is no PNG picture, or too large a one"),
        (too_wide, "has 5000 × 2 pixels: a height map has at most 4,000,000, and no side of more than 4,096"),
        (cut_off, "is a damaged PNG"),
    ],
)
def test_what_is_no_height_map_is_told(tmp_path: Path, make, told: str) -> None:
    with pytest.raises(BadFile) as error:
        grey_of(make(tmp_path))
    assert told in str(error.value) and "hill.png" in str(error.value)
