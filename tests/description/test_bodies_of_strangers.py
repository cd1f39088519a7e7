"""Robots of other habits: which limbs are legs, which way is forward, how knees bend, how high it stands."""

import math

import mujoco
import numpy as np
import pytest

from gaitwright.description.derive import derive
from gaitwright.errors import BadFile
from gaitwright.model.kinematics import angles, feet, knees

LINK = '<inertial mass=".3" pos="0 0 -.05" diaginertia=".001 .001 .001"/>'
TRUNK = '<inertial mass="6" pos="{at}" diaginertia=".05 .15 .18"/><geom type="box" pos="{at}" size="{half}"/>'
CORNERS = ((1, 1), (1, -1), (-1, 1), (-1, -1))
LIMITS = 'range="-2.7 2.7"'


def robot_and_notes(limbs: str, at: str = "0 0 0", half: str = ".2 .08 .05"):
    """What is read from an MJCF robot with these limbs and its trunk at `at`."""
    text = f"""<mujoco><compiler angle="radian" autolimits="true"/><worldbody><body name="trunk"><freejoint/>
      {TRUNK.format(at=at, half=half)}{limbs}</body></worldbody></mujoco>"""
    return derive(mujoco.MjModel.from_xml_string(text), "stranger")


def chain(name: str, places: list[str], axes: tuple[str, str, str], foot: str) -> str:
    """A limb of three hinges with a ball at its end; places and axes in the parent's frame."""
    joints = zip(places, axes, "abc", strict=True)
    bodies = [f'<body pos="{p}">{LINK}<joint name="{name}_{c}" axis="{a}" {LIMITS}/>' for p, a, c in joints]
    return "".join(bodies) + f'<geom size=".02" pos="{foot}"/>' + "</body>" * 3


def dog(
    turn: float = 0.0,
    z: float = 0.0,
    lean: float = 0.0,
    hip: tuple[float, float] = (0.06, 0.08),
    names="pqrs",
) -> str:
    """Four legs that abduct, of 0.2 + 0.2 m, in axes turned by `turn` from the file's.

    `z`: hips above the origin; `lean`: the front feet are so far ahead of the knees at zero angles, the rear
    ones behind; `hip`: the first hinge's distance from the middle plane, and the second's from there.
    """
    c, s = round(math.cos(turn), 12), round(math.sin(turn), 12)

    def turned(x: float, y: float, up: float) -> str:
        return f"{c * x - s * y} {s * x + c * y} {up}"

    axes = (turned(1, 0, 0), turned(0, 1, 0), turned(0, 1, 0))
    return "".join(
        chain(
            name,
            [turned(0.2 * i, hip[0] * j, z), turned(0, hip[1] * j, 0), "0 0 -.2"],
            axes,
            turned(lean * i, 0, -0.2),
        )
        for name, (i, j) in zip(names, CORNERS, strict=True)
    )


def star(n: int, first: float = 0.0, aside: float = 0.0) -> str:
    """`n` legs that yaw, evenly around a round body, the first at that angle; its middle at y = `aside`."""
    limbs = []
    for i in range(n):
        angle = first + 2.0 * math.pi * i / n
        c, s = math.cos(angle), math.sin(angle)
        places = [f"{0.12 * c} {0.12 * s + aside} 0", f"{0.04 * c} {0.04 * s} 0", f"{0.08 * c} {0.08 * s} 0"]
        across = f"{-s} {c} 0"
        limbs.append(chain(f"leg{i}", places, ("0 0 1", across, across), f"{0.12 * c} {0.12 * s} 0"))
    return "".join(limbs)


PLAIN, _ = robot_and_notes(dog())


def assert_as_plain(robot) -> None:
    for field in ("hip", "leg_frame", "offset", "mass", "com", "nominal_feet", "base_com", "trunk"):
        assert getattr(robot, field) == pytest.approx(getattr(PLAIN, field), abs=1e-9), field
    assert (robot.branch == PLAIN.branch).all()


# --- forward ---------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("degrees", "words"),
    [(90, "the file's y axis"), (45, "45° to the left of the file's x"), (-30, "30° to the right")],
)
def test_forward_is_where_the_first_hinges_point(degrees, words):
    half = ".08 .2 .05" if degrees == 90 else ".1 .1 .05"
    robot, notes = robot_and_notes(dog(math.radians(degrees)), half=half)
    assert robot.hip == pytest.approx(PLAIN.hip, abs=1e-9)
    assert robot.nominal_feet == pytest.approx(PLAIN.nominal_feet, abs=1e-9)
    assert robot.leg_frame == pytest.approx(PLAIN.leg_frame, abs=1e-9)
    assert (robot.branch == PLAIN.branch).all()
    assert any(words in note and "along which its first hinges point" in note for note in notes)
    if degrees == 90:
        assert_as_plain(robot)


