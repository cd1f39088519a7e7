"""The picture of the terrain scanner: every output is drawn, where it is."""

from pathlib import Path

import matplotlib.image
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch, Polygon

from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain
from gaitwright.perception.reach_outline import separate
from gaitwright.perception.terrain_preview import TerrainPreview, corners_of
from gaitwright.pictures.scanner import draw_above, draw_ahead, scanner_picture, standing, summary, view
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.record.previews import previews_in
from gaitwright.record.recording import Recording
from gaitwright.session import Session, record
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill
from oracles import robot_called


def recorded(name: str, skill: str, ground: str) -> Recording:
    robot, scene = robot_called(name), load_scene(ground, 1)
    chooser = fixed_skill(robot, skill, None, 0.0, None, "numerical")
    run = Session(Brain.of(robot, scene, chooser), MujocoPlant(robot, scene), Mission(()), 0.9, 1)
    return record(run, 1, ground, previews=True)


@pytest.fixture(
    scope="module", params=[("go2", "trot", "rough"), ("hexapod", "tripod", "flat")], ids="-".join
)
def recording(request) -> Recording:
    return recorded(*request.param)


def moments(recording: Recording) -> list[TerrainPreview]:
    return list(previews_in(recording.previews))


def drawn(recording: Recording, held: TerrainPreview) -> Axes:
    ax = Figure().add_subplot()
    draw_above(ax, recording.robot, held, load_scene(recording.scene, 1))
    return ax


def points(line: Line2D) -> np.ndarray:
    return np.asarray(line.get_xydata(), dtype=float)


def dots(ax: Axes) -> np.ndarray:
    """Places of all single marks."""
    return np.array([points(line)[0] for line in ax.lines if len(points(line)) == 1])


def test_polygons_feet_centre_and_areas_are_drawn_where_they_are(recording: Recording):
    for held in moments(recording)[::4]:
        ax = drawn(recording, held)
        polygons = [patch.get_xy()[:-1] for patch in ax.patches if isinstance(patch, Polygon)]
        for corners in map(corners_of, (held.support_w, held.lowered_w, held.coming_w)):
            if len(corners) > 1:
                assert any(np.array_equal(corners, xy) for xy in polygons)
        places = dots(ax)
        for place in (*held.feet_w[:, :2], held.centre_w, *corners_of(held.footholds_w[:, :2])):
            assert (np.abs(places - place).max(axis=1) < 1e-12).any()
        areas = [patch.get_path() for patch in ax.patches if isinstance(patch, PathPatch)]
        assert len(areas) == 2 * sum(bool(separate(outline)) for outline in held.reach_w)
        assert {text.get_text() for text in ax.texts} >= set(recording.robot.legs)


def test_a_critical_foot_has_a_ring_and_no_other_has(recording: Recording):
    for held in moments(recording)[::3]:
        rings = [line for line in drawn(recording, held).lines if line.get_markersize() == 22]
        at = {tuple(points(line)[0]) for line in rings}
        assert at == {tuple(place) for place in held.feet_w[held.critical, :2]}


def test_all_of_it_is_in_view(recording: Recording):
    for held in moments(recording)[::3]:
        x_min, x_max, y_min, y_max = view(recording.robot, held)
        points = np.concatenate([held.reach_w.reshape(-1, 2), held.feet_w[:, :2]])
        points = points[np.isfinite(points).all(axis=1)]
        assert (points > (x_min, y_min)).all() and (points < (x_max, y_max)).all()


def test_the_ground_ahead_is_a_line_of_its_height_and_slope(recording: Recording):
    held = moments(recording)[-1]
    ax = Figure().add_subplot()
    draw_ahead(ax, recording.robot, held)
    lines = [points(line) for line in ax.lines if len(points(line)) == 2]
    assert len(lines) == recording.robot.n
    for (start, end), slope, mean in zip(lines, held.slope, held.elevation, strict=True):
        assert (start[1] + end[1]) / 2 == pytest.approx(mean)
        assert np.arctan2(*(end - start)[::-1]) == pytest.approx(slope)


def test_words_say_how_it_stands(recording: Recording):
    for held in moments(recording):
        told = standing(recording.robot, held)
        if held.margin < 0.0:
            assert told.endswith("outside its support")
        for name, critical in zip(recording.robot.legs, held.critical, strict=True):
            assert held.margin < 0.0 or (name in told) == critical
        assert f"supporting feet: {held.supporting.sum()} of" in summary(recording.robot, held)


def test_a_moment_of_which_nothing_is_known_is_drawn_too(tmp_path: Path):
    recording = recorded("go2", "trot", "flat")
    held = moments(recording)[3]
    nothing = {name: getattr(held, name) * np.nan for name in ("coming_w", "footholds_w", "reach_w", "slope")}
    blank = held._replace(
        **nothing, elevation=held.slope * np.nan, support_w=held.support_w * np.nan, margin=np.nan,
        supporting=held.supporting & False, critical=held.critical & False,
    )  # fmt: skip
    path = scanner_picture(recording, blank, None, tmp_path / "blank.png")
    assert matplotlib.image.imread(path).shape[1] == 1600
    assert standing(recording.robot, blank) == "in the air" and "not known" in summary(recording.robot, blank)


def test_the_picture_is_1600_pixels_wide_and_alone_in_its_folder(recording: Recording, tmp_path: Path):
    held = moments(recording)[7]
    picture = matplotlib.image.imread(
        scanner_picture(recording, held, load_scene(recording.scene, 1), tmp_path / "scanner.png")
    )
    assert picture.shape[1] == 1600 and picture[..., :3].std() > 0.05
    assert [path.name for path in tmp_path.iterdir()] == ["scanner.png"]
