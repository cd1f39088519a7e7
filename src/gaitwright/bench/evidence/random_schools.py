"""Schools drawn by chance: a teacher who has a whole rulebook in mind, and a pupil who is to learn it.

They know nothing of robots, so they tell what the learning itself is worth. Whatever has the methods of
`School` can stand in their place: the robot's own school plugs in at `rule_lessons.schools`.
"""

from collections.abc import Sequence
from typing import Protocol, runtime_checkable

import numpy as np

from gaitwright.knowledge.compiled import Compiled, compile_book, decide_leaves, decide_many
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.correction import teach
from gaitwright.knowledge.counterfactual import counterfactual
from gaitwright.knowledge.forest import Forest, Situation, replace_value
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Lesson
from gaitwright.knowledge.repair import mend
from gaitwright.knowledge.rules import Instance, Marks, Rule, Rulebook, outside
from gaitwright.knowledge.trees import ROOT, FeatureTree, interval_tree, tree

RULES, TREES = 14, 12
LEAVES = 6
"""Most leaves of a tree."""
CONDITIONS = 3
"""Most conditions of a rule."""
REPAIRS = 10
"""So often a lesson may contradict earlier ones before it is given up."""
CANDIDATES = 24
"""Situations of which the teacher demonstrates the one that teaches most."""
NEAR = 0.2
"""Share of these that are next to a situation of another skill."""
EXAM = 10
"""Situations of each skill in which the teacher looks how far the pupil is."""
TRIES = 40
"""Draws until a rule counts as one that never fires."""

Example = tuple[Situation, str]
"""A situation and the skill that is right in it."""


@runtime_checkable
class School(Protocol):
    """A teacher, and the situations that belong to what is taught."""

    forest: Forest

    def right(self, situation: Situation) -> str:
        """The skill that is right in a situation."""
        ...

    def held_out(self, seed: int, n: int) -> list[Situation]:
        """So many situations drawn anew, every skill as often as any other."""
        ...

    def demonstrate(self, per_skill: int) -> tuple[Rulebook, list[Example]]:
        """What a pupil has learned from so many demonstrations of each skill, and these demonstrations."""
        ...

    def correct(self, book: Rulebook, situation: Situation) -> Rulebook:
        """The pupil's rulebook after one correction by the teacher."""
        ...

    def variants(self, book: Rulebook, fault: Situation, n: int) -> list[Situation]:
        """At most so many other situations in which the pupil makes the same mistake."""
        ...


class RandomSchool:
    """A teacher with a random rulebook in mind, the same for the same seed."""

    def __init__(self, seed: int, rules: int = RULES, trees: int = TREES) -> None:
        self.rng = np.random.default_rng([seed, rules, trees])
        self.truth = random_truth(self.rng, rules, trees)
        self.forest, self.table = self.truth.forest, compile_book(self.truth)

    def right(self, situation: Situation) -> str:
        return decided(self.truth, situation, self.table)

    def held_out(self, seed: int, n: int) -> list[Situation]:
        rng, rules = np.random.default_rng([seed, 1]), self.truth.rules
        return [self.situation(rng, rules[k % len(rules)]) for k in range(n)]

    def demonstrate(self, per_skill: int) -> tuple[Rulebook, list[Example]]:
        """In rounds, each skill once: of some situations the one after which the pupil does best."""
        exam = [(self.situation(self.rng, r), r.name) for r in self.truth.rules for _ in range(EXAM)]
        book, shown = Rulebook(self.forest), []
        for _ in range(per_skill):
            for rule in reversed(self.truth.rules):
                drawn = [self.candidate(rule) for _ in range(CANDIDATES)]
                tried = [(self.correct(book, situation), situation) for situation in drawn]
                worth = [share_right(new, exam) + share_firm(new) for new, _ in tried]
                book, situation = tried[int(np.argmax(worth))]
                shown.append((situation, rule.name))
        return book, shown

    def correct(self, book: Rulebook, situation: Situation) -> Rulebook:
        """A lesson that names the tree that speaks against what the pupil would have done, if one does."""
        skill, done = self.right(situation), decided(book, situation)
        against = outside(self.forest, self.truth[done], situation) if done not in ("", skill) else []
        blame = against[0] if against else ""
        lesson = Lesson("omission", skill, situation, blame=blame, action=Action(skill))
        return taught(book, lesson)

    def variants(self, book: Rulebook, fault: Situation, n: int) -> list[Situation]:
        """The fault with other values in about half of the trees."""
        table, mistake, found = compile_book(book), (self.right(fault), decided(book, fault)), []
        for _ in range(20 * n):
            situation = fault
            for grown in self.forest.trees:
                if self.rng.random() < 0.5:
                    leaf = grown.leaves[int(self.rng.integers(len(grown.leaves)))]
                    situation = replace_value(self.forest, situation, grown.name, leaf)
            if situation not in (fault, *found) and mistake == (
                self.right(situation),
                decided(book, situation, table),
            ):
                found.append(situation)
        return found[:n]

    def situation(self, rng: np.random.Generator, rule: Rule) -> Situation:
        """A situation in which the teacher wants this rule."""
        while True:  # every rule was seen to fire, see `random_truth`
            situation = random_situation(rng, self.forest, rule)
            if self.right(situation) == rule.name:
                return situation

    def candidate(self, rule: Rule) -> Situation:
        """A situation of a rule; now and then the nearest to one of another rule."""
        if self.rng.random() < NEAR:
            other = self.truth.rules[int(self.rng.integers(len(self.truth.rules)))]
            beside = self.situation(self.rng, other)
            near = counterfactual(self.truth, beside, rule.name, compiled=self.table).decision
            if near is not None:
                return near.situation
        return self.situation(self.rng, rule)


def taught(book: Rulebook, lesson: Lesson) -> Rulebook:
    """The rulebook after a lesson, mended wherever it contradicts an earlier one."""
    for _ in range(REPAIRS):
        learned = teach(book, lesson)
        book = learned.rulebook
        if learned.trouble is None:
            return book
        mended = mend(book, learned.trouble, lesson.blame)
        if mended.how == "none":
            return book
        book = mended.rulebook
    return book


def decided(book: Rulebook, situation: Situation, table: Compiled | None = None) -> str:
    """The skill that a rulebook decides for; empty where no rule fires."""
    place, _ = decide_leaves(table or compile_book(book), book.forest.leaf_places(situation))
    return book.rules[place].action.skill if place >= 0 else ""


def share_right(book: Rulebook, examples: Sequence[Example]) -> float:
    """In which share of the examples a rulebook decides for the right skill."""
    leaves = np.array([book.forest.leaf_places(situation) for situation, _ in examples])
    places, _ = decide_many(compile_book(book), leaves)
    done = [book.rules[place].action.skill if place >= 0 else "" for place in places.tolist()]
    return sum(did == right for did, (_, right) in zip(done, examples, strict=True)) / len(examples)


def share_firm(book: Rulebook) -> float:
    """In which share of all trees of all rules the marks meet."""
    marks = [mark for rule in book.rules for mark in rule.marks]
    return sum(mark.upper == mark.lower for mark in marks) / len(marks)


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