@pytest.mark.parametrize("turn", [0.0, math.pi / 2, math.pi, -math.pi / 2])
def test_names_say_which_end_is_the_front(turn):
    robot, notes = robot_and_notes(dog(turn, names=("FL", "FR", "RL", "RR")), half=".1 .1 .05")
    assert robot.hip == pytest.approx(PLAIN.hip, abs=1e-9)
    turned = [note for note in notes if note.startswith("forward is")]
    assert len(turned) == (turn != 0.0)


def test_legs_toed_in_a_little_do_not_turn_the_robot():
    """Each leg turned about its first hinge by 6°, left and right opposite ways."""
    c, t = round(math.cos(0.1), 12), round(math.sin(0.1), 12)
    limbs = [
        chain(
            name,
            [f"{0.2 * i} {0.06 * j} 0", f"{-0.08 * t} {0.08 * c * j} 0", "0 0 -.2"],
            (f"{c} {t * j} 0", f"{-t * j} {c} 0", f"{-t * j} {c} 0"),
            "0 0 -.2",
        )
        for name, (i, j) in zip("pqrs", CORNERS, strict=True)
    ]
    robot, notes = robot_and_notes("".join(limbs))
    assert not [note for note in notes if note.startswith("forward")]
    assert robot.hip == pytest.approx(PLAIN.hip)


# --- pairs -----------------------------------------------------------------------------------------
@pytest.mark.parametrize("n", [4, 6, 8])
@pytest.mark.parametrize("share", [0.0, 0.5, 0.2])
def test_crosses_hexagons_and_octagons_keep_all_their_legs(n, share):
    robot, notes = robot_and_notes(star(n, share * 2.0 * math.pi / n), half=".1 .1 .02")
    assert robot.n == n
    left, right = robot.hip[0::2], robot.hip[1::2]
    assert left == pytest.approx(right * (1.0, -1.0, 1.0), abs=1e-9)
    assert (left[:, 1] > 0.02).all()
    assert (np.diff(left[:, 0]) < 0.0).all()
    q, reached = angles(robot, robot.nominal_feet)
    assert reached.all()
    assert (q > robot.q_min).all()
    assert (q < robot.q_max).all()
    assert any("stand in pairs" in note for note in notes) != (share == 0.5)


@pytest.mark.parametrize("n", [4, 6, 8])
def test_legs_that_yaw_little_stand_less_far_to_the_side(n):
    tight = star(n).replace('_a" axis="0 0 1" range="-2.7 2.7"', '_a" axis="0 0 1" range="-.8 .8"')
    robot, notes = robot_and_notes(tight, half=".1 .1 .02")
    q, reached = angles(robot, robot.nominal_feet)
    assert reached.all()
    assert np.abs(q[:, 0]).max() == pytest.approx(0.45)
    assert not any("outside the joint limits" in note for note in notes)


@pytest.mark.parametrize("aside", [0.005, -0.03])
def test_a_hexagon_beside_the_origin_is_one(aside):
    robot, _ = robot_and_notes(star(6, aside=aside), half=".1 .1 .02")
    assert robot.n == 6
    assert robot.hip[0::2, 1] - robot.hip[1::2, 1] == pytest.approx([0.12, 0.24, 0.12])


def test_yaw_legs_along_the_long_side_walk_along_it():
    """Four legs that point away from a body which is long in y."""
    limbs = [
        chain(
            name,
            [f"{0.06 * i} {0.2 * j} 0", f"{0.04 * i} 0 0", f"{0.1 * i} 0 0"],
            ("0 0 1", "0 1 0", "0 1 0"),
            f"{0.12 * i} 0 -.02",
        )
        for name, (i, j) in zip("pqrs", CORNERS, strict=True)
    ]
    robot, notes = robot_and_notes("".join(limbs), half=".06 .2 .02")
    assert robot.hip[:, 0] == pytest.approx([0.2, 0.2, -0.2, -0.2])
    assert any(note.startswith("forward is the file's y axis") for note in notes)


