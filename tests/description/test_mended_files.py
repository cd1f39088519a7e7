"""What is often wrong in robot files and mended with a note, or refused by the name of the trouble."""

import struct
from pathlib import Path

import numpy as np
import pytest

from gaitwright.description.load import load_robot_and_notes
from gaitwright.description.mujoco_model import read_model
from gaitwright.description.reading import read_robot
from gaitwright.errors import BadFile, WrongUse
from gaitwright.model.robot import Robot, lists_of, robot_of


# --- robots written here ---------------------------------------------------------------------------
def link(name: str, mass: float, inertia: str, at: str = "0 0 0", shapes: str = "") -> str:
    xx, yy, zz = inertia.split()
    return (
        f'<link name="{name}"><inertial><origin xyz="{at}"/><mass value="{mass}"/><inertia ixx="{xx}" '
        f'iyy="{yy}" izz="{zz}" ixy="0" ixz="0" iyz="0"/></inertial>{shapes}</link>'
    )


def joint(name: str, kind: str, parent: str, child: str, at: str, more: str = "") -> str:
    return (
        f'<joint name="{name}" type="{kind}"><origin xyz="{at}"/><parent link="{parent}"/>'
        f'<child link="{child}"/>{more}</joint>'
    )


def shape(geometry: str, at: str = "0 0 0", kind: str = "collision") -> str:
    return f'<{kind}><origin xyz="{at}"/><geometry>{geometry}</geometry></{kind}>'


LIMIT = '<limit lower="-2.7" upper="2.7" effort="30" velocity="20"/>'
BALL = shape('<sphere radius="0.02"/>')
FOOT = link("{n}_foot", 0.05, "1e-5 1e-5 1e-5", shapes=BALL) + joint(
    "{n}_end", "fixed", "{n}3", "{n}_foot", "0 0 -0.2"
)
CORNERS = {"a": (0.2, 1), "b": (0.2, -1), "c": (-0.2, 1), "d": (-0.2, -1)}


def urdf(foot: str = FOOT, shank: str = "", more: str = "", limit: str = LIMIT) -> str:
    """A quadruped of 12 kg; `foot` ends each leg and `shank` are shapes of its last link, `{n}` the leg."""
    text = link("trunk", 6.0, "0.05 0.15 0.18", shapes=shape('<box size="0.4 0.16 0.1"/>'))
    for n, (x, side) in CORNERS.items():
        text += link(f"{n}1", 0.5, "5e-4 5e-4 5e-4") + link(f"{n}2", 0.7, "7e-4 7e-4 7e-4", "0 0 -0.1")
        text += link(f"{n}3", 0.2, "2e-4 2e-4 2e-4", "0 0 -0.1", shank.replace("{n}", n))
        text += joint(
            f"{n}_j1", "revolute", "trunk", f"{n}1", f"{x} {0.06 * side} 0", '<axis xyz="1 0 0"/>' + limit
        )
        for i, at in ((2, f"0 {0.08 * side} 0"), (3, "0 0 -0.2")):
            text += joint(
                f"{n}_j{i}", "revolute", f"{n}{i - 1}", f"{n}{i}", at, '<axis xyz="0 1 0"/>' + limit
            )
        text += foot.replace("{n}", n)
    return f'<robot name="pip">{text}{more}</robot>'


