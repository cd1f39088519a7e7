"""What others write in robot files that readers disagree about is read, or refused by its name."""

import numpy as np
import pytest
from test_bodies_of_strangers import CORNERS, chain, robot_and_notes, star
from test_bodies_of_strangers import dog as dog_limbs
from test_mended_files import TRUNK, joint, link, mjcf, read, same, shape, urdf, write_box

from gaitwright.description.load import load_robot_and_notes
from gaitwright.errors import BadFile
from gaitwright.model.kinematics import angles


@pytest.fixture
def plain(tmp_path):
    return read(tmp_path, urdf())[0]


# --- the head of a file ----------------------------------------------------------------------------
@pytest.mark.parametrize(
    "sections",
    [
        '<mujoco><compiler meshdir="../meshes" discardvisual="false"/></mujoco>',
        '<mujoco/><mujoco><compiler balanceinertia="true"/></mujoco>',
    ],
)
def test_a_urdf_may_have_words_for_mujoco(tmp_path, plain, sections):
    robot, notes = read(tmp_path, urdf(more=sections))
    assert same(robot, plain)
    assert notes == ""


@pytest.mark.parametrize(
    "head",
    [
        '\n\n<?xml version="1.0" encoding="utf-8"?>\n',
        '<!-- a licence -->\n<!-- > -->  <?xml version="1.0"?>',
    ],
)
def test_an_xml_declaration_may_come_late(tmp_path, plain, head):
    path = tmp_path / "late.urdf"
    path.write_text(head + urdf())
    robot, _ = load_robot_and_notes(path)
    assert same(robot, plain)


@pytest.mark.parametrize("head", ["<!-- no end <?xml ?>", '<!-- -->x<?xml version="1.0"?>', "  <?xml "])
def test_what_is_before_a_declaration_and_is_no_comment_is_refused(tmp_path, head):
    path = tmp_path / "late.urdf"
    path.write_text(head + urdf())
    with pytest.raises(BadFile, match="not XML"):
        load_robot_and_notes(path)


def test_namespaces_and_prefixes_mean_nothing(tmp_path, plain):
    text = urdf(more="<sensor:camera><of:it/></sensor:camera>")
    robot, _ = read(tmp_path, text.replace("<robot ", '<robot xmlns="http://a.b/robot" xmlns:x="y" '))
    assert same(robot, plain)


# --- things twice, numbers and sizes ---------------------------------------------------------------
def test_of_what_is_there_twice_the_first_counts(tmp_path, plain):
    twice = '<axis xyz="0 1 0"/><axis xyz="1 0 0"/>'
    text = urdf().replace('<axis xyz="0 1 0"/>', twice, 1)
    text = text.replace('<mass value="6.0"/>', '<mass value="6.0"/><mass value="60"/>')
    robot, notes = read(tmp_path, text)
    assert same(robot, plain)
    assert notes == (
        "of what is there twice, the first one counts: <mass> of <inertial> in link 'trunk', "
        "<axis> of joint 'a_j2'"
    )


def test_of_more_than_three_numbers_the_first_count(tmp_path, plain):
    robot, notes = read(tmp_path, urdf().replace('xyz="0 0 -0.2"', 'xyz="0 0 -0.2 9"', 1))
    assert same(robot, plain)
    assert notes == "of more than three numbers the first three count: xyz of <origin> in joint 'a_j3'"


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        (
            'xyz="0 0 -0.2"',
            'xyz="0 -0.2"',
            "xyz='0 -0.2' of <origin> in joint 'a_j3': expected three",
        ),
        ('xyz="0 0 -0.2"', 'xyz="0,0,-0.2"', "xyz='0,0,-0.2' of <origin> in joint 'a_j3': expected three"),
        (
            'size="0.4 0.16 0.1"',
            'size="0.4 0.16"',
            "size='0.4 0.16' of <box> in link 'trunk': expected three",
        ),
        ('<child link="a2"/>', "", "the child link of joint 'a_j2' is none"),
        (
            '<parent link="a1"/>',
            '<parent link="zz"/>',
            "the parent link of joint 'a_j2' is 'zz', which is not in the file",
        ),
    ],
)
def test_a_urdf_is_refused_with_the_place_of_the_word(tmp_path, old, new, sentence):
    with pytest.raises(BadFile, match=sentence):
        read(tmp_path, urdf().replace(old, new, 1))


