"""A whole correction: what fired, what should have, and every step until the rulebook decides so (§5.4.2)."""

from collections.abc import Iterable
from dataclasses import replace

from gaitwright.errors import WrongUse
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.forest import Situation
from gaitwright.knowledge.modifier import Learned, Lesson, check_about, learn
from gaitwright.knowledge.rules import Event, Preference, Rule, Rulebook


def teach(rulebook: Rulebook, lesson: Lesson) -> Learned:
    """The rulebook that decides for the action of `lesson.rule` in the lesson's situation.

    All rules of that action are right there (a split leaves several). One that fired learns a positive
    instance, else the one that is changed least by it learns an omission (`lesson.kind` is not asked). Then
    each rule that still fires before it is ordered after it, if both could have fired all along and no stored
    instance speaks against that, else discriminated (a commission of that rule). At a contradiction it stops
    with the trouble; what was learned before is kept, and the lesson can be taught again once it is mended.
    """
    if not lesson.rule:
        raise WrongUse("a correction names the rule that should have fired")
    check_about(rulebook, lesson)
    lesson = replace(lesson, id=lesson.id or f"lesson {rulebook.lessons + 1}")
    kin = same_action(rulebook, lesson.rule)
    now = consult(rulebook, lesson.situation)
    if now.rule in kin:
        return learn(rulebook, replace(lesson, kind="positive", rule=now.rule))
    learned, name = _omission(rulebook, lesson, kin, now.conflict)
    while learned.trouble is None:
        first = consult(learned.rulebook, lesson.situation).rule
        if first is None or first in kin:
            return learned
        step = None
        if name in now.conflict and first in now.conflict:
            step = prefer(learned.rulebook, name, first, lesson.situation, lesson.id)
        if step is None:
            step = learn(learned.rulebook, replace(lesson, kind="commission", rule=first))
        if step.trouble is not None:  # wrong inside what it was right at: it may still come later
            step = prefer(learned.rulebook, name, first, lesson.situation, lesson.id) or step
        learned = Learned(step.rulebook, learned.events + step.events, step.trouble)
    return learned


def relapses(rulebook: Rulebook) -> tuple[Lesson, ...]:
    """The lessons to teach again: what was right and is not decided so any more, because a rule that comes
    before was widened since. Marks and order keep each rule's own instances; what others do there, only a
    look tells."""
    return tuple(
        Lesson("omission", rule.name, right.situation, right.id, right.note, right.raw)
        for rule in rulebook.rules
        if rule.may_fire
        for right in rule.positives
        if right.seen and consult(rulebook, right.situation).rule not in same_action(rulebook, rule.name)
    )


def same_action(rulebook: Rulebook, name: str) -> tuple[str, ...]:
    """The rules that do the same as one of them, that one first; a name that is not there stands for
    itself."""
    action = next((rule.action for rule in rulebook.rules if rule.name == name), None)
    others = (rule.name for rule in rulebook.rules if rule.name != name and rule.action == action)
    return (name, *others)


def _omission(
    rulebook: Rulebook, lesson: Lesson, kin: tuple[str, ...], could: tuple[str, ...]
) -> tuple[Learned, str]:
    """The lesson learned by the rule of its action that could have fired, or else moves the fewest marks."""
    tried = [(learn(rulebook, replace(lesson, kind="omission", rule=name)), name) for name in kin]
    learned, name = min(
        tried, key=lambda pair: (pair[0].trouble is not None, pair[1] not in could, len(pair[0].events))
    )
    return learned, name


def prefer(
    rulebook: Rulebook, better: str, worse: str, situation: Situation, instance: str
) -> Learned | None:
    """The rulebook with one rule ordered before another, or `None` where what was learned forbids it.

    Either the better one rises to just before the worse, or the worse one sinks to just after the better:
    what moves no mark, else the first that can be.
    """
    wish = Preference(better, worse, situation, instance)
    down, up = rulebook.place(worse), rulebook.place(better)
    if up < down:
        return _ordered(rulebook, rulebook.rules, wish)
    moved = rulebook.rules[down : up + 1]
    found = []
    for movers, passed in ((moved[-1:], moved[:-1]), (moved[1:], moved[:1])):
        barred = _barred(rulebook, movers, passed)
        if barred is None:
            continue
        now = {rule.name: rule for rule in barred.rulebook.rules}
        block = tuple(now[rule.name] for rule in (*movers, *passed))
        learned = _ordered(barred.rulebook, (*rulebook.rules[:down], *block, *rulebook.rules[up + 1 :]), wish)
        if consult(learned.rulebook, situation).rule == better:
            found.append(Learned(learned.rulebook, barred.events + learned.events))
    return min(found, key=lambda learned: len(learned.events) > 1, default=None)


def _barred(rulebook: Rulebook, movers: Iterable[Rule], passed: Iterable[Rule]) -> Learned | None:
    """The rulebook ready for the movers to come before others: wherever those were right, the movers are
    wrong now, and stay so however their marks move later; `None` where marks cannot do that.

    Earlier wishes against the movers are kept that way too, and need no order any more.
    """
    names = {rule.name for rule in passed}
    learned, settled = Learned(rulebook), set()
    for mover in movers:
        kin = same_action(rulebook, mover.name)
        wishes = [wish for wish in rulebook.preferences if wish.worse == mover.name and wish.better in names]
        rights = [(p.situation, p.id) for rule in passed if rule.name not in kin for p in rule.positives]
        marks = mover.marks
        for situation, instance in (*rights, *((wish.situation, wish.instance) for wish in wishes)):
            step = learn(learned.rulebook, Lesson("commission", mover.name, situation, instance))
            if step.trouble is not None:
                return None
            learned = Learned(step.rulebook, learned.events + step.events)
        rule = learned.rulebook[mover.name]
        quiet = mover.quiet if rule.marks == marks else 0
        calm = learned.rulebook.with_rule(replace(rule, quiet=quiet))
        learned = Learned(replace(learned.rulebook, rules=calm, lessons=rulebook.lessons), learned.events)
        settled.update(wishes)
    kept = tuple(wish for wish in rulebook.preferences if wish not in settled)
    return Learned(replace(learned.rulebook, preferences=kept), learned.events)


def _ordered(rulebook: Rulebook, rules: tuple[Rule, ...], wish: Preference) -> Learned:
    """The rulebook with its rules in this order, and the wish that brought it about."""
    why = f"both could fire at {wish.instance}, and {wish.better} is preferred to {wish.worse}"
    event = Event(wish.instance, wish.better, "", "order", f"after {wish.worse}", f"before {wish.worse}", why)
    wishes, events = (*rulebook.preferences, wish), (*rulebook.events, event)
    new = replace(rulebook, rules=rules, preferences=wishes, events=events, lessons=rulebook.lessons + 1)
    return Learned(new, (event,))
