"""MJCF and URDF files of users: what is read out of them, and what is refused with which sentence."""

from pathlib import Path

import numpy as np
import pytest

from gaitwright.description.derive import derive
from gaitwright.description.mujoco_model import compiled
from gaitwright.errors import BadFile
from gaitwright.model.kinematics import angles
from gaitwright.numerics.geometry import GRAVITY


# --- robots written here ---------------------------------------------------------------------------
def mjcf(legs: str, base: str = "<freejoint/>", rest: str = "") -> str:
    """An MJCF robot with these legs."""
    body = '<inertial mass="8" pos="0 0 0" diaginertia=".1 .2 .2"/>'
    return f"""<mujoco><worldbody><body name="base">{base}{body}{legs}</body></worldbody>{rest}</mujoco>"""


def leg(name: str, x: float, y: float, foot: str = '<geom size=".02" pos="0 0 -.2"/>', **axes: str) -> str:
    """A mammal leg with links of 0.2 m; `first`, `second`, `third` are its axes."""
    first, second = axes.get("first", "1 0 0"), axes.get("second", "0 1 0")
    third = axes.get("third", "0 1 0")
    body = '<inertial mass=".5" pos="0 0 -.05" diaginertia=".001 .001 .001"/>'
    return f"""<body name="{name}1" pos="{x} {y} 0">{body}<joint name="{name}a" axis="{first}"/>
      <body name="{name}2" pos="0 {0.05 if y > 0 else -0.05} 0">{body}<joint name="{name}b" axis="{second}"/>
      <body name="{name}3" pos="0 0 -.2">{body}<joint name="{name}c" axis="{third}"/>{foot.format(name=name)}
      </body></body></body>"""


