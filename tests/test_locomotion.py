"""Small missions in full physics: the lap repeats to the bit, and every end has its sentence."""

import itertools
import math
from dataclasses import dataclass, replace

import mujoco
import numpy as np
import pytest

from gaitwright.ground.scene import Scene, load_scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.locomotion import Brain, Lap, think
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import GRAVITY, rotation
from gaitwright.perception.known_ground import map_of
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.record.recording import Recording
from gaitwright.session import Session, walk
from gaitwright.signals import Mission, MotorCommand
from gaitwright.skills.chooser import fixed_skill
from gaitwright.skills.library import LIBRARY, speed_scale
from gaitwright.termination import STUCK, Ending, Termination
from oracles import robot_called

DT = 0.002
FLAT = load_scene("flat")


def holding(robot: Robot, skill: str, speed: float | None = None, turn: float = 0.0) -> Brain:
    """A brain that holds one skill on flat ground."""
    return Brain.of(robot, FLAT, fixed_skill(robot, skill, speed, 0.0, turn, "numerical"), DT)


def choosing(robot: Robot, scene: Scene = FLAT) -> Brain:
    """A brain that finds its way and chooses its skills."""
    return Brain.of(robot, scene, dt=DT)


def hold(name: str, skill: str, seconds: float, seed: int = 0, plant: MujocoPlant | None = None) -> Recording:
    robot = robot_called(name)
    return walk(holding(robot, skill), plant or MujocoPlant(robot, FLAT), Mission(()), seconds, seed)


# --- walking -------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("name", "skill"), [("go2", "walk"), ("go2", "trot"), ("dog", "trot"), ("hexapod", "trot")]
)
def test_it_goes_as_fast_as_it_is_told(name: str, skill: str) -> None:
    robot = robot_called(name)
    record = hold(name, skill, 2.0)
    assert record.stopped_because == "the 2 s asked for are over" and not record.fell
    wanted = LIBRARY[skill].speed * speed_scale(robot)
    late = record["time"] > 0.8
    start, end = record["position_w"][late][[0, -1]]
    ahead = rotation(record["orientation_wb"][late][0])[:2, 0]
    speed = (end - start)[:2] @ ahead / 1.2
    assert speed == pytest.approx(wanted, rel=0.15)
    assert np.abs(record["tau"] / robot.tau_max.ravel()).max() <= 1.0


def test_standing_it_stays() -> None:
    record = hold("go2", "stand", 1.0)
    assert record.stopped_because == "the 1 s asked for are over"
    assert np.ptp(record["position_w"], axis=0).max() < 0.03
    assert np.linalg.norm(record["velocity_w"][-1]) < 0.02


def test_turning_it_turns_to_the_side_it_is_told() -> None:
    robot = robot_called("go2")
    for turn in (0.5, -0.5):
        record = walk(
            holding(robot, "turn", 0.0, turn), MujocoPlant(robot, FLAT), Mission(()), 2.0, vary=False
        )
        w, x, y, z = record["orientation_wb"][-1]
        assert np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)) == pytest.approx(2.0 * turn, rel=0.2)


def test_a_near_goal_is_reached_and_stood_at() -> None:
    robot = robot_called("go2")
    record = walk(choosing(robot), MujocoPlant(robot, FLAT), Mission(((0.25, 0.0),)), 4.0, vary=False)
    assert record.stopped_because == "arrived at the goal" and record.arrived
    assert np.linalg.norm(record["position_w"][-1, :2] - (0.25, 0.0)) <= 0.15 * robot.body_length
    assert [record.skills[int(i)] for i in record["skill"][[0, -1]]][1] == "stand"


# --- the same again ------------------------------------------------------------------------------
def test_equal_seeds_are_equal_to_the_bit_and_others_are_not() -> None:
    plant = MujocoPlant(robot_called("go2"), FLAT)
    one, again, other = (hold("go2", "trot", 0.6, seed, plant) for seed in (7, 7, 8))
    fresh = hold("go2", "trot", 0.6, 7)
    for name in ("time", "position_w", "q", "qd", "tau", "forces_w", "phase"):
        assert one[name].tobytes() == again[name].tobytes() == fresh[name].tobytes(), name
    assert one.report().state_hash == again.report().state_hash != other.report().state_hash
    assert np.abs(one["q"][0] - other["q"][0]).max() > 1e-3, "the start itself differs"


def test_without_variation_the_seed_does_not_matter() -> None:
    robot = robot_called("go2")
    one, other = (
        walk(holding(robot, "trot"), MujocoPlant(robot, FLAT), Mission(()), 0.2, seed, vary=False)
        for seed in (1, 2)
    )
    assert one["q"].tobytes() == other["q"].tobytes()