def mjcf(base: str, rest: str = "", beyond: str = "") -> str:
    """The same in MJCF; `base` holds the trunk, `beyond` is more of each shank."""
    text = ""
    for n, (x, side) in CORNERS.items():
        text += f"""<body name="{n}1" pos="{x} {0.06 * side} 0"><joint name="{n}_j1" axis="1 0 0"/>
          <inertial pos="0 0 0" mass="0.5" diaginertia="5e-4 5e-4 5e-4"/>
          <body name="{n}2" pos="0 {0.08 * side} 0"><joint name="{n}_j2" axis="0 1 0"/>
          <inertial pos="0 0 -.1" mass="0.7" diaginertia="7e-4 7e-4 7e-4"/>
          <body name="{n}3" pos="0 0 -.2"><joint name="{n}_j3" axis="0 1 0"/>
          <inertial pos="0 0 -.1" mass="0.2" diaginertia="2e-4 2e-4 2e-4"/>
          <geom type="sphere" size=".02" pos="0 0 -.2"/>{beyond.replace("{n}", n)}</body></body></body>"""
    motors = "".join(f'<motor joint="{n}_j{i}" ctrlrange="-30 30"/>' for n in CORNERS for i in (1, 2, 3))
    return f"""<mujoco><worldbody>{base.replace("{legs}", text)}</worldbody>
      <actuator>{motors}</actuator>{rest}</mujoco>"""


TRUNK = '<inertial pos="0 0 0" mass="6" diaginertia=".05 .15 .18"/>{legs}'


def read(folder: Path, text: str) -> tuple[Robot, str]:
    """The robot in a text, read in this process, and its notes in a row."""
    path = folder / ("robot.urdf" if text.startswith("<robot") else "robot.xml")
    path.write_text(text)
    robot, notes = read_robot(path)
    return robot, "; ".join(notes)


def same(a: Robot, b: Robot) -> bool:
    """Whether two robots have the same numbers, the name aside."""
    ours, theirs = lists_of(a), lists_of(b)
    return all(np.allclose(ours[field], theirs[field]) for field in ours if field not in ("name", "legs"))


# --- axes and inertias -----------------------------------------------------------------------------
@pytest.mark.parametrize("axis", ["0 0 0", "0 0 1e-20"])
def test_axes_of_fixed_joints_mean_nothing(tmp_path, axis):
    plain, _ = read(tmp_path, urdf())
    end = joint("{n}_end", "fixed", "{n}3", "{n}_foot", "0 0 -0.2")
    odd, notes = read(
        tmp_path, urdf(FOOT.replace(end, end.replace("</joint>", f'<axis xyz="{axis}"/></joint>')))
    )
    assert same(plain, odd)
    assert notes == ""


def camera(mass: float, inertia: str) -> str:
    return link("camera", mass, inertia) + joint("mount", "fixed", "trunk", "camera", "0.2 0 0.05")


@pytest.mark.parametrize("inertia", ["1e-9 1e-9 1e-7", "-1e-9 1e-9 1e-9", "1e-16 1e-16 1e-16"])
def test_a_light_link_of_no_possible_inertia_is_a_point_of_what_carries_it(tmp_path, inertia):
    robot, notes = read(tmp_path, urdf(more=camera(0.002, inertia)))
    plain, _ = read(tmp_path, urdf())
    assert "the inertia of 'camera' is none that a body has; being light, taken as a point" in notes
    assert robot.base_mass == pytest.approx(6.002)
    lever = 0.002 * 6.0 / 6.002 * (0.2**2 + 0.05**2)
    assert robot.base_inertia[1, 1] - plain.base_inertia[1, 1] == pytest.approx(lever)


@pytest.mark.parametrize(
    ("given", "mended"), [("1 1 3", [1.5, 1.5, 3]), ("0.3 0.7 1.0001", [0.3, 0.7, 1.0001])]
)
def test_a_heavy_link_of_no_possible_inertia_is_balanced(tmp_path, given, mended):
    values = " ".join(str(float(x) * 1e-3) for x in given.split())
    robot, notes = read(tmp_path, urdf().replace('ixx="0.0005" iyy="0.0005" izz="0.0005"', ""))
    text = urdf().replace(
        'ixx="5e-4" iyy="5e-4" izz="5e-4"', "ixx={} iyy={} izz={}".format(*map(repr, values.split()))
    )
    robot, notes = read(tmp_path, text.replace("'", '"'))
    assert "the inertia of 'a1', 'b1', 'c1', 'd1' is none that a body has (A + B < C)" in notes
    assert np.linalg.eigvalsh(robot.inertia[0, 0]) == pytest.approx(1e-3 * np.array(mended), rel=1e-3)


