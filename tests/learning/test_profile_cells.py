"""A skill is taught at its ends, where it is meant for, and between where two cells say too little."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gaitwright.control.learned.cells import Cells
from gaitwright.control.learned.profile import BINS, ROW, Profile
from gaitwright.errors import WrongUse
from gaitwright.learning.profile_cells import STEADY, cells_for, ends_of
from gaitwright.model.robot import Robot
from gaitwright.skills.library import fastest, find_skill, gait_of, meant, speed_scale
from oracles import robot_called

DOG = robot_called("dog")
HOME = meant(find_skill("trot", DOG), DOG)[0]
FASTEST = fastest(find_skill("trot", DOG), DOG)
TURN = ends_of(DOG, find_skill("trot", DOG))[1][1]
Law = Callable[[float, float], float]


def nothing(speed: float, turn: float) -> float:
    return 0.0


@dataclass
class Teacher:
    """Teaches torques that are a plain law of speed and yaw rate; the robot falls where it is told to."""

    torque: Law
    falls: Callable[[float, float], bool] = lambda speed, turn: False
    repeat: Law = nothing
    asked: list[tuple[float, float]] = field(default_factory=list)

    def __call__(self, robot: Robot, name: str, speed: float, turn: float, seed: int) -> Profile:
        self.asked.append((speed, turn))
        if self.falls(speed, turn):
            raise WrongUse("the robot fell")
        skill = find_skill(name, robot)
        table = np.zeros((BINS, ROW.size(robot.n)))
        table[:, ROW.slices(robot.n)["tau"]] = self.torque(speed, turn)
        command = (speed * skill.way[0], speed * skill.way[1], turn)
        return Profile(gait_of(skill, robot), command, table, self.repeat(speed, turn))

    def places(self, name: str = "trot") -> tuple[list[float], list[float]]:
        """Speeds and yaw rates that the skill is taught at; the cells are all of their crossings."""
        cells = Cells.of(cells_for(DOG, name, 0, self))
        assert cells.taught.all()
        return cells.speeds.tolist(), cells.turns.tolist()


def straight(speed: float, turn: float) -> float:
    return 10.0 + 3.0 * speed - 2.0 * turn


def bent_at_home(speed: float, turn: float) -> float:
    """As much more beyond what the skill is meant for as short of it."""
    return 10.0 + 8.0 * abs(speed - HOME)


def curved(speed: float, turn: float) -> float:
    return 1.0 + (speed / HOME) ** 2


ENDS = ([0.0, HOME, FASTEST], [-TURN, 0.0, TURN])


@pytest.mark.parametrize("law", [straight, bent_at_home])
def test_what_is_straight_is_taught_at_its_ends_and_at_home(law):
    teacher = Teacher(law)
    np.testing.assert_allclose(teacher.places()[0], ENDS[0])
    np.testing.assert_allclose(teacher.places()[1], ENDS[1])


def test_what_is_curved_is_taught_in_the_middle_too():
    speeds, turns = Teacher(curved).places()
    np.testing.assert_allclose(speeds, [0.0, HOME / 2, HOME, (HOME + FASTEST) / 2, FASTEST])
    np.testing.assert_allclose(turns, ENDS[1])
    speeds, turns = Teacher(lambda speed, turn: curved(HOME * turn / TURN, 0.0)).places()
    np.testing.assert_allclose(speeds, ENDS[0])
    np.testing.assert_allclose(turns, [-TURN, -TURN / 2, 0.0, TURN / 2, TURN])


def test_a_teacher_who_is_off_by_more_herself_is_not_asked_for_more():
    speeds, _ = Teacher(curved, repeat=lambda speed, turn: 0.15).places()
    np.testing.assert_allclose(speeds, ENDS[0])


@pytest.mark.parametrize(("limit", "end"), [(0.7, 0.5), (0.3, 0.25), (0.2, 0.0)])
def test_an_end_where_the_robot_falls_or_is_unsteady_is_pulled_nearer(limit, end):
    """Limit and end as shares of the way from home to the fastest."""
    limit, end = (HOME + share * (FASTEST - HOME) for share in (limit, end))
    wanted = [0.0, HOME] if end == HOME else [0.0, HOME, end]
    falling = Teacher(straight, lambda speed, turn: speed > limit)
    np.testing.assert_allclose(falling.places()[0], wanted)
    unsteady = Teacher(straight, repeat=lambda speed, turn: STEADY if speed > limit else 0.0)
    np.testing.assert_allclose(unsteady.places()[0], wanted)


def test_crossings_where_the_robot_falls_are_left_out():
    teacher = Teacher(straight, lambda speed, turn: speed > HOME and turn > 0.0)
    cells = Cells.of(cells_for(DOG, "trot", 0, teacher))
    assert cells.taught.tolist() == [[True] * 3, [True] * 3, [True, True, False]]


def test_a_skill_that_the_robot_does_not_keep_up_at_all_is_told():
    with pytest.raises(WrongUse, match=f"dog does not keep trot up at {HOME:.2f} m/s"):
        cells_for(DOG, "trot", 0, Teacher(straight, lambda speed, turn: True))


@given(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0), st.floats(0.0, 1.0))
def test_no_velocity_is_taught_twice(by_speed, by_turn, bend):
    teacher = Teacher(lambda speed, turn: 10.0 + by_speed * speed + by_turn * turn + bend * speed**2)
    teacher.places()
    assert len(set(teacher.asked)) == len(teacher.asked)


@pytest.mark.parametrize(
    ("name", "speeds", "turns"),
    [
        ("stand", [0.0], [0.0]),
        ("turn-in-place", [0.0], [-TURN, TURN]),
        ("walk-backward", [0.0, 0.2, 0.35], [-TURN, 0.0, TURN]),
        ("run", [0.75, 1.5, fastest(find_skill("run", DOG), DOG) / speed_scale(DOG)], [-TURN, 0.0, TURN]),
    ],
)
def test_each_skill_has_the_ends_that_it_can_have(name, speeds, turns):
    found = Teacher(straight).places(name)
    np.testing.assert_allclose(found[0], np.array(speeds) * speed_scale(DOG))
    np.testing.assert_allclose(found[1], turns, rtol=1e-6)
