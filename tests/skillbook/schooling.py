"""Skillbooks taught by chance, without any file."""

from dataclasses import replace

import numpy as np

from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.correction import teach
from gaitwright.knowledge.forest import Forest
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Learned, Lesson
from gaitwright.knowledge.repair import mend
from gaitwright.knowledge.restructure import Mended
from gaitwright.knowledge.rules import Rulebook
from gaitwright.skillbook import Ledger, Skillbook
from gaitwright.skillbook.history import Step, number_lesson
from knowledge.random_books import random_book, random_forest, random_situation


def random_lesson(rng: np.random.Generator, forest: Forest, rules: int = 3) -> Lesson:
    """A lesson that may well contradict others."""
    name = f"rule {rng.integers(rules)}"
    action = Action(name, 0.1, 1.0, "there", (("at", "B"), ("height", 0.3)), ("at",), (("size", 2.0),))
    raw = {"friction": float(rng.random()), "ground": "grass"}
    note = "it\nslipped – «twice»"
    return Lesson("omission", name, random_situation(rng, forest), note=note, raw=raw, action=action)


def truthful_lesson(rng: np.random.Generator, truth: Rulebook) -> Lesson:
    """A lesson from one who knows the rules to be learned."""
    while True:
        situation = random_situation(rng, truth.forest)
        rule = consult(truth, situation).rule
        if rule is not None:
            return Lesson("omission", rule, situation, action=Action(rule))


def corrected(book: Skillbook, lesson: Lesson) -> Skillbook:
    """The book after one correction, mended until it is learned or nothing can mend it."""
    lesson = number_lesson(lesson, book.rulebook.lessons)
    for _ in range(10):
        learned = teach(book.rulebook, lesson)
        trouble = learned.trouble
        book = stepped(
            book, Step("taught", lesson, None, trouble.sentence if trouble else ""), learned.rulebook
        )
        if trouble is None:
            break
        mended = mend(book.rulebook, trouble, lesson.blame)
        book = stepped(book, Step("mended", lesson, None, mended.sentence), mended.rulebook)
        if mended.how == "none":
            break
    return book


def teach_in(ledger: Ledger, lesson: Lesson) -> Learned:
    """A lesson taught and recorded."""
    learned = teach(ledger.book.rulebook, lesson)
    ledger.record(lesson, learned)
    return learned


def mend_in(ledger: Ledger, lesson: Lesson, learned: Learned) -> Mended:
    """The contradiction that a lesson just recorded ended in, mended and recorded."""
    mended = mend(ledger.book.rulebook, learned.trouble, lesson.blame)
    ledger.record(lesson, mended, "mended")
    return mended


def stepped(book: Skillbook, step: Step, rulebook: Rulebook) -> Skillbook:
    events = rulebook.events[len(book.rulebook.events) :]
    return replace(book, rulebook=rulebook, steps=(*book.steps, replace(step, events=events)))


def taught_skillbook(seed: int, lessons: int = 10, trees: int = 4) -> Skillbook:
    rng = np.random.default_rng(seed)
    book = Skillbook.new(random_forest(rng, trees), "go2", f"book {seed}", seed)
    for _ in range(lessons):
        book = corrected(book, random_lesson(rng, book.rulebook.forest))
    return book


def truth_and_forest(seed: int) -> tuple[np.random.Generator, Rulebook]:
    rng = np.random.default_rng(seed)
    return rng, random_book(rng, random_forest(rng, 4, 4), 6, 0.4)
