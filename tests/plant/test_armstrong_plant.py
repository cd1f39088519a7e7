"""The thesis's plant: as MuJoCo in the air, by the laws on the ground; robots stand and walk on it."""

import json
import subprocess
import sys
from dataclasses import replace
from functools import cache

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gaitwright.cli import main
from gaitwright.dynamics.tree_laws import energy
from gaitwright.errors import WrongUse
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.locomotion import Brain
from gaitwright.numerics.geometry import GRAVITY, rotation
from gaitwright.plant.armstrong.build import any_poses, stance_pose, state_of, system_of
from gaitwright.plant.armstrong.contact import NOWHERE, SLOTS, contact_forces
from gaitwright.plant.armstrong.integrators import METHODS, advance
from gaitwright.plant.armstrong.joints import guides, hinge_states, relative, worst_sag
from gaitwright.plant.armstrong.rotors import newton_matrix
from gaitwright.plant.armstrong.simulation import ArmstrongPlant
from gaitwright.plant.armstrong.stiffness import row_mobility, stiffest_mode
from gaitwright.plant.armstrong.system import at_rest, mobility_of_hinges, parts, rotations
from gaitwright.plant.armstrong.touch_planes import Ground
from gaitwright.plant.closure import Closure
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.plant.registry import make_plant
from gaitwright.record.recording import Recording
from gaitwright.session import walk
from gaitwright.signals import Mission, Torques
from gaitwright.skills.chooser import fixed_skill
from gaitwright.skills.library import LIBRARY, speed_scale
from oracles import robot_called

FLAT = load_scene("flat")


def pull(tau: np.ndarray) -> Torques:
    return Torques(tau, np.zeros_like(tau), 0.0)


def off(robot) -> Torques:
    return pull(np.zeros((robot.n, 3)))


def hold(plant, skill: str, seconds: float, seed: int = 0, watch=None) -> Recording:
    chooser = fixed_skill(plant.robot, skill, None, 0.0, 0.0, "numerical")
    brain = Brain.of(plant.robot, plant.scene, chooser, plant.dt)
    return walk(brain, plant, Mission(()), seconds, seed, watch=watch)


@cache
def both_on_a_slope(name: str) -> tuple[ArmstrongPlant, MujocoPlant]:
    """A robot on both plants."""
    robot, scene = robot_called(name), replace(load_scene("cross-slope:5"), start=(1.0, -0.5, 0.3))
    return ArmstrongPlant(robot, scene), MujocoPlant(robot, scene)


# --- the doors that every plant has ---------------------------------------------------------------
@pytest.mark.parametrize("name", ["thesis", "go2", "dog", "insect"])
@settings(max_examples=3)
@given(seed=st.integers(0, 10**6))
def test_it_starts_as_mujoco_does(name: str, seed: int) -> None:
    ours, theirs = (plant.reset(seed) for plant in both_on_a_slope(name))
    for field in ("position_w", "orientation_wb", "velocity_w", "angular_velocity_b", "q", "qd"):
        np.testing.assert_allclose(getattr(ours, field), getattr(theirs, field), atol=1e-9, err_msg=field)


def test_a_plant_is_asked_for_by_name() -> None:
    robot = robot_called("thesis")
    assert isinstance(make_plant("mujoco", robot, FLAT, timestep=0.001), MujocoPlant)
    plant = make_plant("armstrong", robot, FLAT, integrator="rk4", timestep=0.0002, check=True)
    assert isinstance(plant, ArmstrongPlant)
    assert (plant.integrator, plant.timestep, plant.check) == ("rk4", 0.0002, True)
    for words, sentence in (
        ({"name": "bullet"}, "no plant 'bullet'; there is: mujoco, armstrong, kinematic"),
        ({"name": "mujoco", "integrator": "rk4"}, "'rk4' goes with plant armstrong"),
        (
            {"name": "mujoco", "timestep": 0.0015},
            "a step of 1.5 ms does not divide the control period of 2 ms",
        ),
        (
            {"name": "armstrong", "timestep": 0.003},
            "a step of 3 ms does not divide the control period of 2 ms",
        ),
        (
            {"name": "mujoco", "refresh": 2},
            "plant mujoco has no slow coefficients to refresh at every 2. step",
        ),
        ({"name": "armstrong", "refresh": 0}, "refreshed every 1, 2, 3 … steps, not every 0"),
        ({"name": "armstrong", "integrator": "eulr"}, "no integrator 'eulr'.*did you mean 'euler'?"),
    ):
        with pytest.raises(WrongUse, match=sentence):
            make_plant(**words, robot=robot, scene=FLAT)


