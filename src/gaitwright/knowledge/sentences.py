"""A rulebook, a rule, a decision and what moved its marks, as sentences and rows that people read."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from itertools import groupby

from gaitwright.knowledge.compiled import compile_book
from gaitwright.knowledge.consult import Decision, consult
from gaitwright.knowledge.counterfactual import Counterfactual, counterfactual
from gaitwright.knowledge.cutting import is_word, spoken
from gaitwright.knowledge.explain import NEAREST, STATUS, last_move, listed, move_text, why, why_not
from gaitwright.knowledge.forest import Situation
from gaitwright.knowledge.rules import Rule, Rulebook, covers, outside, status
from gaitwright.knowledge.trees import ROOT, FeatureTree


def opening(rulebook: Rulebook, name: str) -> str:
    """How much a book knows, in a sentence or two."""
    over = f"over {counted(len(rulebook.forest.names), 'tree')}"
    if not rulebook.rules:
        return f"{name} has no rules yet, {over}: nobody has taught it."
    states = Counter(status(rule) for rule in rulebook.rules)
    counts = ", ".join(f"{number} {state}" for state, number in states.items())
    return (
        f"{name} knows {counted(len(rulebook.rules), 'rule')} {over}, "
        f"from {counted(rulebook.lessons, 'lesson')} ({counts}). "
        "The first of them that fits a situation fires."
    )


def counted(number: int, what: str) -> str:
    """A number with its word: 1 rule, 2 rules."""
    return f"{number} {what}{'' if number == 1 else 's'}"


def sentence_of(rulebook: Rulebook, rule: Rule) -> str:
    """When a rule fires, and where nobody knows."""
    if rule.proposed:
        return "is only proposed by analogy: it fires once it is confirmed or seen right"
    if not rule.positives:
        return "does not fire yet: nobody has seen it right"
    trees = list(zip(rulebook.forest.trees, rule.marks, strict=True))
    met = [condition(tree, marks.upper) for tree, marks in trees if marks.upper != ROOT]
    grey = [tree.name for tree, marks in trees if marks.upper != marks.lower]
    sentence = f"fires when {listed(met)}" if met else "fires wherever none before it does"
    if rule.action.until:
        sentence += f", and goes on until {rule.action.until}"
    changes = {"notes": [name for name, _ in rule.action.adds], "forgets": rule.action.deletes}
    sentence += "".join(f"; {verb} {listed(names)}" for verb, names in changes.items() if names)
    if not grey:
        return f"{sentence}, and that is sure"
    return f"{sentence}; grey in {len(grey)} of {len(trees)} trees"


def condition(tree: FeatureTree, value: str) -> str:
    """A tree's value as a person says it; where one stands for a few leaves, with these."""
    below = tree.leaves_below(value)
    is_group = is_word(tree, value) and all(is_word(tree, leaf) for leaf in below)
    wider = is_group and 1 < len(below) <= 4 and value not in (run_of(below), *below)
    return spoken(tree, value) + (f" ({', '.join(below)})" if wider else "")


def run_of(leaves: tuple[str, ...]) -> str:
    """How a value is called that is made of its leaves."""
    return " or ".join(leaves)


# --- a decision ------------------------------------------------------------------------------------
def verdict(decision: Decision) -> str:
    """What fires, and how sure that is."""
    if decision.rule is None:
        return "No rule fires."
    how = {"sure": "it was seen right at such values", "grey": "nobody has seen it right there yet"}
    return f"{decision.rule} fires: {how[decision.certainty]}."


def because(rulebook: Rulebook, decision: Decision) -> str:
    """Why the rule fires, without a word about the others."""
    if decision.rule is None:
        return "of each rule a condition is not met."
    alone = replace(rulebook, rules=(rulebook[decision.rule],))
    return why(alone, consult(alone, decision.situation))


def others(rulebook: Rulebook, decision: Decision, name: str) -> list[str]:
    """The rules of which it is told why they did not fire: the named one, else the nearest."""
    if name:
        return [name]
    away = {
        rule.name: len(outside(rulebook.forest, rule, decision.situation))
        for rule in rulebook.rules
        if rule.may_fire and rule.name != decision.rule
    }
    return sorted(away, key=lambda rule: away[rule])[:NEAREST]


def reasons_against(rulebook: Rulebook, decision: Decision, names: list[str]) -> list[tuple[str, str]]:
    """Each rule with what kept it from firing."""
    return [(name, why_not(rulebook, name, decision.situation)) for name in names]


def changes(rulebook: Rulebook, situation: Situation, names: list[str]) -> list[tuple[str, Counterfactual]]:
    """What would have to be different for anything else to be decided, then for each rule; all were tried."""
    table = compile_book(rulebook)
    found = [("", counterfactual(rulebook, situation, compiled=table))]
    found += [(name, counterfactual(rulebook, situation, name, compiled=table)) for name in names]
    nearest = found[0][1].decision
    return [
        (name, change)
        for k, (name, change) in enumerate(found)
        if not k or name != (nearest.rule if nearest else "")
    ]


def movers(rulebook: Rulebook, rule: Rule, situation: Situation | None) -> Iterator[tuple[str, ...]]:
    """For each tree that the rule goes by, or in which it was not seen right here, the value, its marks, and
    the lessons that put them there."""
    for tree, marks in zip(rulebook.forest.trees, rule.marks, strict=True):
        here = situation[tree.name] if situation else ""
        if marks.upper == ROOT and (marks.lower == ROOT or covers(tree, marks.lower, here)):
            continue
        yield (
            tree.name,
            here or "unknown",
            marks.upper,
            mover(rulebook, rule.name, tree.name, "upper"),
            marks.lower or "",
            mover(rulebook, rule.name, tree.name, "lower"),
        )


def mover(rulebook: Rulebook, rule: str, tree: str, mark: str) -> str:
    """The lesson that put a mark where it is, else the one that made the rule; empty where none did."""
    born = mark == "upper" and rulebook[rule].marks_in(tree).upper != ROOT
    event = last_move(rulebook, rule, tree, mark) or (last_move(rulebook, rule, "", "rule") if born else None)
    return "" if event is None else event.instance or "by analogy"


def history_lines(rulebook: Rulebook, name: str) -> list[str]:
    """A line for each lesson that moved something of a rule, the oldest first."""
    lines = []
    events = [event for event in rulebook.events if event.rule == name]
    for instance, group in groupby(events, key=lambda event: event.instance or "by analogy"):
        moves = list(group)
        first = [event for event in moves if event.mark == "lower" and not event.before]
        parts = [move_text(event) for event in moves if event not in first]
        if first:
            seen = listed([f"{event.tree} {event.after}" for event in first])
            parts.append(f"its lower marks were set where it was right: {seen}")
        lines.append(f"{instance}: {'; '.join(parts)}")
    return lines


def facts_of(rulebook: Rulebook, rule: Rule) -> dict:
    """A rule as figures."""
    return {
        "name": rule.name,
        "status": status(rule),
        "right": len(rule.positives),
        "wrong": len(rule.negatives),
        "quiet": rule.quiet,
        "sentence": sentence_of(rulebook, rule),
        "marks": {marks.tree: {"upper": marks.upper, "lower": marks.lower} for marks in rule.marks},
    }


def title(rule: Rule) -> str:
    """A rule's name and how far it has come."""
    seen = f"{len(rule.positives)} right and {len(rule.negatives)} wrong"
    rest = f", {counted(rule.quiet, 'lesson')} since a mark moved"
    return f"{rule.name}, {STATUS[status(rule)]} ({seen}{rest})"
