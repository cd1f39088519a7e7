"""What a pupil learns from a few demonstrations, beside scikit-learn, and what one correction does."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.random_schools import (
    Example,
    RandomSchool,
    School,
    decided,
    share_firm,
    share_right,
)
from gaitwright.bench.measurement import Figure, at_least, at_most
from gaitwright.bench.peers.rules_client import RulesPeer
from gaitwright.files import whole
from gaitwright.knowledge.compiled import compile_book
from gaitwright.knowledge.forest import Situation
from gaitwright.knowledge.json_form import dumps
from gaitwright.knowledge.rules import Rulebook

SCHOOLS = 10
PER_SKILL = 5
HELD_OUT = 200
FAULTS = 5
"""Faults of a pupil that are corrected, each in the pupil as it was."""
SEARCHED = 1000
"""Situations among which these are looked for."""
VARIANTS = 20
"""Other situations of a fault."""


@dataclass(frozen=True)
class Pupil:
    """What a teacher's pupil has learned, from which demonstrations."""

    school: School
    book: Rulebook
    shown: tuple[Example, ...]


def schools(context: Context) -> list[School]:
    """Who teaches: random rulebooks, harder than what a robot's teacher has in mind (claim `school`)."""
    return [RandomSchool(seed) for seed in context.seeds(SCHOOLS, quick=1)]


def store(book: Rulebook, folder: Path) -> None:
    """Keeps a rulebook in a file."""
    with whole(folder / "book.json") as draft:
        draft.write_bytes(dumps(book))


def pupils(context: Context) -> list[Pupil]:
    """A pupil of each school after a few demonstrations of each skill."""
    found, teachers = [], schools(context)
    for k, school in enumerate(teachers):
        context.voice.say(f"rules: school {k + 1} of {len(teachers)}", now=False)
        book, shown = school.demonstrate(PER_SKILL)
        found.append(Pupil(school, book, tuple(shown)))
    return found


# --- from a few demonstrations ---------------------------------------------------------------------
def learning(context: Context, taught: Sequence[Pupil]) -> Iterator[Figure]:
    """Right decisions and firm trees after a few demonstrations, beside CART and k-NN on the same ones."""
    problem, ours = [], []
    for pupil in taught:
        asked = pupil.school.held_out(context.seed + 1000, HELD_OUT)
        examples = [(situation, pupil.school.right(situation)) for situation in asked]
        ours.append(100.0 * share_right(pupil.book, examples))
        problem.append(as_rows(pupil, examples))
    firm = [100.0 * share_firm(pupil.book) for pupil in taught]
    after = f"after {PER_SKILL} demonstrations of each skill"
    yield share(f"random teachers: right {after}, {HELD_OUT} held-out situations", ours)
    yield share(f"random teachers: trees of a rule that are firm {after}", firm)
    yield from beside(context, ours, problem)


def share(what: str, each: Sequence[float], wanted=None, note: str = "") -> Figure:
    """The mean of a share over all schools [%]."""
    spread = f"{min(each):.1f} to {max(each):.1f} %"
    told = f"{spread}; {note}" if note else spread
    return Figure(what, float(np.mean(each)), "%", wanted, len(each), told, {"each": list(each)})


def beside(context: Context, ours: Sequence[float], problem: list[dict]) -> Iterator[Figure]:
    """What CART and k-NN make of the same demonstrations, and whether we are better than the best of them."""
    context.voice.say("rules: scikit-learn (installed at the first run: a minute)")
    what = "random teachers: our right decisions less the best learner's"
    with RulesPeer("sklearn", {"schools": problem}) as peer:
        if peer.reason is not None:
            yield Figure(what, float("nan"), "%", at_least(0.0), 0, peer.reason)
            return
        version = f"scikit-learn {peer.greeting['version']}"
        theirs = {name: [100.0 * s for s in shares] for name, shares in peer.greeting["shares"].items()}
    for name, shares in theirs.items():
        yield share(f"right decisions of {name} on the same demonstrations", shares, None, version)
    best = max(theirs, key=lambda name: float(np.mean(theirs[name])))
    more = [a - b for a, b in zip(ours, theirs[best], strict=True)]
    yield Figure(
        what, float(np.mean(more)), "%", at_least(0.0), len(more), f"the best is {best}", {"each": more}
    )


