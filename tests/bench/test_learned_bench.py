"""What the bench of the learned controller measures with: parts left out, drivers in turn, rows beside the
teacher's."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from gaitwright import bench
from gaitwright.bench.claims.learned_courses import BOXES_END, COURSES, Course
from gaitwright.bench.claims.learned_parts import CASES, PARTS, trial
from gaitwright.bench.evidence.alternations import SWITCHES, alternated
from gaitwright.bench.evidence.beside_teacher import driven_by, handed_over, survived
from gaitwright.bench.evidence.played_share import played_share
from gaitwright.bench.evidence.played_without import LeftOut, PlayedWithout
from gaitwright.bench.trial import Outcome, Then, Trial, brain_for, profile_of, robot_named, simulate
from gaitwright.control.learned.controller import LearnedController
from gaitwright.control.numerical import NumericalController
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Lap
from gaitwright.plant.registry import make_plant
from gaitwright.session import DT, Session
from gaitwright.signals import Mission

GO2 = robot_named("go2")
SMALL = ("nothing", "the weight along a slope")
NOT_REGULATED = LeftOut(stance=True, swing=True, linear=True, angular=True)


@cache
def learned() -> LearnedController:
    return LearnedController(GO2, {"trot": (profile_of("go2", "trot"),)}, NumericalController(GO2))


@cache
def laps() -> tuple[Lap, ...]:
    """Some laps of a trot under the numerical controller."""
    asked, scene = Trial("go2", "flat", 1.6, 3, speed=0.4), load_scene("flat")
    plant = make_plant("mujoco", GO2, scene, DT)
    session = Session(brain_for(asked, GO2, scene), plant, Mission(()), asked.seconds, asked.seed)
    return tuple([lap for lap in session if lap.sensed.time > 1.0][::23])


def torques(lap: Lap, left_out: LeftOut, **seen: np.ndarray) -> np.ndarray:
    command, _ = PlayedWithout(learned(), left_out).command(
        lap.target, replace(lap.sensed, **seen), None, lap.call
    )
    return command.tau


# --- parts left out --------------------------------------------------------------------------------
def test_with_nothing_left_out_the_law_is_the_products():
    for lap in laps():
        whole, _ = learned().command(lap.target, lap.sensed, None, lap.call)
        np.testing.assert_array_equal(torques(lap, LeftOut()), whole.tau)


def test_without_pull_and_regulation_it_does_not_matter_how_fast_the_body_goes():
    pushed = np.array([0.4, -0.3, 0.1])
    for lap in laps():
        faster = lap.sensed.velocity_w + pushed
        alone = torques(lap, NOT_REGULATED)
        np.testing.assert_allclose(torques(lap, NOT_REGULATED, velocity_w=faster), alone, atol=1e-9)
        assert np.abs(torques(lap, LeftOut(), velocity_w=faster) - torques(lap, LeftOut())).max() > 0.5


@pytest.mark.parametrize("part", [part for part in PARTS if part not in SMALL])
def test_every_part_makes_a_difference(part):
    off = [np.abs(torques(lap, PARTS[part]) - torques(lap, LeftOut())).max() for lap in laps()]
    assert max(off) > 0.01


def test_only_the_legs_that_are_down_lose_what_pulls_them():
    for lap in laps():
        off = np.abs(torques(lap, LeftOut(stance=True)) - torques(lap, LeftOut())).max(axis=1)
        assert not off[~lap.target.stance].any()


def test_the_weight_along_a_slope_is_nothing_where_there_is_none():
    lap = laps()[0]
    level = lap._replace(target=replace(lap.target, normal_w=np.array([0.0, 0.0, 1.0])))
    tilted = lap._replace(target=replace(lap.target, normal_w=np.array([-0.17, 0.0, 0.985])))
    for some, most in ((level, 1e-9), (tilted, None)):
        off = np.abs(torques(some, LeftOut(slope=True)) - torques(some, LeftOut())).max()
        assert off <= most if most else off > 0.5


def test_a_trial_does_without_a_part():
    found = [simulate(replace(trial(CASES[1], 0, PARTS[part]), seconds=2.5)) for part in ("nothing", "both")]
    assert found[0].report.state_hash != found[1].report.state_hash
    assert found[0].kept_up and found[0].report.driver_share["learned"] > 0.15


# --- drivers in turn -------------------------------------------------------------------------------
def test_drivers_alternate_without_a_leap():
    run = alternated(("trot", 0))
    assert not run.fell and len(run.at_switch) == SWITCHES
    assert run.at_switch.max() < 0.5 < run.else_where.max()
    assert len(run.after) >= 24 * SWITCHES


# --- what is played ---------------------------------------------------------------------------------
def test_most_of_a_run_is_played_back():
    assert played_share("go2", "run", 0) > 0.85  # 0.65 in a limp


# --- beside the teacher ----------------------------------------------------------------------------
def test_the_teacher_has_the_same_starts():
    late, alone = handed_over("trot", 3, 5.0), Trial("go2", "flat", 5.0, 3, then=Then("walk", 2.0))
    assert driven_by("numerical", late) == replace(late, then=Then("trot", 2.0, "numerical", True))
    assert driven_by("learned", late) == late
    assert driven_by("learned", alone) == replace(alone, driver="learned")


@pytest.fixture(scope="module")
def one() -> Outcome:
    return simulate(Trial("go2", "flat", 0.4, 0, speed=0.4))


def test_what_is_wanted_follows_the_teacher(one):
    fell = replace(one, kept_up=False)
    found = {"numerical": [one] * 18 + [fell] * 2, "learned": [one] * 17 + [fell] * 3}
    assert survived("rows", found, beside=0.10).reached is True
    assert survived("rows", found, beside=0.01).reached is False
    assert survived("rows", found).reached is None
    assert "numerical 18 of 20" in survived("rows", found, 0.5).note


def test_across_is_beyond_the_last_obstacle(one):
    course, length = next(c for c in COURSES if c.end == BOXES_END), GO2.body_length
    there, before = ((course.end + share * length) / length for share in (0.6, 0.4))
    assert course.is_across(replace(one, off_goal=there))
    assert not course.is_across(replace(one, off_goal=before))
    assert not course.is_across(replace(one, off_goal=there, kept_up=False))
    assert Course("slope:15", "trot", 8.0).is_across(one)


def test_boxes_end_where_the_course_says():
    scene = load_scene("boxes:0.08")
    x = np.linspace(0.0, 5.0, 5001)
    height = np.asarray(scene.height(x, np.zeros_like(x)))
    assert x[height > 0.0].max() == pytest.approx(BOXES_END, abs=2e-3)
    assert set(np.round(height, 9)) == {0.0, 0.08}


def test_bench_learned_is_all_of_it():
    assert [claim for _, claim in bench.claims_named(["learned"])] == list(bench.GROUPS["learned"])
