"""Constructive induction: a new tree where right and wrong are one and the same situation (§5.4.2.1,
§6.7)."""

import math
import statistics
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import groupby, pairwise

from gaitwright.errors import WrongUse
from gaitwright.knowledge.forest import OTHER, Forest, leaf_in
from gaitwright.knowledge.mark_fitting import fit_all, with_instance
from gaitwright.knowledge.memory import Fact
from gaitwright.knowledge.modifier import Inconsistency, Learned, closed, contradiction, moves
from gaitwright.knowledge.rules import Event, Rule, Rulebook
from gaitwright.knowledge.trees import ROOT, FeatureTree, interval_tree, tree
from gaitwright.knowledge.widen import seen_in, widened

MOST_BOUNDS = 3


@dataclass(frozen=True, slots=True)
class Proposal:
    """A new feature that tells the instances of a contradiction apart; a teacher accepts it or takes another.

    `tree` is read from the measurement `tree.source`. `clearness` compares the gap between right and wrong
    with the spread of that measurement over all instances: the larger, the less it is chance.
    """

    tree: FeatureTree
    clearness: float
    sentence: str
    trouble: Inconsistency


def propose_features(rulebook: Rulebook, trouble: Inconsistency) -> tuple[Proposal, ...]:
    """Features made from what was measured besides the situation, the best first; none where nothing differs.

    Only a measurement that tells apart all that were right and wrong in the same situation will do. Those
    with fewer bounds come first, then the clearer ones.
    """
    rule = with_instance(rulebook[trouble.rule], trouble.instance)
    wrong_at = {negative.situation for negative in rule.negatives}
    rights = [right for right in rule.positives if right.situation in wrong_at]
    right_at = {right.situation for right in rights}
    wrongs = [wrong for wrong in rule.negatives if wrong.situation in right_at]
    everyone = [instance for other in rulebook.rules for instance in (*other.positives, *other.negatives)]
    proposals = []
    for source in sorted({name for right in rights for name in right.raw}):
        known = [instance.raw[source] for instance in (*everyone, trouble.instance) if source in instance.raw]
        right_values = [right.raw[source] for right in rights if source in right.raw]
        wrong_values = [wrong.raw[source] for wrong in wrongs if source in wrong.raw]
        if len(wrong_values) == len(wrongs):
            proposals += _proposal(rulebook.forest, source, right_values, wrong_values, known, trouble)
    return tuple(sorted(proposals, key=lambda proposal: (len(proposal.tree.bounds), -proposal.clearness)))


def accept(rulebook: Rulebook, proposal: Proposal) -> Learned:
    """The rulebook with the new tree, every instance placed in it by its measurement, and the lesson learned.

    An instance without that measurement keeps no value there: a right one binds no mark of the new tree, a
    wrong one cannot be kept out by it. Raises `WrongUse` for a feature that the rulebook has.
    """
    added, trouble = proposal.tree, proposal.trouble
    if added.name in rulebook.forest.names:
        raise WrongUse(f"the rules know {added.name} already: it cannot be a new feature of theirs")
    grown = widened(rulebook, (added,))
    instance = seen_in(grown.forest, trouble.instance)
    born = Event(instance.id, trouble.rule, added.name, "tree", "", added.name, proposal.sentence)
    rule = grown[trouble.rule]
    fitted = fit_all(grown.forest, rule, instance, added.name)
    if not isinstance(fitted, Rule):
        return Learned(rulebook, (), contradiction(grown, rule, instance, fitted))
    events = (born, *moves(grown.forest, rule, fitted, instance))
    proposed = rule.proposed and not instance.speaks_for
    return closed(grown, replace(fitted, quiet=0, proposed=proposed), events)


def _proposal(
    forest: Forest,
    source: str,
    rights: Sequence[Fact],
    wrongs: Sequence[Fact],
    known: Sequence[Fact],
    trouble: Inconsistency,
) -> list[Proposal]:
    """The proposal that one measurement makes, or none where it cannot tell right from wrong."""
    name = source
    while name in forest.names:
        name += " (finer)"
    numbers = [value for value in known if not isinstance(value, str) and math.isfinite(value)]
    if len(numbers) == len(known):
        found = _intervals(name, [float(v) for v in rights], [float(v) for v in wrongs], numbers)
    elif not numbers and not set(rights) & set(wrongs):
        found = _names(name, [str(v) for v in rights], [str(v) for v in wrongs], [str(v) for v in known])
    else:
        found = None
    if found is None:
        return []
    grown, clearness = found
    said_right, said_wrong = (
        " or ".join(sorted({str(leaf_in(grown, {name: v})) for v in vs})) for vs in (rights, wrongs)
    )
    sentence = (
        f"{trouble.rule} was right where {source} was {said_right} and wrong where it was {said_wrong}, "
        f"in the same situation otherwise: {source} should be a feature"
    )
    return [Proposal(replace(grown, source=source), clearness, sentence, trouble)]


def _intervals(
    name: str, rights: Sequence[float], wrongs: Sequence[float], known: Sequence[float]
) -> tuple[FeatureTree, float] | None:
    """Intervals with a bound wherever right turns into wrong, and how wide the narrowest gap is [spreads]."""
    ordered = sorted({(value, True) for value in rights} | {(value, False) for value in wrongs})
    runs = [[value for value, _ in run] for _, run in groupby(ordered, key=lambda pair: pair[1])]
    gaps = [(low[-1], high[0]) for low, high in pairwise(runs)]
    if not 1 <= len(gaps) <= MOST_BOUNDS or any(low >= high for low, high in gaps):
        return None
    spread = statistics.pstdev(known)
    bounds = [round_between(low, high) for low, high in gaps]
    return interval_tree(name, "", bounds), min(high - low for low, high in gaps) / spread


def _names(
    name: str, rights: Sequence[str], wrongs: Sequence[str], known: Sequence[str]
) -> tuple[FeatureTree, float] | None:
    """The values met so far, those that were right under one value of their own, those that were wrong
    too."""
    groups = [sorted(set(rights)), sorted(set(wrongs))]
    rest = [[value] for value in sorted(set(known) - set(rights) - set(wrongs) - {OTHER})]
    shape = [row[0] if len(row) == 1 else {" or ".join(row): row} for row in (*groups, *rest)]
    met = {value for row in (*groups, *rest) for value in row}
    if ROOT in met or not all(value.strip() and value.isprintable() and len(value) <= 60 for value in met):
        return None
    return tree(name, (*shape, *(() if OTHER in met else (OTHER,)))), 1.0


def round_between(low: float, high: float) -> float:
    """The number in (low, high] with the fewest digits, near the middle: a bound that a person would set."""
    middle = low + (high - low) / 2
    for digits in range(-6, 16):
        bound = round(middle, digits)
        if low < bound <= high:
            return bound
    return high