@pytest.mark.parametrize(
    ("n", "counts"), [(5, "2 legs on the left (y > 0) and 2 on the right, 1 on the"), (7, "3")]
)
def test_what_makes_no_pairs_is_counted_and_refused(n, counts):
    with pytest.raises(BadFile) as error:
        robot_and_notes(star(n))
    assert str(error.value).startswith(counts)


def test_first_hinges_on_the_middle_plane_are_legs():
    robot, notes = robot_and_notes(dog(hip=(0.0, 0.14)))
    assert robot.legs == ("FL", "FR", "RL", "RR")
    assert robot.nominal_feet == pytest.approx(PLAIN.nominal_feet, abs=1e-9)
    assert all("torque" in note for note in notes)


def test_a_sentence_says_which_hinge_must_come_first():
    swapped = dog().replace('axis="1.0 0.0 0"', "first").replace('_b" axis="0.0 1.0 0"', '_b" axis="1 0 0"')
    swapped = swapped.replace("first", 'axis="0 1 0"')
    with pytest.raises(BadFile, match=r"pitch, roll, pitch; roll must come first"):
        robot_and_notes(swapped)


# --- arms ------------------------------------------------------------------------------------------
ARM = {
    "beside the middle": chain(
        "m", [".1 .03 .06", "0 0 .1", ".2 0 0"], ("0 0 1", "0 1 0", "0 1 0"), ".15 0 0"
    ),
    "on the middle": chain("m", [".1 0 .06", "0 0 .1", ".2 0 0"], ("0 0 1", "0 1 0", "0 1 0"), ".15 0 0"),
    "other axes": chain("m", [".1 .03 .06", "0 0 .1", ".2 0 0"], ("0 1 0", "0 1 0", "1 0 0"), ".15 0 0"),
}


@pytest.mark.parametrize("which", ARM)
def test_a_limb_above_the_hips_that_cannot_reach_the_ground_is_an_arm(which):
    robot, notes = robot_and_notes(dog() + ARM[which])
    assert robot.n == 4
    assert robot.hip == pytest.approx(PLAIN.hip)
    assert robot.base_mass == pytest.approx(PLAIN.base_mass + 0.9)
    assert any("'m_a' is no leg, for it starts above the hips" in note for note in notes)


@pytest.mark.parametrize("longer", [False, True])
def test_two_arms_do_not_make_a_hexapod(longer):
    arm = ARM["beside the middle"].replace(".2 0 0", ".4 0 0") if longer else ARM["beside the middle"]
    arms = arm + arm.replace('"m_', '"n_').replace(".03", "-.03")
    robot, notes = robot_and_notes(dog() + arms)
    assert robot.legs == ("FL", "FR", "RL", "RR")
    assert len([note for note in notes if "is no leg" in note]) == 2


def test_a_neck_at_the_height_of_the_hips_is_told():
    neck = chain("neck", [".25 0 0", ".1 0 0", ".1 0 0"], ("0 0 1", "0 1 0", "0 1 0"), ".1 0 0")
    robot, notes = robot_and_notes(dog() + neck)
    assert robot.n == 4
    assert any("'neck_a' is no leg, for it is unlike the others" in note for note in notes)


# --- height ----------------------------------------------------------------------------------------
@pytest.mark.parametrize("z", [0.27, 0.5, 0.08, -0.3])
def test_heights_count_from_the_hips_wherever_the_origin_is(z):
    robot, notes = robot_and_notes(dog(z=z), at=f"0 0 {z}")
    assert_as_plain(robot)
    assert robot.height == pytest.approx(PLAIN.height)
    assert any("the base's origin is moved" in note for note in notes)


# --- knees -----------------------------------------------------------------------------------------
@pytest.mark.parametrize("lean", [0.1, -0.1])
def test_rear_legs_that_mirror_the_front_ones_bend_mirrored_knees(lean):
    robot, _ = robot_and_notes(dog(lean=lean))
    q, _ = angles(robot, robot.nominal_feet)
    assert q[2:] == pytest.approx(q[:2] * (1.0, -1.0, -1.0), abs=1e-9)
    assert np.abs(q[:, 2]).max() < 1.5  # the way they lean already, not folded past straight
    ahead = (knees(robot, q) - robot.nominal_feet)[:, 0]
    assert np.sign(ahead) == pytest.approx(np.sign(lean) * np.array([-1, -1, 1, 1]))


def test_legs_that_are_alike_bend_alike():
    q, _ = angles(PLAIN, PLAIN.nominal_feet)
    assert q == pytest.approx(np.tile(q[0], (4, 1)))
    assert feet(PLAIN, q) == pytest.approx(PLAIN.nominal_feet)