def test_a_link_without_inertia_is_a_ball_of_water(tmp_path):
    robot, notes = read(
        tmp_path, urdf().replace('ixx="2e-4" iyy="2e-4" izz="2e-4"', 'ixx="0" iyy="0" izz="0"')
    )
    radius = (0.2 / (1000 * 4 / 3 * np.pi)) ** (1 / 3)
    assert "no inertia is given for 'a3', 'b3', 'c3', 'd3': taken as that of a ball of water" in notes
    assert robot.inertia[0, 2, 2, 2] == pytest.approx(0.4 * 0.2 * radius**2 + 1e-5)


def test_frames_without_mass_may_move(tmp_path):
    text = urdf().replace(link("a1", 0.5, "5e-4 5e-4 5e-4"), '<link name="a1"/>')
    robot, notes = read(tmp_path, text)
    assert "no mass is given for 'a1', which moves on its own: taken as 0.011 kg" in notes
    assert robot.mass[0, 0] == pytest.approx(0.0113)


def test_negative_mass_is_refused_also_where_nothing_moves(tmp_path):
    with pytest.raises(BadFile, match="the mass of 'camera' is -1 kg"):
        read(tmp_path, urdf(more=camera(-1.0, "1 1 1")))


def test_impossible_inertias_and_a_mass_beside_the_feet_are_told_with_their_links(tmp_path):
    _, notes = read(
        tmp_path, urdf().replace('ixx="7e-4" iyy="7e-4" izz="7e-4"', 'ixx="0.07" iyy="0.07" izz="0.07"')
    )
    assert "the inertia of 'a2', 'b2', 'c2', 'd2' is impossible for links of that mass" in notes
    _, notes = read(
        tmp_path,
        urdf(more=link("load", 3.0, "0.01 0.01 0.01") + joint("on", "fixed", "trunk", "load", "0 1.2 0")),
    )
    assert "outside the feet: 'load' (3 of 14.8 kg) has its own at (0.00, 1.20, 0.00) m" in notes


# --- meshes ----------------------------------------------------------------------------------------
FACES = ("023", "031", "457", "467", "045", "041", "263", "267", "064", "062", "173", "175")


def write_box(path: Path) -> None:
    """A shank of 2 × 2 × 20 cm below its knee as binary STL."""
    path.parent.mkdir(parents=True, exist_ok=True)
    corners = np.array([(x, y, z) for x in (-0.01, 0.01) for y in (-0.01, 0.01) for z in (-0.2, 0.0)])
    body = b"".join(
        struct.pack("<12fH", 0, 0, 0, *corners[[int(i) for i in face]].ravel(), 0) for face in FACES
    )
    path.write_bytes(b"\0" * 80 + struct.pack("<I", len(FACES)) + body)


def meshed(name: str) -> str:
    return urdf(foot="", shank=shape(f'<mesh filename="{name}"/>'))


@pytest.mark.parametrize(
    "name",
    [
        "package://pip/meshes/shank.stl",
        "package://pip/meshes/Shank.STL",
        "package://pip/meshes/shank.dae",
        "model://pip/meshes/shank.stl",
        "../meshes/shank.stl",
        "{folder}/meshes/shank.stl",
        "file://{folder}/meshes/shank.stl",
        "/home/someone/pip/meshes/shank.stl",
        "..\\meshes\\shank.stl",
    ],
)
def test_meshes_are_found_in_the_package_of_the_file(tmp_path, name):
    write_box(tmp_path / "meshes" / "shank.stl")
    (tmp_path / "urdf").mkdir()
    robot, notes = read(tmp_path / "urdf", meshed(name.format(folder=tmp_path)))
    assert robot.offset[0, 2, 2] == pytest.approx(-0.19, abs=0.01)
    assert notes == ""


