"""A stream of moments gives what one tick after another gives, bit for bit."""

from dataclasses import replace

import numpy as np
import pytest

from gaitwright.control.certificate import explain, felt_limits
from gaitwright.control.moments import moment_of, moments_of, row
from gaitwright.control.numerical import NumericalController
from gaitwright.control.stream import CHUNK, Efforts, Job, stream
from gaitwright.control.thesis_program import LinearSettings
from gaitwright.errors import WrongUse
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain, Lap
from gaitwright.model.robot import Robot
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import Session
from gaitwright.signals import Mission, Torques
from gaitwright.skills.chooser import fixed_skill
from oracles import robot_called


def laps(name: str, skill: str, speed: float, seconds: float) -> list[Lap]:
    robot, scene = robot_called(name), load_scene("flat")
    brain = Brain.of(robot, scene, fixed_skill(robot, skill, speed, 0.0, 0.0, "numerical"))
    return list(Session(brain, MujocoPlant(robot, scene), Mission(()), seconds))


def job_of(robot: Robot, walked: list[Lap]) -> Job:
    return Job(robot, moments_of([lap.sensed for lap in walked], [lap.target for lap in walked]))


def tick_by_tick(robot: Robot, walked: list[Lap], method: str) -> list[Torques]:
    controller, done, memory = NumericalController(robot, method), [], None
    for lap in walked:
        command, memory = controller.command(lap.target, lap.sensed, memory)
        done.append(command)
    return done


@pytest.fixture(scope="module")
def trot() -> list[Lap]:
    return laps("dog", "trot", 0.4, 2.2)


def same(efforts: Efforts, ticks: list[Torques]) -> bool:
    return all(
        np.array_equal(getattr(efforts, name), [getattr(t, name) for t in ticks])
        for name in ("tau", "forces_w", "multipliers", "residual")
    )


@pytest.mark.parametrize("cores", [1, 2, 5])
def test_many_jobs_at_once_equal_one_tick_at_a_time(trot: list[Lap], cores: int) -> None:
    dog, bug = robot_called("dog"), robot_called("insect")
    crawl = laps("insect", "walk", 0.05, 0.6)
    assert len(trot) > 2 * CHUNK, "more than one chunk"
    linear = replace(job_of(dog, trot[:600]), method="lp")
    jobs = [job_of(dog, trot), job_of(bug, crawl), job_of(dog, trot[:7]), linear]
    first, second, third, fourth = stream(jobs, cores=cores)
    assert same(first, tick_by_tick(dog, trot, "qp"))
    assert same(second, tick_by_tick(bug, crawl, "qp"))
    assert same(third, tick_by_tick(dog, trot[:7], "qp"))
    assert same(fourth, tick_by_tick(dog, trot[:600], "lp"))


def test_forces_before_the_first_moment_count(trot: list[Lap]) -> None:
    dog = robot_called("dog")
    whole = stream([job_of(dog, trot)])[0]
    rest = replace(job_of(dog, trot[500:]), start=whole.forces_w[499])
    np.testing.assert_array_equal(stream([rest])[0].tau, whole.tau[500:])
    assert (stream([replace(rest, start=None)])[0].tau != whole.tau[500:]).any()


def test_held_dynamics_cost_accuracy_and_only_that(trot: list[Lap]) -> None:
    job = job_of(robot_called("dog"), trot)
    exact = stream([job])[0].tau
    worse = [float(np.sqrt(np.mean((stream([job], every=n)[0].tau - exact) ** 2))) for n in (1, 2, 8, 32)]
    assert worse[0] == 0.0 and worse == sorted(worse) and worse[1] < 0.2 * worse[3]


