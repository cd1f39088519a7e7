"""Claim: whoever names a skill now and then is understood, and sooner than by other learners."""

from collections.abc import Iterator, Mapping
from dataclasses import asdict
from math import nan

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.large_book import large_book
from gaitwright.bench.evidence.report_cards import SILENT, STRONGEST, TOLD, Cards, mean_of, worst_of
from gaitwright.bench.evidence.taught import Marks, School, taught, warm_up
from gaitwright.bench.measurement import Figure, Wanted, at_least, at_most
from gaitwright.bench.peers.environment import PeerUnavailable, peer_python
from gaitwright.bench.teachers import teachers

SEEDS = 5
QUICK = ("round places", "odd places", "slipping", "changed mind", "weighing")
"""The teachers of a quick run."""
ASKED = {25: 200, 50: 200, 100: 200, 200: 200, 400: 400, 800: 400}
"""After so many labels, so many moments of other trips are asked."""
CHANGING, NEW_MIND = "changed mind", 600
"""The teacher who changes her mind at lesson 400, and the labels after which the new one is asked for."""
WANTED_MORE = {25: -10.0, 50: -10.0, 100: -6.0, 200: -1.0, 400: 0.0, 800: 0.0}
"""What the silent pupil shall have more than the strongest other, after so many labels [%]."""
NOTE = (
    "Teachers: 16 that the learner's author did not write, each with 5 seeds. A school is one of situations "
    "along trips without physics that the silent pupil drives as it learns; of each trip ten moments are "
    "drawn and labelled in their order, and a second pupil hears the same labels with the number that "
    "decided. A trip ends where the robot has stood for ten moments. Asked are moments of other trips, on "
    "courses of exams, driven by the silent pupil as it is then; right is what she meant at her last label. "
    "Strongest other: for each teacher and number of labels the best in the mean over seeds of CART, random "
    "forest and boosted trees, on the measured numbers and on the pupil's columns, each tuned by "
    "cross-validation on the labels. Means are over the 15 teachers whose mind an ordered list can say, if "
    "nothing else is said."
)


def measure(context: Context) -> Iterator[Figure]:
    """Schools side by side, then the means, what is wanted of single teachers, and a row for each."""
    schools = schools_of(context)
    context.voice.say("warming up pupils")
    warm_up()  # before workers compile the same side by side
    try:
        peer_python("sklearn")
    except PeerUnavailable as problem:
        context.voice.say(f"without scikit-learn: {problem}")
    cards = Cards(tuple(context.each("schools of test teachers", taught, schools)))
    yield from means(cards)
    yield from of_some(cards)
    yield from of_rules(cards)
    yield from (row(cards, teacher) for teacher in cards.teachers)
    yield everything(cards)
    yield large_book(context)


def schools_of(context: Context) -> list[School]:
    """The schools to be held."""
    found = []
    for seed in context.seeds(SEEDS, quick=1):
        for place, teacher in enumerate(teachers(seed)):
            if context.quick and teacher.name not in QUICK:
                continue
            asked = ASKED | ({NEW_MIND: ASKED[400]} if teacher.name == CHANGING else {})
            found.append(School(teacher, place, seed, tuple(sorted(asked.items()))))
    return found


# --- means over teachers ---------------------------------------------------------------------------
def means(cards: Cards) -> Iterator[Figure]:
    """Pupils and the strongest other after each number of labels, and what is between them."""
    for labels in cards.counts:
        for who in (TOLD, SILENT, STRONGEST):
            found = {teacher: cards.right(who, teacher, labels) for teacher in cards.lists}
            yield over_teachers(f"{who}: right after {labels} labels", found, -1.0, note=missing(cards, who))
    for labels in cards.counts:
        more = {
            teacher: less(cards.right(SILENT, teacher, labels), cards.right(STRONGEST, teacher, labels))
            for teacher in cards.lists
        }
        what = f"silent pupil less strongest other after {labels} labels"
        yield over_teachers(what, more, -1.0, at_least(WANTED_MORE[labels]), missing(cards, STRONGEST))


def missing(cards: Cards, who: str) -> str:
    """Why the others have no figure, where they have none."""
    return cards.missing if who == STRONGEST else ""


def less(ours: list[float], theirs: list[float]) -> list[float]:
    return [a - b for a, b in zip(ours, theirs, strict=True)]


def over_teachers(
    what: str,
    found: Mapping[str, list[float]],
    sign: float,
    wanted: Wanted | None = None,
    note: str = "",
    unit: str = "%",
) -> Figure:
    """The mean over teachers, the worst named: that with the least where the sign is −1, else the most."""
    found = dict(found)
    name, worst = worst_of(found, sign)
    told = note or f"worst {name} {worst:.1f}"
    starts = sum(len(each) for each in found.values())
    return Figure(what, mean_of(found), unit, wanted, starts, told, {"each": found})


