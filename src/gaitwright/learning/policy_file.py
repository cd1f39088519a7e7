"""A teacher's policy from a file that a person wrote: rules in order, the first whose conditions hold.

[[rule]]
name = "walk where it is slippery"
skill = "walk"
speed = [0.1, 0.25]           # m/s, of a robot 0.29 m tall
when = "grip < 0.5 and arrived < 0.5"
because = "it slips"          # in words; the first number of `when` is the one that decided

[[rule]]                      # goes on, once begun, on ground on which nobody would begin it
name = "walk where it is slippery"
skill = "walk"
speed = [0.1, 0.25]
when = "in use is walk and grip < 0.6"

[[rule]]                      # working memory: `notes` and `drops`, read as "stairs is noted"
skill = "climb"
when = "step up > 0.15"
notes = ["stairs"]

[[rule]]                      # without `when`: wherever no other holds
skill = "trot"
"""

import re
import tomllib
from collections.abc import Callable, Collection
from typing import Annotated

import msgspec
from msgspec import Meta

from gaitwright.errors import BadFile, GaitwrightError, WrongUse, short, unknown
from gaitwright.files import content_of, text_of
from gaitwright.induction.columns import Column
from gaitwright.knowledge.json_form import Label, Strict, Text
from gaitwright.knowledge.memory import NOT_NOTED, NOTED
from gaitwright.learning.said_action import Words, said_action
from gaitwright.learning.teacher import Clause, Raw
from gaitwright.model.robot import Robot
from gaitwright.skills.library import skill_names
from gaitwright.skills.vocabulary import IN_USE, VOCABULARY

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
    notes: Annotated[tuple[Label, ...], Meta(max_length=100)] = ()
    drops: Annotated[tuple[Label, ...], Meta(max_length=100)] = ()


class Policy(Strict, frozen=True):
    rule: Annotated[tuple[RuleEntry, ...], Meta(min_length=1, max_length=1000)]


def policy_in(path: str, robot: Robot) -> tuple[Clause, ...]:
    """The lines of a policy for a robot. Raises `BadFile` with one sentence that names the rule."""
    content = text_of(content_of(path, "policy", MAX_BYTES), f"policy {short(path)}")
    try:
        policy = msgspec.convert(tomllib.loads(content), Policy)
    except (tomllib.TOMLDecodeError, msgspec.ValidationError, RecursionError) as error:
        raise BadFile(f"policy {short(path)}: {error}") from None
    notes = {name for entry in policy.rule for name in (*entry.notes, *entry.drops)}
    lines = []
    for place, entry in enumerate(policy.rule, start=1):
        try:
            lines.append(clause_of(entry, robot, notes))
        except GaitwrightError as error:
            raise BadFile(f"policy {short(path)}, rule {place}: {error}") from None
    if policy.rule[-1].when:
        raise BadFile(
            f"policy {short(path)}: its last rule has no `when`, so that there is always one that holds"
        )
    return tuple(lines)


def clause_of(entry: RuleEntry, robot: Robot, notes: Collection[str]) -> Clause:
    """One line of a policy; `notes` are those that any line of it makes or wipes out."""
    action = said_action(Words(entry.skill, entry.speed, entry.until, entry.notes, entry.drops), robot)
    name = entry.name or entry.skill
    if not name.isprintable():
        raise WrongUse(f"a rule has a name that can be read, not {name!r}")
    parts = [part.strip() for part in entry.when.split(" and ")] if entry.when else []
    conditions = [condition_of(part, robot, notes) for part in parts]
    about = next((about for about, _ in conditions if about), "")
    return Clause(name, action, lambda raw: all(test(raw) for _, test in conditions), about, entry.because)


def condition_of(said: str, robot: Robot, notes: Collection[str]) -> tuple[str, Callable[[Raw], bool]]:
    """The fact that a condition looks at, and its test; no fact where it is what is in use. Raises
    `WrongUse`."""
    subject, is_, value = said.partition(" is ")
    if is_ and subject == IN_USE:
        if value not in skill_names(robot.n):
            raise unknown("skill", value, skill_names(robot.n))
        return "", lambda raw: raw.get(IN_USE) == value
    if is_ and subject in notes and value in (NOTED, NOT_NOTED):
        return subject, lambda raw: raw.get(subject, NOT_NOTED) == value
    if is_ and value in (NOTED, NOT_NOTED):
        raise unknown("note", subject, sorted(notes))
    if said in VOCABULARY.places and column_named(said).values:  # "doing is walking"
        named = column_named(said)
        return named.sources[0], lambda raw: named.read(raw) > 0.5
    found = COMPARED.match(said)
    if found is None:
        raise WrongUse(f"{said!r} is no condition; write e.g. 'grip < 0.5', joined by ' and '")
    if found["name"] not in VOCABULARY.places:
        raise unknown("number", found["name"], VOCABULARY.places)
    column, compare, bound = column_named(found["name"]), ORDER[found["sign"]], float(found["bound"])
    return column.sources[0], lambda raw: compare(column.read(raw), bound)


def column_named(name: str) -> Column:
    return VOCABULARY.columns[VOCABULARY.places[name]]
