"""Why a rule fired, why another did not, and what moved its marks, in sentences (row L11)."""

from collections.abc import Sequence

from gaitwright.knowledge.consult import Decision, consult
from gaitwright.knowledge.cutting import spoken, value_text
from gaitwright.knowledge.forest import Situation
from gaitwright.knowledge.rules import Event, Rulebook, outside, status
from gaitwright.knowledge.trees import ROOT, FeatureTree

NEAREST = 3
"""So many of the rules that did not fire are told of."""
UPPER, LOWER = "▲", "▼"


def why(rulebook: Rulebook, decision: Decision) -> str:
    """What speaks for the decision, what kept the nearest others out, and where it rests on nothing seen."""
    sentences = [_because(rulebook, decision), *_outranked(rulebook, decision), *_nearest(rulebook, decision)]
    if decision.grey:
        values = " and ".join(
            _says(rulebook.forest[tree], decision.situation[tree]) for tree in decision.grey
        )
        sentences.append(f"nobody has yet seen {decision.rule} where {values}: grey")
    return "; ".join(sentences) + "."


def why_not(rulebook: Rulebook, name: str, situation: Situation) -> str:
    """What kept a rule from firing in a situation, and which lesson is behind it."""
    rule, decision = rulebook[name], consult(rulebook, situation)
    if decision.rule == name:
        return f"{name} does fire: {why(rulebook, decision)}"
    if rule.proposed:
        return f"{name} is only proposed by analogy: it fires once it is confirmed or seen right."
    if not rule.positives:
        return f"{name} has no conditions yet: nobody has seen it right."
    blocked = outside(rulebook.forest, rule, situation)
    if not blocked:
        wish = _wish(rulebook, str(decision.rule), name)
        return f"{name} could fire, but {decision.rule} comes before it{wish}."
    parts = []
    for tree in (rulebook.forest[name_of] for name_of in blocked):
        moved = last_move(rulebook, name, tree.name)
        since = f", since {moved.instance}" if moved else ""
        needed, given = rule.marks_in(tree.name).upper, situation[tree.name]
        parts.append(f"{_needs(tree, needed)}, not {_value(tree, given)}{since}")
    return f"{name} would need {' and '.join(parts)}."


def history(rulebook: Rulebook, name: str) -> tuple[str, ...]:
    """How far a rule has come, then each event that moved it, oldest first."""
    rule = rulebook[name]
    seen = f"{len(rule.positives)} right and {len(rule.negatives)} wrong situations"
    head = f"{name} is {STATUS[status(rule)]}: {seen}, {rule.quiet} lessons since a mark moved"
    moves = [event for event in rulebook.events if event.rule == name]
    return (head, *(f"{event.instance or 'by analogy'}: {move_text(event)}" for event in moves))


STATUS = {
    "proposed": "proposed by analogy",
    "empty": "empty",
    "shell": "a rule shell",
    "stabilised": "a stabilised rule shell",
    "firm": "a firm rule",
}


def forest_text(rulebook: Rulebook, name: str) -> str:
    """The trees of a rule, indented: ▲ its upper and ▼ its lower marks; a leaf is + inside, ? grey or −
    outside."""
    rule = rulebook[name]
    blocks = []
    for tree, marks in zip(rulebook.forest.trees, rule.marks, strict=True):
        lines = [tree.name]
        for value in tree.values:
            signs = UPPER * (value == marks.upper) + LOWER * (value == marks.lower)
            sign = f"{_leaf_sign(tree, marks.upper, marks.lower, value)} " if tree.is_leaf(value) else ""
            indent = "  " * len(tree.path(value))
            lines.append(f"{indent}{sign}{value} {signs}".rstrip())
        blocks.append("\n".join(lines))
    return "\n".join(blocks)


def _because(rulebook: Rulebook, decision: Decision) -> str:
    """The conditions of the rule that fired, as they are met."""
    if decision.rule is None:
        return "no rule fires"
    reasons = []
    for tree, marks in zip(rulebook.forest.trees, rulebook[decision.rule].marks, strict=True):
        if marks.upper != ROOT:
            value = decision.situation[tree.name]
            wider = f" ({value_text(tree, marks.upper)})" if marks.upper != value else ""
            reasons.append(_says(tree, value) + wider)
    return f"{decision.rule}, because {listed(reasons) or 'no lesson speaks against it'}"


def _outranked(rulebook: Rulebook, decision: Decision) -> list[str]:
    """The rules that could have fired too."""
    return [
        f"{name} could fire too, but comes after it{_wish(rulebook, str(decision.rule), name)}"
        for name in decision.conflict[1 : 1 + NEAREST]
    ]


def _nearest(rulebook: Rulebook, decision: Decision) -> list[str]:
    """The rules that one or two trees kept out, the nearest first."""
    forest = rulebook.forest
    blocked = [
        (outside(rulebook.forest, rule, decision.situation), rule)
        for rule in rulebook.rules
        if rule.may_fire and rule.name not in decision.conflict
    ]
    near = sorted((pair for pair in blocked if len(pair[0]) <= 2), key=lambda pair: len(pair[0]))
    return [
        f"{rule.name} would need {listed([_needs(forest[t], rule.marks_in(t).upper) for t in trees])}"
        for trees, rule in near[:NEAREST]
    ]


def _wish(rulebook: Rulebook, better: str, worse: str) -> str:
    """Which lesson put one rule before another."""
    for wish in reversed(rulebook.preferences):
        if (wish.better, wish.worse) == (better, worse):
            return f", as {wish.instance} taught"
    return ""


def last_move(rulebook: Rulebook, rule: str, tree: str, mark: str = "upper") -> Event | None:
    """The event that put a rule's mark in a tree where it is; `None` where it never moved."""
    for event in reversed(rulebook.events):
        if (event.rule, event.tree, event.mark) == (rule, tree, mark):
            return event
    return None


def move_text(event: Event) -> str:
    """One event as a person tells it, without the lesson's name."""
    if event.mark not in ("upper", "lower"):
        return event.why
    if event.why.startswith(f"{event.rule} now "):
        return event.why
    before = event.before or "nowhere"
    return f"the {event.mark} mark in {event.tree} went from {before} to {event.after}: {event.why}"


def _leaf_sign(tree: FeatureTree, upper: str, lower: str | None, leaf: str) -> str:
    if not tree.is_below(leaf, upper):
        return "−"
    return "+" if lower is not None and tree.is_below(leaf, lower) else "?"


def _says(tree: FeatureTree, value: str | None) -> str:
    return spoken(tree, value) if value else f"{tree.about or tree.name + ' is'} unknown"


def _value(tree: FeatureTree, value: str | None) -> str:
    return value_text(tree, value) if value else "unknown"


def _needs(tree: FeatureTree, value: str) -> str:
    return f"{tree.name} to be {value_text(tree, value)}"


def listed(parts: Sequence[str]) -> str:
    """A, b and c."""
    return " and ".join([*([", ".join(parts[:-1])] if parts[:-1] else []), *parts[-1:]])
