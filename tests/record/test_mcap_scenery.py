"""What Foxglove sees of a recording beside its frames: the robot as a URDF, the ground, boxes and the way."""

import json
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory

from gaitwright.bench.evidence.oracles import pinocchio
from gaitwright.description.load import load_robot
from gaitwright.ground.holes import Hole, dug
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.solids import Cylinder, Prism, Pyramid, Sphere, Wedge
from gaitwright.ground.terrain import Box, Flat, HeightField, Slope, Surface
from gaitwright.locomotion import Brain
from gaitwright.model.kinematics import feet
from gaitwright.model.urdf import LIMB, Names, write_urdf
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.record.mcap_export import export_mcap
from gaitwright.record.recording import Recording
from gaitwright.record.scene_of import scene_of
from gaitwright.record.scenery import KINDS, MOST_NODES, SCHEMA, scene_update
from gaitwright.session import walk
from gaitwright.signals import Mission
from oracles import NEEDS_PINOCCHIO

ROBOTS = ("go2", "thesis", "hexapod")


@pytest.fixture(scope="module")
def recording() -> Recording:
    """Go2 goes for a goal among blocks for a second."""
    robot, scene = load_robot("go2"), load_scene("blocks", 1)
    mission = Mission(((2.0, 0.5),))
    return walk(Brain.of(robot, scene), MujocoPlant(robot, scene), mission, 1.0, seed=1, scene="blocks")


def read(path: Path) -> dict[str, list]:
    """The messages of every topic, those in JSON read."""
    found: dict[str, list] = {}
    with path.open("rb") as file:
        for schema, channel, message in make_reader(file).iter_messages():
            if schema.encoding == "jsonschema":
                found.setdefault(channel.topic, []).append(
                    (json.loads(schema.data), json.loads(message.data))
                )
        file.seek(0)
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        topics = ["/robot_description", "/joint_states", "/tf", "/tf_static"]
        for _, channel, _, message in reader.iter_decoded_messages(topics=topics):
            found.setdefault(channel.topic, []).append(message)
    return found


def metadata(path: Path) -> dict[str, str]:
    with path.open("rb") as file:
        return next(iter(make_reader(file).iter_metadata())).metadata


# --- the robot -------------------------------------------------------------------------------------
def test_the_urdf_has_every_frame_and_joint_of_the_other_topics(recording: Recording, tmp_path: Path):
    told = read(export_mcap(recording, tmp_path / "walk.mcap"))
    (description,) = told["/robot_description"]
    root = ElementTree.fromstring(description.data)
    links = {link.get("name") for link in root.iter("link")}
    joints = {joint.get("name") for joint in root.iter("joint") if joint.get("type") == "revolute"}
    frames = {t.child_frame_id for tree in (told["/tf"][0], told["/tf_static"][0]) for t in tree.transforms}
    assert joints == set(told["/joint_states"][0].name)
    assert links == frames
    for joint in root.iter("joint"):  # a frame hangs on the same parent in both
        parents = {
            t.header.frame_id
            for tree in (told["/tf"][0], told["/tf_static"][0])
            for t in tree.transforms
            if t.child_frame_id == joint.find("child").get("link")
        }
        assert parents == {joint.find("parent").get("link")}


@NEEDS_PINOCCHIO
@pytest.mark.parametrize("name", ROBOTS)
def test_pinocchio_puts_the_feet_of_the_urdf_where_the_transforms_do(name: str):
    robot = load_robot(name)
    urdf = write_urdf(robot, Names(("hip1", "hip2", "knee"), ("hip1", "hip2", "knee")), shapes=True)
    pin = pinocchio()
    model = pin.buildModelFromXML(urdf, pin.JointModelFreeFlyer())
    data = model.createData()
    assert model.nv == 6 + 3 * robot.n
    assert sum(inertia.mass for inertia in model.inertias) == pytest.approx(robot.total_mass)
    q = np.random.default_rng(1).uniform(robot.q_min, robot.q_max)
    order = [
        model.joints[model.getJointId(f"{leg}_{joint}")].idx_q
        for leg in robot.legs
        for joint in ("hip1", "hip2", "knee")
    ]
    full = pin.neutral(model)
    full[order] = q.ravel()
    pin.framesForwardKinematics(model, data, full)
    found = [data.oMf[model.getFrameId(f"{leg}_foot", pin.FrameType.BODY)].translation for leg in robot.legs]
    np.testing.assert_allclose(found, feet(robot, q), atol=1e-12)