def test_the_world_need_not_be_a_link(tmp_path, plain):
    robot, _ = read(tmp_path, urdf(more=joint("held", "fixed", "world", "trunk", "0 0 1")))
    assert same(robot, plain)


@pytest.mark.parametrize("form", ["<sphere><radius>0.02</radius></sphere>", '<sphere radius="0"/>', "<box/>"])
def test_a_shape_without_a_size_is_as_if_it_were_not_there(tmp_path, plain, form):
    robot, _ = read(tmp_path, urdf(shank=shape(form)))
    assert same(robot, plain)


def test_joint_limits_beyond_all_turns_are_none(tmp_path):
    robot, _ = read(tmp_path, urdf(limit='<limit lower="-1e10" upper="2.5" effort="30" velocity="20"/>'))
    assert robot.q_min == pytest.approx(-np.pi)
    assert robot.q_max == pytest.approx(2.5)


def test_no_mass_at_all_is_told(tmp_path):
    text = urdf().replace("<inertial>", "<unknown>").replace("</inertial>", "</unknown>")
    with pytest.raises(BadFile, match="none of its links has a mass; expected masses and inertias"):
        read(tmp_path, text)


# --- what floats -----------------------------------------------------------------------------------
def test_links_that_float_beside_the_robot_are_left_out(tmp_path, plain):
    balls = "".join(
        link(f"ball{i}", 1.0, "1 1 1") + joint(f"free{i}", "floating", "trunk", f"ball{i}", "1 0 0")
        for i in range(2)
    )
    robot, notes = read(tmp_path, urdf(more=balls))
    assert same(robot, plain)
    assert notes == "the links 'ball0', 'ball1' float beside the robot and are left out"


def test_two_robots_that_float_in_one_urdf_are_refused(tmp_path):
    loose = urdf().replace('"a_j1" type="revolute"', '"a_j1" type="floating"')
    loose = loose.replace('"b_j1" type="revolute"', '"b_j1" type="floating"')
    with pytest.raises(BadFile, match="the joints 'a_j1', 'b_j1' all let a part of it float"):
        read(tmp_path, loose)


def test_other_bodies_that_float_are_told(tmp_path):
    base = f'<body name="trunk"><freejoint/>{TRUNK}</body>'
    alone, _ = read(tmp_path, mjcf(base))
    ball = '<body name="ball" pos="1 0 0"><freejoint/><geom size=".1"/></body>'
    robot, notes = read(tmp_path, mjcf(base + ball))
    assert same(robot, alone)
    assert "of the bodies that float 'trunk' is taken, without 'ball'" in notes


def test_legs_that_hang_on_the_world_are_told(tmp_path):
    with pytest.raises(
        BadFile, match="the limbs from 'a_j1', 'b_j1', 'c_j1', 'd_j1' hang on the world itself"
    ):
        read(tmp_path, mjcf('<geom type="box" size=".2 .1 .05"/>{legs}'))


# --- numbers that cannot be ------------------------------------------------------------------------
def test_impossible_inertias_become_those_of_rods_and_plates(tmp_path, plain):
    text = urdf().replace('ixx="7e-4" iyy="7e-4" izz="7e-4"', 'ixx="70" iyy="70" izz="70"')
    text = text.replace('ixx="0.05" iyy="0.15" izz="0.18"', 'ixx="500" iyy="1500" izz="1800"')
    robot, notes = read(tmp_path, text)
    assert "the inertia of 'trunk', 'a2', 'b2', 'c2', 'd2' is impossible for links of that mass" in notes
    assert "('trunk' would have its mass 17.3 m from its middle): taken as that of a rod" in notes
    assert robot.inertia[0, 1] == pytest.approx(np.eye(3) * 0.7 * 0.2**2 / 12)
    wide = np.hypot(0.2, 0.06)
    assert np.diag(robot.base_inertia) == pytest.approx(6.0 * wide**2 / 3.0 * np.array([5, 15, 18]) / 18)
    assert same(read(tmp_path, urdf())[0], plain)