def test_a_row_holds_all_of_a_moment(trot: list[Lap]) -> None:
    lap = trot[100]
    moment = moment_of(row(lap.sensed, lap.target))
    s, t = lap.sensed, lap.target
    for mine, theirs in [
        (moment.position, s.position_w), (moment.orientation, s.orientation_wb),
        (moment.velocity, s.velocity_w),
        (moment.omega_b, s.angular_velocity_b), (moment.q, s.q), (moment.qd, s.qd), (moment.stance, t.stance),
        (moment.load_scale, t.load_scale), (moment.normal, t.normal_w), (moment.position_d, t.position_w),
        (moment.velocity_d, t.velocity_w), (moment.acceleration_d, t.acceleration_w),
        (moment.rotation_d, t.rotation_wb),
        (moment.omega_d, t.angular_velocity_w), (moment.omega_rate_d, t.angular_acceleration_w),
        (moment.feet_p, t.feet_w), (moment.feet_v, t.feet_velocity_w), (moment.feet_a, t.feet_acceleration_w),
    ]:  # fmt: skip
        np.testing.assert_array_equal(mine, theirs)


def test_wrong_moments_are_named(trot: list[Lap]) -> None:
    job = job_of(robot_called("dog"), trot[:3])
    with pytest.raises(WrongUse, match="job 0: dog has 4 legs, so 112 numbers a moment, not 111"):
        stream([replace(job, moments=job.moments[:, :-1])])
    broken = job.moments.copy()
    broken[2, 5] = np.nan
    with pytest.raises(WrongUse, match="job 1: moment 2 holds a number that is not finite"):
        stream([job, replace(job, moments=broken)])
    with pytest.raises(WrongUse, match="n at least 1, not 0"):
        stream([job], every=0)
    with pytest.raises(WrongUse, match="3 components of a foot's load, not 6"):
        stream([replace(job, method="lp", linear=LinearSettings(components=6.0))])
    with pytest.raises(WrongUse, match="are not 4 × 3 finite numbers"):
        stream([replace(job, start=np.full((4, 3), np.nan))])
    with pytest.raises(WrongUse, match="at least 1 core, not -1"):
        stream([job], cores=-1)


def test_no_moments_give_no_torques() -> None:
    dog = robot_called("dog")
    assert stream([Job(dog, np.zeros((0, 112)))])[0].tau.shape == (0, 4, 3)


# --- the certificate in words ----------------------------------------------------------------------
def test_a_weak_knee_is_named_with_its_limit(trot: list[Lap]) -> None:
    dog = robot_called("dog")
    lap = [lap for lap in trot[300:] if lap.target.stance.all()][12]
    strong = NumericalController(dog).command(lap.target, lap.sensed)[0]
    leg = int(np.abs(strong.tau[:, 2]).argmax())
    limits = dog.tau_max.copy()
    limits[leg, 2] = 0.8 * abs(strong.tau[leg, 2])
    weak = replace(dog, tau_max=limits)
    torques = NumericalController(weak).command(lap.target, lap.sensed)[0]
    felt = felt_limits(weak, torques)
    sentence = f"foot {dog.legs[leg]} at its torque limit: knee, {limits[leg, 2]:.3g} N·m"
    assert abs(torques.tau[leg, 2]) == pytest.approx(limits[leg, 2])
    assert any(one.sentence == sentence and one.price > 0 for one in felt)
    assert [one.price for one in felt] == sorted((one.price for one in felt), reverse=True)
    assert f"{sentence} (price" in explain(weak, torques)


def test_ice_is_felt_as_friction(trot: list[Lap]) -> None:
    dog = robot_called("dog")
    lap = trot[600]
    shove = replace(lap.target, acceleration_w=np.array([0.0, 14.0, 0.0]))
    torques = NumericalController(dog).command(shove, lap.sensed)[0]
    down = [dog.legs[leg] for leg in np.flatnonzero(shove.stance)]
    sentences = [one.sentence for one in felt_limits(dog, torques)]
    assert any(
        f"foot {leg} at its friction limit towards +y" in sentence for leg in down for sentence in sentences
    )
    assert torques.residual > 0.1
