"""Marks that fit all instances of a rule, or the instances that no marks fit.

A rule is a conjunction of one value per tree, so its lower marks are the least upper bounds of its positive
instances, and a negative one can be kept out in every tree where it is not below them. These choices do not
touch each other: marks that fit exist exactly when every negative instance has such a tree, and a choice that
proves wrong is replaced alone. Backtracking thus needs no search.
"""

from dataclasses import replace

from gaitwright.knowledge.discriminate import discriminate, grey_trees, lowered
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.generalise import generalise
from gaitwright.knowledge.rules import Choice, Instance, Marks, Rule, outside
from gaitwright.knowledge.trees import ROOT

KEPT = 8
"""So many instances of one sign at one situation are kept: they move no mark, but carry measurements."""
NO_CHOICE = Choice("")
"""Of a negative instance that came before any positive one: nothing can be told apart yet."""


def take_in(forest: Forest, rule: Rule, instance: Instance, blame: str = "") -> Rule | tuple[Instance, ...]:
    """The rule after one more instance, or the negative instances that no marks keep out."""
    if enough_like(rule, instance):
        return rule
    if instance.speaks_for:
        fired = rule.positives and not outside(forest, rule, instance.situation)
        marks = generalise(forest, rule.marks, instance.situation)
        grown = replace(rule, marks=marks, positives=(*rule.positives, instance))
        return grown if fired else refit(forest, grown, blame)
    negatives = (*rule.negatives, instance)
    if not rule.positives:
        return replace(rule, negatives=negatives, choices=(*rule.choices, NO_CHOICE))
    found = discriminate(forest, rule.marks, instance.situation, blame)
    if found is None:
        return (instance,)
    return replace(rule, marks=found.marks, negatives=negatives, choices=(*rule.choices, found.choice))


def enough_like(rule: Rule, instance: Instance) -> bool:
    """Whether the rule has so many instances of this sign and situation that another tells nothing new."""
    kept = rule.positives if instance.speaks_for else rule.negatives
    alike = [other for other in kept if other.situation == instance.situation]
    return len(alike) >= KEPT or any(
        other.raw == instance.raw and other.kind == instance.kind for other in alike
    )


def refit(forest: Forest, rule: Rule, blame: str = "") -> Rule | tuple[Instance, ...]:
    """The rule with upper marks that keep out all its negatives, lower marks as they are.

    Choices that still can hold are kept; only those proved wrong are made anew. Returns the negatives inside
    the lower marks where there are any.
    """
    if not rule.positives:
        empty = tuple(Marks(mark.tree) for mark in rule.marks)
        return replace(rule, marks=empty, choices=tuple(NO_CHOICE for _ in rule.negatives))
    options = [grey_trees(forest, rule.marks, negative.situation) for negative in rule.negatives]
    inside = tuple(negative for negative, grey in zip(rule.negatives, options, strict=True) if not grey)
    if inside:
        return inside
    marks = [Marks(mark.tree, ROOT, mark.lower) for mark in rule.marks]
    chosen = [forest.names.index(choice.tree) if choice.tree else -1 for choice in rule.choices]
    holds = [place in grey for place, grey in zip(chosen, options, strict=True)]
    choices = [NO_CHOICE] * len(options)
    for k in sorted(range(len(options)), key=lambda k: (not holds[k], len(options[k]))):
        situation = rule.negatives[k].situation
        if holds[k]:
            place = chosen[k]
            mark, value = marks[place], str(situation.values[place])
            marks[place] = Marks(mark.tree, lowered(forest.trees[place], mark, value), mark.lower)
            others = tuple(forest.names[other] for other in options[k] if other != place)
            choices[k] = Choice(mark.tree, others)
            continue
        found = discriminate(forest, tuple(marks), situation, blame)
        assert found is not None, "a negative instance with grey trees can be kept out"
        marks, choices[k] = list(found.marks), found.choice
    return replace(rule, marks=tuple(marks), choices=tuple(choices))


def tightened(forest: Forest, rule: Rule) -> Rule:
    """The rule with lower marks just around its positive instances: after a tree was regrouped they may be
    wider."""
    marks = tuple(Marks(mark.tree, mark.upper) for mark in rule.marks)
    for positive in rule.positives:
        marks = generalise(forest, marks, positive.situation)
    return replace(rule, marks=marks)


def without_analogies(rule: Rule) -> Rule:
    """The rule with only what was seen."""
    seen = [(n, choice) for n, choice in zip(rule.negatives, rule.choices, strict=True) if n.seen]
    return replace(
        rule,
        positives=tuple(positive for positive in rule.positives if positive.seen),
        negatives=tuple(negative for negative, _ in seen),
        choices=tuple(choice for _, choice in seen),
    )


def fit_all(forest: Forest, rule: Rule, instance: Instance, blame: str = "") -> Rule | tuple[Instance, ...]:
    """As `take_in`; where that fails, with lower marks drawn tight, then without what was only an analogy."""
    fitted = take_in(forest, rule, instance, blame)
    if isinstance(fitted, Rule):
        return fitted
    whole = with_instance(rule, instance)
    for candidate in (whole, without_analogies(whole)):
        again = refit(forest, tightened(forest, candidate), blame)
        if isinstance(again, Rule):
            return again
        fitted = again
    return fitted


def with_instance(rule: Rule, instance: Instance) -> Rule:
    """The rule holding one more instance, marks as they were."""
    if instance.speaks_for:
        return replace(rule, positives=(*rule.positives, instance))
    return replace(rule, negatives=(*rule.negatives, instance), choices=(*rule.choices, NO_CHOICE))
