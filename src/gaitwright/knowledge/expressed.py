"""A list that was learned on numbers, as rules over feature trees: the thesis's form (§5.4.2.1, fig. 5.6).

A bound that no tree has cuts the leaf that it lies in; a number that no tree reads becomes a tree. A rule's
upper mark in a tree is what its conditions there allow, its lower mark what it was right at.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from jaxtyping import Bool, Int

from gaitwright.induction.cases import Cases
from gaitwright.induction.columns import Column, Vocabulary
from gaitwright.induction.decision_list import Bound, Lines
from gaitwright.induction.marks import gap_of
from gaitwright.induction.standing import Standing
from gaitwright.knowledge.cutting import cut_at, run_of, tree_at
from gaitwright.knowledge.forest import Forest, Situation
from gaitwright.knowledge.memory import Action, Fact
from gaitwright.knowledge.rules import QUIET, Choice, Instance, Kind, Marks, Rule, Rulebook
from gaitwright.knowledge.trees import ROOT, FeatureTree

MOST_WITNESSES = 24
"""Cases of either sign that a rule shows: those that hold its marks, and then the first ones."""


@dataclass(frozen=True, slots=True)
class Lessons:
    """What was taught, beside the numbers that the search sees: instance, action and rule name by case."""

    instances: Sequence[Instance]
    actions: Sequence[Action]
    names: Sequence[str]
    """What the teacher called the rule, case by case."""
    ends: Mapping[int, Bound] = field(default_factory=dict)
    """While which number lies where an action goes on that was begun, by the action's place."""


@dataclass(frozen=True)
class Wording:
    """How columns are spoken of: the trees there are, and which of them reads which column."""

    forest: Forest
    tree_of: Mapping[str, str]
    """The tree that reads a column, by their names; a column that is not named gets a tree of its own."""

    def of(self, column: Column) -> str:
        """The name of a column's tree."""
        return self.tree_of.get(column.sources[0] if column.values else column.name, column.name)


def expressed(
    lines: Lines, cases: Cases, standing: Standing, vocabulary: Vocabulary, wording: Wording, taught: Lessons
) -> Rulebook:
    """The rulebook that decides as the list does."""
    forest = forest_for(lines, vocabulary, wording, taught.ends.values())
    actions = [
        replace(action, until=action.until or until_text(forest, vocabulary, wording, taught.ends.get(a)))
        for a, action in enumerate(taught.actions)
    ]
    numbers = number_columns(vocabulary, wording)
    sets = leaf_sets(forest, cases, numbers, taught.instances)
    rules: list[Rule] = []
    for r, name in enumerate(rule_names(lines, standing.fire, standing.right, taught.names)):
        mine = np.flatnonzero(standing.right & (standing.fire == r)).tolist()
        if not name:
            continue
        action = lines.rules[r].action if r < len(lines.rules) else lines.otherwise
        upper = upper_sets(lines, r, forest, vocabulary, wording)
        rights, wrongs = witnesses(lines, r, cases, standing)
        rule = Rule(
            name,
            actions[action],
            marks_of(forest, upper, sets[mine]),
            tuple(shown(forest, vocabulary, numbers, taught.instances[k], "positive") for k in rights),
            tuple(shown(forest, vocabulary, numbers, taught.instances[k], "commission") for k in wrongs),
            quiet=QUIET if standing.firm[r] else 0,
        )
        rules.append(replace(rule, choices=tuple(choice_of(forest, rule, wrong) for wrong in rule.negatives)))
    return Rulebook(forest, tuple(rules), lessons=cases.n)


# --- trees -----------------------------------------------------------------------------------------
def forest_for(lines: Lines, vocabulary: Vocabulary, wording: Wording, more: Iterable[Bound] = ()) -> Forest:
    """The trees with every bound of a list, and some more, in them, and new ones for numbers that none of
    them reads."""
    needed: dict[str, tuple[Column, set[float]]] = {}
    for bound in (*(bound for rule in lines.rules for bound in rule.bounds), *more):
        column = vocabulary.columns[bound.column]
        if not column.values:
            cuts = needed.setdefault(wording.of(column), (column, set()))[1]
            cuts.update(cut for cut in (bound.low, bound.high) if np.isfinite(cut))
    trees = []
    for tree in wording.forest.trees:
        if tree.name in needed:
            column, cuts = needed.pop(tree.name)
            source = tree.source or ("" if column.name == tree.name else column.name)
            tree = replace(cut_at(tree, sorted(cuts)), source=source)  # noqa: PLW2901
        trees.append(tree)
    new = [
        tree_at(name, column.unit, sorted(cuts), f"{column.said} is", column.name)
        for name, (column, cuts) in needed.items()
    ]
    return Forest((*trees, *new))


def until_text(forest: Forest, vocabulary: Vocabulary, wording: Wording, bound: Bound | None) -> str:
    """The condition that holds outside of a bound on a number; none where there is no bound."""
    if bound is None:
        return ""
    tree = forest[wording.of(vocabulary.columns[bound.column])]
    inside = run_of(tree, bound.low, bound.high)
    return f"{tree.name} is {tree.label_of(((1 << len(tree.leaves)) - 1) & ~inside)}"


def number_columns(vocabulary: Vocabulary, wording: Wording) -> dict[str, int]:
    """The place of the column that each tree of numbers reads, by the trees' names."""
    return {wording.of(c): k for k, c in enumerate(vocabulary.columns) if not c.values}


def shown(
    forest: Forest, vocabulary: Vocabulary, numbers: Mapping[str, int], instance: Instance, kind: Kind
) -> Instance:
    """The instance in a forest with more bounds."""
    situation = read_in(forest, vocabulary, numbers, instance.situation, instance.raw)
    return replace(instance, kind=kind, situation=situation)


