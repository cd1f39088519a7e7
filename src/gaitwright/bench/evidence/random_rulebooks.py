"""Rulebooks drawn by chance: they know nothing of robots, so they tell what deciding by rules is worth."""

import numpy as np

from gaitwright.knowledge.compiled import compile_book, decide_leaves
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.forest import Forest, Situation
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.rules import Instance, Marks, Rule, Rulebook
from gaitwright.knowledge.trees import ROOT, FeatureTree, interval_tree, tree

RULES, TREES = 14, 12
LEAVES = 6
"""Most leaves of a tree."""
CONDITIONS = 3
"""Most conditions of a rule."""
TRIES = 40
"""Draws until a rule counts as one that never fires."""


class RandomRulebook:
    """A rulebook, and situations in which it is asked: the same for the same seed."""

    def __init__(self, seed: int, rules: int = RULES, trees: int = TREES) -> None:
        self.book = random_truth(np.random.default_rng([seed, rules, trees]), rules, trees)
        self.forest, self.compiled = self.book.forest, compile_book(self.book)

    def rule_at(self, situation: Situation) -> str:
        """The rule that fires; the last one does where no other does."""
        place, _ = decide_leaves(self.compiled, self.forest.leaf_places(situation))
        return self.book.rules[place].name

    def asked(self, seed: int, n: int) -> list[Situation]:
        """So many situations, every rule the one that fires as often as any other."""
        rng, rules = np.random.default_rng([seed, 1]), self.book.rules
        return [self.situation(rng, rules[k % len(rules)]) for k in range(n)]

    def situation(self, rng: np.random.Generator, rule: Rule) -> Situation:
        """A situation in which this rule fires."""
        while True:  # every rule was seen to fire, see `random_truth`
            situation = random_situation(rng, self.forest, rule)
            if self.rule_at(situation) == rule.name:
                return situation


# --- drawn by chance -------------------------------------------------------------------------------
def random_truth(rng: np.random.Generator, rules: int, trees: int) -> Rulebook:
    """Firm rules of few conditions, each of which fires somewhere; the last one for all the rest."""
    while True:
        forest = Forest(tuple(random_tree(rng, f"tree {k + 1}") for k in range(trees)))
        drawn = [random_rule(rng, forest, f"skill {k + 1}") for k in range(rules - 1)]
        drawn.sort(key=lambda rule: sum(marks.upper == ROOT for marks in rule.marks))
        book = Rulebook(forest, (*drawn, random_rule(rng, forest, f"skill {rules}", 0)))
        if all(fires_somewhere(rng, book, rule) for rule in book.rules):
            return book


def fires_somewhere(rng: np.random.Generator, book: Rulebook, rule: Rule) -> bool:
    """Whether a rule is the first in at least one of some situations that it covers."""
    drawn = (random_situation(rng, book.forest, rule) for _ in range(TRIES))
    return any(consult(book, situation).rule == rule.name for situation in drawn)


def random_tree(rng: np.random.Generator, name: str) -> FeatureTree:
    """A tree of names in random groups, or of intervals."""
    count = int(rng.integers(2, LEAVES + 1))
    if rng.random() < 0.3:
        return interval_tree(name, "m", np.arange(1.0, count).tolist())
    return tree(name, _grouped(rng, [f"{name}.{k + 1}" for k in range(count)]))


def _grouped(rng: np.random.Generator, row: list[str]) -> list:
    """Neighbours of a row put under values of their own, now and then."""
    if len(row) <= 2 or rng.random() < 0.3:
        return row
    cut = int(rng.integers(1, len(row)))
    parts = (row[:cut], row[cut:])
    return [part[0] if len(part) == 1 else {" or ".join(part): _grouped(rng, part)} for part in parts]


def random_rule(rng: np.random.Generator, forest: Forest, name: str, conditions: int | None = None) -> Rule:
    """A firm rule with conditions in so many trees, by lot where not said, and an instance to let it fire."""
    count = int(rng.integers(1, CONDITIONS + 1)) if conditions is None else conditions
    chosen = rng.choice(len(forest.trees), count, replace=False).tolist()
    values = [
        grown.values[int(rng.integers(1, len(grown.values)))] if k in chosen else ROOT
        for k, grown in enumerate(forest.trees)
    ]
    marks = tuple(Marks(grown.name, value, value) for grown, value in zip(forest.trees, values, strict=True))
    rule = Rule(name, Action(name), marks)
    seen = Instance("true", "positive", random_situation(rng, forest, rule))
    return Rule(name, Action(name), marks, (seen,))


def random_situation(rng: np.random.Generator, forest: Forest, rule: Rule | None = None) -> Situation:
    """A leaf of every tree, one that the rule allows where there is a rule."""
    values = []
    for k, grown in enumerate(forest.trees):
        leaves = grown.leaves_below(rule.marks[k].upper if rule else ROOT)
        values.append(leaves[int(rng.integers(len(leaves)))])
    return Situation(forest.names, tuple(values))
