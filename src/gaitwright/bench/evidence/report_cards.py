"""What came of many schools: means over seeds and teachers, and who is worst."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import nan

import numpy as np

from gaitwright.bench.evidence.taught import Exam, Marks, Taught

SILENT, TOLD, STRONGEST = "silent pupil", "pupil with reasons", "strongest other"


@dataclass(frozen=True)
class Cards:
    """The schools of all teachers and seeds, and what they were asked."""

    schools: tuple[Taught, ...]
    changing: str = "changed mind"
    """The teacher whose mind changes on the way."""

    @cached_property
    def teachers(self) -> tuple[str, ...]:
        """Their names."""
        return tuple(dict.fromkeys(school.teacher for school in self.schools))

    @cached_property
    def lists(self) -> tuple[str, ...]:
        """The names of those whose mind a list of rules can say."""
        return tuple(dict.fromkeys(school.teacher for school in self.schools if school.is_list))

    @cached_property
    def counts(self) -> tuple[int, ...]:
        """The numbers of labels after which all teachers' pupils are examined."""
        found = [{exam.labels for exam in school.exams} for school in self.schools]
        return tuple(sorted(set.intersection(*found)))

    def exams(self, teacher: str, labels: int) -> list[Exam]:
        """The exams of a teacher's pupils after so many labels, seed by seed."""
        mine = (school for school in self.schools if school.teacher == teacher)
        return [exam for school in mine for exam in school.exams if exam.labels == labels]

    def strongest(self, teacher: str, labels: int) -> str:
        """Which of the other learners is best for a teacher after so many labels ("": none was measured)."""
        exams = self.exams(teacher, labels)
        names = exams[0].others if exams else {}
        return max(names, key=lambda name: np.mean([exam.others[name] for exam in exams]), default="")

    def right(self, who: str, teacher: str, labels: int) -> list[float]:
        """The share right seed by seed [%]: of a pupil, of the strongest of the others, or of one by name."""
        name = self.strongest(teacher, labels) if who == STRONGEST else who
        return [100.0 * right_of(who, name, exam) for exam in self.exams(teacher, labels)]

    def of_pupils(
        self, pick: Callable[[Marks], float], labels: int, who: str = SILENT
    ) -> dict[str, list[float]]:
        """Something of a pupil's marks, teacher by teacher and seed by seed."""
        return {
            teacher: [
                pick(exam.silent if who == SILENT else exam.told) for exam in self.exams(teacher, labels)
            ]
            for teacher in self.teachers
        }

    def mean(self, who: str, labels: int, teachers: Sequence[str]) -> float:
        """The mean over teachers of the means over seeds [%]."""
        return mean_of({teacher: self.right(who, teacher, labels) for teacher in teachers})

    def falls(self) -> dict[str, list[float]]:
        """How much the mean of each teacher's silent pupils falls from exam to exam, from 100 labels
        on [%]; not across a change of her mind, after which other things are right."""
        late = [labels for labels in self.counts if labels >= 100]
        found = {}
        for teacher in self.teachers:
            kept = [labels for labels in late if teacher != self.changing or labels <= 400]
            curve = [float(np.mean(self.right(SILENT, teacher, labels))) for labels in kept]
            found[teacher] = [a - b for a, b in pairwise(curve)]
        return {teacher: each for teacher, each in found.items() if each}

    @cached_property
    def missing(self) -> str:
        """Why the others were not measured in some school ("": they were)."""
        return next((school.missing for school in self.schools if school.missing), "")


def right_of(who: str, name: str, exam: Exam) -> float:
    """The share right in an exam of a pupil or of another learner; NaN where it was not there."""
    if who == SILENT:
        return exam.silent.right
    return exam.told.right if who == TOLD else exam.others.get(name, nan)


def mean_of(found: dict[str, list[float]]) -> float:
    """The mean over teachers of the means over seeds."""
    return float(np.mean([np.mean(each) for each in found.values()])) if found else nan


def worst_of(found: dict[str, list[float]], sign: float = 1.0) -> tuple[str, float]:
    """The teacher with the largest mean over seeds, or with sign −1 the least, and that mean."""
    name = max(found, key=lambda teacher: sign * float(np.mean(found[teacher])))
    return name, float(np.mean(found[name]))