@pytest.mark.parametrize("name", ROBOTS)
def test_links_are_drawn_from_hinge_to_hinge(name: str):
    robot = load_robot(name)
    root = ElementTree.fromstring(write_urdf(robot, shapes=True))
    thigh = next(link for link in root.iter("link") if link.get("name") == f"{robot.legs[1]}_thigh")
    ball, limb = thigh.findall("visual")
    assert ball.find("geometry/sphere").get("radius") == limb.find("geometry/cylinder").get("radius")
    assert float(ball.find("geometry/sphere").get("radius")) == pytest.approx(LIMB * robot.foot_radius[1])
    half = 0.5 * float(limb.find("geometry/cylinder").get("length"))
    centre, turn = (
        np.array([float(x) for x in limb.find("origin").get(key).split()]) for key in ("xyz", "rpy")
    )
    roll, pitch, yaw = turn
    axis = np.array([np.cos(yaw) * np.sin(pitch), np.sin(yaw) * np.sin(pitch), np.cos(pitch)])
    assert roll == 0.0
    np.testing.assert_allclose(centre - half * axis, 0.0, atol=1e-12)
    np.testing.assert_allclose(centre + half * axis, robot.offset[1, 1], atol=1e-12)
    trunk = root.find("link[@name='base']/visual/geometry/box").get("size").split()
    np.testing.assert_allclose([float(side) for side in trunk], 2 * robot.trunk[1])


# --- the ground ------------------------------------------------------------------------------------
def test_ground_boxes_and_way_are_in_the_file(recording: Recording, tmp_path: Path):
    told = read(export_mcap(recording, tmp_path / "walk.mcap"))["/gaitwright/scene"]
    assert all(schema == SCHEMA and schema["title"] == "foxglove.SceneUpdate" for schema, _ in told)
    for _, message in told:
        fits(message, SCHEMA)
    entities = {entity["id"]: entity for _, message in told for entity in message["entities"]}
    assert set(entities) == {"ground", "boxes", "way"}
    assert {entity["frame_id"] for entity in entities.values()} == {"world"}
    scene = load_scene("blocks", 1)
    for box, cube in zip(scene.boxes, entities["boxes"]["cubes"], strict=True):
        assert cube["pose"]["position"]["x"] == box.x
        top = cube["pose"]["position"]["z"] + cube["size"]["z"] / 2
        assert top == pytest.approx(scene.top(box))
    (line,) = entities["way"]["lines"]
    assert [line["points"][-1][axis] for axis in "xy"] == [2.0, 0.5]
    (ball,) = entities["way"]["spheres"]
    assert ball["pose"]["position"] == line["points"][-1]


def test_a_scene_that_cannot_be_had_is_left_out_and_told(recording: Recording, tmp_path: Path):
    lost = Recording(**{**vars(recording), "scene": "my garden"})
    path = export_mcap(lost, tmp_path / "walk.mcap")
    assert "/gaitwright/scene" not in read(path)
    assert metadata(path)["ground"].startswith("left out: no scene 'my garden'")
    path = export_mcap(lost, tmp_path / "again.mcap", load_scene("flat"))
    assert read(path)["/gaitwright/scene"] and "ground" not in metadata(path)


@pytest.mark.parametrize("name", ["forest:0.3", "streets:0.8", "holes", "bugtrap:1"])
def test_a_recording_in_a_family_has_its_scene(recording: Recording, name: str):
    told = Recording(**{**vars(recording), "scene": name, "seed": 5})
    assert scene_of(told) == load_scene(name, 5) != load_scene(name, 6)


class Waves(Surface):
    """Ground of another kind than ours."""

    def height(self, x, y):
        return 0.1 * np.sin(np.asarray(x)) * np.cos(np.asarray(y))

    def normal(self, x, y):
        raise NotImplementedError


