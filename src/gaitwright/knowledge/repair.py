"""Mending a contradiction, by the least invasive way that works: order, trees, two rules (row L8)."""

from dataclasses import replace

from gaitwright.knowledge.correction import prefer, same_action
from gaitwright.knowledge.mark_fitting import fit_all
from gaitwright.knowledge.modifier import Inconsistency, Lesson, closed, learn, moves
from gaitwright.knowledge.restructure import Mended, regroup, split
from gaitwright.knowledge.rules import Instance, Rule, Rulebook


def mend(rulebook: Rulebook, trouble: Inconsistency, blame: str = "") -> Mended:
    """The contradiction resolved and its lesson learned: by rule ordering, else by new groups in the trees
    (that of `blame` first), else by two rules. Right and wrong in the very same situation needs a new
    feature."""
    if trouble.same:
        return Mended(rulebook, "none", trouble.sentence)
    return reorder(rulebook, trouble) or regroup(rulebook, trouble, blame) or split(rulebook, trouble)


def reorder(rulebook: Rulebook, trouble: Inconsistency) -> Mended | None:
    """The rulebook in which the rule may cover what it was wrong at, because the rule that was right there
    comes before it; `None` where no rule is known to be right there, or it cannot come before.

    That is how a rule for all the rest is learned: its wrong situations lie anywhere, and fit no marks.
    """
    if not trouble.instance.speaks_for:
        return None
    ordered, events, here = rulebook, [], trouble.instance
    for wrong in trouble.inside:
        better = _right_at(ordered, wrong, same_action(rulebook, trouble.rule))
        if better is None:
            return None
        # It comes before a rule that is right at the lesson, so there it must not fire.
        barred = learn(ordered, Lesson("commission", better.name, here.situation, here.id))
        step = prefer(barred.rulebook, better.name, trouble.rule, wrong.situation, wrong.id)
        if barred.trouble is not None or step is None:
            return None
        ordered, events = step.rulebook, [*events, *barred.events, *step.events]
    rule = ordered[trouble.rule]
    left = [(n, c) for n, c in zip(rule.negatives, rule.choices, strict=True) if n not in trouble.inside]
    freed = replace(rule, negatives=tuple(n for n, _ in left), choices=tuple(c for _, c in left))
    fitted = fit_all(ordered.forest, freed, trouble.instance)
    if not isinstance(fitted, Rule):
        return None
    moved = moves(ordered.forest, rule, fitted, trouble.instance)
    proposed = rule.proposed and not trouble.instance.speaks_for
    learned = closed(ordered, replace(fitted, quiet=0, proposed=proposed), moved)
    others = " and ".join(dict.fromkeys(event.rule for event in events if event.mark == "order"))
    sentence = f"{trouble.rule} now comes after {others}, which know better where it was wrong"
    return Mended(learned.rulebook, "ordered", f"{sentence} ({trouble.sentence})", (*events, *moved))


def _right_at(rulebook: Rulebook, wrong: Instance, kin: tuple[str, ...]) -> Rule | None:
    """The first rule of another action that was right in a situation."""
    for rule in rulebook.rules:
        if rule.name not in kin and any(right.situation == wrong.situation for right in rule.positives):
            return rule
    return None