def legs(n: int = 4, **how: str) -> str:
    """`n` legs in pairs."""
    return "".join(leg(f"leg{i}", 0.3 - 0.2 * (i // 2), 0.1 if i % 2 == 0 else -0.1, **how) for i in range(n))


def written(tmp_path: Path, text: str, name: str = "robot.xml") -> Path:
    path = tmp_path / name
    path.write_text(text)
    return path


def read(tmp_path: Path, text: str, name: str = "robot.xml"):
    """The robot in a text, read in this process."""
    path = written(tmp_path, text, name)
    return derive(compiled(path), path.stem)


def test_missing_torque_limits_are_derived_and_told(tmp_path):
    robot, notes = read(tmp_path, mjcf(legs()))
    assert robot.tau_max == pytest.approx(14.0 * GRAVITY / 2 * 0.2)
    assert "no torque limit is given for 12 joints" in notes[0]
    assert "the centre of mass is 0.04 m outside the feet: 'base' (8 of 14 kg)" in notes[1]
    assert (robot.q_max == np.pi).all()


@pytest.mark.parametrize(
    ("actuator", "limit"),
    [
        ('<motor joint="leg0a" ctrlrange="-2 2" gear="10"/>', 20.0),
        ('<general joint="leg0a" ctrlrange="-2 2" gainprm="3"/>', 6.0),
        ('<motor joint="leg0a" ctrlrange="-9 9" forcerange="-4 4" gear="2"/>', 8.0),
        ('<position joint="leg0a" ctrlrange="-1 1" forcerange="-7 7"/>', 7.0),
    ],
)
def test_torque_limits_of_actuators(tmp_path, actuator, limit):
    robot, _ = read(tmp_path, mjcf(legs(), rest=f"<actuator>{actuator}</actuator>"))
    assert robot.tau_max[0, 0] == pytest.approx(limit)


def test_eight_legs(tmp_path):
    robot, _ = read(tmp_path, mjcf(legs(8)))
    assert robot.legs == ("FL", "FR", "M1L", "M1R", "M2L", "M2R", "RL", "RR")


def test_heads_and_arms_are_locked_into_the_base(tmp_path):
    link = '<inertial mass="1" pos="0 0 .1" diaginertia=".01 .01 .01"/>'
    head = f'<body pos=".4 0 0">{link}<joint name="neck"/></body>'
    arm = (
        "".join(f'<body pos="0 0 .1">{link}<joint name="arm{i}" axis="0 1 0"/>' for i in range(3))
        + "</body>" * 3
    )
    robot, _ = read(tmp_path, mjcf(legs() + head + arm))
    assert robot.n == 4
    assert robot.base_mass == pytest.approx(12.0)


def test_joint_positions_count_from_ref(tmp_path):
    """A joint with `ref` shows that angle as modelled; our zero is where MuJoCo's joint position is zero."""
    text = mjcf(legs()).replace('name="leg0c"', 'name="leg0c" ref="30"')
    robot, _ = read(tmp_path, text)
    assert robot.offset[0, 2] == pytest.approx([0.1, 0.0, -0.2 * np.cos(np.pi / 6)])


@pytest.mark.parametrize(
    ("foot", "centre", "radius"),
    [
        ('<geom type="capsule" size=".015" fromto="0 0 -.05 0 0 -.19"/>', [0, 0, -0.19], 0.015),
        ('<geom type="cylinder" size=".03 .01" euler="90 0 0" pos="0 0 -.18"/>', [0, 0, -0.18], 0.03),
        ('<site name="{name}_foot" pos="0 0 -.2"/>', [0, 0, -0.2], 0.004),
        ('<body name="{name}_toe" pos=".01 0 -.2"/>', [0.01, 0, -0.2], 0.02 * np.hypot(0.01, 0.2)),
    ],
)
def test_feet_of_other_shapes(tmp_path, foot, centre, radius):
    robot, _ = read(tmp_path, mjcf(legs(foot=foot)))
    assert robot.offset[0, 2] == pytest.approx(centre)
    assert robot.foot_radius == pytest.approx([radius] * 4)


def test_a_box_for_a_foot_touches_the_ground_where_it_is_lowest(tmp_path):
    """The sphere's lowest point and the box's lowest edge are at one height in the nominal stance."""
    robot, _ = read(tmp_path, mjcf(legs(foot='<geom type="box" size=".01 .02 .1" pos="0 0 -.1"/>')))
    q, _ = angles(robot, robot.nominal_feet)
    turn = q[0, 1] + robot.sign[0] * q[0, 2]
    knee = -0.2 * np.cos(q[0, 1])
    box_low = knee - 0.2 * np.cos(turn) - 0.01 * abs(np.sin(turn))
    assert robot.nominal_feet[0, 2] - robot.foot_radius[0] == pytest.approx(box_low, abs=2e-3)
    assert robot.foot_radius[0] == pytest.approx(0.02)


BOX_CORNERS = [(x, y, z) for x in (-0.01, 0.01) for y in (-0.02, 0.02) for z in (-0.2, 0.0)]
BOX_FACES = ("124", "143", "578", "586", "156", "162", "348", "387", "137", "175", "268", "284")
BOX = "".join(f"v {x} {y} {z}\n" for x, y, z in BOX_CORNERS) + "".join(
    f"f {' '.join(f)}\n" for f in BOX_FACES
)
"""An OBJ file of the box below: its twelve triangles by the numbers of their corners."""


def test_a_mesh_for_a_foot_is_as_good_as_a_box(tmp_path):
    (tmp_path / "box.obj").write_text(BOX)
    mesh, _ = read(
        tmp_path,
        mjcf(legs(foot='<geom type="mesh" mesh="box"/>'), rest='<asset><mesh file="box.obj"/></asset>'),
    )
    box, _ = read(tmp_path, mjcf(legs(foot='<geom type="box" size=".01 .02 .1" pos="0 0 -.1"/>')))
    assert mesh.offset == pytest.approx(box.offset, abs=1e-6)
    assert mesh.foot_radius == pytest.approx(box.foot_radius, abs=1e-6)


def test_a_mesh_that_nothing_hangs_on_may_be_missing(tmp_path):
    feet = '<geom type="mesh" mesh="shell"/><geom size=".02" pos="0 0 -.2"/>'
    robot, _ = read(
        tmp_path, mjcf(legs(foot=feet), rest='<asset><mesh name="shell" file="../no.stl"/></asset>')
    )
    assert robot.foot_radius == pytest.approx([0.02] * 4)


def test_a_link_out_of_the_folder_is_outside(tmp_path):
    (tmp_path / "inner").mkdir()
    (tmp_path / "legs.xml").write_text(f"<mujocoinclude>{legs()}</mujocoinclude>")
    (tmp_path / "inner" / "legs.xml").symlink_to(tmp_path / "legs.xml")
    with pytest.raises(BadFile, match="not a file inside its own folder"):
        read(tmp_path / "inner", mjcf('<include file="legs.xml"/>'))


URDF_LEG = """
<link name="{n}1"><inertial><mass value="1"/><origin xyz="0 0 0"/>
  <inertia ixx=".01" iyy=".01" izz=".01" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="{n}2"><inertial><mass value="1"/><origin xyz="0 0 -.1"/>
  <inertia ixx=".01" iyy=".01" izz=".01" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><geometry><mesh filename="package://robot/meshes/thigh.dae"/></geometry></collision></link>
<link name="{n}3"><inertial><mass value="1"/><origin xyz="0 0 -.1"/>
  <inertia ixx=".01" iyy=".01" izz=".01" ixy="0" ixz="0" iyz="0"/></inertial>
  <visual><geometry><mesh filename="../meshes/calf.stl"/></geometry></visual></link>
<link name="{n}_foot"><collision><geometry><sphere radius=".03"/></geometry></collision></link>
<joint name="{n}a" type="revolute"><parent link="base"/><child link="{n}1"/>
  <origin xyz="{x} {y} 0"/><axis xyz="1 0 0"/>
  <limit lower="-1" upper="1" effort="11" velocity="9"/><dynamics damping=".3" friction=".2"/></joint>
<joint name="{n}b" type="revolute"><parent link="{n}1"/><child link="{n}2"/>
  <origin xyz="0 {d} 0"/><axis xyz="0 1 0"/>
  <limit lower="-3" upper="3" effort="12" velocity="9"/></joint>
<joint name="{n}c" type="revolute"><parent link="{n}2"/><child link="{n}3"/>
  <origin xyz="0 0 -.2"/><axis xyz="0 -1 0"/>
  <limit lower="-2" upper="2" effort="13" velocity="9"/></joint>
<joint name="{n}f" type="fixed"><parent link="{n}3"/><child link="{n}_foot"/>
  <origin xyz="0 0 -.25"/></joint>"""
URDF_BASE = """<link name="base"><inertial><mass value="10"/>
  <inertia ixx=".1" iyy=".2" izz=".2" ixy="0" ixz="0" iyz="0"/>
  </inertial><collision><geometry><box size=".6 .2 .1"/></geometry></collision></link>"""
URDF_LEGS = "".join(
    URDF_LEG.format(n=f"leg{i}", x=x, y=y, d=0.08 if y > 0 else -0.08)
    for i, (x, y) in enumerate([(-0.3, -0.1), (-0.3, 0.1), (0.3, 0.1), (0.3, -0.1)])
)
FLOATING = (
    '<link name="odom"/><joint name="f" type="floating"><parent link="odom"/><child link="base"/></joint>'
)


@pytest.mark.parametrize(
    "above", ["", FLOATING, FLOATING.replace("floating", "fixed").replace("odom", "world")]
)
def test_urdf(tmp_path, above):
    robot, notes = read(tmp_path, f'<robot name="r">{above}{URDF_BASE}{URDF_LEGS}</robot>', "r.urdf")
    assert notes == ()
    assert robot.total_mass == pytest.approx(22.0)
    assert robot.hip[0] == pytest.approx([0.3, 0.1, 0.0])
    assert robot.offset[0, 2] == pytest.approx([0.0, 0.0, -0.25])
    assert robot.foot_radius == pytest.approx([0.03] * 4)
    assert (robot.sign == -1.0).all()
    assert robot.tau_max == pytest.approx(np.tile([11.0, 12.0, 13.0], (4, 1)))
    assert (robot.damping[:, 0] == 0.3).all()
    assert (robot.friction[:, 0] == 0.2).all()
    assert robot.trunk == pytest.approx(np.array([[0, 0, 0], [0.3, 0.1, 0.05]]))


def test_includes_of_the_same_folder(tmp_path):
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "legs.xml").write_text(f"<mujocoinclude>{legs()}</mujocoinclude>")
    robot, _ = read(tmp_path, mjcf('<include file="parts/legs.xml"/>'))
    assert robot.n == 4


# --- what is refused -------------------------------------------------------------------------------
NO_TRUNK = mjcf("").replace("<freejoint/>", "")
REFUSED = {
    "not XML": "robots are great",
    "outermost element is <html>": "<html/>",
    "DOCTYPE": '<!DOCTYPE mujoco [<!ENTITY a "b">]><mujoco/>',
    "nest deeper": "<mujoco>" + "<body>" * 150 + "</body>" * 150 + "</mujoco>",
    "MuJoCo refuses it: Schema violation": "<mujoco><worldbody><nonsense/></worldbody></mujoco>",
    "MuJoCo refuses it: repeated name 'leg01'": mjcf(legs(2) * 2),
    "no floating body": NO_TRUNK,
    "the floating body has no joints": mjcf(""),
    "found limbs of 2 joints from 'leg0b'": mjcf(legs()).replace('<joint name="leg0a" axis="1 0 0"/>', ""),
    "0 legs of three hinges where 4, 6 or 8": mjcf(legs()).replace('c" axis="0 1 0"', 'c" type="slide"'),
    "2 legs of three hinges": mjcf(legs(2)),
    "on the left (y > 0) and 2 on the right": mjcf(legs(5)),
    "its second hinge is 45.00° from square": mjcf(legs(second="1 1 0")),
    "its third hinge is 90.00° from parallel": mjcf(legs(third="0 0 1")),
    "leg FL has no foot": mjcf(legs(foot="")),
    "leg FL: its thigh has no length": mjcf(legs()).replace('pos="0 0 -.2">', 'pos="0 .1 0">'),
    "leg FL: its shank has no length: knee and foot are 0 m apart": mjcf(
        legs(foot='<geom size=".02" pos="0 .1 0"/>')
    ),
    "mass of the body is not finite or not below 1e+06": mjcf(legs()).replace('mass="8"', 'mass="1e300"'),
    "damping of leg FR, knee is not finite or not below 1e+06 (SI units): 1e+30": mjcf(legs()).replace(
        'name="leg1c"', 'name="leg1c" damping="1e30"'
    ),
    "armature of leg FL, hip 2 is -1; expected 0 or more": mjcf(legs()).replace(
        'name="leg0b"', 'name="leg0b" armature="-1"'
    ),
    "the place of leg FL, knee, is not finite or not below 1e+06 (SI units): -1e+30": mjcf(legs()).replace(
        'pos="0 0 -.2"><inertial', 'pos="0 0 -1e30"><inertial'
    ),
    "leg FL has a thigh or shank without mass: [1.0, 0.0, 0.5] kg": mjcf(legs())
    .replace('<joint name="leg0b" axis="0 1 0"/>', "")
    .replace(
        '<joint name="leg0c" axis="0 1 0"/>',
        '<joint name="leg0b" axis="0 1 0" pos="0 0 .2"/><joint name="leg0c" axis="0 1 0"/>',
    ),
    "the mass of 'leg01' is -1 kg; expected 0 or more": mjcf(legs()).replace('mass=".5"', 'mass="-1"'),
    "<attach> is not supported": mjcf('<attach model="other" prefix="a"/>'),
    "includes '../secret.xml'": mjcf('<include file="../secret.xml"/>'),
    "includes '/etc/hostname'": mjcf('<include file="/etc/hostname"/>'),
    "twice": mjcf('<include file="robot.xml"/>'),
    "takes its mass from mesh 'm'": mjcf(
        legs(foot='<body><geom type="mesh" mesh="m"/></body>'),
        rest='<asset><mesh name="m" file="/etc/passwd"/></asset>',
    ),
    "xacro": '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro/></robot>',
}


URDF = f'<robot name="r">{URDF_BASE}{URDF_LEGS}</robot>'
AXIS = '<axis xyz="0 -1 0"/>'
NOT_NUMBERS = {
    "pos='0 0 nan' of <inertial> in body 'base' is not finite": mjcf(legs()).replace("0 0 0", "0 0 nan"),
    "mass='inf' of <inertial> in body 'leg01' is not finite": mjcf(legs()).replace('".5"', '"inf"', 1),
    "axis='0 1e400 0' of joint 'leg1b' is not finite": mjcf(legs()).replace(
        'name="leg1b" axis="0 1 0"', 'name="leg1b" axis="0 1e400 0"'
    ),
    "range='-Infinity 1' of joint 'leg0c' is not finite": mjcf(legs()).replace(
        'name="leg0c"', 'name="leg0c" range="-Infinity 1"'
    ),
    "the axis '0 0 0' of joint 'leg2a' has no length": mjcf(legs()).replace(
        'name="leg2a" axis="1 0 0"', 'name="leg2a" axis="0 0 0"'
    ),
    "the axis '0 1e-16 -0.0' of joint 'leg3c' has no length": mjcf(legs()).replace(
        'name="leg3c" axis="0 1 0"', 'name="leg3c" axis="0 1e-16 -0.0"'
    ),
    "MuJoCo refuses it: bad format in attribute 'axis'": mjcf(legs()).replace("1 0 0", "1 zero 0"),
    "xyz='0 nan 0' of <axis> in joint 'leg0c' is not finite": URDF.replace(
        AXIS, AXIS.replace("-1", "nan"), 1
    ),
    "the axis '0 0 0' of <axis> in joint 'leg0c' has no length": URDF.replace(
        AXIS, AXIS.replace("-1", "0"), 1
    ),
    "ixx='1e309' of <inertia> in link 'leg01' is not finite": URDF.replace('ixx=".01"', 'ixx="1e309"', 1),
}
"""What is no number, or no direction, before MuJoCo sees it; in MJCF and in URDF."""


@pytest.mark.parametrize("sentence", NOT_NUMBERS)
def test_what_is_no_number_is_told_with_its_place(tmp_path, sentence):
    text = NOT_NUMBERS[sentence]
    with pytest.raises(BadFile) as error:
        read(tmp_path, text, "robot.urdf" if text.startswith("<robot") else "robot.xml")
    assert sentence in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("length", "text"),
    [("-.2", "thigh has no length: hip 2 and knee"), ("-.25", "shank has no length: knee")],
)
def test_a_urdf_whose_hinges_coincide_is_told_with_leg_and_link(tmp_path, length, text):
    flat = URDF.replace(f'<origin xyz="0 0 {length}"/>', '<origin xyz="0 .01 0"/>')
    with pytest.raises(BadFile, match=f"leg FL: its {text}.* 0 m apart.*more than 1e-06 m"):
        read(tmp_path, flat, "robot.urdf")


@pytest.mark.parametrize("sentence", REFUSED)
def test_refused_with_a_sentence(tmp_path, sentence):
    with pytest.raises(BadFile) as error:
        read(tmp_path, REFUSED[sentence])
    assert sentence in str(error.value)
    assert "\n" not in str(error.value)
