"""Perturbed robots: within what was asked, symmetric, physical, and standing as a file's robot would."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from gaitwright.description.load import load_robot
from gaitwright.description.validate import check
from gaitwright.errors import WrongUse
from gaitwright.model.kinematics import angles, feet
from gaitwright.model.perturb import perturbed, stretched
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY

NAMES = ("go2", "thesis", "hexapod")
SEEDS = st.integers(0, 2**32)
ROBOTS = {name: load_robot(name) for name in NAMES}


@pytest.fixture(params=NAMES, scope="module")
def robot(request) -> Robot:
    return ROBOTS[request.param]


def test_nothing_changes_where_nothing_may(robot: Robot):
    same = perturbed(robot, 3, most=0.0)
    for field, value in vars(robot).items():
        if isinstance(value, np.ndarray | float):
            np.testing.assert_allclose(getattr(same, field), value, rtol=1e-12, atol=1e-12, err_msg=field)


@given(seed=SEEDS, name=st.sampled_from(NAMES), most=st.floats(0.0, 0.5))
def test_what_is_drawn_is_within_what_was_asked(seed: int, name: str, most: float):
    robot = ROBOTS[name]
    new = perturbed(robot, seed, most)
    check(new)

    def share(field: str) -> np.ndarray:
        old = np.asarray(getattr(robot, field), dtype=float)
        return (np.asarray(getattr(new, field), dtype=float) / np.where(old == 0.0, np.nan, old)).ravel()

    lengths = np.linalg.norm(new.offset, axis=2) / np.maximum(np.linalg.norm(robot.offset, axis=2), 1e-12)
    spacing = np.ptp(new.hip[:, :2], axis=0) / np.ptp(robot.hip[:, :2], axis=0)
    for factors in (share("base_mass"), share("mass"), lengths[:, 1:].ravel(), spacing):
        known = factors[np.isfinite(factors)]
        assert (known >= 1.0 - most - 1e-9).all()
        assert (known <= 1.0 + most + 1e-9).all()
    for kept in ("tau_max", "q_min", "q_max", "foot_radius", "armature"):
        assert (getattr(new, kept) == getattr(robot, kept)).all()


@given(seed=SEEDS, name=st.sampled_from(NAMES))
def test_it_stands_level_on_legs_alike_left_and_right(seed: int, name: str):
    new = perturbed(ROBOTS[name], seed)
    q, reached = angles(new, new.stance)
    assert reached.all()
    np.testing.assert_allclose(feet(new, q), new.stance, atol=1e-9)
    old = ROBOTS[name].stance[:, 2]
    assert np.ptp(new.stance[:, 2]) == pytest.approx(np.ptp(old), abs=1e-9)
    np.testing.assert_allclose(
        new.mass[::2] * ROBOTS[name].mass[1::2], new.mass[1::2] * ROBOTS[name].mass[::2], atol=1e-12
    )
    assert new.total_mass * GRAVITY == pytest.approx(new.measures[0])


@given(seed=SEEDS, name=st.sampled_from(NAMES))
def test_inertias_stay_those_of_bodies(seed: int, name: str):
    try:
        new = perturbed(ROBOTS[name], seed, 0.5)
    except WrongUse:  # links so changed that the robot cannot stand on them
        assume(False)
    tensors = [new.base_inertia, *new.inertia.reshape(-1, 3, 3)]
    for old, tensor in zip(
        [ROBOTS[name].base_inertia, *ROBOTS[name].inertia.reshape(-1, 3, 3)], tensors, strict=True
    ):
        a, b, c = np.linalg.eigvalsh(tensor)
        slack = min(0.0, np.linalg.eigvalsh(old) @ [1.0, 1.0, -1.0])  # rounded files may lie outside a bit
        assert a + b >= c + 4.0 * slack - 1e-12


def test_a_stretched_cloud_of_points_has_the_stretched_inertia(rng: np.random.Generator):
    points, factors = rng.normal(size=(20, 3)), rng.uniform(0.5, 1.5, 3)

    def inertia(p: np.ndarray) -> np.ndarray:
        return (p**2).sum() * np.eye(3) - p.T @ p

    np.testing.assert_allclose(stretched(inertia(points), factors), inertia(points * factors), rtol=1e-12)


def test_a_seed_tells_one_robot_from_another(robot: Robot):
    first, again, other = (perturbed(robot, seed) for seed in (1, 1, 2))
    assert (first.packed == again.packed).all()
    assert (first.packed != other.packed).any()
    assert first.name == f"{robot.name}~1"


def test_what_cannot_be_drawn_is_refused(robot: Robot):
    with pytest.raises(WrongUse, match=r"up to 0\.7 of each number"):
        perturbed(robot, 0, 0.7)
    with pytest.raises(WrongUse, match="seed -1"):
        perturbed(robot, -1)
