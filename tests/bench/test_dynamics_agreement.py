"""What the bench says about agreement: foreign engines and a closed form agree, another robot does not."""

from dataclasses import replace

import numpy as np
import pytest

from gaitwright.bench.evidence import dynamics_agreement
from gaitwright.bench.evidence.dynamics_agreement import (
    armstrong_agreement,
    closed_form_agreement,
    direct_agreement,
    inverse_agreement,
)
from gaitwright.bench.evidence.oracles import pinocchio
from gaitwright.description.load import load_robot
from oracles import NEEDS_PINOCCHIO


@pytest.fixture(autouse=True)
def few(monkeypatch) -> None:
    """A handful of states."""
    monkeypatch.setattr(dynamics_agreement, "STATES", 10)


@NEEDS_PINOCCHIO
@pytest.mark.parametrize("name", ["go2", "thesis", "hexapod"])
def test_all_ways_to_the_same_motion_agree(name: str) -> None:
    pin = pinocchio()
    robot = load_robot(name)
    figures = [inverse_agreement(pin, robot, 1), direct_agreement(pin, robot, 1)]
    figures += [closed_form_agreement(robot, 1), *armstrong_agreement(pin, robot, 1)]
    assert all(figure.reached for figure in figures), [(f.what, f.measured) for f in figures]


@NEEDS_PINOCCHIO
def test_another_robot_is_found_out(monkeypatch) -> None:
    """A link that is a thousandth heavier shows."""
    pin = pinocchio()
    robot = load_robot("go2")
    heavier = replace(robot, base_mass=1.001 * robot.base_mass)
    model, ball = dynamics_agreement.hinge_model, dynamics_agreement.ball_model
    monkeypatch.setattr(dynamics_agreement, "hinge_model", lambda _: model(heavier))
    tree, _ = dynamics_agreement.ball_tree(heavier)
    monkeypatch.setattr(dynamics_agreement, "ball_model", lambda _, gravity: ball(tree, gravity))
    figures = [inverse_agreement(pin, robot, 1), direct_agreement(pin, robot, 1)]
    figures += armstrong_agreement(pin, robot, 1)
    assert not any(figure.reached for figure in figures)
    assert all(np.isfinite(figure.measured) for figure in figures)
