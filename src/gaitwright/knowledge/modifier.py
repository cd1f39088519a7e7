"""The modifier: one lesson in, a new rulebook and what moved out (§5.4.2).

Kept through every lesson: a rule's positive instances stay below its upper marks, its negative ones do not.
Where no marks can do both, nothing changes and the answer says which instances contradict each other.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

from gaitwright.errors import WrongUse
from gaitwright.knowledge.forest import Forest, Situation
from gaitwright.knowledge.mark_fitting import fit_all
from gaitwright.knowledge.memory import Action, Fact
from gaitwright.knowledge.rules import Event, Instance, Marks, Rule, Rulebook, empty_rule


@dataclass(frozen=True, slots=True)
class Lesson:
    """What the critic found: a rule was right ("positive"), should have fired ("omission") or not
    ("commission").

    `blame` is the tree a teacher names as the reason; `action` makes an omission's missing rule; `raw` holds
    whatever else was measured; without an `id` it is numbered.
    """

    kind: Literal["positive", "omission", "commission"]
    rule: str
    situation: Situation
    id: str = ""
    note: str = ""
    raw: Mapping[str, Fact] = field(default_factory=dict, hash=False)
    blame: str = ""
    action: Action | None = None


@dataclass(frozen=True, slots=True)
class Inconsistency:
    """A lesson that no marks of the rule can follow together with its earlier ones: `inside` contradict
    it."""

    rule: str
    instance: Instance
    inside: tuple[Instance, ...]
    same: bool
    sentence: str


@dataclass(frozen=True, slots=True)
class Learned:
    """The rulebook after a lesson, what moved, and the contradiction where there was one (then nothing
    moved)."""

    rulebook: Rulebook
    events: tuple[Event, ...] = ()
    trouble: Inconsistency | None = None


def learn(rulebook: Rulebook, lesson: Lesson) -> Learned:
    """One lesson for one rule. Raises `WrongUse` for a rule that does not exist and comes without an
    action."""
    check_about(rulebook, lesson)
    lesson_id = lesson.id or f"lesson {rulebook.lessons + 1}"
    instance = Instance(lesson_id, lesson.kind, lesson.situation, lesson.raw, lesson.note)
    blame = rulebook.forest[lesson.blame].name if lesson.blame else ""
    made, events = with_rule_for(rulebook, lesson.rule, lesson.action, instance)
    rule = made[lesson.rule]
    fitted = fit_all(rulebook.forest, rule, instance, blame)
    if not isinstance(fitted, Rule):
        return Learned(rulebook, (), contradiction(rulebook, rule, instance, fitted))
    moved = moves(rulebook.forest, rule, fitted, instance)
    quiet = 0 if moved else rule.quiet + 1
    fitted = replace(fitted, quiet=quiet, proposed=rule.proposed and not instance.speaks_for)
    return closed(made, fitted, events + moved)


def check_about(rulebook: Rulebook, lesson: Lesson) -> None:
    """Raises `WrongUse` for a lesson in other trees than the rules are about."""
    if lesson.situation.trees != rulebook.forest.names:
        raise WrongUse(
            f"the lesson is about {list(lesson.situation.trees)}, "
            f"the rules about {list(rulebook.forest.names)}"
        )


def closed(rulebook: Rulebook, rule: Rule, events: tuple[Event, ...]) -> Learned:
    """The rulebook with the changed rule, one lesson older."""
    after = replace(
        rulebook,
        rules=rulebook.with_rule(rule),
        events=(*rulebook.events, *events),
        lessons=rulebook.lessons + 1,
    )
    return Learned(after, events)


def with_rule_for(
    rulebook: Rulebook, name: str, action: Action | None, instance: Instance
) -> tuple[Rulebook, tuple[Event, ...]]:
    """The rulebook with a rule of that name: where it is missing and an action is given, an empty shell,
    last."""
    if action is None or any(rule.name == name for rule in rulebook.rules):
        return rulebook, ()
    shell = empty_rule(rulebook.forest, name, action)
    born = Event(instance.id, name, "", "rule", "", name, f"{name} is new: nothing in the rulebook did this")
    return replace(rulebook, rules=(*rulebook.rules, shell)), (born,)


def moves(forest: Forest, before: Rule, after: Rule, instance: Instance) -> tuple[Event, ...]:
    """An event for each mark that moved between two states of a rule, with the reason in a sentence."""
    dropped = any(not other.seen for other in before.positives) and all(
        other.seen for other in after.positives
    )
    remark = "; what was only concluded by analogy gave way" if dropped else ""
    events = []
    for old, new, value in zip(before.marks, after.marks, instance.situation.values, strict=True):
        if old.lower != new.lower:
            why = f"{before.name} was right at {old.tree} {value}{remark}"
            events.append(
                Event(instance.id, before.name, old.tree, "lower", old.lower or "", new.lower or "", why)
            )
        if old.upper != new.upper:
            why = _upper_reason(forest, before, old, new, instance) + remark
            events.append(Event(instance.id, before.name, old.tree, "upper", old.upper, new.upper, why))
    return tuple(events)


def _upper_reason(forest: Forest, rule: Rule, old: Marks, new: Marks, instance: Instance) -> str:
    """Why an upper mark moved: a negative instance lowered it, or an earlier choice proved wrong."""
    tree = forest[old.tree]
    value = instance.situation[old.tree]
    if not tree.is_below(new.upper, old.upper):
        return (
            f"{rule.name} was right at {old.tree} {value}: keeping others out there had been the wrong choice"
        )
    if instance.speaks_for:
        return f"another tree had to keep an earlier wrong situation out, and {old.tree} can"
    return f"{rule.name} was wrong at {old.tree} {value}"


def contradiction(
    rulebook: Rulebook, rule: Rule, instance: Instance, inside: Sequence[Instance]
) -> Inconsistency:
    """The inconsistency in words."""
    rights = [instance] if instance.speaks_for else list(rule.positives)
    same = any(wrong.situation == right.situation for wrong in inside for right in rights)
    wrongs = ", ".join(
        f"{wrong.id} ({values_text(rulebook.forest, wrong.situation)})" for wrong in inside[:3]
    )
    if same:
        twin = next(wrong for wrong in inside if any(wrong.situation == right.situation for right in rights))
        sentence = (
            f"{rule.name} is right and wrong in one and the same situation "
            f"({values_text(rulebook.forest, twin.situation)}): a feature is missing that tells the two apart"
        )
    elif instance.speaks_for:
        sentence = (
            f"{rule.name} cannot be right at {instance.id} "
            f"({values_text(rulebook.forest, instance.situation)}): values that hold it "
            f"and the earlier right situations hold the wrong {wrongs} too"
        )
    else:
        sentence = (
            f"{rule.name} cannot be wrong at {wrongs}: every one of its values there lies "
            f"among those at which it was right, in these trees"
        )
    return Inconsistency(rule.name, instance, tuple(inside), same, sentence)


def values_text(forest: Forest, situation: Situation) -> str:
    """The values of a situation in a row."""
    return ", ".join(f"{tree} {value}" for tree, value in situation.items() if value is not None)


def audit(rulebook: Rulebook) -> tuple[str, ...]:
    """What contradicts the guarantees, in sentences; none in any rulebook that learning made."""
    faults = []
    for rule in rulebook.rules:
        for tree, marks in zip(rulebook.forest.trees, rule.marks, strict=True):
            if marks.lower is not None and not tree.is_below(marks.lower, marks.upper):
                faults.append(
                    f"{rule.name}: in {tree.name} the lower mark {marks.lower!r} is not below the upper"
                )
        faults += _instance_faults(rulebook.forest, rule)
    order = {rule.name: k for k, rule in enumerate(rulebook.rules)}
    for wish in rulebook.preferences:
        if order[wish.better] > order[wish.worse]:
            faults.append(f"{wish.better} should come before {wish.worse}, as {wish.instance} taught")
    return tuple(faults)


def _instance_faults(forest: Forest, rule: Rule) -> list[str]:
    """Instances that the marks of a rule do not fit."""
    wrong = [positive for positive in rule.positives if _excluded(forest, rule, positive)]
    if rule.positives:
        wrong += [negative for negative in rule.negatives if not _excluded(forest, rule, negative)]
    return [f"{rule.name}: the marks do not fit {instance.id} ({instance.kind})" for instance in wrong]


def _excluded(forest: Forest, rule: Rule, instance: Instance) -> bool:
    return any(
        value is not None and not tree.is_below(value, marks.upper)
        for tree, marks, value in zip(forest.trees, rule.marks, instance.situation.values, strict=True)
    )
