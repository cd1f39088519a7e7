"""What a lesson changed, in sentences: "trot now ends at 1.3 m/s, not at 1.0"."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Int

from gaitwright.induction.columns import Column, Vocabulary
from gaitwright.induction.decision_list import Lines, RuleLine
from gaitwright.knowledge.cutting import between, subject
from gaitwright.knowledge.expressed import Wording
from gaitwright.knowledge.rules import Event
from gaitwright.knowledge.trees import ROOT

WHOLE = (float("-inf"), float("inf"))


@dataclass(frozen=True)
class Stage:
    """A list, the rule that decides each lesson by it (its last line counts as one), and what rules are
    called."""

    lines: Lines
    fire: Int[np.ndarray, " lessons"]
    names: Sequence[str]

    def rule(self, r: int) -> RuleLine:
        """A rule; the last line has no conditions."""
        rules = self.lines.rules
        return rules[r] if r < len(rules) else RuleLine(self.lines.otherwise, ())


def differences(
    before: Stage, after: Stage, lesson: str, vocabulary: Vocabulary, wording: Wording
) -> tuple[Event, ...]:
    """What is different in a list after a lesson, rule by rule. Both stages are over the same lessons."""
    same = partners(before, after)
    events: list[Event] = []
    for r, name in enumerate(after.names):
        rule = after.rule(r)
        if r not in same:
            if name:
                met = " and ".join(condition(vocabulary, wording, rule, c) for c in asked(rule))
                when = f"where {met}" if met else "wherever no other fires"
                events.append(Event(lesson, name, "", "rule", "", name, f"a new rule: {name}, {when}"))
            continue
        old = before.rule(same[r])
        events += [
            Event(lesson, name, wording.of(vocabulary.columns[c]), "upper", *texts)
            for c, texts in moved(vocabulary, wording, name, old, rule)
        ]
    kept = set(same.values())
    gone = [name for r, name in enumerate(before.names) if r not in kept and name]
    events += [Event(lesson, name, "", "rule", name, "", f"the rule {name} is gone") for name in gone]
    return (*events, *reordered(before, after, same, lesson))


def partners(before: Stage, after: Stage) -> dict[int, int]:
    """Which rule of the list before each rule was: one of the same action that decided most of what it
    decides now."""
    counts: dict[tuple[int, int], int] = {}
    for old, new in zip(before.fire.tolist(), after.fire.tolist(), strict=True):
        if before.rule(old).action == after.rule(new).action:
            counts[new, old] = counts.get((new, old), 0) + 1
    found: dict[int, int] = {}
    for (new, old), _ in sorted(counts.items(), key=lambda item: -item[1]):
        if new not in found and old not in found.values():
            found[new] = old
    return found


def moved(
    vocabulary: Vocabulary, wording: Wording, name: str, old: RuleLine, new: RuleLine
) -> Iterator[tuple[int, tuple[str, str, str]]]:
    """The columns in which a rule asks for something else than before: what, before and after, as texts."""
    for c in sorted({*asked(old), *asked(new)}):
        (low, high), (least, most) = asked(old).get(c, WHOLE), asked(new).get(c, WHOLE)
        if (low, high) == (least, most):
            continue
        column = vocabulary.columns[c]
        texts = allowed(column, low, high), allowed(column, least, most)
        yield c, (*texts, f"{name} now {change(vocabulary, wording, c, old, new)}")


def change(vocabulary: Vocabulary, wording: Wording, c: int, old: RuleLine, new: RuleLine) -> str:
    """One change of a rule's conditions as a person tells it."""
    (low, high), (least, most) = asked(old).get(c, WHOLE), asked(new).get(c, WHOLE)
    column = vocabulary.columns[c]
    if c not in asked(new):
        return f"does not ask any more whether {condition(vocabulary, wording, old, c)}"
    ends = [(low, least, "begins"), (high, most, "ends")]
    ends = [(a, b, verb) for a, b, verb in ends if a != b and np.isfinite([a, b]).all()]
    if column.values or c not in asked(old) or len(ends) != 1 or (low != least and high != most):
        return f"asks that {condition(vocabulary, wording, new, c)}"
    (a, b, verb), unit = ends[0], f" {column.unit}".rstrip()
    return f"{verb} where {about(wording, column)} {b:.4g}{unit}, not {a:.4g}"


def reordered(before: Stage, after: Stage, same: dict[int, int], lesson: str) -> Iterator[Event]:
    """For each rule that comes before another now which it came after, and takes lessons from it so, the
    first of these."""
    taken = set(zip(after.fire.tolist(), before.fire.tolist(), strict=True))
    rows = sorted(same)
    for k, r in enumerate(rows):
        passed = [p for p in rows[k + 1 :] if same[p] < same[r] and (r, same[p]) in taken]
        if passed and after.names[r] and after.names[passed[0]]:
            why = f"{after.names[r]} now comes before {after.names[passed[0]]}"
            yield Event(lesson, after.names[r], "", "order", str(same[r] + 1), str(r + 1), why)


# --- in words --------------------------------------------------------------------------------------
def asked(rule: RuleLine) -> dict[int, tuple[float, float]]:
    """What a rule asks of each column: from where to where."""
    return {bound.column: (bound.low, bound.high) for bound in rule.bounds}


def condition(vocabulary: Vocabulary, wording: Wording, rule: RuleLine, c: int) -> str:
    """One condition of a rule as a person says it."""
    column, (low, high) = vocabulary.columns[c], asked(rule)[c]
    return f"{about(wording, column)} {allowed(column, low, high)}"


def allowed(column: Column, low: float, high: float) -> str:
    """The values between two bounds; any, where both are open."""
    if (low, high) == WHOLE:
        return ROOT
    if column.values:
        names = " or ".join(column.values)
        return names if low <= 1.0 < high else f"not {names}"
    return between(low, high, column.unit)


def about(wording: Wording, column: Column) -> str:
    """How a sentence on a column begins."""
    name = wording.of(column)
    if name not in wording.forest.names:
        return f"{column.said} is"
    tree = wording.forest[name]
    return tree.about if column.values else subject(replace(tree, source=tree.source or column.name))