@pytest.mark.parametrize("name", ["mujoco", "armstrong"])
def test_numbers_that_no_plant_can_do_are_refused(name: str) -> None:
    robot = robot_called("thesis")
    for step, sentence in (
        (1e-300, r"a step of 1e-297 ms is asked; the least is 0.0002 ms"),
        (1e-320, r"the least is 0.0002 ms"),
        (1.9e-7, r"a step of 0.00019 ms is asked; the least is 0.0002 ms"),
        (0.0, "a step of 0 ms is asked; steps are finite and greater than 0"),
        (np.nan, "a step of nan ms is asked"),
        (np.inf, "a step of inf ms is asked"),
    ):
        with pytest.raises(WrongUse, match=sentence):
            make_plant(name, robot, FLAT, timestep=float(step))
    plant = make_plant(name, robot, FLAT, timestep=0.0001)
    for force in ((np.nan, 0.0, 0.0), (0.0, -np.inf, 0.0)):
        with pytest.raises(WrongUse, match="forces are finite numbers"):
            plant.push(force)
    assert plant.step(off(robot)).is_finite()


@pytest.mark.parametrize("tolerance", [0.0, -1e-4, np.nan, np.inf])
def test_a_tolerance_that_is_none_is_refused(tolerance: float) -> None:
    with pytest.raises(WrongUse, match="it is finite and greater than 0"):
        ArmstrongPlant(robot_called("thesis"), FLAT, integrator="adaptive", tolerance=float(tolerance))


def test_older_slow_coefficients_move_it_almost_alike() -> None:
    robot = robot_called("thesis")
    fresh, old = (hold(make_plant("armstrong", robot, FLAT, refresh=n), "walk", 0.2)["q"][-1] for n in (1, 4))
    assert 0.0 < np.abs(fresh - old).max() < 1e-3


def test_it_needs_no_mujoco() -> None:
    program = (
        "import sys; sys.path[:0] = sys.argv[1:]\n"
        "from gaitwright.ground.scene import load_scene\n"
        "from gaitwright.plant.registry import make_plant\n"
        "from robots_by_hand import dog\n"
        "plant = make_plant('armstrong', dog(), load_scene('flat'))\n"
        "print(plant.reset(1).is_finite(), 'mujoco' in sys.modules)"
    )
    told = [sys.executable, "-c", program, *sys.path]
    done = subprocess.run(told, capture_output=True, text=True, timeout=300, check=True)
    assert done.stdout.split() == ["True", "False"]


def test_equal_seeds_are_equal_to_the_bit_and_a_plant_forgets() -> None:
    plant = ArmstrongPlant(robot_called("thesis"), FLAT)
    one, again = hold(plant, "walk", 0.3, 5), hold(plant, "walk", 0.3, 5)
    fresh = hold(ArmstrongPlant(plant.robot, FLAT), "walk", 0.3, 5)
    other = hold(plant, "walk", 0.3, 6)
    assert one.report().state_hash == again.report().state_hash == fresh.report().state_hash
    assert one.report().state_hash != other.report().state_hash


def test_torques_are_limited_and_no_numbers_stop_the_motors() -> None:
    plant = ArmstrongPlant(robot_called("thesis"), FLAT)
    much, broken = np.full((4, 3), 1e3), np.full((4, 3), 5.0)
    broken[2, 1] = np.nan
    plant.step(pull(much))
    np.testing.assert_array_equal(plant.drive.motor, plant.robot.tau_max.ravel())
    assert plant.step(pull(broken)).is_finite()
    np.testing.assert_array_equal(plant.drive.motor, 0.0)


