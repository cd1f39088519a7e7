"""The physics world is the robot's own numbers and the scene's own ground."""

from dataclasses import replace
from pathlib import Path
from xml.etree.ElementTree import Element, tostring

import mujoco
import numpy as np
import pytest

from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Slope, Surface
from gaitwright.model.kinematics import angles, feet
from gaitwright.model.robot import Robot
from gaitwright.plant.mujoco import terrain_geoms as ground
from gaitwright.plant.mujoco.mjcf import child
from gaitwright.plant.mujoco.simulation import MujocoWorld
from gaitwright.plant.mujoco.world import Placed, build_world
from gaitwright.signals import MotorCommand
from oracles import robot_called
from robots_by_hand import dog, insect

ROBOTS = pytest.mark.parametrize("robot", [dog(), insect()], ids=["dog", "insect"])


@ROBOTS
def test_mass_order_and_feet_are_the_robots_own(robot: Robot) -> None:
    model = build_world([Placed(robot)], load_scene("flat"))
    data = mujoco.MjData(model)
    assert model.body_subtreemass[0] == pytest.approx(robot.total_mass, abs=1e-12)
    assert (model.nq, model.nv, model.nu, model.nsensordata) == (19, 18, 12, 4)
    assert model.joint(1).name == "FL_hip1" and model.joint(12).name == "RR_knee"
    q = np.random.default_rng(0).uniform(-1, 1, (4, 3))
    data.qpos[:7], data.qpos[7:] = [0, 0, 0, 1, 0, 0, 0], q.ravel()
    mujoco.mj_kinematics(model, data)
    np.testing.assert_allclose(data.site_xpos, feet(robot, q), atol=1e-12)


@ROBOTS
def test_motors_joints_and_options_are_as_asked(robot: Robot) -> None:
    model = build_world([Placed(robot)], replace(load_scene("flat"), friction=0.4), timestep=0.001)
    np.testing.assert_array_equal(model.actuator_ctrlrange[:, 1].reshape(4, 3), robot.tau_max)
    np.testing.assert_array_equal(model.jnt_range[1:].reshape(4, 3, 2)[..., 0], robot.q_min)
    np.testing.assert_array_equal(model.dof_armature[6:].reshape(4, 3), robot.armature)
    np.testing.assert_array_equal(model.geom_friction[:, 0], 0.4)
    assert model.opt.timestep == 0.001
    assert model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_AUTORESET


def held(robot: Robot, scene: Scene, seconds: float) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """A robot set on its feet, its joints held by springs."""
    model = build_world([Placed(robot)], scene)
    data = mujoco.MjData(model)
    rest = angles(robot, robot.nominal_feet)[0].ravel()
    data.qpos[7:] = rest
    for _ in range(round(seconds / model.opt.timestep)):
        data.ctrl[:] = 60.0 * (rest - data.qpos[7:]) - 1.5 * data.qvel[6:]
        mujoco.mj_step(model, data)
    return model, data


def test_the_touch_sensors_carry_the_weight() -> None:
    robot = dog()
    _, data = held(robot, load_scene("flat"), 1.5)
    assert data.sensordata.sum() == pytest.approx(robot.total_mass * 9.81, rel=1e-3)
    assert np.all(data.sensordata > 0.0)
    assert data.ncon == 4


def test_numbers_that_blow_up_stay_visible(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)  # MuJoCo writes its warnings into the working folder
    model = build_world([Placed(dog())], load_scene("flat"))
    data = mujoco.MjData(model)
    data.qvel[0] = np.nan
    mujoco.mj_step(model, data)
    assert np.isnan(data.qpos).any()


def test_the_trunk_meets_a_block_and_no_robot_part_meets_another() -> None:
    robot = dog()
    wall = Scene("wall", load_scene("flat").surface, (Box(0.0, 0.0, 0.3, 0.2, 0.2, 0.29),))
    model = build_world([Placed(robot)], wall)
    data = mujoco.MjData(model)
    data.qpos[2] = robot.height
    data.qpos[7:] = np.random.default_rng(1).uniform(-2, 2, 12)
    mujoco.mj_forward(model, data)
    owners = [{model.geom(int(geom)).bodyid[0] for geom in pair} for pair in data.contact.geom]
    names = [{model.geom(int(geom)).name for geom in pair} for pair in data.contact.geom]
    assert {"trunk", "box_0"} in names
    assert all(0 in owner for owner in owners)


class Wave(Surface):
    """Ground that MuJoCo has no shape for."""

    def height(self, x, y):
        return 0.1 * np.sin(np.asarray(x)) * np.cos(np.asarray(y))

    def normal(self, x, y):
        slope_x = 0.1 * np.cos(x) * np.cos(y)
        slope_y = -0.1 * np.sin(x) * np.sin(y)
        up = np.stack([-slope_x, -slope_y, np.ones_like(slope_x)], axis=-1)
        return up / np.linalg.norm(up, axis=-1, keepdims=True)


