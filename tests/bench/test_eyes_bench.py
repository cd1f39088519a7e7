"""The bench of the eyes: fields and things as asked, figures with what is wanted of them."""

import numpy as np
import pytest

from gaitwright.bench import claims_named
from gaitwright.bench.claims import eyes
from gaitwright.bench.evidence.lone_things import KINDS, lone
from gaitwright.bench.trial import robot_named
from gaitwright.model.camera import Camera

GO2 = robot_named("go2")


def test_the_claim_is_in_its_group():
    assert claims_named(["eyes"]) == [("unknown", "eyes")]


def test_a_field_has_its_boxes_and_its_strip_and_comes_out_of_its_seed():
    scene = eyes.crowd(50, 3)
    assert len(scene.boxes) == 50 and all(abs(box.y) >= eyes.STRIP for box in scene.boxes)
    assert scene.boxes == eyes.crowd(50, 3).boxes != eyes.crowd(50, 4).boxes


@pytest.mark.parametrize("kind", KINDS)
def test_a_lone_thing_is_as_high_as_said_and_stands_where_said(kind):
    scene, true = lone(kind, 5)
    x = np.linspace(0.5, 2.1, 161)
    heights = np.asarray(scene.height(x[None, :], x[:, None] - 1.3))
    rows, columns = np.nonzero(heights > 0.5 * heights.max())
    assert heights.max() == pytest.approx(true["height"], rel=0.1)
    if kind != "wedge":
        assert x[columns].mean() == pytest.approx(true["x"], abs=0.03)
        assert x[rows].mean() - 1.3 == pytest.approx(true["y"], abs=0.03)
    assert float(scene.height(0.0, 0.0)) == 0.0


def test_a_walk_gives_its_figures():
    taken = eyes.walk(GO2, Camera.for_robot(GO2), eyes.crowd(100, 0), 0.6)
    figures = [*eyes.times_of(taken, "few"), *eyes.errors_of(taken, "few", True)]
    assert all(figure.what.startswith("few: ") and np.isfinite(figure.measured) for figure in figures)
    wanted = {figure.what: figure for figure in figures if figure.wanted}
    assert wanted["few: a frame into the map"].wanted.bound == 1.1
    assert wanted["few: … cast included"].wanted.bound == 1.5
    assert wanted["few: cells of one height right to 1 cm"].reached
    assert len(taken.times["fuse"]) == len(taken.sights) == 15
    (off, _) = eyes.against_mujoco(taken, "few")
    assert off.reached
