"""What was changed by hand in their book, not by lessons: rules taken over, confirmed, ordered."""

from dataclasses import replace

from gaitwright.knowledge.analogy import confirm
from gaitwright.knowledge.correction import prefer
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Lesson
from gaitwright.knowledge.rules import Event, Instance, Preference, Rule, Rulebook
from gaitwright.skillbook.merging.state import Conflict, Joining
from gaitwright.skillbook.merging.translate import lesson_over, restated


def take_edit(joining: Joining, before: Rulebook | None, after: Rulebook) -> None:
    """Takes in what differs between their rulebooks before and after an edit (`None`: their beginning)."""
    old = {rule.name: rule for rule in before.rules} if before else {}
    for rule in after.rules:
        if rule != old.get(rule.name):
            take_rule(joining, rule, old.get(rule.name))
    gone = old.keys() - {rule.name for rule in after.rules}
    for name in sorted(name for name in gone if joining.has(name)):
        sentence = f"{joining.their_name} took {name} out by hand: it stays"
        joining.report(Conflict(name, (), (), (), sentence))
    for wish in after.preferences:
        if before is None or wish not in before.preferences:
            take_preference(joining, wish)


def take_rule(joining: Joining, rule: Rule, old: Rule | None) -> None:
    """A rule that their edit made or changed: as it is where we have none, else its instances."""
    name = joining.renamed.get(rule.name, rule.name)
    if not joining.has(name):
        add_rule(joining, replace(rule, name=name))
        return
    known = () if old is None else (*old.positives, *old.negatives)
    for instance in (*rule.positives, *rule.negatives):
        if instance.seen and instance not in known:
            take_instance(joining, name, rule.action, instance)
    if joining.rulebook[name].proposed and not rule.proposed:
        confirmed = confirm(joining.rulebook, name, f"a merge with {joining.their_name}")
        joining.edit(confirmed.rulebook, f"{name} was confirmed in {joining.their_name}")


def add_rule(joining: Joining, rule: Rule) -> None:
    stated = restated(rule, joining.rulebook.forest)
    if not isinstance(stated, Rule):
        ids = tuple(instance.id for instance in (*rule.positives, *rule.negatives))
        sentence = f"{rule.name} of {joining.their_name} cannot be taken over: {stated}"
        joining.report(Conflict(rule.name, (), (), ids, sentence))
        return
    why = f"{rule.name} was taken over from {joining.their_name}"
    event = Event("", rule.name, "", "rule", "", rule.name, why)
    rules = (*joining.rulebook.rules, stated)
    joining.edit(replace(joining.rulebook, rules=rules), why, (event,))


def take_instance(joining: Joining, name: str, action: Action, instance: Instance) -> None:
    """Teaches one of their instances to our rule, unless that knows the situation already."""
    kind = "omission" if instance.speaks_for else "commission"
    raw = dict(instance.raw)
    lesson = Lesson(kind, name, instance.situation, instance.id, instance.note, raw, "", action)
    stated = lesson_over(joining.rulebook.forest, lesson)
    if isinstance(stated, str):
        sentence = f"{instance.id} of {joining.their_name} has a value in {stated} that is not known here"
        joining.report(Conflict(name, (stated,), (), (instance.id,), sentence))
        return
    rule = joining.rulebook[name]
    here = rule.positives if instance.speaks_for else rule.negatives
    if all(other.situation != stated.situation for other in here):
        joining.teach(stated, "learned")


def take_preference(joining: Joining, wish: Preference) -> None:
    better, worse = (joining.renamed.get(name, name) for name in (wish.better, wish.worse))
    why = f"{better} is preferred to {worse} in {joining.their_name}"
    here = lesson_over(joining.rulebook.forest, Lesson("positive", better, wish.situation, wish.instance))
    learned = None
    if joining.has(better) and joining.has(worse) and isinstance(here, Lesson):
        if (
            replace(wish, better=better, worse=worse, situation=here.situation)
            in joining.rulebook.preferences
        ):
            return
        learned = prefer(joining.rulebook, better, worse, here.situation, wish.instance)
    if learned is None:
        sentence = f"{why}, as {wish.instance} taught; here that order cannot be"
        joining.report(Conflict(better, (), (), (wish.instance,), sentence))
        return
    joining.edit(learned.rulebook, why)
