"""What would have to be different, in numbers: the fewest measured facts, changed just so far that another
rule fires.

A change of the numbers themselves is always a possible situation, which one of their names need not be: no
slope is under 3 ° and of a size of 9 °.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, product

from gaitwright.induction.columns import Column, Names
from gaitwright.knowledge.compiled import Compiled, compile_book, decide
from gaitwright.knowledge.memory import NOT_NOTED, NOTED, Fact
from gaitwright.knowledge.rules import Rulebook
from gaitwright.skills.book_trees import notes_of, situation_in
from gaitwright.skills.vocabulary import FACTS, FLAGS, VOCABULARY
from gaitwright.skills.wording import NUMBERS

MOST_FACTS = 2
"""So many facts are changed at once at most."""
BESIDE = 1e-9
"""How far beyond a bound a number is tried, as a share of it."""
QUANTITIES = {fact.name: fact for fact in FACTS}

Facts = Mapping[str, Fact]


@dataclass(frozen=True, slots=True)
class Changed:
    """One fact as it is and as it would have to be, and that in words."""

    fact: str
    before: Fact
    after: Fact
    said: str


@dataclass(frozen=True, slots=True)
class WhatIf:
    """The fewest changes after which another rule fires; none where none was found."""

    rule: str
    changes: tuple[Changed, ...]
    sentence: str


def what_if(rulebook: Rulebook, facts: Facts, to: str = "") -> WhatIf:
    """What would have to be different for a rule to fire, or, without `to`, for any other."""
    return what_ifs(rulebook, facts, (to,))[0]


def what_ifs(rulebook: Rulebook, facts: Facts, targets: Sequence[str]) -> list[WhatIf]:
    """`what_if` for some rules ("": any other), each with the fewest changes; each answer was tried."""
    table = compile_book(rulebook)
    now = decided(rulebook, table, facts)
    tried = {fact: list(values_of(rulebook, facts, fact)) for fact in facts if fact in QUANTITIES}
    tried |= {note: [other_way(note, facts)] for note in notes_of(rulebook)}
    found: dict[str, WhatIf] = {}
    for many in range(1, MOST_FACTS + 1):
        left, nearest = set(targets) - found.keys(), dict[str, float]()
        if not left:
            break
        for names in combinations(tried, many):
            for changes in product(*(tried[name] for name in names)):
                rule = decided(rulebook, table, {**facts, **{c.fact: c.after for c in changes}})
                away = sum(far(change) for change in changes)
                for to in left & {"", rule} if rule not in (None, now) else ():
                    if away < nearest.get(to, math.inf):
                        nearest[to], found[to] = away, told(str(rule), changes)
    return [found.get(to) or nothing_for(to) for to in targets]


def nothing_for(to: str) -> WhatIf:
    """That no answer was found."""
    return WhatIf("", (), f"no change of {MOST_FACTS} numbers was found after which {to or 'another'} fires")


def decided(rulebook: Rulebook, table: Compiled, facts: Facts) -> str | None:
    """The rule that fires where these facts hold."""
    situation = situation_in(rulebook, facts)
    values = {tree: value for tree, value in situation.items() if value is not None}
    return decide(table, values)[0] if len(values) == len(table.trees) else None


def values_of(rulebook: Rulebook, facts: Facts, name: str) -> Iterator[Changed]:
    """The values of a fact that are worth trying: just on this and that side of every bound that it meets."""
    quantity, now = QUANTITIES[name], facts[name]
    if isinstance(quantity, Names) or isinstance(now, str):
        names = quantity.values if isinstance(quantity, Names) else ()
        yield from (Changed(name, now, value, f"it had been {value}") for value in names if value != now)
        return
    if name in FLAGS:
        yield from (Changed(name, now, value, said) for value, said in FLAGS[name].items() if value != now)
        return
    for tree in rulebook.forest.trees:
        if tree.name not in NUMBERS:
            continue
        column = VOCABULARY.columns[NUMBERS[tree.name]]
        if name in column.sources:
            for bound in tree.bounds:
                for there in crossings(column, name, facts, bound):
                    yield beside(quantity.said or name, quantity.unit, name, float(now), there)


def other_way(note: str, facts: Facts) -> Changed:
    """A note in working memory made that is not, or the other way round."""
    now = facts.get(note, NOT_NOTED)
    other = NOTED if now == NOT_NOTED else NOT_NOTED
    return Changed(note, now, other, f"{note} were {other}")


def crossings(column: Column, name: str, facts: Facts, bound: float) -> list[float]:
    """Where a fact has to be for a column to be at a bound, the others as they are."""
    other = next((source for source in column.sources if source != name), "")
    rest = facts.get(other)
    if column.form == "is":
        return [bound]
    if column.form == "size":
        return [bound, -bound]
    if rest is None or isinstance(rest, str):
        return []
    if column.form == "larger":
        return [bound]
    is_first = column.sources[0] == name
    if column.form == "difference":
        return [rest + bound if is_first else rest - bound]
    return [bound * rest] if is_first else ([rest / bound] if bound else [])


def beside(said: str, unit: str, name: str, now: float, there: float) -> Changed:
    """A number just beyond a bound, on the other side than it is now."""
    unit = f" {unit}".rstrip()
    if now < there:
        return Changed(name, now, there, f"{said} were at least {there:.4g}{unit} instead of {now:.4g}")
    after = there - BESIDE * max(1.0, abs(there))
    return Changed(name, now, after, f"{said} were under {there:.4g}{unit} instead of {now:.4g}")


def far(change: Changed) -> float:
    """How large a change is, so that numbers of different units can be compared."""
    if isinstance(change.before, str) or isinstance(change.after, str):
        return 1.0
    return abs(change.after - change.before) / (abs(change.before) + abs(change.after) + 1e-6)


def told(rule: str, changes: tuple[Changed, ...]) -> WhatIf:
    """An answer with its sentence."""
    return WhatIf(rule, changes, f"{rule} would fire if {' and '.join(change.said for change in changes)}")
