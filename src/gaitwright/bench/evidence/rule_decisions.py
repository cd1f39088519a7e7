"""How long a decision takes beside CLIPS, and whether what is said about a decision is true."""

import gc
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from time import perf_counter_ns

import numpy as np

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.clips_text import constructs, loops, symbols
from gaitwright.bench.evidence.random_rulebooks import RULES, TREES, RandomRulebook, random_situation
from gaitwright.bench.measurement import Figure, Wanted, at_least, at_most, count
from gaitwright.bench.peers.rules_client import RulesPeer
from gaitwright.description.load import load_robot
from gaitwright.knowledge.compiled import Compiled, decide, decide_many
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.counterfactual import counterfactual
from gaitwright.knowledge.explain import forest_text, history, why, why_not
from gaitwright.knowledge.forest import Forest, Situation, replace_value
from gaitwright.knowledge.memory import Fact, Memory
from gaitwright.knowledge.rules import Rulebook
from gaitwright.knowledge.trees import FeatureTree
from gaitwright.learning.exam import held_out
from gaitwright.learning.skill_pupil import SkillPupil, told_at
from gaitwright.learning.teacher import teacher_for
from gaitwright.skills.book_trees import in_trees_of

SITUATIONS, QUICK_SITUATIONS = 1000, 200
ROUNDS, QUICK_ROUNDS = 40, 5
PASSES = 3
"""Of so many passes over all situations a round takes the best, of ours and of CLIPS's alike."""
REPLAYS, QUICK_REPLAYS = 1000, 100
EXPLAINED, QUICK_EXPLAINED = 200, 20
LESSONS, QUICK_LESSONS = 300, 40
"""What the pupil was told whose rules are explained."""
SIZE = f"{RULES} rules × {TREES} trees"


@dataclass(frozen=True)
class Asked:
    """A rulebook with situations in which it is asked: each rule is the right one as often as any other."""

    book: Rulebook
    compiled: Compiled
    situations: tuple[Situation, ...]
    leaves: np.ndarray
    """Places of their leaves, `(situations, trees)`."""
    values: tuple[dict[str, str], ...]
    facts: tuple[dict[str, Fact], ...]
    """Working memory that describes them."""


def asked(seed: int, number: int) -> Asked:
    """A random rulebook and so many situations, drawn by the seed."""
    drawn_by = RandomRulebook(seed)
    forest, drawn = drawn_by.forest, drawn_by.asked(seed, number)
    return Asked(
        drawn_by.book,
        drawn_by.compiled,
        tuple(drawn),
        np.array([forest.leaf_places(situation) for situation in drawn]),
        tuple({tree: str(value) for tree, value in situation.items()} for situation in drawn),
        tuple(facts_of(forest, situation) for situation in drawn),
    )


# --- a decision ------------------------------------------------------------------------------------
def decisions(context: Context) -> Iterator[Figure]:
    """Times from Python, in a compiled loop and of CLIPS, and whether all decide alike."""
    context.voice.say("rules: decisions (CLIPS is installed at the first run: a minute)")
    work = asked(context.seed, QUICK_SITUATIONS if context.quick else SITUATIONS)
    rows = [symbols(row) for row in work.leaves.tolist()]
    problem = {"constructs": constructs(work.book), "situations": rows, "loops": loops(rows)}
    with RulesPeer("clips", problem) as clips:
        rounds = [timed(work, clips) for _ in range(1 + (QUICK_ROUNDS if context.quick else ROUNDS))]
        yield from times(rounds[1:], clips)
        yield agreement(work, clips)


def timed(work: Asked, clips: RulesPeer) -> dict[str, float]:
    """µs of a decision in one round, by who decides; CLIPS is left out where it cannot run."""
    compiled, number = work.compiled, len(work.situations)
    intervals = [tree for tree in work.book.forest.trees if tree.bounds]
    found = {
        "compiled": per_item(lambda: decide_many(compiled, work.leaves), number),
        "masks": per_item(lambda: [decide(compiled, known) for known in work.values], number),
        "python": per_item(lambda: [built(compiled, intervals, known) for known in work.facts], number),
    }
    told = clips.ask(f"run {PASSES}")
    return found | ({"called": told["called_us"], "inside": told["inside_us"]} if told else {})


