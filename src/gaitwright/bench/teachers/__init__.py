"""Test teachers: people with rules in mind, who choose a legged robot's skill and name what decided.

They were written by somebody who did not know the learner; `everyone.teachers` has all of them.
"""

from gaitwright.bench.teachers.conditions import Facts
from gaitwright.bench.teachers.everyone import teachers, without_reasons
from gaitwright.bench.teachers.kinds import BenchTeacher, Said

__all__ = ["BenchTeacher", "Facts", "Said", "teachers", "without_reasons"]
