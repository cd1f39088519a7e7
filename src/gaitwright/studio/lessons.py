"""Teaching from the page: what is said there → what is tried, learned, and shown of the rules."""

from typing import Any

from gaitwright.errors import WrongUse, unknown
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.explain import why_not
from gaitwright.knowledge.memory import said_of
from gaitwright.knowledge.rules import Rule, Rulebook, outside
from gaitwright.knowledge.sentences import because, facts_of, history_lines
from gaitwright.knowledge.trees import FeatureTree
from gaitwright.learning.live import LiveLessons, Tried
from gaitwright.learning.live_sources import Running
from gaitwright.learning.notes import pupil_of
from gaitwright.learning.said_action import Words, said_action
from gaitwright.learning.teacher import Shown
from gaitwright.skillbook.writer import Ledger
from gaitwright.skills.book_trees import in_trees_of
from gaitwright.skills.what_if import what_if
from gaitwright.studio.messages import Right

HISTORY = 20
"""So many of the last moves of a rule's marks are shown, and as many lessons."""


class Lessons:
    """A person's lessons to the pupil of a book, while a mission runs."""

    def __init__(self, ledger: Ledger) -> None:
        self.live = LiveLessons(ledger, pupil_of(ledger.book))
        self.open: Tried | None = None
        """What was tried and waits to be kept."""

    @property
    def rulebook(self) -> Rulebook:
        return self.live.ledger.book.rulebook

    def warm_up(self, source: Running) -> None:
        """Learns nothing; but what is compiled at a first lesson is compiled now."""
        self.live.confirmation(source.here(), source.session.brain.robot, source.name)

    def right(self, said: Right, source: Running) -> dict[str, Any]:
        """What it would do to be told what is right now. Raises `WrongUse` for what cannot be said."""
        pupil, robot = self.live.pupil, source.session.brain.robot
        speed = None if said.speed is None else (said.speed, said.speed)
        action = said_action(Words(said.skill, speed), robot, pupil.actions)
        if said.about and said.about not in pupil.vocabulary.names:
            raise unknown("number", said.about, pupil.vocabulary.names)
        here = source.here()
        self.open = self.live.correction(here, Shown(said.name, action, about=said.about), source.name)
        return self.tried_shown(self.open)

    def order(self, rule: str, before: str, source: Running) -> dict[str, Any]:
        """What it would do to have one rule before another where both could fire: a lesson at the last moment
        seen at which the other one did. Raises `WrongUse` where there was none."""
        book = self.rulebook
        wanted, _ = book[rule], book[before]
        for seen in reversed([*self.live.seen, source.here()]):
            situation = in_trees_of(book, seen.moment.situation, seen.moment.facts)
            if consult(book, situation).rule == before and not outside(book.forest, wanted, situation):
                self.open = self.live.correction(seen, Shown(rule, wanted.action), source.name)
                return self.tried_shown(self.open)
        raise WrongUse(f"nowhere on this run did {before} fire where {rule} could too: that teaches no order")

    def ok(self, source: Running) -> str:
        """What it does now is right: learned at once; the lesson's name."""
        self.open = self.live.confirmation(source.here(), source.session.brain.robot, source.name)
        return self.keep(source)

    def keep(self, source: Running) -> str:
        """Learns what was tried, and drives by it; the lesson's name."""
        if self.open is None:
            raise WrongUse("there is nothing to keep: say what is right first")
        tried, self.open = self.open, None
        self.live.keep(tried)
        source.drive_by(self.rulebook)
        return tried.told.id

    def back(self) -> None:
        """What was tried is not learned."""
        self.open = None

    def forget(self, lesson: str, source: Running) -> str:
        """Takes a lesson back, the last one where none is named; its name."""
        name, _ = self.live.forget(lesson)
        self.open = None
        source.drive_by(self.rulebook)
        return name

    def look(self, source: Running) -> None:
        """Notes this moment, as one that a lesson is tried on."""
        self.live.seen.append(source.here())
        del self.live.seen[:-600]

    # --- shown --------------------------------------------------------------------------------------
    def why(self, rule: str, source: Running) -> list[str]:
        """Why it does what it does, or why a rule does not fire; what would have to be different."""
        book, moment = self.rulebook, source.here().moment
        situation = in_trees_of(book, moment.situation, moment.facts)
        if rule:
            return [why_not(book, rule, situation)]
        decision = consult(book, situation)
        said = [source.session.mind.call.because, because(book, decision)]
        return said if decision.rule is None else [*said, what_if(book, moment.facts).sentence]

    def tried_shown(self, tried: Tried) -> dict[str, Any]:
        """What a lesson would do."""
        return {
            "say": "tried",
            "lesson": tried.told.id,
            "sentence": f"{said_of(tried.told.action)} is right here",
            "moves": [event.why for event in tried.taken.events][:HISTORY],
            "followed": tried.is_followed,
            "stretches": [stretch.sentence for stretch in tried.stretches][:HISTORY],
            "broken": [told.id for told in tried.broken],
            "mended": [told.id for told in tried.mended],
        }

    def rules_shown(self) -> dict[str, Any]:
        """The rules in their order, the trees they go by, and the last lessons."""
        book = self.rulebook
        return {
            "say": "rules",
            "trees": [tree_shown(tree) for tree in book.forest.trees],
            "rules": [rule_shown(book, rule) for rule in book.rules],
            "lessons": [
                {"id": told.id, "rule": told.rule, "given": told.given, "about": told.about}
                for told in self.live.pupil.told[::-1][:HISTORY]
            ],
            "numbers": list(self.live.pupil.vocabulary.names),
        }


def tree_shown(tree: FeatureTree) -> dict[str, Any]:
    """A feature's values, and the place of the one that each hangs below (−1: the root)."""
    shape = {"values": list(tree.values), "parents": list(tree.parents)}
    return {"name": tree.name, "about": tree.about, "unit": tree.unit, **shape}


def rule_shown(book: Rulebook, rule: Rule) -> dict[str, Any]:
    """A rule with its marks in every tree, and what moved them last."""
    lines = history_lines(book, rule.name)[-HISTORY:]
    return facts_of(book, rule) | {
        "skill": rule.action.skill,
        "action": said_of(rule.action),
        "history": lines,
    }