def built(compiled: Compiled, intervals: Sequence[FeatureTree], memory: Memory) -> tuple[str | None, bool]:
    """A decision from working memory: numbers become leaves of their trees, then it is decided."""
    values: dict = dict(memory)
    for tree in intervals:
        values[tree.name] = tree.leaf_of(values[tree.name])
    return decide(compiled, values)


def facts_of(forest: Forest, situation: Situation) -> dict[str, Fact]:
    """Working memory that describes a situation: numbers where the tree has intervals."""
    facts: dict[str, Fact] = {}
    for tree in forest.trees:
        value = str(situation[tree.name])
        place = tree.leaf_place[value]
        facts[tree.name] = ((tree.bounds[0] - 1.0, *tree.bounds)[place]) if tree.bounds else value
    return facts


def per_item(work: Callable[[], object], number: int) -> float:
    """How long it takes for each of so many, in µs: the best of a few passes, the first of which warms up."""
    took = []
    gc.disable()
    for _ in range(PASSES):
        began = perf_counter_ns()
        work()
        took.append((perf_counter_ns() - began) / 1e3)
    gc.enable()
    return min(took) / number


TIMES: tuple[tuple[str, str, Wanted | None], ...] = (
    ("compiled", f"decision, {SIZE}: compiled, in a loop", at_most(1.0)),
    ("python", "… from Python, the situation built from working memory", at_most(10.0)),
    ("masks", "… from Python, the situation at hand", None),
    ("inside", "CLIPS on the same rules: reset, assert and run in a loop of its own", None),
    ("called", "… called from Python", None),
)


def times(rounds: Sequence[Mapping[str, float]], clips: RulesPeer) -> Iterator[Figure]:
    """The median of all rounds of everyone, and ours over CLIPS's."""
    version = clips.reason or f"clipspy {clips.greeting['version']}"
    for name, what, wanted in TIMES:
        each = [times[name] for times in rounds if name in times]
        theirs = name in ("inside", "called")
        note = version if theirs else ""
        measured = float(np.median(each)) if each else float("nan")
        yield Figure(what, measured, "µs", wanted, len(each), note, {"each_round_us": each})
    for ours, theirs, what in (
        ("compiled", "inside", "our decision over CLIPS's, both in a loop of their own"),
        ("python", "called", "our decision over CLIPS's, both from Python"),
    ):
        each = [times[ours] / times[theirs] for times in rounds if theirs in times]
        measured = float(np.median(each)) if each else float("nan")
        yield Figure(what, measured, "×", None, len(each), version, {"each_round": each})


def agreement(work: Asked, clips: RulesPeer) -> Figure:
    """In how many situations CLIPS, the masks and the plain consultation decide alike."""
    what = "same decision as CLIPS and as the consultation that the thesis describes"
    places, _ = decide_many(work.compiled, work.leaves)
    told = clips.ask("decide")
    if told is None:
        nan = float("nan")
        number = len(work.situations)
        return Figure(what, nan, f"of {number}", at_least(float(number)), 0, clips.reason or "")
    names = [rule.name for rule in work.book.rules]
    plain = [consult(work.book, situation).rule for situation in work.situations]
    alike = [
        ours == theirs and names[ours] == rule
        for ours, theirs, rule in zip(places.tolist(), told["decisions"], plain, strict=True)
    ]
    fired = f"{len(set(plain))} of {len(names)} rules fired"
    return count(what, sum(alike), len(alike), 1.0, fired, {"first_other": first_false(alike)})


def first_false(answers: Sequence[bool]) -> int | None:
    """The place of the first that is not true."""
    return next((k for k, answer in enumerate(answers) if not answer), None)


