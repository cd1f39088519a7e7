"""Corners of meshes that MuJoCo does not read: COLLADA scenes, and STL as text."""

from pathlib import Path

import numpy as np
import pytest
from test_mended_files import TRUNK, meshed, mjcf, read, same, write_box

from gaitwright.description.vertices import vertices_of
from gaitwright.errors import BadFile

BOX = np.array([(x, y, z) for x in (-0.01, 0.01) for y in (-0.01, 0.01) for z in (-0.2, 0.0)])
"""Corners of a shank of 2 × 2 × 20 cm below its knee [m]."""


def words(numbers: np.ndarray) -> str:
    return " ".join(f"{x:.12g}" for x in np.ravel(numbers))


def collada(corners: np.ndarray, node: str = "", inner: str = "", unit: str = "1", scene: bool = True) -> str:
    """A COLLADA file with one geometry, shown once in a node within a node."""
    shown = f"""<library_visual_scenes><visual_scene id="s"><node>{node}<node>{inner}
      <instance_geometry url="#g"/></node></node></visual_scene></library_visual_scenes>"""
    return f"""\ufeff<?xml version="1.0" encoding="utf-8"?>
      <COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
      <asset><unit meter="{unit}"/></asset><library_geometries><geometry id="g"><mesh>
      <source id="n"><float_array count="3">9 9 9</float_array></source>
      <source id="p"><float_array count="{corners.size}">{words(corners)}</float_array>
      <technique_common><accessor source="#a" count="{len(corners)}" stride="{corners.shape[1]}"/>
      </technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
      </mesh></geometry></library_geometries>{shown if scene else ""}</COLLADA>"""


def stl_text(corners: np.ndarray) -> str:
    facets = "".join(
        "facet normal 0 0 1\nouter loop\n"
        + "".join(f"  vertex {words(corner)}\n" for corner in (corners[i], corners[i - 1], corners[i - 2]))
        + "endloop\nendfacet\n"
        for i in range(len(corners))
    )
    return f"solid shank\n{facets}endsolid shank\n"


def found(folder: Path, name: str, text: str) -> np.ndarray | None:
    (folder / name).write_text(text, encoding="utf-8")
    return vertices_of(folder / name)


def ordered(corners: np.ndarray) -> np.ndarray:
    return np.unique(np.round(corners, 9), axis=0)


def test_corners_of_a_plain_scene_and_of_one_without(tmp_path):
    for scene in (True, False):
        assert ordered(found(tmp_path, "a.dae", collada(BOX, scene=scene))) == pytest.approx(ordered(BOX))
    wide = np.column_stack([BOX, np.ones(8)])
    assert ordered(found(tmp_path, "b.dae", collada(wide))) == pytest.approx(ordered(BOX))
    assert ordered(found(tmp_path, "c.stl", stl_text(BOX))) == pytest.approx(ordered(BOX))


def test_units_and_transformations_of_nodes_count(tmp_path):
    turn = np.array([[0.0, -1.0, 0.0, 0.3], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, -0.1], [0, 0, 0, 1]])
    text = collada(
        1000.0 * BOX,
        f"<matrix>{words(turn * [[1, 1, 1, 1000]] * 3 + [[0, 0, 0, 0]])}</matrix>",
        "<translate>5 0 0</translate><rotate>1 0 0 90</rotate><scale>1 1 2</scale>",
        unit="0.001",
    )
    x, y, z = (BOX * [1, 1, 2]).T
    inner = np.column_stack([x + 0.005, -z, y])
    scaled = turn.copy() * 3.0
    expected = inner @ scaled[:3, :3].T + scaled[:3, 3]
    assert ordered(found(tmp_path, "a.dae", text)) == pytest.approx(ordered(expected), abs=1e-8)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "solid\n",
        "<COLLADA/>",
        "<!DOCTYPE a []><COLLADA/>",
        collada(BOX[:2]),
        collada(BOX).replace("-0.2", "far"),
        collada(BOX).replace("-0.2", "nan"),
        collada(BOX, "<matrix>1 2 3</matrix>"),
        collada(BOX, "<rotate>0 0 0 90</rotate>"),
        collada(BOX, unit="long"),
        collada(BOX[:, :2], scene=False),
        collada(np.zeros((8, 3))),
        stl_text(BOX).replace("-0.2", "1e999"),
        stl_text(BOX).replace("-0.2", "x"),
    ],
)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_what_is_no_mesh_has_no_corners(tmp_path, text):
    assert found(tmp_path, "a.dae" if "COLLADA" in text else "a.stl", text) is None
    assert vertices_of(tmp_path / "missing.dae") is None


def test_a_scene_that_shows_a_mesh_too_often_is_none(tmp_path, monkeypatch):
    monkeypatch.setattr("gaitwright.description.vertices.MOST", 100)
    often = '<instance_geometry url="#g"/>'
    assert found(tmp_path, "a.dae", collada(BOX, inner=10 * often)) is not None
    assert found(tmp_path, "a.dae", collada(BOX, inner=12 * often)) is None


@pytest.mark.parametrize("name", ["shank.dae", "shank.stl"])
def test_a_foot_is_found_on_a_mesh_that_mujoco_does_not_read(tmp_path, name):
    write_box(tmp_path / "plain" / "shank.stl")
    plain, _ = read(tmp_path / "plain", meshed("shank.stl"))
    text = collada(BOX) if name.endswith("dae") else stl_text(BOX)
    (tmp_path / name).write_text(text, encoding="utf-8")
    robot, notes = read(tmp_path, meshed(f"package://pip/meshes/{name}"))
    assert same(robot, plain)
    assert notes == ""


def test_a_mesh_of_mujoco_is_preferred_and_a_flat_one_is_told(tmp_path):
    (tmp_path / "shank.dae").write_text(collada(10.0 * BOX), encoding="utf-8")
    write_box(tmp_path / "shank.stl")
    robot, _ = read(tmp_path, meshed("shank.dae"))
    assert robot.offset[0, 2, 2] == pytest.approx(-0.19, abs=0.01)
    (tmp_path / "shank.stl").unlink()
    (tmp_path / "shank.dae").write_text(collada(BOX * [1, 0, 1]), encoding="utf-8")
    with pytest.raises(BadFile, match="shank"):
        read(tmp_path, meshed("shank.dae"))


def test_no_mass_is_taken_from_corners(tmp_path):
    (tmp_path / "shank.stl").write_text(stl_text(BOX))
    shank = '<inertial pos="0 0 -.1" mass="0.2" diaginertia="2e-4 2e-4 2e-4"/>'
    text = mjcf(
        f'<body name="trunk"><freejoint/>{TRUNK}</body>', '<asset><mesh file="shank.stl"/></asset>'
    ).replace('<geom type="sphere" size=".02" pos="0 0 -.2"/>', '<geom type="mesh" mesh="shank"/>')
    robot, _ = read(tmp_path, text)
    assert robot.offset[0, 2, 2] == pytest.approx(-0.19, abs=0.01)
    with pytest.raises(BadFile, match="body 'a3' takes its mass from mesh 'shank'"):
        read(tmp_path, text.replace(shank, ""))
