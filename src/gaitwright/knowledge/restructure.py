"""Two ways out of a contradiction: regroup a tree (fig. 5.6), or split the rule in two (§5.4.2.1, §6.7)."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from gaitwright.errors import WrongUse
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.mark_fitting import refit, tightened, with_instance
from gaitwright.knowledge.modifier import Inconsistency
from gaitwright.knowledge.rules import Event, Instance, Preference, Rule, Rulebook
from gaitwright.knowledge.trees import FeatureTree, nest, regrouped, run_label


@dataclass(frozen=True, slots=True)
class Group:
    """One tree with a new group: how many of the wrong situations inside, and of all, that keeps out, and how
    many old groups it costs."""

    keeps_out: int = 0
    keeps_out_of_all: int = 0
    lost: int = 0
    tree: FeatureTree | None = None
    label: str = ""

    def on(self, blame: str) -> bool:
        return self.tree is not None and self.tree.name == blame


@dataclass(frozen=True, slots=True)
class Mended:
    """The rulebook with the contradiction resolved and its lesson learned, and how, in a sentence.

    "none": no marks in any shape of these trees can do it, the book is as it was
    (`features.propose_feature`).
    """

    rulebook: Rulebook
    how: Literal["ordered", "regrouped", "split", "none"]
    sentence: str
    events: tuple[Event, ...] = ()


def regroup(rulebook: Rulebook, trouble: Inconsistency, blame: str = "") -> Mended | None:
    """The rulebook with trees in which the right values of the rule have a value of their own (fig. 5.6).

    The marks of all rules stay what they were as sets of leaves; `None` where that, or the contradiction,
    leaves no room. Takes one tree after another, each time the one that a teacher blames or that keeps out
    most of what is inside, then most of all that was wrong, then costs the fewest old groups.
    """
    rule = with_instance(rulebook[trouble.rule], trouble.instance)
    others = [other for other in rulebook.rules if other.name != rule.name]
    forest, grown = rulebook.forest, []
    while not isinstance(fitted := refit(forest, tightened(forest, rule)), Rule):
        groups = [_new_group(forest, place, rule, others, fitted) for place in range(len(forest.trees))]
        best = max(groups, key=lambda g: (g.on(blame), g.keeps_out, g.keeps_out_of_all, -g.lost))
        if best.tree is None:
            return None
        forest = forest.replaced(best.tree)
        grown.append(best)
    return _regrouped_book(rulebook, trouble, forest, fitted, grown)


def split(rulebook: Rulebook, trouble: Inconsistency) -> Mended:
    """The rulebook with the rule as several of the same action, each holding some of its right situations.

    Each right situation joins the part it widens least without taking in a wrong one; every part keeps out
    all wrong ones. That fails only where right and wrong are the very same situation.
    """
    rule = with_instance(rulebook[trouble.rule], trouble.instance)
    forest = rulebook.forest
    parts: list[Rule] = []
    for positive in rule.positives:
        grown = [(k, _joined(forest, part, positive)) for k, part in enumerate(parts)]
        fits = [(_size(forest, part), k, part) for k, part in grown if part is not None]
        if fits:
            _, k, part = min(fits, key=lambda fit: fit[:2])
            parts[k] = part
            continue
        alone = _joined(forest, replace(rule, positives=()), positive)
        if alone is None:
            return Mended(rulebook, "none", trouble.sentence)
        parts.append(alone)
    names = _part_names(rulebook, rule.name, len(parts))
    quiet = [replace(part, name=name, quiet=0) for part, name in zip(parts, names, strict=True)]
    here = rulebook.place(rule.name)
    rules = (*rulebook.rules[:here], *quiet, *rulebook.rules[here + 1 :])
    sentence = (
        f"{rule.name} has become {len(parts)} rules of the same action, {' and '.join(names)}: "
        f"what it is right at does not go together under one value per tree ({trouble.sentence})"
    )
    born = tuple(Event(trouble.instance.id, name, "", "rule", rule.name, name, sentence) for name in names)
    wishes = tuple(part for wish in rulebook.preferences for part in _shared_out(wish, rule.name, quiet))
    new = replace(
        rulebook,
        rules=rules,
        preferences=wishes,
        events=(*rulebook.events, *born),
        lessons=rulebook.lessons + 1,
    )
    return Mended(new, "split", sentence, born)


def _new_group(
    forest: Forest, place: int, rule: Rule, others: Sequence[Rule], inside: Sequence[Instance]
) -> Group:
    """The tree at `place` with one value just for the rule's right values; no tree where it keeps nothing
    out.

    Neighbouring intervals stay neighbours: there the group reaches from the lowest right value to the
    highest.
    """
    tree = forest.trees[place]
    noted = [value for positive in rule.positives if (value := positive.situation.values[place]) is not None]
    bits = tree.set_of(noted)
    if tree.bounds and bits:
        bits = (1 << bits.bit_length()) - (bits & -bits)
    keeps_out, of_all = (
        sum(value is not None and not tree.set_of([value]) & bits for value in values)
        for values in (
            [n.situation.values[place] for n in inside],
            [n.situation.values[place] for n in rule.negatives],
        )
    )
    marked = {
        tree.set_of([mark])
        for other in others
        for mark in (other.marks[place].upper, other.marks[place].lower)
        if mark is not None
    }
    if not keeps_out or not nest([bits, *marked]):
        return Group()
    old = {bits_of: value for value, bits_of in zip(tree.values, tree.sets, strict=True)}
    kept = {other: label for other, label in old.items() if nest([bits, other])}
    label = _group_label(tree, bits)
    try:
        grown = regrouped(tree, kept | {bits: label})
    except WrongUse:  # too deep
        return Group()
    return Group(keeps_out, of_all, len(old) - len(kept), grown, label)


def _group_label(tree: FeatureTree, bits: int) -> str:
    """What a group of leaves is called: its members, or the ends of a run; told apart from what there is."""
    leaves = [leaf for k, leaf in enumerate(tree.leaves) if bits >> k & 1]
    label = run_label(leaves) if tree.bounds else " or ".join(leaves)
    if len(label) > 60:
        label = f"{leaves[0]} or {len(leaves) - 1} others"
    while label in tree.place:
        label += " (together)"
    return label


def _regrouped_book(
    rulebook: Rulebook, trouble: Inconsistency, forest: Forest, fitted: Rule, grown: Sequence[Group]
) -> Mended:
    """The rulebook over the new trees: all other rules as they were, their marks' values all still there."""
    condition = " and ".join(
        f"{group.tree.name} now has the value {group.label!r}" for group in grown if group.tree
    )
    sentence = f"{condition}, so that {trouble.rule} can be right there and nowhere else ({trouble.sentence})"
    before = rulebook[trouble.rule]
    events = [
        Event(trouble.instance.id, trouble.rule, group.tree.name, "tree", "", group.label, sentence)
        for group in grown
        if group.tree
    ]
    for old, new in zip(before.marks, fitted.marks, strict=True):
        ends: list[tuple[Literal["upper", "lower"], str | None, str | None]] = [
            ("upper", old.upper, new.upper),
            ("lower", old.lower, new.lower),
        ]
        for mark, was, now in ends:
            if was != now:
                why = f"{before.name} was learned anew with the new groups"
                events.append(
                    Event(trouble.instance.id, before.name, old.tree, mark, was or "", now or "", why)
                )
    proposed = before.proposed and not trouble.instance.speaks_for
    rules = rulebook.with_rule(replace(fitted, quiet=0, proposed=proposed))
    told_all = (*rulebook.events, *events)
    new = replace(rulebook, forest=forest, rules=rules, events=told_all, lessons=rulebook.lessons + 1)
    return Mended(new, "regrouped", sentence, tuple(events))