# --- what is said about it -------------------------------------------------------------------------
def explanations(context: Context) -> Iterator[Figure]:
    """Whether counterfactuals come true, and how long a whole explanation takes."""
    context.voice.say("rules: counterfactuals")
    wanted = QUICK_REPLAYS if context.quick else REPLAYS
    true, changed, none = [], [], 0
    for seed in context.seeds(wanted // 20, quick=max(2, wanted // 20)):
        for came_true, trees in replays(seed, 20):
            if came_true is None:
                none += 1
            else:
                true.append(came_true)
                changed.append(trees)
    note = f"{np.mean(changed):.1f} trees changed on average; {none} times no change can bring it about"
    numbers = {"first_false": first_false(true), "none_found": none}
    what = "counterfactuals that come true when the change is made"
    yield count(what, sum(true), len(true), 0.99, note, numbers)
    yield from explaining(context)


def replays(seed: int, number: int) -> Iterator[tuple[bool | None, int]]:
    """Whether what was said of a change comes true (`None`: none was found), and how many trees it changes.

    The change is made value by value, as a reader of the sentence would, and decided by plain consultation.
    """
    drawn = RandomRulebook(seed)
    book, rng, table = drawn.book, np.random.default_rng([seed, 2]), drawn.compiled
    for k in range(number):
        rule = book.rules[int(rng.integers(len(book.rules)))]
        situation = random_situation(rng, book.forest, rule)
        to = "" if k % 2 else book.rules[int(rng.integers(len(book.rules)))].name
        found = counterfactual(book, situation, to, compiled=table)
        if found.decision is None:
            yield None, 0
            continue
        other = situation
        for change in found.changes:
            other = replace_value(book.forest, other, change.tree, change.after)
        now, then = consult(book, situation).rule, consult(book, other).rule
        said = found.sentence.startswith(str(then or "no rule"))
        yield said and then == found.decision.rule and (then == to if to else then != now), len(found.changes)


def explaining(context: Context) -> Iterator[Figure]:
    """How long one explanation takes: why, why not another, the smallest changes, a rule's history."""
    context.voice.say("rules: explanations")
    lessons, number = (QUICK_LESSONS, QUICK_EXPLAINED) if context.quick else (LESSONS, EXPLAINED)
    book, asked_of = learned(context.seed, lessons, number)
    took = []
    for situation in asked_of:
        began = perf_counter_ns()
        explain(book, situation)
        took.append((perf_counter_ns() - began) / 1e6)
    numbers = {"each_ms": took, "slowest_ms": max(took)}
    size = f"{len(book.rules)} rules × {len(book.forest.trees)} trees, {len(book.events)} events"
    note = f"{size}; median {np.median(took):.1f} ms, slowest {max(took):.1f} ms"
    what = "one explanation of a book from a robot's school: 95th percentile"
    yield Figure(what, float(np.percentile(took, 95)), "ms", at_most(50.0), number, note, numbers)


def learned(seed: int, lessons: int, number: int) -> tuple[Rulebook, list[Situation]]:
    """The rulebook of a pupil of skills with its history, and so many other situations to explain it in."""
    robot = load_robot("go2")
    teacher, pupil = teacher_for(robot), SkillPupil(seed)
    moments = held_out(robot, teacher, seed, lessons + number)
    events = [pupil.hear(told_at(m, teacher.ideal(m.facts), m.id)).events for m in moments[:lessons]]
    book = replace(pupil.rulebook(), events=tuple(event for moved in events for event in moved))
    return book, [in_trees_of(book, m.situation, m.raw) for m in moments[lessons:]]


def explain(book: Rulebook, situation: Situation) -> list[str]:
    """Everything that is told about one decision."""
    decision = consult(book, situation)
    others = [rule.name for rule in book.rules if rule.name != decision.rule]
    told = [why(book, decision), *(why_not(book, name, situation) for name in others)]
    told.append(counterfactual(book, situation).sentence)
    told += [counterfactual(book, situation, name).sentence for name in others[:3]]
    if decision.rule is not None:
        told += [forest_text(book, decision.rule), *history(book, decision.rule)]
    return told