# --- single teachers -------------------------------------------------------------------------------
def of_some(cards: Cards) -> Iterator[Figure]:
    """What is wanted of pupils of teachers by name, those that were heard."""
    asked = [("round places", 200, 95.0), ("round places", 400, 97.0)]
    asked += [("odd places", 200, 95.0), ("odd places", 400, 97.0)]
    asked += [("slipping", 400, 96.0), ("slipping", 800, 96.0), (CHANGING, NEW_MIND, 94.0)]
    for teacher, labels, least in asked:
        if teacher in cards.teachers:
            each = cards.right(SILENT, teacher, labels)
            told = float(np.mean(cards.right(TOLD, teacher, labels)))
            note = f"worst seed {min(each):.1f}; with reasons {told:.1f}"
            what = f"{teacher}: silent pupil right after {labels} labels"
            note += ", 200 after the change" if labels == NEW_MIND else ""
            yield Figure(what, float(np.mean(each)), "%", at_least(least), len(each), note, {"each": each})
    if "weighing" in cards.teachers:
        yield weighed(cards, max(cards.counts))


def weighed(cards: Cards, labels: int) -> Figure:
    """The teacher whose mind no list can say: beside CART, whose tree cannot either."""
    cart = {view: cards.right(f"CART on {view}", "weighing", labels) for view in ("numbers", "columns")}
    best = max(cart, key=lambda view: float(np.mean(cart[view])))
    more = less(cards.right(SILENT, "weighing", labels), cart[best])
    what = f"weighing: silent pupil less CART after {labels} labels"
    note = cards.missing or f"CART on {best} {float(np.mean(cart[best])):.1f}"
    return Figure(what, float(np.mean(more)), "%", at_least(-10.0), len(more), note, {"each": more})


# --- the list and its sureness ---------------------------------------------------------------------
def of_rules(cards: Cards) -> Iterator[Figure]:
    """How steadily, shortly, surely and quickly the silent pupil learns."""
    falls = {teacher: [max(each)] for teacher, each in cards.falls().items()}
    name, worst = worst_of(falls)
    note = f"of {name}; between exams from 100 labels on, means over seeds; not across a change of mind"
    yield Figure("worst fall of a curve", worst, "%", at_most(1.0), len(falls), note, {"each": falls})
    last = max(cards.counts)
    rules = cards.of_pupils(lambda marks: marks.rules / marks.actions, last)
    listed = {teacher: each for teacher, each in rules.items() if teacher in cards.lists}
    most, at_worst = worst_of(listed)
    one = max(max(each) for each in listed.values())
    what = f"rules an action after {last} labels"
    aside = ", ".join(f"{t} {np.mean(rules[t]):.1f}" for t in cards.teachers if t not in cards.lists)
    yield over_teachers(what, listed, 1.0, at_most(1.5), f"beside these {aside}" if aside else "", "")
    note = f"{most}; the worst single school {one:.1f}"
    yield Figure(f"{what}, worst teacher", at_worst, "", at_most(2.0), len(listed), note, {"each": rules})
    for labels in cards.counts:
        yield sureness(cards, labels)
    for labels in (labels for labels in cards.counts if labels >= 400):
        wrong = cards.of_pupils(lambda marks: 100.0 * marks.sure_wrong, labels)
        told = mean_of(cards.of_pupils(lambda marks: 100.0 * marks.sure_wrong, labels, TOLD))
        name, worst = worst_of(wrong)
        note = f"of all moments, all teachers; worst {name} {worst:.2f}; with reasons {told:.2f}"
        yield over_teachers(f"wrong while sure after {labels} labels", wrong, 1.0, at_most(0.5), note)
    slowest = max(cards.schools, key=lambda school: school.slowest)
    wall = max(school.slowest_wall for school in cards.schools)
    note = f"{slowest.teacher}; time of the processor, {1e3 * wall:.0f} ms by the clock beside other schools"
    yield Figure("slowest lesson", 1e3 * slowest.slowest, "ms", at_most(100.0), len(cards.schools), note)


def sureness(cards: Cards, labels: int) -> Figure:
    """How much of what is asked the pupil is sure of."""

    def sure(marks: Marks) -> float:
        return 100.0 * marks.sure

    told = mean_of(cards.of_pupils(sure, labels, TOLD))
    note = f"all teachers; with reasons {told:.0f}"
    return over_teachers(f"sure after {labels} labels", cards.of_pupils(sure, labels), -1.0, note=note)


# --- a row for each --------------------------------------------------------------------------------
def row(cards: Cards, teacher: str) -> Figure:
    """All curves of a teacher's pupils: mean over seeds and worst seed, after each number of labels."""
    found, said = {}, []
    for labels in sorted({exam.labels for s in cards.schools if s.teacher == teacher for exam in s.exams}):
        each = {who: cards.right(who, teacher, labels) for who in (SILENT, TOLD, STRONGEST)}
        found[str(labels)] = each | {"strongest": cards.strongest(teacher, labels)}
        said.append(f"{labels}: " + " / ".join(f"{np.mean(e):.1f} ({min(e):.1f})" for e in each.values()))
    last = cards.right(SILENT, teacher, max(cards.counts))
    note = "silent / reasons / strongest, mean (worst seed): " + "; ".join(said)
    mean = float(np.mean(last)) if last else nan
    return Figure(f"{teacher}: silent pupil", mean, "%", None, len(last), note, found)


def everything(cards: Cards) -> Figure:
    """How many schools there were, and all their numbers."""
    numbers = {"schools": [asdict(school) for school in cards.schools]}
    return Figure("schools held", float(len(cards.schools)), "", None, len(cards.schools), "", numbers)