def test_meshes_elsewhere_need_the_users_word(tmp_path):
    write_box(tmp_path / "elsewhere" / "meshes" / "shank.stl")
    (tmp_path / "mine").mkdir()
    path = tmp_path / "mine" / "robot.urdf"
    for name in ("package://pip/meshes/shank.stl", "../elsewhere/meshes/shank.stl"):
        path.write_text(meshed(name))
        with pytest.raises(BadFile, match=f"of link 'a3', mesh '{name}' is not an OBJ"):
            read_robot(path)
        robot, _ = load_robot_and_notes(path, {"pip": tmp_path / "elsewhere"})
        assert robot.n == 4
    with pytest.raises(WrongUse, match=r"package pip: .*nowhere is no folder"):
        load_robot_and_notes(path, {"pip": tmp_path / "nowhere"})


def test_links_out_of_the_package_and_placeholders_of_large_files_are_no_meshes(tmp_path):
    write_box(tmp_path / "secret.stl")
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "link.stl").symlink_to(tmp_path / "secret.stl")
    (folder / "lfs.stl").write_text(
        "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 100000\n" * 2
    )
    (folder / "text.stl").write_text("solid shank\n" + "facet normal 0 0 0\n" * 20)
    for name in (
        "link.stl",
        "lfs.stl",
        "text.stl",
        "../secret.stl",
        str(tmp_path / "secret.stl"),
        "x" * 5000,
    ):
        with pytest.raises(BadFile, match="leg FL has no foot"):
            read(folder, meshed(name))


def test_what_a_link_looks_like_stands_for_a_missing_mesh(tmp_path):
    missing = shape('<mesh filename="package://pip/meshes/shank.stl"/>')
    seen = shape('<cylinder radius="0.01" length="0.2"/>', "0 0 -0.1", "visual")
    robot, notes = read(tmp_path, urdf(foot="", shank=missing + seen))
    assert "feet are found on their visual ones" in notes
    assert robot.offset[0, 2, 2] == pytest.approx(-0.19, abs=0.01)


def test_an_mjcf_finds_its_meshdir_beside_its_folder(tmp_path):
    write_box(tmp_path / "assets" / "Shank.stl")
    (tmp_path / "xml").mkdir()
    text = mjcf(
        f'<body name="trunk"><freejoint/>{TRUNK}</body>',
        rest='<compiler meshdir="../assets"/><asset><mesh file="shank.stl"/></asset>',
    )
    sphere = '<geom type="sphere" size=".02" pos="0 0 -.2"/>'
    robot, _ = read(tmp_path / "xml", text.replace(sphere, '<geom type="mesh" mesh="shank"/>'))
    assert robot.n == 4


# --- limits ----------------------------------------------------------------------------------------
def test_limits_that_limit_nothing_are_told(tmp_path):
    robot, notes = read(tmp_path, urdf(limit=LIMIT.replace('"30"', '"1000"').replace('"20"', '"1000"')))
    assert "the torque limit of 1000 N·m at 12 joints (legs FL, FR, RL, RR) is beyond 10 × weight" in notes
    assert "the velocity limit of 1000 rad/s at 12 joints is beyond 99 rad/s" in notes
    unlimited, _ = read(tmp_path, urdf(limit=LIMIT.replace('"30"', '"0"').replace('"20"', '"0"')))
    assert same(robot, unlimited)
    assert robot.rate_max is None


def test_velocity_limits_are_read_and_kept(tmp_path):
    robot, notes = read(tmp_path, urdf())
    assert robot.rate_max is not None
    assert (robot.rate_max == 20.0).all()
    assert notes == ""
    again = robot_of(lists_of(robot))
    assert again.rate_max == pytest.approx(robot.rate_max)


# --- held trunks -----------------------------------------------------------------------------------
SLIDES = "".join(
    f'<joint name="b{axis}" type="{kind}" axis="{axis}"/>'.replace('name="b', 'name="b' + kind[0])
    for kind in ("slide", "hinge")
    for axis in ("1 0 0", "0 1 0", "0 0 1")
)


