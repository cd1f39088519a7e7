"""Whether our quadratic and linear programs find what quadprog and HiGHS find, on loads of real gaits."""

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.sharing_oracles import Task, by_highs, by_quadprog, missing
from gaitwright.bench.measurement import Figure, at_most, count
from gaitwright.control.numerical import PLAIN
from gaitwright.control.thesis_program import LinearSettings
from gaitwright.numerics.status import INFEASIBLE, SOLVED

OBJECTIVE, FORCE = 1e-7, 1e-6
"""Differences up to which answers agree: of the linear objective, of a quadratic force [N]."""
ABSOLUTE = PLAIN._replace(change=0.0)
THESIS = ABSOLUTE._replace(literal=1.0)
KINDS = {
    "as it walks": PLAIN,
    "absolute power and peak": ABSOLUTE,
    "absolute power and peak, exact balance": ABSOLUTE._replace(unmet=math.inf),
    "thesis": THESIS,
    "thesis, exact balance": THESIS._replace(unmet=math.inf),
    "thesis, exact balance, feet with moments": THESIS._replace(unmet=math.inf, components=6.0),
}
"""The linear programs that are compared, each on its part of the loads."""
WEAK = (0.005, 0.5)
"""Every other load is borne by motors with such a share of their torque, so that limits bite."""


@dataclass
class Tally:
    """How two solvers compare, load by load."""

    bound: float
    """Difference up to which they agree."""
    worst: float = 0.0
    """Largest difference where both have an answer."""
    loads: int = 0
    agree: int = 0
    outcomes: Counter[str] = field(default_factory=Counter)

    def add(self, kind: str, ours: int, theirs: int, difference: float) -> None:
        """One load: codes (`SOLVED`, `INFEASIBLE`) of both, and how far their answers are apart."""
        self.loads += 1
        same = ours == theirs and ours in (SOLVED, INFEASIBLE)
        if ours == theirs == SOLVED:
            self.worst = max(self.worst, difference)
            same = difference <= self.bound
        self.agree += same
        verdict = "disagree" if not same else "solved" if ours == SOLVED else "infeasible"
        self.outcomes[f"{kind}: {verdict}"] += 1

    def figures(self, what: str, unit: str) -> Iterator[Figure]:
        """Largest difference, and the loads with the same answer; no answer for both is one, too."""
        none = sum(number for kind, number in self.outcomes.items() if kind.endswith(": infeasible"))
        note = f"{none} infeasible, by both"
        numbers = {"outcomes": dict(self.outcomes)}
        yield Figure(f"{what}: worst difference", self.worst, unit, at_most(self.bound), self.loads, note)
        yield count(f"{what}: same verdict and answer", self.agree, self.loads, 1.0, note, numbers)


def agreement(context: Context, loads: Sequence[Task]) -> Iterator[Figure]:
    """Figures of both programs; not measured where their oracles are not installed."""
    linear, quadratic = "linear program against HiGHS", "quadratic program against quadprog"
    if why := missing():
        warmly = f"{linear}, from the last basis"
        for what, unit, bound in ((linear, "", OBJECTIVE), (warmly, "", OBJECTIVE), (quadratic, "N", FORCE)):
            yield Figure(f"{what}: worst difference", math.nan, unit, at_most(bound), 0, why)
        return
    lp, warm, qp = Tally(OBJECTIVE), Tally(OBJECTIVE), Tally(FORCE)
    rng = np.random.default_rng(context.seed)
    kinds = list(KINDS.items())
    for number, load in enumerate(loads):
        context.voice.say(f"sharing: comparing, {number} of {len(loads)} loads", now=False)
        task = weakened(load, rng) if number % 2 else load
        compare_linear((lp, warm), *kinds[rng.integers(len(kinds))], task, loads[max(number - 1, 0)])
        compare_quadratic(qp, task)
    yield from lp.figures(linear, "")
    yield from warm.figures(f"{linear}, from the last basis", "")
    yield from qp.figures(quadratic, "N")


def weakened(task: Task, rng: np.random.Generator) -> Task:
    """The same load on motors with some share of their torque."""
    low, high = np.log(WEAK)
    return replace(task, tau_max=task.tau_max * np.exp(rng.uniform(low, high)))


def compare_linear(
    tallies: tuple[Tally, Tally], kind: str, asked: LinearSettings, task: Task, before: Task
) -> None:
    """Our objective and HiGHS's: ours without hints, and from the basis that `before` leaves, as it walks."""
    theirs = by_highs(task, asked)
    code = {0: SOLVED, 2: INFEASIBLE}.get(theirs.status, -1)
    for tally, hints in zip(tallies, (None, last_basis(task, before, asked)), strict=True):
        ours = task.linear(asked, hints)
        difference = float(abs(ours.objective - theirs.fun)) if theirs.success else math.nan
        tally.add(kind, ours.code, code, difference)


def last_basis(task: Task, before: Task, asked: LinearSettings) -> np.ndarray | None:
    """Hints of the load before on the same motors; `None` where that was another robot's."""
    if before.stance.size != task.stance.size or before.weight != task.weight:
        return None
    return replace(before, tau_max=task.tau_max).linear(asked).basis


def compare_quadratic(tally: Tally, task: Task) -> None:
    """Our forces and quadprog's."""
    (forces, _, code, _), theirs = task.quadratic(), by_quadprog(task)
    if theirs is None:
        tally.add("quadratic", code, INFEASIBLE, math.nan)
    else:
        tally.add("quadratic", code, SOLVED, float(np.abs(forces - theirs).max()))
