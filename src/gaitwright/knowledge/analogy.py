"""New rules from old: walk-backward from walk-forward (§5.5)."""

from collections.abc import Callable, Mapping
from dataclasses import replace

from gaitwright.errors import WrongUse, unknown
from gaitwright.knowledge.forest import Forest, Situation
from gaitwright.knowledge.mark_fitting import refit, tightened
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Learned, contradiction
from gaitwright.knowledge.rules import Event, Instance, Rule, Rulebook, empty_rule

ValueMaps = Mapping[str, Mapping[str, str]]
"""Per tree, the leaf that stands for each leaf on the other side; what is not named stands for itself."""


def mirrored(
    rulebook: Rulebook,
    name: str,
    new_name: str,
    action_map: Callable[[Action], Action],
    value_maps: ValueMaps,
) -> Learned:
    """The rulebook with a proposed rule: the old one's instances carried over, and the marks that fit them.

    It stands last and does not fire until it is confirmed or seen right. What is seen later overrules what
    was carried over. Where the maps put right and wrong in one place, nothing changes and the trouble says
    so.
    """
    rule = rulebook[name]
    _check_maps(rulebook.forest, value_maps)
    if any(other.name == new_name for other in rulebook.rules):
        raise WrongUse(f"there is a rule {new_name!r} already")
    shell = replace(
        empty_rule(rulebook.forest, new_name, action_map(rule.action)),
        positives=tuple(_map_instance(instance, name, value_maps) for instance in rule.positives),
        negatives=tuple(_map_instance(instance, name, value_maps) for instance in rule.negatives),
        choices=rule.choices,
        proposed=True,
    )
    fitted = refit(rulebook.forest, tightened(rulebook.forest, shell))
    if not isinstance(fitted, Rule):
        return Learned(rulebook, (), contradiction(rulebook, shell, fitted[0], fitted))
    why = f"{new_name} is proposed as the counterpart of {name}; nobody has seen it yet"
    event = Event("", new_name, "", "rule", name, new_name, why)
    new = replace(rulebook, rules=(*rulebook.rules, fitted), events=(*rulebook.events, event))
    return Learned(new, (event,))


def confirm(rulebook: Rulebook, name: str, instance: str) -> Learned:
    """The rulebook in which a proposed rule may fire. Raises `WrongUse` for a rule that is not proposed."""
    rule = rulebook[name]
    if not rule.proposed:
        raise WrongUse(f"{name} is not proposed: there is nothing to confirm")
    event = Event(instance, name, "", "rule", "proposed", "confirmed", f"{name} was confirmed at {instance}")
    rules = rulebook.with_rule(replace(rule, proposed=False))
    return Learned(replace(rulebook, rules=rules, events=(*rulebook.events, event)), (event,))


def _map_instance(instance: Instance, name: str, value_maps: ValueMaps) -> Instance:
    """An instance as it would be on the other side, marked as never seen."""
    values = tuple(
        None if value is None else value_maps.get(tree, {}).get(value, value)
        for tree, value in instance.situation.items()
    )
    kind = "analogy for" if instance.speaks_for else "analogy against"
    situation = Situation(instance.situation.trees, values)
    return Instance(f"{instance.id} of {name}", kind, situation, note=instance.note)


def _check_maps(forest: Forest, value_maps: ValueMaps) -> None:
    """Raises `WrongUse` for a map in a tree that does not exist, or of values that are no leaves."""
    for name, values in value_maps.items():
        tree = forest[name]
        for value in (*values, *values.values()):
            if not tree.is_leaf(value):
                raise unknown(f"leaf of {name}", value, tree.leaves)