STEPS = HeightField(
    -1.0, -2.0, 0.5, np.array([[0.0, 0.1, 0.3], [0.2, -0.1, 0.0], [0.0, 0.0, 0.4], [0.1, 0.2, 0.3]])
)
SCENES = [
    load_scene("slope:10"),
    load_scene("rough:0.05", 3),
    load_scene("stairs"),
    Scene("steps", STEPS),
    Scene("waves", Waves(), bounds=(-50.0, -50.0, 50.0, 50.0)),
    Scene("fine", HeightField(0.0, 0.0, 0.01, np.random.default_rng(0).uniform(0, 0.1, (700, 1400)))),
    Scene("box on a slope", Slope(0.2), (Box(1.0, 0.0, 0.3, 0.5, 0.4, 0.3),)),
]


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.name)
def test_the_triangles_lie_on_the_surface(scene: Scene):
    message = scene_update(scene, 1.5)
    fits(message, SCHEMA)
    ground = message["entities"][0]
    assert ground["timestamp"] == {"sec": 1, "nsec": 500_000_000}
    (mesh,) = ground["triangles"]
    nodes = np.array([[p["x"], p["y"], p["z"]] for p in mesh["points"]])
    assert len(nodes) <= 1.1 * MOST_NODES
    np.testing.assert_allclose(nodes[:, 2], scene.surface.height(nodes[:, 0], nodes[:, 1]), atol=3e-4)
    triangles = nodes[np.array(mesh["indices"]).reshape(-1, 3)]
    ab, ac = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    up = np.cross(ab, ac)[:, 2]
    assert (up > 0.0).all()  # anticlockwise from above
    x, y = np.ptp(nodes[:, 0]), np.ptp(nodes[:, 1])
    assert up.sum() / 2 == pytest.approx(x * y, rel=1e-6)
    if scene.name in ("steps", "rough:0.05"):  # not thinned: straight between the nodes as the ground is
        middle = triangles.mean(axis=1)
        np.testing.assert_allclose(middle[:, 2], scene.surface.height(*middle[:, :2].T), atol=3e-4)


BENT = ((4.0, 0.0), (6.0, 0.0), (6.0, 2.0), (5.0, 0.5), (4.0, 2.0))
PIT = Hole(((0.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)), 0.3)


@pytest.mark.parametrize("plane", [Flat(), Slope(0.1, 0.2)])
def test_every_primitive_and_every_hole_is_shown_where_it_is(plane: Surface):
    shapes = (
        Cylinder(1.0, 0.0, 0.3, 0.5), Pyramid(3.0, 0.0, 0.4, 1.0, 0.8, 0.3, 0.3),
        Wedge(-1.0, 0.0, 1.0, 0.8, 0.6, 0.3), Prism(BENT, 0.4), Sphere(-2.0, -2.0, 0.5, 0.3),
    )  # fmt: skip
    scene = Scene("all", dug(plane, (PIT,)), (), shapes=shapes, holes=(PIT,))
    message = scene_update(scene, 0.0)
    fits(message, SCHEMA)
    entities = {entity["id"]: entity for entity in message["entities"]}
    (ball,) = entities["shapes"]["spheres"]
    top = ball["pose"]["position"]["z"] + ball["size"]["z"] / 2
    assert top == pytest.approx(scene.top(shapes[-1]))
    meshes = [*entities["ground"]["triangles"], *entities["shapes"]["triangles"]]
    assert len(meshes) == 1 + len(shapes) - 1
    top_area = 0.0
    for mesh in meshes:
        nodes = np.array([[p["x"], p["y"], p["z"]] for p in mesh["points"]])
        triangles = nodes[np.array(mesh["indices"]).reshape(-1, 3)]
        normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        up = triangles[normal[:, 2] > 1e-6]
        assert (normal[:, 2] > -1e-6).all()  # nothing is seen from below
        middle = up.mean(axis=1)
        seen = scene.height(*middle[:, :2].T)
        own = mesh is not meshes[0]
        assert np.allclose(middle[:, 2], seen, atol=2e-3) if own else np.all(middle[:, 2] <= seen + 2e-3)
        top_area += normal[normal[:, 2] > 0.0, 2].sum() / 2 if not own else 0.0
    x_min, y_min, x_max, y_max = scene.bounds
    assert top_area == pytest.approx((x_max - x_min) * (y_max - y_min))


# --- the schema ------------------------------------------------------------------------------------
def fits(value, schema: dict) -> None:
    """A value against a JSON schema, as far as ours go; every part of it must be known there."""
    kind = schema["type"]
    if kind == "object":
        assert isinstance(value, dict)
        if "properties" in schema:
            assert value.keys() == schema["properties"].keys() == set(schema["required"])
            for name, part in schema["properties"].items():
                fits(value[name], part)
    elif kind == "array":
        for part in value:
            fits(part, schema["items"])
    elif kind == "integer":
        assert type(value) is int and schema.get("minimum", value) <= value <= schema.get("maximum", value)
    else:
        assert isinstance(value, {"number": (int, float), "string": str, "boolean": bool}[kind])


def test_an_entity_has_all_kinds_of_shapes():
    entity = SCHEMA["properties"]["entities"]["items"]
    assert set(KINDS) <= entity["properties"].keys()
