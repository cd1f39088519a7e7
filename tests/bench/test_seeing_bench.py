"""What bench seeing counts."""

from gaitwright.bench.claims.seeing import figures
from gaitwright.bench.evidence.seen_courses import EVERY, Course, Crossed, in_holes
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.locomotion import Brain
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import walk
from gaitwright.signals import Mission
from gaitwright.skills.chooser import fixed_skill
from oracles import robot_called

GO2 = robot_called("go2")


def test_a_foot_is_in_a_hole_where_all_around_is_higher():
    flat = load_scene("flat")
    brain = Brain.of(GO2, flat, fixed_skill(GO2, "trot", 0.3, 0.0, 0.0, "numerical"))
    recording = walk(brain, MujocoPlant(GO2, flat), Mission(()), 0.4, seed=1)
    looks = len(range(EVERY, len(recording), EVERY))  # at the first no foot has felt its load yet
    assert in_holes(GO2, flat, recording) == 0
    bounds = (-5.0, -5.0, 5.0, 5.0)
    pit = Scene("pit", Flat(), (Box(0.0, 0.0, 0.0, 20.0, 20.0, 0.4),), bounds)
    assert in_holes(GO2, pit, recording) == looks
    step = Scene("step", Flat(), (Box(0.0, 5.2, 0.0, 10.0, 10.0, 0.4),), bounds)
    assert in_holes(GO2, step, recording) == 0, "beside a step is no hole"


def test_who_did_not_arrive_is_named():
    good = Crossed(True, False, "arrived at the goal", 10.0, 25.0, 0, 0.0)
    bad = Crossed(False, True, "fell: the body leaned 61°", 3.0, 9.0, 2, 0.0)
    courses = [Course("forest", 1, None), Course("maze", 2, None)]
    arrived, clean = figures("camera", courses, [good, bad], least=0.9)
    assert (arrived.measured, clean.measured) == (1.0, 1.0) and not arrived.reached
    assert "maze 2: fell" in arrived.note and "10 m in 25 s" in arrived.note
