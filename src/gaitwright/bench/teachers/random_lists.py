"""Random ordered lists of rules, drawn until each skill has its share of what is met."""

from collections.abc import Callable

import numpy as np

from gaitwright.bench.teachers.conditions import Rule, Within
from gaitwright.bench.teachers.kinds import BenchTeacher, RuleList
from gaitwright.bench.teachers.met import MET, made_up_moments, met_quantile

SKILLS = (
    "stop",
    "turn-in-place",
    "walk",
    "climb",
    "descend",
    "turn-left",
    "turn-right",
    "trot",
    "run",
    "gallop",
    "creep",
    "sidestep",
    "recover",
    "pace",
    "bound",
    "pronk",
)
SIGNED = ("slope", "off the path", "direction")
SWITCHES = ("arrived", "familiar", "turning")


def random_condition(draw: np.random.Generator, name: str) -> Within:
    """An interval of a number, bounds anywhere from the 10th to the 90th percentile of what is met."""
    if name in SWITCHES:
        return Within(name, lo=0.5) if draw.random() < 0.5 else Within(name, hi=0.5)
    by_size = name in SIGNED and draw.random() < 0.4
    low, high = np.sort(draw.uniform(0.1, 0.9, 2))
    low, high = (low, high) if high - low > 0.2 else (max(0.1, low - 0.2), min(0.9, high + 0.2))
    bounds = [met_quantile(name, float(q)) for q in (low, high)]
    if by_size:
        sizes = np.abs(made_up_moments()[name])
        bounds = [float(np.quantile(sizes[sizes > abs(MET[name][0]) + 0.5], q)) for q in (low, high)]
    side = draw.random()
    lo, hi = bounds[0], bounds[1]
    lo, hi = (lo, float("inf")) if side < 0.35 else (float("-inf"), hi) if side < 0.6 else (lo, hi)
    return Within(name, lo, hi, "size" if by_size else "is")


def random_rules(draw: np.random.Generator, skills: list[str], count: int) -> tuple[Rule, ...] | None:
    """Rules of 1 to 3 conditions, that decide 3.5 % or more of made-up moments each (None: none found)."""
    columns = made_up_moments()
    left = np.ones(len(columns["speed"]), dtype=bool)
    rules: list[Rule] = []
    for _ in range(60 * count):
        if len(rules) == count:
            break
        names = draw.choice(list(MET), int(draw.choice([1, 2, 3], p=[0.3, 0.45, 0.25])), replace=False)
        conditions = tuple(random_condition(draw, str(n)) for n in names)
        held = [c.holds(columns) for c in conditions]
        if not all(0.03 <= h.mean() <= 0.9 for h in held):
            continue
        fires = left & np.logical_and.reduce(held)
        free = [s for s in skills if not rules or s != rules[-1].skill]
        if 0.035 <= fires.mean() <= 1.5 / count:
            unused = [s for s in free if all(s != r.skill for r in rules)]
            rules.append(Rule(str(draw.choice(unused or free)), conditions))
            left &= ~fires
    return tuple(rules) if len(rules) == count and 0.05 <= left.mean() <= 0.5 else None


def shares(teacher: BenchTeacher, rows: int = 1500) -> dict[str, float]:
    """How often she uses each skill over made-up moments (for policies that don't look at 'doing')."""
    columns = made_up_moments()
    lists = [column[:rows].tolist() for column in columns.values()]
    said = [teacher.skill(dict(zip(columns, row, strict=True))) for row in zip(*lists, strict=True)]
    return {skill: said.count(skill) / len(said) for skill in teacher.skills}


def balanced(teacher: BenchTeacher, least: float = 0.042, most: float = 0.54) -> bool:
    """Whether each skill has its share over made-up moments."""
    found = shares(teacher).values()
    return least <= min(found) and max(found) <= most


def random_list(draw: np.random.Generator, name: str, least: int, most: int) -> BenchTeacher:
    """A list of `least` to `most` rules and an else, of 5 to 9 skills, each with its share."""
    what = "A random ordered list over random numbers and intervals."
    many, count = int(draw.integers(5, 10)), int(draw.integers(least, most + 1))
    for _ in range(1000):
        skills = [str(s) for s in draw.choice(SKILLS, many, replace=False)]
        found = random_rules(draw, skills[1:], count)
        if found is None:
            continue
        teacher = RuleList(name, what, True, rules=found, otherwise=skills[0], nearest=True)
        if len(teacher.skills) == len(skills) and balanced(teacher):
            return teacher
    raise RuntimeError("no balanced list found")


def until_balanced(one: Callable[[], BenchTeacher]) -> BenchTeacher:
    """Draws teachers until each of her skills has its share."""
    for _ in range(600):
        teacher = one()
        if balanced(teacher):
            return teacher
    raise RuntimeError("no balanced teacher found")
