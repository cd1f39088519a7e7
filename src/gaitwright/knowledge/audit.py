"""Whether a rulebook is one that learning could have made: rules fit what they say they were right at."""

from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.rules import Instance, Rule, Rulebook, outside


def audit(rulebook: Rulebook) -> tuple[str, ...]:
    """What contradicts that, in sentences; none in any rulebook that learning made.

    Lower marks are below upper ones, right instances below the upper marks and wrong ones not, and rules
    stand in the order that was asked for.
    """
    faults = []
    for rule in rulebook.rules:
        for tree, marks in zip(rulebook.forest.trees, rule.marks, strict=True):
            if marks.lower is not None and not tree.is_below(marks.lower, marks.upper):
                faults.append(
                    f"{rule.name}: in {tree.name} the lower mark {marks.lower!r} is not below the upper"
                )
        faults += instance_faults(rulebook.forest, rule)
    order = {rule.name: k for k, rule in enumerate(rulebook.rules)}
    for wish in rulebook.preferences:
        if order[wish.better] > order[wish.worse]:
            faults.append(f"{wish.better} should come before {wish.worse}, as {wish.instance} taught")
    return tuple(faults)


def instance_faults(forest: Forest, rule: Rule) -> list[str]:
    """Instances that the marks of a rule do not fit."""

    def excluded(instance: Instance) -> bool:
        return bool(outside(forest, rule, instance.situation))

    wrong = [positive for positive in rule.positives if excluded(positive)]
    if rule.positives:
        wrong += [negative for negative in rule.negatives if not excluded(negative)]
    return [f"{rule.name}: the marks do not fit {instance.id} ({instance.kind})" for instance in wrong]
