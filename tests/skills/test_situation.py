"""The situation space: one leaf per tree, the same for robots of any size, and what each name means."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_chooser import DOG, route, sensed

from gaitwright.knowledge.memory import Action
from gaitwright.model.kinematics import angles, feet
from gaitwright.numerics.geometry import GRAVITY, rotation
from gaitwright.signals import Scan
from gaitwright.skills.measured import measured, torque_utilisation
from gaitwright.skills.rule_chooser import carry_out
from gaitwright.skills.situation import FOREST, READ_FROM, named, turn_of
from oracles import robot_called

INSECT = robot_called("insect")
numbers = st.floats(0.0, 2.0)


def situation(robot, way, here, call=None):
    return named(measured(robot, way, here, call), call)


def seen(robot=DOG, **scan):
    return replace(route((5.0, 0.0)), ahead=Scan(**scan))


@given(
    st.builds(
        Scan,
        *(st.floats(-0.7, 0.7),) * 2,
        *(numbers,) * 4,
        st.floats(0.0, math.inf),
        st.floats(-math.pi, math.pi),
        st.booleans(),
    ),
    st.tuples(st.floats(-10.0, 10.0), st.floats(-10.0, 10.0)),
    st.floats(-math.pi, math.pi),
    st.floats(0.05, 2.0),
    st.booleans(),
)
def test_every_moment_has_one_leaf_in_each_tree(scan, place, yaw, speed, arrived):
    way = replace(route((5.0, 0.0), (3.0, 1.0), speed=speed, arrived=arrived), ahead=scan)
    here = sensed(place, yaw)
    found = situation(DOG, way, here)
    assert found.trees == FOREST.names and len(FOREST.names) == 15
    assert all(FOREST[tree].is_leaf(leaf) for tree, leaf in found.items())
    raw = measured(DOG, way, here)
    assert all(math.isfinite(number) for number in raw.values()) and set(raw) == {*READ_FROM, "grip"}
    assert named(raw) == found and set(READ_FROM.values()) == set(FOREST.names)


@pytest.mark.parametrize(
    ("scan", "leaf", "group"),
    [
        ({}, "flat", "easy"),
        ({"slope": math.radians(5)}, "gently uphill", "easy"),
        ({"slope": math.radians(-5)}, "gently downhill", "easy"),
        ({"slope": math.radians(12)}, "steep uphill", "up"),
        ({"slope": math.radians(-12)}, "steep downhill", "down"),
        ({"slope": 0.3, "step_up": 0.3, "roughness": 0.1}, "stairs up", "up"),
        ({"slope": -0.3, "step_down": 0.3, "roughness": 0.1}, "stairs down", "down"),
        ({"roughness": 0.05}, "rough", "broken"),
        ({"step_down": 0.1}, "rough", "broken"),
        ({"gap": 0.5, "slope": 0.3}, "gap", "broken"),
    ],
)
@pytest.mark.parametrize("robot", [DOG, INSECT], ids=["dog", "insect"])
def test_the_road_is_named_by_the_hardest_part_of_it(robot, scan, leaf, group):
    """Lengths in body heights: the same road for a robot of any size."""
    sized = {name: n if name == "slope" else n * robot.height for name, n in scan.items()}
    raw = measured(robot, seen(**sized), sensed_like(robot))
    assert named(raw)["road"] == leaf and FOREST["road"].is_below(leaf, group)


def sensed_like(robot, load: float = 0.25):
    q, _ = angles(robot, robot.nominal_feet)
    here = sensed()
    return replace(here, q=q, qd=0.0 * q, load=q[:, 0] * 0.0 + load * robot.total_mass * GRAVITY)


@given(st.floats(0.1, 179.9))
def test_left_and_right_mirror_each_other(degrees):
    left, right = turn_of(degrees), turn_of(-degrees)
    assert left.replace("left", "right") == right


def test_without_a_scan_the_road_is_what_the_body_leans_to():
    pose = replace(sensed(), orientation_wb=sensed().orientation_wb)
    uphill = replace(pose, orientation_wb=tilted(-0.2))
    assert situation(DOG, route((5.0, 0.0)), uphill)["road"] == "steep uphill"
    assert situation(DOG, route((5.0, 0.0)), pose)["road"] == "flat"


def tilted(pitch: float):
    import numpy as np

    return np.array([math.cos(pitch / 2), 0.0, math.sin(pitch / 2), 0.0])


@pytest.mark.parametrize("name", ["go2", "dog", "hexapod"])
def test_effort_is_the_static_torque_of_the_loads(name):
    """Oracle: virtual work, by finite differences of the feet's heights."""
    robot = robot_called(name)
    here = sensed_like(robot, 1.0 / robot.n)
    R, most = rotation(here.orientation_wb), 0.0
    for leg in range(robot.n):
        for joint in range(3):
            ends = []
            for step in (1e-5, -1e-5):
                q = here.q.copy()
                q[leg, joint] += step
                ends.append((R @ feet(robot, q)[leg])[2])
            torque = here.load[leg] * (ends[0] - ends[1]) / 2e-5
            most = max(most, abs(torque) / robot.tau_max[leg, joint])
    assert torque_utilisation(robot, here) == pytest.approx(most, rel=1e-6) and most > 0.0


@pytest.mark.parametrize("robot", [DOG, INSECT])
def test_the_leg_setting_names_the_side_that_carries(robot):
    def setting(loaded) -> str:
        load = np.where(loaded, 1.0, 0.0) * robot.total_mass
        here = replace(sensed(), load=load, q=np.zeros((robot.n, 3)), qd=np.zeros((robot.n, 3)))
        return str(situation(robot, route((5.0, 0.0)), here)["leg setting"])

    x, y = robot.hip[:, 0], robot.hip[:, 1]
    sides = {"front feet": x > 0.01, "hind feet": x < -0.01, "left feet": y > 0.0, "right feet": y < 0.0}
    for name, loaded in sides.items():
        assert setting(loaded) == name
    assert setting(np.ones(robot.n, bool)) == "all feet" and setting(np.zeros(robot.n, bool)) == "no feet"
    assert setting(((x > 0.01) & (y > 0.0)) | ((x < -0.01) & (y < 0.0))) == "feet across"


def test_where_the_way_began_and_ends_are_streets():
    way = replace(route((5.0, 0.0)), begins=math.pi / 2, ends=math.pi)
    found = situation(DOG, way, sensed())
    assert (found["initial location"], found["street"], found["final location"]) == ("north", "east", "west")
    nobody = situation(DOG, route((5.0, 0.0)), sensed())
    assert nobody["initial location"] == nobody["final location"] == "east", (
        "an older recording: as it leads now"
    )


def test_what_it_does_is_the_kind_of_motion():
    kinds = {"stand": "standing", "turn-in-place": "turning", "climb": "walking", "trot": "trotting"}
    for skill, kind in (kinds | {"gallop": "flying"}).items():
        call = replace(carry_out(DOG, Action("trot", 0.0, 1.0), route((5.0, 0.0)), sensed()), skill=skill)
        assert situation(DOG, route((5.0, 0.0)), sensed(), call)["doing"] == kind