def _joined(forest: Forest, part: Rule, positive: Instance) -> Rule | None:
    """The part with one more right situation, or `None` where that takes in a wrong one."""
    fitted = refit(forest, tightened(forest, replace(part, positives=(*part.positives, positive))))
    return fitted if isinstance(fitted, Rule) else None


def _shared_out(wish: Preference, name: str, parts: Sequence[Rule]) -> list[Preference]:
    """A wish about a rule, for its parts: those that were right there come first, all of them come after."""
    better = [wish.better]
    worse = [part.name for part in parts] if wish.worse == name else [wish.worse]
    if wish.better == name:
        better = [p.name for p in parts if any(right.situation == wish.situation for right in p.positives)]
    return [replace(wish, better=first, worse=then) for first in better for then in worse]


def _size(forest: Forest, part: Rule) -> float:
    """How many situations are below the lower marks, as a logarithm."""
    return sum(
        math.log(len(tree.leaves_below(mark.lower)))
        for tree, mark in zip(forest.trees, part.marks, strict=True)
        if mark.lower is not None
    )


def _part_names(rulebook: Rulebook, name: str, count: int) -> list[str]:
    """Names for the parts of a rule: its own, then the first free numbers behind it."""
    taken = {rule.name for rule in rulebook.rules}
    names, number = [name], 2
    while len(names) < count:
        if f"{name} {number}" not in taken:
            names.append(f"{name} {number}")
        number += 1
    return names