@pytest.mark.parametrize(
    ("base", "how"),
    [
        (
            f'<body name="trunk" pos="0 0 .3">{SLIDES}{TRUNK}</body>',
            "held in the world by the joints 'bs1 0 0',",
        ),
        (f'<body name="trunk" pos="0 0 .3">{TRUNK}</body>', "the trunk 'trunk' is fixed in the world"),
        (
            f'<body name="rail"><joint name="rail" type="slide"/><geom size=".01" mass=".001"/>'
            '<body name="trunk" pos="0 0 .3"><joint name="lift" type="slide" axis="0 0 1"/>'
            f"{TRUNK}</body></body>",
            "held in the world by the joints 'rail', 'lift'",
        ),
    ],
)
def test_a_trunk_that_is_held_floats(tmp_path, base, how):
    robot, notes = read(tmp_path, mjcf(base))
    free, _ = read(tmp_path, mjcf(f'<body name="trunk"><freejoint/>{TRUNK}</body>'))
    assert how in notes
    assert robot.mass == pytest.approx(free.mass)
    assert robot.base_mass == pytest.approx(free.base_mass, abs=2e-3)
    assert robot.branch.tolist() == free.branch.tolist()


def test_keyframes_outlast_what_is_taken_away(tmp_path):
    pose = "0 .8 -1.6 " * 4
    held = mjcf(
        f'<body name="trunk" pos="0 0 .3">{SLIDES}{TRUNK}</body>',
        rest=f'<keyframe><key name="home" qpos="0 0 0 0 0 0 {pose}"/></keyframe>',
    )
    (tmp_path / "robot.xml").write_text(held)
    m = read_model(tmp_path / "robot.xml").model
    assert m.key_qpos[0] == pytest.approx(np.array([0, 0, 0.3, 1, 0, 0, 0, *[0, 0.8, -1.6] * 4]))


# --- joints that legs of three hinges do not have ----------------------------------------------------
WHEEL = link("{n}4", 0.3, "3e-4 3e-4 3e-4", shapes=shape('<sphere radius="0.05"/>')) + joint(
    "{n}_w", "continuous", "{n}3", "{n}4", "0 0 -0.2", '<axis xyz="0 1 0"/>'
)
TOE = link("{n}4", 0.05, "5e-5 5e-5 5e-5", shapes=BALL) + joint(
    "{n}_t",
    "prismatic",
    "{n}3",
    "{n}4",
    "0 0 -0.2",
    '<axis xyz="0 0 1"/><limit lower="-.01" upper=".01" effort="9"/>',
)
PAD = link("{n}4", 0.05, "5e-5 5e-5 5e-5", shapes=BALL) + joint(
    "{n}_p", "revolute", "{n}3", "{n}4", "0 0 -0.18", f'<axis xyz="0 1 0"/>{LIMIT}'
)
ROD = (
    FOOT
    + link("{n}_rod", 0.02, "1e-5 1e-5 1e-5", "0 0 0.03")
    + joint("{n}_r", "revolute", "{n}2", "{n}_rod", "0 0 -0.05", f'<axis xyz="0 1 0"/>{LIMIT}')
)


@pytest.mark.parametrize(
    ("foot", "note"),
    [
        (WHEEL, "the wheels 'a_w', 'b_w', 'c_w', 'd_w' are locked as modelled"),
        (TOE, "the slides of springs 'a_t', 'b_t', 'c_t', 'd_t' are locked as modelled"),
        (PAD, "the joints of toes 'a_p', 'b_p', 'c_p', 'd_p' are locked as modelled"),
        (ROD, "the joints of side branches 'a_r', 'b_r', 'c_r', 'd_r' are locked as modelled"),
    ],
)
def test_wheels_toes_springs_and_rods_are_locked(tmp_path, foot, note):
    robot, notes = read(tmp_path, urdf(foot))
    assert note in notes
    assert robot.offset[0, :2] == pytest.approx(np.array([[0, 0.08, 0], [0, 0, -0.2]]))