def read_in(
    forest: Forest,
    vocabulary: Vocabulary,
    numbers: Mapping[str, int],
    now: Situation,
    facts: Mapping[str, Fact],
) -> Situation:
    """The situation in a forest with more bounds: leaves that are names as they were, all others read anew.

    `numbers` are the `number_columns`.
    """
    known = {}
    for tree in forest.trees:
        if tree.bounds and tree.name in numbers:
            number = vocabulary.columns[numbers[tree.name]].read(facts)
            if not np.isnan(number):
                known[tree.name] = tree.leaf_of(number)
        elif tree.name in now.trees and (now[tree.name] is None or tree.is_leaf(str(now[tree.name]))):
            known[tree.name] = now[tree.name]
    return forest.read(known, facts)


def leaf_sets(
    forest: Forest,
    cases: Cases,
    numbers: Mapping[str, int],
    instances: Sequence[Instance],
) -> Int[np.ndarray, "cases trees"]:
    """The place of each case's leaf in each tree; −1 where it was not noted."""
    places = np.full((cases.n, len(forest.trees)), -1)
    for t, tree in enumerate(forest.trees):
        if tree.bounds and tree.name in numbers:
            x = cases.x[numbers[tree.name]]
            found = np.searchsorted(np.array(tree.bounds), x, side="right")
            places[:, t] = np.where(np.isnan(x), -1, found)
        elif instances and tree.name in instances[0].situation.trees:
            leaves = (instance.situation[tree.name] for instance in instances)
            places[:, t] = [-1 if leaf is None else tree.leaf_place[leaf] for leaf in leaves]
    return places


# --- marks -----------------------------------------------------------------------------------------
def upper_sets(
    lines: Lines, r: int, forest: Forest, vocabulary: Vocabulary, wording: Wording
) -> dict[str, int]:
    """The leaves that the conditions of a rule allow, in each tree in which it has any."""
    allowed: dict[str, int] = {}
    for bound in lines.rules[r].bounds if r < len(lines.rules) else ():
        column = vocabulary.columns[bound.column]
        tree = forest[wording.of(column)]
        whole = (1 << len(tree.leaves)) - 1
        allowed[tree.name] = allowed.get(tree.name, whole) & leaves_within(tree, column, bound)
    return allowed


def leaves_within(tree: FeatureTree, column: Column, bound: Bound) -> int:
    """The leaves of a tree that one condition allows, as bits."""
    if not column.values:
        return run_of(tree, bound.low, bound.high)
    bits = tree.set_of(column.values)
    return bits if bound.low <= 1.0 < bound.high else ((1 << len(tree.leaves)) - 1) & ~bits


def marks_of(
    forest: Forest, upper: Mapping[str, int], rights: Int[np.ndarray, "rights trees"]
) -> tuple[Marks, ...]:
    """A rule's marks: what it may fire at, and what it was right at; in a tree of numbers all between two."""
    marks = []
    for tree, places in zip(forest.trees, rights.T, strict=True):
        top = tree.label_of(upper[tree.name]) if tree.name in upper else ROOT
        seen = sorted(set(places[places >= 0].tolist()))
        if tree.bounds and seen:
            seen = list(range(seen[0], seen[-1] + 1))
        bits = sum(1 << place for place in seen)
        marks.append(Marks(tree.name, top, tree.label_of(bits) if bits else None))
    return tuple(marks)


# --- what holds them -------------------------------------------------------------------------------
def witnesses(lines: Lines, r: int, cases: Cases, standing: Standing) -> tuple[list[int], list[int]]:
    """Cases that show why a rule is as it is: those at its bounds and the first that were right; and the
    nearest that it is kept from."""
    mine, rights, wrongs = standing.fire == r, [], []
    if r < len(lines.rules):
        for j in range(len(lines.rules[r].bounds)):
            for side in (1, -1):
                gap = gap_of(lines.rules[r], j, r, cases, standing.fire, side)
                if gap is not None:
                    rights += [gap.inner_case] if standing.right[gap.inner_case] else []
                    wrongs.append(gap.outer_case)
    first = np.flatnonzero(mine & standing.right)[:MOST_WITNESSES].tolist()
    return first_few([*rights, *first]), first_few(wrongs)


def first_few(places: Sequence[int]) -> list[int]:
    """The first of some places, each once, in order."""
    return sorted(list(dict.fromkeys(places))[:MOST_WITNESSES])


def choice_of(forest: Forest, rule: Rule, wrong: Instance) -> Choice:
    """The trees that keep an instance out: the first of them, and the others."""
    out = [
        tree.name
        for tree, marks, value in zip(forest.trees, rule.marks, wrong.situation.values, strict=True)
        if value is not None and not tree.is_below(value, marks.upper)
    ]
    return Choice(out[0], tuple(out[1:])) if out else Choice("")


def rule_names(
    lines: Lines, fire: Int[np.ndarray, " cases"], right: Bool[np.ndarray, " cases"], names: Sequence[str]
) -> list[str]:
    """What each rule of a list is called, the last line included; that has no name where it was never right.

    By case: the rule that decides it, whether that is right, and what the teacher called the rule.
    """
    found: list[str] = []
    for r in range(len(lines.rules) + 1):
        mine = np.flatnonzero(right & (fire == r)).tolist()
        is_one = mine or r < len(lines.rules)
        found.append(name_for([names[k] for k in mine], found) if is_one else "")
    return found


def name_for(said: Sequence[str], taken: Sequence[str]) -> str:
    """What the teacher called a rule most often; with a number where another is called so already."""
    name = max(sorted(set(said)), key=said.count) if said else "rule"
    number, free = 2, name
    while free in taken:
        free, number = f"{name} {number}", number + 1
    return free
