"""All test teachers, and the same without reasons."""

import numpy as np

from gaitwright.bench.teachers.by_places import (
    exceptions,
    habit,
    headway,
    momentum,
    odd_places,
    round_places,
    strange_looks,
)
from gaitwright.bench.teachers.by_temper import (
    careful_operator,
    changed_mind,
    counting_worries,
    lopsided,
    rare_but_important,
    slowest_allowed,
    weighing,
)
from gaitwright.bench.teachers.kinds import BenchTeacher, Silent
from gaitwright.bench.teachers.random_lists import random_list


def teachers(seed: int) -> tuple[BenchTeacher, ...]:
    """All of them; the seed draws the random ones and the slips."""
    draws = [np.random.default_rng((seed, kind)) for kind in range(4)]
    return (
        round_places(),
        odd_places(draws[0]),
        headway(),
        exceptions(),
        momentum(),
        habit(),
        strange_looks(),
        slowest_allowed(seed),
        changed_mind(),
        random_list(draws[1], "random list A", 8, 11),  # kind 9
        random_list(draws[2], "random list B", 10, 14),
        weighing(draws[3]),
        careful_operator(),
        rare_but_important(),
        lopsided(),
        counting_worries(),
    )


def without_reasons(teacher: BenchTeacher) -> BenchTeacher:
    """The same teacher, silent about reasons."""
    name = f"{teacher.name}, silent"
    return Silent(name, teacher.what, teacher.is_list, teacher.seed, teacher.slips, of=teacher)