def test_a_trunk_of_two_parts_is_locked(tmp_path):
    halves = link("rear", 3.0, "0.02 0.05 0.06") + joint(
        "waist", "revolute", "trunk", "rear", "0 0 0", f'<axis xyz="0 0 1"/>{LIMIT}'
    )
    text = urdf(more=halves)
    for n in "cd":
        text = text.replace(
            f'<parent link="trunk"/><child link="{n}1"/>', f'<parent link="rear"/><child link="{n}1"/>'
        )
    robot, notes = read(tmp_path, text)
    assert "the joints of the trunk 'waist' are locked as modelled" in notes
    assert robot.base_mass == pytest.approx(9.0)


def test_a_base_on_links_that_slide_in_the_plane_floats(tmp_path):
    """Links without mass between a world and the trunk, as files for navigation have them."""
    above, parent = '<link name="odom"/>', "odom"
    for child, kind, axis in (
        ("x", "prismatic", "1 0 0"),
        ("y", "prismatic", "0 1 0"),
        ("trunk", "continuous", "0 0 1"),
    ):
        above += "" if child == "trunk" else f'<link name="{child}"/>'
        above += joint(f"to_{child}", kind, parent, child, "0 0 0", f'<axis xyz="{axis}"/>{LIMIT}')
        parent = child
    robot, notes = read(tmp_path, urdf(more=above))
    plain, _ = read(tmp_path, urdf())
    assert notes == "the joints of the trunk 'to_trunk', 'to_y', 'to_x' are locked as modelled"
    assert same(robot, plain)


def test_arms_and_springs_of_joints_are_told(tmp_path):
    arm, parent = "", "trunk"
    for i in range(4):
        arm += link(f"arm{i}", 0.2, "1e-4 1e-4 1e-4")
        arm += joint(f"turn{i}", "revolute", parent, f"arm{i}", "0 0 0.1", f'<axis xyz="0 1 0"/>{LIMIT}')
        parent = f"arm{i}"
    _, notes = read(tmp_path, urdf(more=arm))
    assert notes == "the limb of 4 joints from 'turn0' is no leg: its joints are locked"
    _, notes = read(
        tmp_path,
        mjcf(f'<body name="trunk"><freejoint/>{TRUNK}</body>').replace(
            'joint name="b_j3"', 'joint name="b_j3" stiffness="2"'
        ),
    )
    assert "the springs at the joints 'b_j3' are left out" in notes


def test_knees_that_slide_are_named(tmp_path):
    with pytest.raises(BadFile, match=r"3 joints \(1 of them no hinge\) from 'a_j1'"):
        read(tmp_path, urdf().replace('_j3" type="revolute"', '_j3" type="prismatic"'))


def test_driven_ankles_are_no_toes(tmp_path):
    shin = link("{n}4", 0.2, "2e-4 2e-4 2e-4", "0 0 -0.1") + joint(
        "{n}_k2", "revolute", "{n}3", "{n}4", "0 0 -0.2", f'<axis xyz="0 1 0"/>{LIMIT}'
    )
    with pytest.raises(BadFile, match="4 joints from 'a_j1'"):
        read(tmp_path, urdf(shin + FOOT.replace('"{n}3"', '"{n}4"')))


LOOP = '<equality><connect name="a_loop" body1="a1" body2="a3" anchor="0 0 0"/></equality>'


def test_loops_are_told_and_named_where_no_legs_are_left(tmp_path):
    free = f'<body name="trunk"><freejoint/>{TRUNK}</body>'
    _, notes = read(tmp_path, mjcf(free, LOOP))
    assert "the loops that join 'a1' and 'a3' are left open" in notes
    rod = '<geom type="capsule" size=".01" fromto="0 0 0 0 0 -.2"/>'
    both = f'<body name="{{n}}4" pos="0 0 -.2"><joint axis="0 1 0"/>{rod}</body>'
    with pytest.raises(BadFile, match=r"its file closes loops of links .'a1' and 'a3'"):
        read(tmp_path, mjcf(free, LOOP, both))