def drop(scene: Scene, places: np.ndarray, radius: float) -> np.ndarray:
    """Heights of the centres of small spheres that slid down vertical rails until they lay still [m]."""
    root = Element("mujoco")
    child(root, "option", cone="elliptic", impratio=10)
    world = child(root, "worldbody")
    ground.add(root, world, scene)
    solid = ground.robot_touches(scene, 0, 1)
    for x, y in places:
        body = child(world, "body", pos=[x, y, float(scene.height(x, y)) + 0.01])
        child(body, "joint", type="slide", axis=[0, 0, 1], damping=0.02)
        child(body, "geom", solid, type="sphere", size=radius, mass=0.001)
    model = mujoco.MjModel.from_xml_string(tostring(root, encoding="unicode"))
    ground.fill(model, scene)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=800)
    return data.xpos[1:, 2]


SCENES = [
    load_scene("flat"),
    load_scene("slope:15"),
    load_scene("cross-slope:-12"),
    load_scene("rough:0.05", seed=3),
    load_scene("blocks", seed=3),
    load_scene("stairs"),
    Scene("slope with a block", Slope(0.2, -0.1), (Box(1.0, 0.5, 0.4, 0.8, 0.6, 0.2),)),
    Scene("wave", Wave()),
]


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.name)
def test_what_mujoco_collides_with_is_the_scenes_height(scene: Scene) -> None:
    random = np.random.default_rng(0)
    places = random.uniform(scene.bounds[:2], scene.bounds[2:], (60, 2))
    if scene.boxes:
        on_boxes = [(box.x, box.y) for box in scene.boxes]
        places = np.concatenate(
            [places, np.array(on_boxes) + random.uniform(-0.05, 0.05, (len(on_boxes), 2))]
        )
    places = places[[clear_of_sides(scene, place) for place in places]]
    radius = 0.004
    upright = scene.normal(places[:, 0], places[:, 1])[:, 2]
    touched = drop(scene, places, radius) - radius / upright
    assert len(places) > 40
    np.testing.assert_allclose(touched, scene.height(places[:, 0], places[:, 1]), atol=1e-3)


def clear_of_sides(scene: Scene, place: np.ndarray) -> bool:
    """Whether a place is 1 cm or more from the side of any box."""
    wide = [replace(box, lx=box.lx + 0.02, ly=box.ly + 0.02).covers(*place) for box in scene.boxes]
    narrow = [replace(box, lx=box.lx - 0.02, ly=box.ly - 0.02).covers(*place) for box in scene.boxes]
    return wide == narrow


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.name)
def test_rays_meet_the_scenes_height(scene: Scene) -> None:
    robot = dog()
    model = build_world([Placed(robot)], scene)
    data = mujoco.MjData(model)
    data.qpos[:3] = [150.0, 150.0, 150.0]
    mujoco.mj_kinematics(model, data)
    places = np.random.default_rng(1).uniform(scene.bounds[:2], scene.bounds[2:], (300, 2))
    hit = np.zeros(1, np.int32)
    down = np.array([0.0, 0.0, -1.0])
    met = [60.0 - mujoco.mj_ray(model, data, np.array([*p, 60.0]), down, None, 1, -1, hit) for p in places]
    np.testing.assert_allclose(met, scene.height(places[:, 0], places[:, 1]), atol=1e-3)


def test_several_robots_share_a_world_and_are_obstacles_to_each_other() -> None:
    """Each is addressed by its own names; alone, far from the other, it moves as if it were the only one."""
    robot, six, scene = robot_called("go2"), robot_called("hexapod"), load_scene("flat")
    idle = [MotorCommand(np.zeros((r.n, 3)), np.zeros((r.n, 3))) for r in (robot, six)]
    world = MujocoWorld([Placed(robot, "a_"), Placed(six, "b_", (3.0, 1.0, 0.5))], scene, 0.002)
    alone = MujocoWorld([Placed(robot)], scene, 0.002)
    for one in (world, alone):
        one.place(0, 7, True)
    world.place(1, 7, False)
    for _ in range(150):
        world.advance(idle, 1)
        alone.advance(idle[:1], 1)
    mine, its, same = world.sense(0, 0.002), world.sense(1, 0.002), alone.sense(0, 0.002)
    np.testing.assert_allclose(mine.q, same.q, atol=1e-6)
    np.testing.assert_allclose(mine.position_w, same.position_w, atol=1e-6)
    assert its.q.shape == (6, 3) and np.allclose(its.position_w[:2], (3.0, 1.0), atol=0.1)
    heap = MujocoWorld([Placed(robot, "a_"), Placed(six, "b_", (0.0, 0.0, 0.0))], scene, 0.002)
    heap.place(0, 0, False)
    heap.place(1, 0, False)
    heap.data.qpos[heap.addresses[0].qpos.start + 2] += 0.5
    touching = set()
    for _ in range(500):
        heap.advance(idle, 1)
        bodies = heap.model.geom_bodyid[[pair for contact in heap.data.contact for pair in contact.geom]]
        owners = ["ab"[int(body >= heap.addresses[1].base)] if body else "" for body in bodies]
        touching |= {owners[i] + owners[i + 1] for i in range(0, len(owners), 2)}
    assert {"ab"} <= touching <= {"ab", "a", "b"}, "the one lies on the other, and neither touches itself"
