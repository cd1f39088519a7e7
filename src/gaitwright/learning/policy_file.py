"""A teacher's policy from a file that a person wrote: rules in order, the first whose conditions hold.

[[rule]]
name = "walk where it is slippery"
skill = "walk"
speed = [0.1, 0.25]           # m/s, of a robot 0.29 m tall
when = "grip < 0.5 and arrived < 0.5"
because = "it slips"          # in words; the first number of `when` is the one that decided

[[rule]]                      # without `when`: wherever no other holds
skill = "trot"
"""

import re
import tomllib
from collections.abc import Callable
from typing import Annotated

import msgspec
from msgspec import Meta

from gaitwright.errors import BadFile, GaitwrightError, WrongUse, short, unknown
from gaitwright.files import content_of, text_of
from gaitwright.induction.columns import Column
from gaitwright.knowledge.json_form import Label, Strict, Text
from gaitwright.learning.said_action import said_action
from gaitwright.learning.teacher import Clause, Raw
from gaitwright.model.robot import Robot
from gaitwright.skills.vocabulary import COLUMN_PLACES, VOCABULARY

MAX_BYTES = 1_000_000
ORDER: dict[str, Callable[[float, float], bool]] = {
    "<": lambda x, bound: x < bound,
    "<=": lambda x, bound: x <= bound,
    ">": lambda x, bound: x > bound,
    ">=": lambda x, bound: x >= bound,
}
NUMBER = r"[-+]?\d*\.?\d+(?:[eE][-+]?\d+)?"
COMPARED = re.compile(rf"^(?P<name>[^<>=]+?)\s*(?P<sign><=|>=|<|>)\s*(?P<bound>{NUMBER})$")
"""One condition: a number of `vocabulary.VOCABULARY` and a bound."""


class RuleEntry(Strict, frozen=True):
    skill: Label
    name: Label = ""
    speed: tuple[float, float] | None = None
    until: Text = ""
    when: Text = ""
    because: Text = ""


class Policy(Strict, frozen=True):
    rule: Annotated[tuple[RuleEntry, ...], Meta(min_length=1, max_length=1000)]


def policy_in(path: str, robot: Robot) -> tuple[Clause, ...]:
    """The lines of a policy for a robot. Raises `BadFile` with one sentence that names the rule."""
    content = text_of(content_of(path, "policy", MAX_BYTES), f"policy {short(path)}")
    try:
        policy = msgspec.convert(tomllib.loads(content), Policy)
    except (tomllib.TOMLDecodeError, msgspec.ValidationError, RecursionError) as error:
        raise BadFile(f"policy {short(path)}: {error}") from None
    lines = []
    for place, entry in enumerate(policy.rule, start=1):
        try:
            lines.append(clause_of(entry, robot))
        except GaitwrightError as error:
            raise BadFile(f"policy {short(path)}, rule {place}: {error}") from None
    if policy.rule[-1].when:
        raise BadFile(
            f"policy {short(path)}: its last rule has no `when`, so that there is always one that holds"
        )
    return tuple(lines)


def clause_of(entry: RuleEntry, robot: Robot) -> Clause:
    """One line of a policy."""
    action = said_action(entry.skill, robot, entry.speed, entry.until)
    name = entry.name or entry.skill
    if not name.isprintable():
        raise WrongUse(f"a rule has a name that can be read, not {name!r}")
    conditions = [condition_of(part.strip()) for part in entry.when.split(" and ")] if entry.when else []
    about = conditions[0][0].sources[0] if conditions else ""

    def holds(raw: Raw) -> bool:
        return all(test(column.read(raw)) for column, test in conditions)

    return Clause(name, action, holds, about, entry.because)


def condition_of(said: str) -> tuple[Column, Callable[[float], bool]]:
    """The column that a condition looks at, and the test of its number. Raises `WrongUse`."""
    if said in COLUMN_PLACES and column_named(said).values:  # "doing is walking"
        return column_named(said), lambda number: number > 0.5
    found = COMPARED.match(said)
    if found is None:
        raise WrongUse(f"{said!r} is no condition; write e.g. 'grip < 0.5', joined by ' and '")
    if found["name"] not in COLUMN_PLACES:
        raise unknown("number", found["name"], COLUMN_PLACES)
    compare, bound = ORDER[found["sign"]], float(found["bound"])
    return column_named(found["name"]), lambda number: compare(number, bound)


def column_named(name: str) -> Column:
    return VOCABULARY.columns[COLUMN_PLACES[name]]
