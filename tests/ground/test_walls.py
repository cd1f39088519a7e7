"""What is walked around: the outline of what is too high, and of a ramp only the sides that break off."""

import numpy as np
import pytest
import shapely

from gaitwright.ground.scene import Scene
from gaitwright.ground.solids import Cylinder, Prism, Pyramid, Wedge
from gaitwright.ground.terrain import Box, Flat

STEP = 0.1
UP = Wedge(1.0, 0.0, 0.0, 1.0, 0.8, 0.3)
"""A ramp of 17° along x, from x = 0.5 to 1.5."""
TOP = Box(2.0, 0.0, 0.0, 1.0, 0.8, 0.3)
DOWN = Wedge(3.0, 0.0, np.pi, 1.0, 0.8, 0.3)


def walls(*shapes) -> shapely.Geometry:
    scene = Scene("ramp", Flat(), (), shapes=shapes)
    return shapely.union_all([shapely.Polygon(one.corners()) for one in scene.obstacles(STEP)])


def test_high_things_are_walked_around_by_their_outlines() -> None:
    pillar, low = Cylinder(1.0, 1.0, 0.2, 0.5), Cylinder(3.0, 1.0, 0.2, 0.05)
    corner = Prism(((4.0, 0.0), (5.0, 0.0), (5.0, 1.0), (4.8, 0.2)), 0.4)
    gentle, steep = Pyramid(7.0, 0.0, 0.0, 2.0, 2.0, 0.3), Pyramid(9.0, 3.0, 0.0, 0.3, 2.0, 0.3)
    scene = Scene("yard", Flat(), (), shapes=(pillar, low, corner, gentle, steep))
    assert scene.obstacles(STEP) == (pillar, corner, steep)


def test_one_walks_over_a_ramp_and_not_off_its_sides() -> None:
    blocked = walls(UP, TOP, DOWN)
    over = shapely.LineString([(0.0, 0.0), (4.0, 0.0)])
    assert not blocked.intersects(over)
    for x in (1.2, 2.0, 2.8):  # where the side is higher than a step
        assert blocked.intersects(shapely.LineString([(x, -1.0), (x, 0.0)]))
        assert blocked.intersects(shapely.LineString([(x, 1.0), (x, 0.0)]))
    for x in (0.6, 3.4):  # where it is lower
        assert not blocked.intersects(shapely.LineString([(x, -1.0), (x, 0.0)]))


def test_a_ramp_that_leads_nowhere_ends_in_a_wall() -> None:
    blocked = walls(UP)
    assert blocked.intersects(shapely.LineString([(1.2, 0.0), (2.0, 0.0)]))
    assert not blocked.intersects(shapely.LineString([(0.0, 0.0), (1.2, 0.0)]))


def test_the_side_of_a_ramp_is_a_wall_from_where_it_is_a_step_high() -> None:
    low_end = shapely.get_coordinates(walls(UP))[:, 0].min()
    assert low_end == pytest.approx(0.5 + STEP / 0.3, abs=0.03)


def test_a_ramp_that_is_too_steep_is_walked_around() -> None:
    steep = Wedge(1.0, 0.0, 0.0, 0.2, 0.8, 0.3)
    assert Scene("steep", Flat(), (), shapes=(steep,)).obstacles(STEP) == (steep,)


def test_what_stands_far_from_a_ramp_stays_whole() -> None:
    far = Box(6.0, 3.0, 0.3, 0.5, 0.5, 0.4)
    scene = Scene("yard", Flat(), (far,), shapes=(UP,))
    assert far in scene.obstacles(STEP)
    near = Box(1.0, 0.65, 0.0, 1.0, 0.5, 0.5)  # beside the ramp: higher than it all along
    assert shapely.Polygon(near.corners()).boundary.within(walls(UP, near).buffer(1e-6))