def as_rows(pupil: Pupil, asked: Sequence[Example]) -> dict:
    """A school's situations as numbers, and what is right in them."""
    return {
        "shown": [row_of(pupil.school, situation) for situation, _ in pupil.shown],
        "skills": [skill for _, skill in pupil.shown],
        "asked": [row_of(pupil.school, situation) for situation, _ in asked],
        "right": [skill for _, skill in asked],
    }


def row_of(school: School, situation: Situation) -> list[int]:
    """A 1 for each value that the situation is below: with the groups of the trees, not only the leaves."""
    pairs = zip(school.forest.trees, situation.values, strict=True)
    return [int(tree.is_below(str(leaf), value)) for tree, leaf in pairs for value in tree.values[1:]]


# --- one correction --------------------------------------------------------------------------------
def corrections(context: Context, taught: Sequence[Pupil]) -> Iterator[Figure]:
    """Whether one correction mends a fault wherever it occurs, breaks nothing, and is stored quickly."""
    mended, broken, took = [], [], []
    for k, pupil in enumerate(taught):
        context.voice.say(f"rules: corrections of pupil {k + 1}", now=False)
        for fixed, lost, seconds in corrected(context, pupil):
            mended += fixed
            broken += lost
            took.append(1e3 * seconds)
    faults, nan = len(took), float("nan")
    each = {"faults": faults, "variants": len(mended), "earlier": len(broken), "each_ms": took}
    about = f"{faults} faults of pupils after {PER_SKILL} demonstrations of each skill"
    rows = (
        (
            "random teachers: unseen variants of a fault mended by one correction",
            mended,
            None,
            f"{len(mended)} variants",
        ),
        (
            "random teachers: earlier right decisions broken by one correction",
            broken,
            None,
            f"{len(broken)} decisions",
        ),
    )
    for what, found, wanted, note in rows:
        measured = 100.0 * float(np.mean(found)) if found else nan
        yield Figure(what, measured, "%", wanted, faults, f"{about}, {note}", each)
    note = f"median {np.median(took):.1f} ms" if took else "no pupil made a mistake"
    slowest = max(took) if took else nan
    yield Figure("correction to stored rule: slowest", slowest, "ms", at_most(100.0), faults, note, each)


def corrected(context: Context, pupil: Pupil) -> Iterator[tuple[list[bool], list[bool], float]]:
    """For some faults: which variants are mended, which earlier decisions broken, and the time [s]."""
    school, book = pupil.school, pupil.book
    table = compile_book(book)
    earlier = [
        situation
        for situation in school.held_out(context.seed + 2000, HELD_OUT)
        if decided(book, situation, table) == school.right(situation)
    ]
    for fault in found_faults(school, book, context.seed + 3000):
        variants = school.variants(book, fault, VARIANTS)
        began = perf_counter()
        better = school.correct(book, fault)
        with TemporaryDirectory() as folder:
            store(better, Path(folder))
            seconds = perf_counter() - began
        now = compile_book(better)
        yield (
            [decided(better, situation, now) == school.right(situation) for situation in variants],
            [decided(better, situation, now) != school.right(situation) for situation in earlier],
            seconds,
        )


def found_faults(school: School, book: Rulebook, seed: int) -> list[Situation]:
    """Situations in which the pupil is wrong, each another mistake."""
    table, found = compile_book(book), {}
    for situation in school.held_out(seed, SEARCHED):
        done, right = decided(book, situation, table), school.right(situation)
        if done != right:
            found.setdefault((done, right), situation)
    return list(found.values())[:FAULTS]
