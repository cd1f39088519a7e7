"""A rulebook in the language of CLIPS: a deftemplate, a defrule for each rule, functions that decide."""

from collections.abc import Sequence

from gaitwright.knowledge.rules import Rulebook

CHUNK = 100
"""Decisions in one function of CLIPS."""


def constructs(book: Rulebook) -> list[str]:
    """What makes the rulebook in CLIPS; `(decide …)` takes a symbol per tree and gives the place of the rule.

    Names become symbols by their places, `t2-l0` for the first leaf of the third tree: labels may hold
    anything.
    """
    slots = " ".join(f"(slot t{k} (type SYMBOL))" for k in range(len(book.forest.trees)))
    names = " ".join(f"?t{k}" for k in range(len(book.forest.trees)))
    fact = " ".join(f"(t{k} ?t{k})" for k in range(len(book.forest.trees)))
    return [
        f"(deftemplate situation {slots})",
        "(defglobal ?*decision* = -1)",
        *(defrule(book, place) for place in range(len(book.rules)) if book.rules[place].may_fire),
        f"(deffunction decide ({names}) (reset) (assert (situation {fact})) (run 1) ?*decision*)",
    ]


def defrule(book: Rulebook, place: int) -> str:
    """One rule: its upper marks as conditions, its place in the order as salience."""
    conditions = []
    for k, (tree, marks) in enumerate(zip(book.forest.trees, book.rules[place].marks, strict=True)):
        below = tree.leaves_below(marks.upper)
        if len(below) < len(tree.leaves):
            allowed = "|".join(symbol(k, tree.leaf_place[leaf]) for leaf in below)
            conditions.append(f"(t{k} {allowed})")
    salience = f"(declare (salience {len(book.rules) - place}))"
    return f"(defrule r{place} {salience} (situation {' '.join(conditions)}) => (bind ?*decision* {place}))"


def symbol(tree: int, leaf: int) -> str:
    return f"t{tree}-l{leaf}"


def symbols(leaves: Sequence[int]) -> list[str]:
    """The symbols of a situation, from the places of its leaves."""
    return [symbol(tree, leaf) for tree, leaf in enumerate(leaves)]


def loops(situations: Sequence[Sequence[str]]) -> list[str]:
    """Functions `(all-0)`, `(all-1)` … of CLIPS that decide these situations without a word of Python."""
    parts = [situations[k : k + CHUNK] for k in range(0, len(situations), CHUNK)]
    return [
        f"(deffunction all-{k} () " + " ".join("(decide " + " ".join(words) + ")" for words in part) + ")"
        for k, part in enumerate(parts)
    ]