def test_a_state_that_is_no_number_is_sensed_as_such() -> None:
    for integrator in METHODS:
        plant = ArmstrongPlant(robot_called("thesis"), FLAT, integrator=integrator)
        parts(plant.system, plant.state).v[:] = np.nan
        assert not plant.step(off(plant.robot)).is_finite()


# --- hinges out of ball joints --------------------------------------------------------------------
@pytest.mark.parametrize("name", ["thesis", "go2", "dog", "insect", "hexapod"])
@settings(max_examples=10)
@given(data=st.data())
def test_the_angles_of_a_pose_are_read_off_its_ball_joints(name: str, data) -> None:
    robot = robot_called(name)
    system = system_of(robot, 0.8)
    rng = np.random.default_rng(data.draw(st.integers(0, 10**6)))
    q = rng.uniform(robot.q_min, robot.q_max)
    quaternion = rng.normal(size=4)
    y = state_of(robot, system, np.zeros(3), rotation(quaternion), q)
    R = rotations(parts(system, y).quaternion)
    read, rates = hinge_states(system.tree, system.joints, R, parts(system, y).w)
    np.testing.assert_allclose(read.reshape(-1, 3), q, atol=1e-6)
    np.testing.assert_array_equal(rates, 0.0)
    assert worst_sag(system.tree, system.joints, R) < 1e-6


def in_the_air(plant, height: float) -> None:
    """Lifts a robot off the ground."""
    if isinstance(plant, MujocoPlant):
        plant.data.qpos[2] += height
        mujoco.mj_forward(plant.model, plant.data)
    else:
        parts(plant.system, plant.state).x[2] += height


@pytest.mark.parametrize(("name", "share"), [("thesis", 0.25), ("go2", 0.15), ("dog", 0.15)])
def test_in_the_air_it_moves_as_mujoco_moves_it(name: str, share: float, rng: np.random.Generator) -> None:
    """Motors, gravity, rotors and viscous friction: hinges of ball joints against real ones, for 0.2 s.

    Dry friction differs: MuJoCo's is a soft constraint.
    """
    robot = robot_called(name)
    robot = replace(robot, friction=np.zeros_like(robot.friction))
    tau = share * robot.tau_max * rng.uniform(-1.0, 1.0, (robot.n, 3))
    ends, fastest = [], 0.0
    for plant in (ArmstrongPlant(robot, FLAT), MujocoPlant(robot, FLAT, timestep=0.0005)):
        plant.reset(vary=False)
        in_the_air(plant, 5.0 * robot.height)
        for k in range(100):
            sensed = plant.step(pull(tau * np.cos(0.05 * k)))
            fastest = max(fastest, np.abs(sensed.qd).max())
        ends.append(sensed)
    ours, theirs = ends
    assert fastest > 1.0
    np.testing.assert_allclose(ours.q, theirs.q, atol=2e-3)
    np.testing.assert_allclose(ours.qd, theirs.qd, atol=0.02 * fastest)
    np.testing.assert_allclose(ours.angular_velocity_b, theirs.angular_velocity_b, atol=0.02 * fastest)
    np.testing.assert_allclose(rotation(ours.orientation_wb), rotation(theirs.orientation_wb), atol=1e-3)


