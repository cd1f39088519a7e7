"""Claim: what was taught on level ground is played on slopes, rough ground, boxes, trenches and stairs."""

from collections.abc import Iterator
from dataclasses import dataclass

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.beside_teacher import both, handed_over, survived
from gaitwright.bench.measurement import Figure
from gaitwright.bench.trial import Outcome, robot_named

STARTS = 20
HANDED_OVER = 1.0
"""Before the first obstacle [s]."""
NOTE = (
    "The ground is known ahead of the feet, by either driver; profiles are of level ground. Across: the "
    "robot is beyond the last obstacle at the end, without a fall."
)


@dataclass(frozen=True, slots=True)
class Course:
    """A scene to get across by a skill."""

    scene: str
    skill: str
    seconds: float
    """Enough to get across [s]."""
    least: float | None = None
    """Share of the starts that must get across, …"""
    beside: float | None = None
    """… or how far it may be below the numerical controller's."""
    end: float = 0.0
    """x of the last obstacle's end [m]."""

    def is_across(self, outcome: Outcome) -> bool:
        """Whether a robot is beyond the last obstacle, with all of its body."""
        robot = robot_named("go2")
        beyond = outcome.off_goal * robot.body_length - (self.end + 0.5 * robot.body_length)
        return outcome.kept_up and (not self.end or beyond > 0.0)


BOXES_END, STAIRS_END = 2.55, 5.1
COURSES = (
    *(
        Course(scene, skill, 8.0, beside=0.01)
        for scene in ("slope:15", "slope:-15", "rough:0.05")
        for skill in ("trot", "walk")
    ),
    Course("boxes:0.08", "trot", 12.0, 0.95, end=BOXES_END),
    Course("boxes:0.08", "walk", 18.0, 0.95, end=BOXES_END),
    Course("gap:0.1", "trot", 13.0, 0.95, end=3.1),
    Course("gap:0.1", "walk", 19.0, 0.95, end=3.1),
    Course("gap:0.15", "trot", 13.0, 0.95, end=3.25),
    Course("gap:0.15", "walk", 19.0, 0.95, end=3.25),
    Course("stairs:0.1", "climb", 34.0, 0.95, end=STAIRS_END),
    Course("stairs:0.1", "trot", 18.0, beside=0.10, end=STAIRS_END),
)


def measure(context: Context) -> Iterator[Figure]:
    """Starts that get across, beside the teacher's."""
    for course in COURSES:
        what = f"go2 {course.skill} over {course.scene}"
        trials = [
            handed_over(course.skill, seed, course.seconds, course.scene, HANDED_OVER)
            for seed in context.seeds(STARTS)
        ]
        found = both(context, what, trials)
        ends = "across" if course.end else f"{course.seconds:g} s without a fall"
        yield survived(f"{what}: {ends}", found, course.least, course.beside, course.is_across)