# --- which side is up ------------------------------------------------------------------------------
def lying(limbs: str, turn: str) -> str:
    """A robot whose file has other axes: its limbs turned within a trunk that is the same all round."""
    return f'<body quat="{turn}">{limbs}</body>'


@pytest.mark.parametrize(
    ("turn", "axis"),
    [("0.5 -0.5 -0.5 -0.5", "y"), ("0.5 0.5 0.5 0.5", "x"), ("0.5 0.5 -0.5 0.5", "-y")],
)
def test_a_robot_on_its_side_is_stood_up(turn, axis):
    plain, _ = robot_and_notes(dog_limbs(), half=".05 .05 .05")
    robot, notes = robot_and_notes(lying(dog_limbs(), turn), half=".05 .05 .05")
    assert any(f"up is the file's {axis} axis, square to the plane of its hips" in note for note in notes)
    for field in ("nominal_feet", "offset"):
        assert np.abs(getattr(robot, field)) == pytest.approx(np.abs(getattr(plain, field)), abs=1e-9), field
    assert np.abs(robot.hip) == pytest.approx(np.abs(plain.hip), abs=1e-9)


def test_a_round_robot_stands_as_it_is():
    _, notes = robot_and_notes(star(6))
    assert not any("up is" in note for note in notes)


# --- which mesh is missing -------------------------------------------------------------------------
def test_the_mesh_of_the_foot_is_the_one_that_is_told(tmp_path):
    lost = shape('<mesh filename="package://pip/trunk.dae"/>')
    text = urdf("", shape('<mesh filename="package://pip/{n}_shank.dae"/>'))
    text = text.replace(shape('<box size="0.4 0.16 0.1"/>'), lost)
    with pytest.raises(BadFile) as caught:
        read(tmp_path, text)
    assert "of link 'a3', mesh 'package://pip/a_shank.dae'" in str(caught.value)


def test_flat_meshes_are_shapes_like_others(tmp_path):
    write_box(tmp_path / "meshes" / "shank.stl")
    bare = '<link name="{n}_toe"/>' + joint("{n}_end", "fixed", "{n}3", "{n}_toe", "0 0 -0.1")
    text = urdf(bare, shape('<mesh filename="meshes/shank.stl" scale="1 1 1"/>'))
    thick, _ = read(tmp_path, text)
    flat, _ = read(tmp_path, text.replace('scale="1 1 1"', 'scale="1 1e-9 1"'))
    assert flat.offset[:, 2, 2] == pytest.approx(thick.offset[:, 2, 2], abs=0.01)


# --- too little inertia, too little mass -----------------------------------------------------------
def test_less_inertia_than_any_matter_has_is_that_of_water(tmp_path):
    little = urdf().replace('ixx="7e-4" iyy="7e-4" izz="7e-4"', 'ixx="1e-8" iyy="1e-8" izz="1e-8"')
    robot, notes = read(tmp_path, little)
    assert "the inertia of 'a2', 'b2', 'c2', 'd2' is less than any matter of that mass has" in notes
    radius = (0.7 / (1000 * 4 / 3 * np.pi)) ** (1 / 3)
    assert robot.inertia[0, 1] == pytest.approx(np.eye(3) * 0.4 * 0.7 * radius**2)
    osmium = 0.4 * 0.7 * (0.7 / (22_600 * 4 / 3 * np.pi)) ** (2 / 3)
    for share, told in ((0.99, True), (1.01, False)):
        value = f'"{share * osmium}"'
        _, notes = read(tmp_path, little.replace('"1e-8"', value))
        assert ("less than any matter" in notes) is told