def test_springs_make_no_energy() -> None:
    """Guides without dampers: what the links lose, the springs hold."""
    robot = robot_called("thesis")
    system = system_of(robot, 0.8)
    joints = system.joints._replace(
        guide_damping=np.zeros_like(system.joints.guide), stop=0.0 * system.joints.stop,
        stop_damping=0.0 * system.joints.stop,
    )  # fmt: skip
    system = system._replace(joints=joints, gravity=np.zeros(3))
    y = state_of(robot, system, *stance_pose(robot))
    parts(system, y).w[:] = np.random.default_rng(2).normal(0.0, 0.5, (9, 3))

    def total(y: np.ndarray) -> tuple[float, float]:
        p = parts(system, y)
        R = rotations(p.quaternion)
        held = 0.0
        for j in range(len(joints.link)):
            s1, _, s2, _ = guides(joints.kind[j], relative(system.tree, joints, j, R))
            held += 0.5 * (joints.guide[j, 0] * s1**2 + joints.guide[j, 1] * s2**2)
        return sum(energy(system.tree, R, p.x, p.v, p.w, system.gravity)) + held, held

    before, _ = total(y)
    most = 0.0
    for _ in range(20):
        advance(system, at_rest(system), y, METHODS["rk4"], 5e-5, 0.005, 1, 1e-6)
        after, held = total(y)
        most = max(most, held)
        assert after == pytest.approx(before, rel=1e-6)
    assert most > 0.01 * before


def test_a_joint_limit_holds() -> None:
    robot = robot_called("thesis")
    plant = ArmstrongPlant(robot, FLAT)
    plant.reset(vary=False)
    in_the_air(plant, 50.0)
    for _ in range(400):
        sensed = plant.step(pull(np.tile([0.0, 30.0, 20.0], (4, 1))))
    assert (sensed.q <= robot.q_max + 0.02).all()
    assert (sensed.q >= robot.q_min - 0.02).all()
    assert (robot.q_max - sensed.q)[:, 1:].min() < 0.02, "some joint has come to its limit"


# --- steps ---------------------------------------------------------------------------------------
@pytest.mark.parametrize("integrator", ["euler", "semi-implicit", "rk4"])
def test_a_step_that_is_too_long_is_refused_with_the_joint_and_the_longest(integrator: str) -> None:
    with pytest.raises(WrongUse) as told:
        ArmstrongPlant(robot_called("thesis"), FLAT, integrator=integrator, timestep=0.002)
    words = str(told.value)
    assert words.startswith("leg FL, hip: the spring at its limits needs steps of at most 0.")
    assert words.endswith(f"ms with {integrator} integration; 2 ms asked")
    longest = float(words.partition("at most ")[2].partition(" ms")[0]) * 1e-3
    safe = ArmstrongPlant(robot_called("thesis"), FLAT, integrator=integrator)
    step = safe.timestep or 0.0
    assert step <= 1.02 * longest < 2 * step


@pytest.mark.parametrize("integrator", ["euler", "semi-implicit", "rk4"])
def test_the_longest_step_is_where_small_motions_begin_to_grow(integrator: str) -> None:
    """In the air, shaken a little: quiet at 0.9 of that step, wild at 1.3 of it."""
    robot = robot_called("go2")
    system = system_of(robot, 0.8)
    joints, none = system.joints, np.zeros(12)
    # Without what pulls only beyond a limit, along a motion, or on the ground.
    always = joints._replace(stop=none, stop_damping=none, dry=none)
    feet = system.feet._replace(stiffness=np.zeros(4), damping=np.zeros(4))
    system = system._replace(joints=always, feet=feet, gravity=np.zeros(3))
    pose, method = any_poses(robot, system)[0], METHODS[integrator]
    longest = stiffest_mode(system, [pose]).longest_step(method, 0.01)
    newton = newton_matrix(mobility_of_hinges(system, pose), joints.rotor)
    grown = []
    for share in (0.9, 1.3):
        y = pose.copy()
        parts(system, y).w[:] = np.random.default_rng(0).normal(0.0, 1e-6, (13, 3))
        drive = at_rest(system)._replace(newton=newton)
        advance(system, drive, y, method, share * longest, 400 * share * longest, 1, 1e-6)
        grown.append(np.abs(parts(system, y).w).max() / 1e-6)
    assert grown[0] < 30.0
    assert not grown[1] < 1e4


def test_the_mobility_is_symmetric_and_positive() -> None:
    """A unit load on one row moves another as much as the other way round (Maxwell)."""
    for name in ("thesis", "go2"):
        robot = robot_called(name)
        system = system_of(robot, 0.8)
        for y in any_poses(robot, system)[:3]:
            Y = row_mobility(system, y)
            np.testing.assert_allclose(Y, Y.T, atol=1e-9 * np.abs(Y).max())
            assert np.linalg.eigvalsh(Y).min() > -1e-9 * np.abs(Y).max()


