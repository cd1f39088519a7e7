"""Nominal stances and branches, from lengths, axes and limits alone."""

import numpy as np
import pytest

from gaitwright.model import nominal_pose as stance
from gaitwright.model.kinematics import foot_in_leg
from gaitwright.model.nominal_pose import LegShape

ABDUCTION = np.eye(3)
YAW = np.column_stack([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""Leg frame of a left leg that yaws: x up, y forward, z sideways."""
FREE = np.full(3, np.pi)
HIP = np.array([0.3, 0.1, 0.0])
MAMMAL_OFFSET = np.array([[0.0, 0.1, 0.0], [0.0, 0.0, -0.2], [0.0, 0.0, -0.2]])
SPRAWLED_OFFSET = np.array([[0.0, 0.0, 0.05], [0.0, 0.0, 2.0], [-3.0, 0.0, 0.0]])
MAMMAL = LegShape(HIP, ABDUCTION, MAMMAL_OFFSET, 1.0, -FREE, FREE)
SPRAWLED = LegShape(HIP, YAW, SPRAWLED_OFFSET, 1.0, -FREE, FREE)
KNEE_BEHIND, KNEE_BEFORE = (-1, -1), (-1, 1)


def test_abduction_leg_stands_below_its_second_hinge():
    assert stance.nominal_foot(MAMMAL) == pytest.approx([0.3, 0.2, -0.26])


def test_abduction_axis_may_point_backward():
    leg = MAMMAL._replace(leg_frame=np.diag([-1.0, 1.0, -1.0]))
    assert stance.nominal_foot(leg) == pytest.approx([0.3, 0.2, -0.26])


def test_yaw_leg_stands_sideways():
    assert stance.nominal_foot(SPRAWLED) == pytest.approx([0.3, 0.1 + 2.05, -2.25])
    right = SPRAWLED._replace(hip=HIP * (1.0, -1.0, 1.0))
    assert stance.nominal_foot(right) == pytest.approx([0.3, -0.1 - 2.05, -2.25])


def test_every_branch_brings_the_foot_there(rng):
    for _ in range(50):
        jitter = rng.uniform(-0.03, 0.03, (3, 3)) * [[0.0, 1.0, 0.0], [1.0, 1.0, 1.0], [1.0, 1.0, 1.0]]
        leg = MAMMAL._replace(offset=MAMMAL.offset + jitter, sign=float(rng.choice([-1.0, 1.0])))
        foot = stance.nominal_foot(leg)
        choices = stance.branch_angles(leg, foot)
        assert len(choices) == 4
        for q in choices.values():
            assert HIP + np.array(foot_in_leg(q, leg.offset, leg.sign)) == pytest.approx(foot, abs=1e-12)


def test_free_legs_bend_as_animals_do():
    assert stance.nominal_branch(MAMMAL, stance.nominal_foot(MAMMAL)) == KNEE_BEHIND
    foot = stance.nominal_foot(SPRAWLED)
    branch = stance.nominal_branch(SPRAWLED, foot)
    assert branch is not None
    q = stance.branch_angles(SPRAWLED, foot)[branch]
    assert stance.knee_bends_well(SPRAWLED, q)
    assert abs(q[0]) < 0.1  # the foot on its own side, not over the back


def test_limits_decide_the_branch():
    leg = MAMMAL._replace(q_min=np.array([-1.0, -2.0, 0.3]), q_max=np.array([1.0, 2.0, 2.5]))
    assert stance.nominal_branch(leg, stance.nominal_foot(leg)) == KNEE_BEFORE


def test_a_home_pose_decides_where_it_stands():
    foot = stance.nominal_foot(MAMMAL)
    assert stance.nominal_branch(MAMMAL, foot, np.array([0.0, -0.9, 1.8])) == KNEE_BEFORE
    for useless in ([0.0, 0.0, 0.0], [0.0, np.pi, 1.8], [9.0, -0.9, 1.8]):
        assert stance.nominal_branch(MAMMAL, foot, np.array(useless)) == KNEE_BEHIND


def test_no_branch_where_the_foot_is_out_of_reach():
    lopsided = np.array([[0.0, 0.1, 0.0], [0.0, 0.0, -1.0], [0.0, 0.0, -0.05]])
    leg = MAMMAL._replace(offset=lopsided)
    assert stance.nominal_branch(leg, stance.nominal_foot(leg)) is None


def test_down_in_shank_is_where_the_foot_presses():
    """Stretched straight down the ground is along the shank; bent by q₃ it is q₃ aside."""
    q = np.array([0.0, 0.0, 0.5])
    assert stance.down_in_shank(MAMMAL, q) == pytest.approx([np.sin(0.5), 0.0, -np.cos(0.5)])