def test_thighs_to_which_no_mass_is_given_are_refused(tmp_path):
    text = urdf().replace(link("a2", 0.7, "7e-4 7e-4 7e-4", "0 0 -0.1"), '<link name="a2"/>')
    with pytest.raises(BadFile, match="leg FL has a thigh or shank without mass: "):
        read(tmp_path, text)


def test_hinges_that_are_nearly_parallel_are_taken_with_a_note(tmp_path, plain):
    robot, notes = read(tmp_path, urdf().replace('<axis xyz="0 1 0"/>', '<axis xyz="0.002 1 0"/>', 1))
    assert notes == "hinges are up to 0.11° from square and parallel: taken as if they were not"
    assert robot.offset == pytest.approx(plain.offset, abs=1e-3)
    with pytest.raises(
        BadFile, match=r"leg FL \(from joint 'a_j1'\): its second hinge is 0\.57° from square"
    ):
        read(tmp_path, urdf().replace('<axis xyz="0 1 0"/>', '<axis xyz="0.01 1 0"/>', 1))


# --- what is included ------------------------------------------------------------------------------
def test_parts_beside_the_folder_are_included_from_folders_that_may_be_read(tmp_path):
    (tmp_path / "dog").mkdir()
    (tmp_path / "common").mkdir()
    text = mjcf(f'<body name="trunk"><freejoint/>{TRUNK}</body>')
    alone, _ = read(tmp_path, text)
    base = text[: text.index("<actuator")]
    path = tmp_path / "dog" / "robot.xml"
    path.write_text(base + '<include file="../common/motors.xml"/></mujoco>')
    (tmp_path / "common" / "motors.xml").write_text(
        f"<mujocoinclude>{text[text.index('<actuator') : text.index('</mujoco>')]}</mujocoinclude>"
    )
    with pytest.raises(BadFile, match=r"it includes '\.\./common/motors\.xml', which is not a file inside"):
        load_robot_and_notes(path)
    robot, _ = load_robot_and_notes(path, {"common": tmp_path / "common"})
    assert same(robot, alone)
    (tmp_path / "package.xml").write_text("<package/>")
    robot, _ = load_robot_and_notes(path)
    assert same(robot, alone)


# --- torque limits of joints that resist -----------------------------------------------------------
def test_a_missing_torque_limit_is_enough_to_move_joints_that_resist(tmp_path):
    limit = '<limit lower="-2.7" upper="2.7" effort="0" velocity="20"/>'
    free, notes = read(tmp_path, urdf(limit=limit))
    assert notes.endswith("a lever of half a leg")
    stiff, notes = read(tmp_path, urdf(limit=limit + '<dynamics damping="0.5" friction="0.3"/>'))
    assert notes.endswith("a lever of half a leg and moves the joints against what they resist")
    rate = np.sqrt(9.81 / free.leg_length)
    assert stiff.tau_max == pytest.approx(free.tau_max + 0.3 + 0.5 * rate, rel=1e-3)


# --- legs that stick out sideways at zero angles ---------------------------------------------------
@pytest.mark.parametrize("tilt", [0.0, 1e-9, -1e-9])
def test_legs_that_stick_out_at_zero_angles_all_hang_down(tilt):
    limbs = "".join(
        chain(
            name,
            [f"{0.2 * i} {0.1 * j} 0", f"0 {0.05 * j} 0", f"0 {0.2 * j} 0"],
            ("1 0 0", f"0 {tilt * i} 1", f"0 {tilt * i} 1"),
            f"0 {0.2 * j} 0",
        )
        for name, (i, j) in zip("pqrs", CORNERS, strict=True)
    )
    robot, _ = robot_and_notes(limbs)
    assert robot.nominal_feet[:, 2] == pytest.approx(-0.05 - 0.65 * 0.4, abs=1e-6)
    q, _ = angles(robot, robot.nominal_feet)
    assert q[:, 0] == pytest.approx(np.array([-1, 1, -1, 1]) * np.pi / 2, abs=1e-6)