# --- ground --------------------------------------------------------------------------------------
def test_what_stands_weighs_what_it_weighs_and_does_not_creep() -> None:
    plant = ArmstrongPlant(robot_called("thesis"), replace(FLAT, friction=0.6))
    feet = []
    record = hold(plant, "stand", 3.0, 1, watch=lambda lap: feet.append(plant.centres.copy()))
    assert record.done and not record.fell
    weight = plant.robot.total_mass * GRAVITY
    np.testing.assert_allclose(record["load"][-250:].sum(axis=1), weight, rtol=0.01)
    assert np.abs(feet[-1] - feet[-501])[:, :2].max() < 1e-3


def test_friction_is_coulombs() -> None:
    """A foot that slides is held by μ N against its motion; one that hardly moved, by less."""
    system = system_of(robot_called("thesis"), 0.5)
    planes = np.tile([0.0, 0.0, NOWHERE, 0.0, 0.0, 1.0], (SLOTS * 4, 1))
    at, R = np.zeros((9, 3)), np.tile(np.eye(3), (9, 1, 1))
    at[2] = -system.feet.at[0] + (0.0, 0.0, 0.048)  # foot 0 is 2 mm deep
    planes[0, 2] = 0.0
    for speed, share in ((1.0, 1.0), (1e-4, None)):
        force, moment, rate = np.zeros((3, 9, 3))
        rate[2] = 0.6 * speed, -0.8 * speed, 0.0
        slip = np.zeros((SLOTS * 4, 3))
        load = contact_forces(system.feet, planes, slip, R, at, rate, np.zeros((9, 3)), force, moment)
        assert load[0] == pytest.approx(0.002 * system.feet.stiffness[0])
        held = np.linalg.norm(force[2, :2]) / load[0]
        np.testing.assert_allclose(force[2, :2] / np.linalg.norm(force[2, :2]), [-0.6, 0.8], atol=1e-12)
        assert held == pytest.approx(0.5) if share else held < 0.01


@settings(max_examples=30)
@given(st.integers(0, 10**6))
def test_the_plane_of_a_box_is_that_of_its_nearest_point(seed: int) -> None:
    rng = np.random.default_rng(seed)
    boxes = tuple(
        Box(*rng.uniform(-1, 1, 2), rng.uniform(-3, 3), *rng.uniform(0.2, 0.8, 2), 0.4) for _ in range(3)
    )
    centre = rng.uniform([-1.5, -1.5, 0.0], [1.5, 1.5, 0.8], (4, 3))
    planes = Ground.of(Scene("boxes", Flat(), boxes)).planes(centre).reshape(4, SLOTS, 6)
    np.testing.assert_allclose(planes[:, 0, 2], 0.0)
    np.testing.assert_allclose(np.linalg.norm(planes[:, :, 3:], axis=2), 1.0)
    gap = np.einsum("fi,fi->f", centre - planes[:, 1, :3], planes[:, 1, 3:])
    outside = [nearest(boxes, c) for c in centre]
    for own, known in zip(gap, outside, strict=True):
        assert own == pytest.approx(known, abs=1e-9) if known > 0.0 else own <= 0.0


def test_two_boxes_side_by_side_push_once() -> None:
    robot = robot_called("thesis")
    tiles = tuple(Box(x, 0.0, 0.0, 1.0, 4.0, 0.1) for x in (-0.5, 0.5, 1.5, -1.5))
    for shift in (0.0, 0.003):
        ahead = float(robot.nominal_feet[:, 0].max()) + shift
        scene = Scene("tiles", Flat(), tiles, start=(-ahead, 0.0, 0.0))
        plant = ArmstrongPlant(robot, scene)
        plant.reset(vary=False)
        planes = plant.ground.planes(plant.centres).reshape(robot.n, SLOTS, 6)
        on_seam = int(np.abs(plant.centres[:, 0]).argmin())
        near = planes[on_seam, :, 2] > NOWHERE / 2
        assert near.sum() == 2  # the floor below, and one of the two tiles
        load = hold(plant, "stand", 1.5)["load"][-100:].sum(axis=1)
        np.testing.assert_allclose(load, robot.total_mass * GRAVITY, rtol=0.02)