def test_a_thought_depends_on_nothing_but_what_it_is_given() -> None:
    robot = robot_called("go2")
    brain, plant = choosing(robot), MujocoPlant(robot, FLAT)
    sensed = plant.reset(3)
    mind = brain.begin(Mission(((2.0, 1.0),)), sensed, 0.4)
    for _ in range(50):
        lap, after = think(brain, mind, sensed)
        same, _ = think(brain, mind, sensed)
        assert lap.command.tau.tobytes() == same.torques.tau.tobytes()
        assert (lap.route, lap.call) == (same.route, same.call)
        sensed, mind = plant.step(lap.command), after


# --- the end -------------------------------------------------------------------------------------
@dataclass
class Struck(MujocoPlant):
    """The real plant until `at` seconds; then something happens to the robot."""

    at: float = 0.3
    what: str = "nan"

    def step(self, command: MotorCommand):
        before = self.data.time
        sensed = super().step(command)
        if before < self.at <= self.data.time + 1e-9:
            self.strike()
            mujoco.mj_forward(self.model, self.data)
            sensed = self.sense()
        return sensed

    def strike(self) -> None:
        if self.what == "nan":
            self.data.qvel[:] = np.nan
        elif self.what == "flip":
            self.data.qpos[2:7] = 1.5 * self.robot.height, 0.0, 1.0, 0.0, 0.0
        elif self.what == "lift":
            self.data.qpos[2] += 10.0 * self.robot.height


def strike(what: str, monkeypatch: pytest.MonkeyPatch, tmp_path) -> tuple[list[Lap], Struck]:
    """Laps of a trotting robot that is struck after 0.3 s."""
    monkeypatch.chdir(tmp_path)  # MuJoCo writes its warnings into the working folder
    robot = robot_called("go2")
    plant = Struck(robot, FLAT, what=what)
    return list(Session(holding(robot, "trot"), plant, Mission(()), 2.0, vary=False)), plant


@pytest.mark.parametrize(
    ("what", "sentence", "fell", "by"),
    [
        ("nan", "the sensed state is not a number at 0.300 s: motors stopped", False, 0.31),
        ("flip", "fell: the body leaned 1", True, 0.31),
        ("lift", "lost contact: no foot has touched the ground since 0.", False, 0.7),
    ],
)
def test_a_robot_that_is_struck_down_stops(what, sentence, fell, by, monkeypatch, tmp_path) -> None:
    laps, _ = strike(what, monkeypatch, tmp_path)
    last = laps[-1]
    assert last.stopped_because.startswith(sentence)
    assert (last.fell, last.arrived) == (fell, False)
    assert last.sensed.time <= by
    assert all(lap.stopped_because is None for lap in laps[:-1])


@pytest.mark.parametrize("what", ["nan", "flip", "lift"])
def test_when_it_stops_its_motors_are_off(what: str, monkeypatch, tmp_path) -> None:
    _, plant = strike(what, monkeypatch, tmp_path)
    np.testing.assert_array_equal(plant.data.ctrl, 0.0)


def test_a_trip_that_nobody_follows_any_more_switches_the_motors_off() -> None:
    robot = robot_called("go2")
    plant = MujocoPlant(robot, FLAT)
    laps = iter(Session(holding(robot, "stand"), plant, Mission(()), 1.0, vary=False))
    for _ in itertools.islice(laps, 20):
        pass
    assert plant.data.ctrl.any()
    laps.close()
    np.testing.assert_array_equal(plant.data.ctrl, 0.0)


def test_time_up_on_the_way_says_how_far_it_is() -> None:
    robot = robot_called("go2")
    record = walk(choosing(robot), MujocoPlant(robot, FLAT), Mission(((5.0, 0.0),)), 0.5, vary=False)
    words = record.stopped_because.split()
    assert record.stopped_because.startswith("out of time after 0.5 s, ")
    assert float(words[6]) == pytest.approx(5.0 - record["position_w"][-1, 0], abs=0.05)
    assert record["time"][-1] == pytest.approx(0.5) and not record.arrived


def test_a_goal_without_a_way_is_told_at_once() -> None:
    robot = robot_called("go2")
    walled = Scene("walled", Flat(), (Box(3.0, 0.0, 0.0, 0.2, 9.0, 1.0),), (-1.0, -4.0, 7.0, 4.0))
    record = walk(choosing(robot, walled), MujocoPlant(robot, walled), Mission(((6.0, 0.0),)), 2.0)
    assert record.stopped_because == "there is no way to the goal: to (6, 0) leads no way"
    assert len(record["time"]) == 1