def test_a_foot_in_the_corner_of_a_stair_touches_tread_and_riser() -> None:
    scene = load_scene("stairs:0.1")
    edge = min(box.x - box.lx / 2 for box in scene.boxes[1:])
    planes = Ground.of(scene).planes(np.tile([edge - 0.02, 0.0, 0.12], (4, 1)))[:SLOTS]
    touched = {tuple(np.round(plane[3:]) + 0.0): plane for plane in planes[1:]}
    assert touched[0.0, 0.0, 1.0][2] == pytest.approx(0.1)
    assert touched[-1.0, 0.0, 0.0][0] == pytest.approx(edge)


def nearest(boxes: tuple[Box, ...], centre: np.ndarray) -> float:
    """Distance of a point from the nearest box, 0 inside [m]."""
    out = []
    for b in boxes:
        c, s = np.cos(b.yaw), np.sin(b.yaw)
        x, y = c * (centre[0] - b.x) + s * (centre[1] - b.y), c * (centre[1] - b.y) - s * (centre[0] - b.x)
        beyond = np.maximum([abs(x) - b.lx / 2, abs(y) - b.ly / 2, centre[2] - b.height], 0.0)
        out.append(float(np.linalg.norm(beyond)))
    return min(out)


# --- robots on it ---------------------------------------------------------------------------------
def test_the_thesis_robot_walks_at_its_speed() -> None:
    plant = ArmstrongPlant(robot_called("thesis"), replace(FLAT, bounds=(-9.0, -9.0, 30.0, 9.0)))
    system, sag = plant.system, []

    def watch(lap) -> None:
        sag.append(worst_sag(system.tree, system.joints, rotations(parts(system, plant.state).quaternion)))

    record = hold(plant, "walk", 6.0, 3, watch)
    assert record.done and not record.fell
    ahead = np.array([rotation(turn)[:2, 0] for turn in record["orientation_wb"][1500:]])
    wanted = LIBRARY["walk"].speed * speed_scale(plant.robot)
    assert (record["velocity_w"][1500:, :2] * ahead).sum(axis=1).mean() == pytest.approx(wanted, rel=0.1)
    assert np.abs(record["tau"] / plant.robot.tau_max.ravel()).max() <= 1.0
    assert max(sag) < 0.03


def test_the_integrators_agree_on_a_walk() -> None:
    """They part as their errors do; before the first touchdown by little."""
    robot = robot_called("thesis")
    ends = [
        hold(ArmstrongPlant(robot, FLAT, integrator=name), "walk", 0.3)["position_w"][-1] for name in METHODS
    ]
    np.testing.assert_allclose(ends, np.tile(ends[2], (4, 1)), atol=2e-3)


def test_go2_trots_on_it_as_on_mujoco() -> None:
    robot = robot_called("go2")
    ours, theirs = (
        hold(plant, "trot", 1.5) for plant in (ArmstrongPlant(robot, FLAT), MujocoPlant(robot, FLAT))
    )
    assert ours.done and not ours.fell
    speeds = [record["velocity_w"][400:, 0].mean() for record in (ours, theirs)]
    assert speeds[0] == pytest.approx(speeds[1], rel=0.05)


def test_a_push_moves_it_as_newton_says() -> None:
    plant = ArmstrongPlant(robot_called("thesis"), FLAT)
    plant.reset(vary=False)
    in_the_air(plant, 50.0)
    closure = Closure(plant.robot, plant.dt)
    plant.push((0.0, 20.0, 0.0))
    first = closure.centre_of_mass(plant.sense())
    for _ in range(100):
        sensed = plant.step(off(plant.robot))
    moved = closure.centre_of_mass(sensed) - first
    np.testing.assert_allclose(
        moved, [0.0, 0.5 * 2.0 * 0.2**2, -0.5 * GRAVITY * 0.2**2], rtol=0.01, atol=1e-6
    )