def test_a_robot_too_weak_to_stand_says_so() -> None:
    robot = robot_called("go2")
    lame = replace(robot, name="lame", tau_max=0.02 * robot.tau_max)
    record = walk(holding(lame, "stand"), MujocoPlant(lame, FLAT), Mission(()), 2.0, vary=False)
    assert record.stopped_because.startswith(("these feet cannot carry this load", "fell: the body sank"))
    assert record["time"][-1] < 1.0


# --- the watch, lap by lap -----------------------------------------------------------------------
@pytest.fixture(scope="module")
def on_the_way() -> tuple[Brain, Lap]:
    """One honest lap of a robot that goes somewhere."""
    robot = robot_called("go2")
    brain, mission = choosing(robot), Mission(((8.0, 0.0),))
    laps = Session(brain, MujocoPlant(robot, FLAT), mission, 60.0, vary=False)
    return brain, list(itertools.islice(laps, 20))[-1]


def later(lap: Lap, time: float, **changes) -> Lap:
    """The same lap at another time; `remaining` metres to go."""
    route = replace(lap.route, remaining=changes.pop("remaining", lap.route.remaining))
    return lap._replace(sensed=replace(lap.sensed, time=time, **changes), route=route)


def watching(brain: Brain) -> Termination:
    return Termination(brain.robot, map_of(FLAT, brain.robot).bounds, 1000.0)


def verdict(watch: Termination, lap: Lap) -> Ending | None:
    return watch.judge(lap.sensed, lap.route, lap.call, lap.target, lap.command)


def test_no_progress_is_noticed_and_progress_is_patience_anew(on_the_way) -> None:
    brain, lap = on_the_way
    patience = STUCK * math.sqrt(brain.robot.height / 0.29)
    watch = watching(brain)
    assert verdict(watch, later(lap, 0.1, remaining=5.0)) is None
    assert verdict(watch, later(lap, 0.1 + 0.99 * patience, remaining=5.0)) is None
    nearer = later(lap, 0.1 + 0.995 * patience, remaining=4.0)
    assert verdict(watch, nearer) is None
    assert verdict(watch, later(lap, 0.1 + 1.9 * patience, remaining=4.0)) is None
    stuck = verdict(watch, later(lap, 0.1 + 2.01 * patience, remaining=4.0))
    assert stuck is not None and stuck.because.startswith("stuck: no progress for 15 s at (")


def test_another_way_that_is_longer_is_patience_anew(on_the_way) -> None:
    """Planned anew: an explorer that turns back out of a trap comes no nearer than it was for a long time."""
    brain, lap = on_the_way
    patience = STUCK * math.sqrt(brain.robot.height / 0.29)
    watch = watching(brain)
    assert verdict(watch, later(lap, 0.1, remaining=3.0)) is None
    assert verdict(watch, later(lap, 0.1 + 0.9 * patience, remaining=6.0)) is None
    assert verdict(watch, later(lap, 0.1 + 1.8 * patience, remaining=5.0)) is None
    assert verdict(watch, later(lap, 0.1 + 2.7 * patience, remaining=5.0)) is None
    back = 5.0 + 0.1 * brain.robot.body_length
    stuck = verdict(watch, later(lap, 0.1 + 2.9 * patience, remaining=back))
    assert stuck is not None and stuck.because.startswith("stuck")


def test_a_force_distribution_that_keeps_failing_is_an_overload(on_the_way) -> None:
    brain, lap = on_the_way
    watch, words = watching(brain), "these feet cannot carry this load"
    bad = lap._replace(command=replace(lap.command, status=words))
    assert verdict(watch, later(lap, 1.0)) is None
    assert verdict(watch, later(bad, 1.1)) is None
    assert verdict(watch, later(lap, 1.2)) is None, "a moment's failure is forgiven"
    assert verdict(watch, later(bad, 1.3)) is None
    assert verdict(watch, later(bad, 1.5)) == Ending(f"{words} (since 1.20 s)")


def test_torques_that_are_no_numbers_never_reach_the_motors(on_the_way) -> None:
    brain, lap = on_the_way
    broken = lap._replace(command=replace(lap.command, tau=np.full((4, 3), np.nan)))
    judged = verdict(watching(brain), broken)
    assert judged is not None and judged.because.startswith("a torque is not a number at ")


def test_a_body_that_sinks_has_fallen(on_the_way) -> None:
    brain, lap = on_the_way
    low = lap.sensed.position_w - (0.0, 0.0, 0.7 * brain.robot.height)
    judged = verdict(watching(brain), later(lap, 1.0, position_w=low))
    assert judged is not None and judged.fell and judged.because.startswith("fell: the body sank to")


def test_a_lap_of_a_sound_robot_is_left_alone(on_the_way) -> None:
    brain, lap = on_the_way
    assert verdict(watching(brain), lap) is None
    assert lap.sensed.load.sum() > 0.2 * brain.robot.total_mass * GRAVITY