# --- checks that run ------------------------------------------------------------------------------
def test_the_recursion_is_checked_while_it_runs() -> None:
    plant = ArmstrongPlant(robot_called("thesis"), FLAT, check=True)
    hold(plant, "walk", 0.2)
    assert 0.0 < plant.worst_residual < 1e-10
    parts(plant.system, plant.state).v[:] = np.nan
    plant.step(off(plant.robot))
    plant.reset()
    assert plant.worst_residual == 0.0
    parts(plant.system, plant.state).w[:] = np.nan
    for _ in range(2):
        plant.step(off(plant.robot))
    assert np.isnan(plant.worst_residual)


def test_the_closure_sees_what_the_controller_did_not_want() -> None:
    robot = robot_called("thesis")
    plant, sizes = ArmstrongPlant(robot, FLAT), []
    for shove in (0.0, 30.0):
        closure = Closure(robot, plant.dt)

        def watch(lap, closure=closure, shove=shove) -> None:
            closure.add(lap.sensed, lap.command)
            plant.push((shove, 0.0, 0.0))

        hold(plant, "stand", 1.0, watch=watch)
        sizes.append(np.median(closure.differences()[300:]))
    assert sizes[0] < 0.1
    share = sizes[1] / (30.0 / robot.total_mass)
    assert 0.5 < share < 1.1, "stiff joints take a part of the shove that nobody foresaw, not most of it"


# --- on the command line --------------------------------------------------------------------------
def test_the_command_line_walks_on_it_and_reports_the_checks(capsys: pytest.CaptureFixture[str]) -> None:
    words = [
        "skill",
        "--robot",
        "thesis",
        "--skill",
        "walk",
        "--plant",
        "armstrong",
        "--seconds",
        "0.2",
        "--check",
    ]
    assert main(words) == 0
    out = capsys.readouterr().out
    assert "recursion" in out and "off the closed form by" in out
    assert "centre of mass off by" in out
    assert "recursion of the controller" in out and "(worst of 3)" in out
    assert "dearest limit" in out


@pytest.mark.parametrize("more", [[], ["--plant", "armstrong", "--refresh", "2"]])
def test_the_checks_are_figures_too(more: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    words = ["skill", "--robot", "thesis", "--skill", "walk", "--seconds", "0.3", "--json", "-", *more]
    assert main(words) == 0
    bare = json.loads(capsys.readouterr().out)
    assert main([*words, "--check"]) == 0
    report = json.loads(capsys.readouterr().out)
    checks = report.pop("checks")
    assert report.keys() == bare.keys() and report["state_hash"] == bare["state_hash"]
    assert checks["recursion_compared"] == 4
    assert 0.0 < checks["recursion_worst"] < 1e-9
    assert checks["motion_off_worst_mps2"] >= checks["motion_off_median_mps2"] > 0.0
    assert (checks["plant_recursion_worst"] is None) == (not more)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (
            ["--plant", "armstrng"],
            "no plant 'armstrng'; there is: mujoco, armstrong, kinematic; did you mean 'armstrong'?",
        ),
        (
            ["--plant", "armstrong", "--integrator", "rk5"],
            "no integrator 'rk5'; there is: euler, semi-implicit",
        ),
        (["--integrator", "rk4"], "'rk4' goes with plant armstrong"),
        (["--plant", "armstrong", "--timestep", "0.001"], "its restorative spring needs steps of at most 0."),
        (["--refresh", "2"], "plant mujoco has no slow coefficients to refresh at every 2. step"),
        (["--refresh", "0"], "'0' is not a whole number from 1"),
        (["--timestep", "1e-300"], "a step of 1e-297 ms is asked; the least is 0.0002 ms"),
        (["--timestep", "-1"], "-1 is not greater than 0"),
    ],
)
def test_what_does_not_fit_is_one_sentence(words, sentence: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["skill", "--seconds", "0.1", *words]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1
    assert sentence in err
