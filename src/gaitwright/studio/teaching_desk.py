"""Teaching from the page: what is said there → what is tried, learned, and shown of the rules."""

from collections.abc import Callable
from typing import Any

from gaitwright.errors import WrongUse, unknown
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.explain import why_not
from gaitwright.knowledge.memory import said_of
from gaitwright.knowledge.rules import Rule, Rulebook, outside
from gaitwright.knowledge.sentences import because, facts_of, history_lines
from gaitwright.knowledge.trees import FeatureTree
from gaitwright.learning.live import LiveLessons, Seen, Tried
from gaitwright.learning.live_sources import Running
from gaitwright.learning.notes import pupil_of
from gaitwright.learning.said_action import Words, said_action
from gaitwright.learning.teacher import Shown
from gaitwright.skillbook.writer import Ledger
from gaitwright.skills.book_trees import in_trees_of
from gaitwright.skills.library import speed_scale
from gaitwright.skills.what_if import what_if
from gaitwright.studio import messages as m
from gaitwright.studio.live_run import LiveRun

HISTORY = 20
"""So many of the last moves of a rule's marks are shown, and as many lessons."""
MOMENTS = 600
"""So many of the last moments of a run are looked at by a lesson that is tried."""


class TeachingDesk:
    """A person's lessons to the pupil of a book, while a mission runs. `say` is told of the rules."""

    run: LiveRun

    def __init__(self, ledger: Ledger, say: Callable[[dict[str, Any]], None]) -> None:
        self.live, self.say = LiveLessons(ledger, pupil_of(ledger.book)), say
        self.open: Tried | None = None
        """What was tried and waits to be kept."""
        self.is_proposed = False
        """Whether everybody was told of it."""
        self.does: dict[type[m.Message], Callable[[Any], dict[str, Any] | None]] = {
            m.Right: self.right, m.Ok: self.ok, m.Keep: self.keep, m.Back: self.back,
            m.Forget: self.forget, m.Order: self.order, m.Why: self.why,
        }  # fmt: skip

    def attend(self, run: LiveRun) -> None:
        """From now on it is about this run."""
        self.run = run
        self.live.seen = []
        self.settle()

    @property
    def rulebook(self) -> Rulebook:
        return self.live.ledger.book.rulebook

    @property
    def source(self) -> Running:
        """What is taught at."""
        return self.run.lesson

    def warm_up(self) -> None:
        """Learns nothing; but what is compiled at a first lesson is compiled now."""
        self.live.confirmation(self.source.here(), self.run.robot, self.source.name)

    def look(self) -> None:
        """Notes this moment, as one that a lesson is tried on."""
        self.live.seen.append(self.source.here())
        del self.live.seen[:-MOMENTS]

    # --- what is asked ------------------------------------------------------------------------------
    def right(self, said: m.Right) -> dict[str, Any]:
        """What it would do to be told what is right now. Raises `WrongUse` for what cannot be said."""
        pupil = self.live.pupil
        speed = None if said.speed is None else 2 * (said.speed / speed_scale(self.run.robot),)
        action = said_action(Words(said.skill, speed), self.run.robot, pupil.actions)
        if said.about and said.about not in pupil.vocabulary.names:
            raise unknown("number", said.about, pupil.vocabulary.names)
        return self.tried(self.source.here(), Shown(said.name, action, about=said.about))

    def propose(self, shown: dict[str, Any]) -> None:
        """Tells everybody what a lesson would do that a person gave by doing it; it waits for her word."""
        self.is_proposed = True
        self.say({"say": "tried", "proposed": True, **shown})

    def settle(self) -> None:
        """Nothing waits any more."""
        self.open = None
        if self.is_proposed:
            self.is_proposed = False
            self.say({"say": "tried", "proposed": False})

    def order(self, said: m.Order) -> dict[str, Any]:
        """What it would do to have one rule before another where both could fire: a lesson at the last moment
        seen at which the other one did. Raises `WrongUse` where there was none."""
        book = self.rulebook
        wanted, before = book[said.rule], book[said.before].name
        for seen in reversed([*self.live.seen, self.source.here()]):
            situation = in_trees_of(book, seen.moment.situation, seen.moment.facts)
            if consult(book, situation).rule == before and not outside(book.forest, wanted, situation):
                return self.tried(seen, Shown(said.rule, wanted.action))
        raise WrongUse(
            f"nowhere on this run did {before} fire where {said.rule} could too: that teaches no order"
        )

    def tried(self, seen: Seen, shown: Shown) -> dict[str, Any]:
        """What a lesson would do; it waits to be kept."""
        self.settle()
        self.open = self.live.correction(seen, shown, self.source.name)
        return tried_shown(self.open)

    def ok(self, said: m.Ok) -> dict[str, Any]:
        """What it does now is right: learned at once."""
        self.settle()
        self.open = self.live.confirmation(self.source.here(), self.run.robot, self.source.name)
        return self.keep(m.Keep())

    def keep(self, said: m.Keep) -> dict[str, Any]:
        """Learns what was tried, and drives by it."""
        if self.open is None:
            raise WrongUse("there is nothing to keep: say what is right first")
        tried = self.open
        if said.lesson not in ("", tried.told.id):
            raise WrongUse(f"what waits to be kept is {tried.told.id} by now, not {said.lesson}")
        self.settle()
        self.live.keep(tried)
        self.run.note("lesson", f"{tried.told.id}: {sentence_of(tried)}")
        return self.learned(tried.told.id)

    def back(self, said: m.Back) -> None:
        """What was tried is not learned."""
        self.settle()

    def forget(self, said: m.Forget) -> dict[str, Any]:
        """Takes a lesson back, the last one where none is named."""
        name, _ = self.live.forget(said.lesson)
        self.settle()
        self.run.note("lesson", f"{name} is taken back")
        return self.learned(name)

    def learned(self, lesson: str) -> dict[str, Any]:
        """Rules choose the skills, by what was learned just now."""
        self.run.let_choose()
        self.say_rules()
        return {"lesson": lesson}

    # --- shown --------------------------------------------------------------------------------------
    def why(self, said: m.Why) -> dict[str, Any]:
        """Why it does what it does, or why a rule does not fire; what would have to be different for that
        rule to fire, or any other; and the situation that all this is about. In `brief` this alone, and what
        fires."""
        book, moment = self.rulebook, self.source.here().moment
        situation = in_trees_of(book, moment.situation, moment.facts)
        decision = consult(book, situation)
        known = {tree: situation[tree] for tree in book.forest.names}
        brief = {"situation": known, "fires": decision.rule or ""}
        if said.brief:
            return {"sentences": [], "different": "", **brief}
        why = [self.run.session.mind.call.because, because(book, decision)]
        other = "" if said.rule == decision.rule else said.rule
        return {
            "sentences": [why_not(book, said.rule, situation)] if said.rule else why,
            "different": what_if(book, moment.facts, other).sentence if book.rules else "",
            **brief,
        }

    def say_rules(self) -> None:
        """The rules in their order, the trees they go by, and the last lessons."""
        book = self.rulebook
        self.say(
            {
                "say": "rules",
                "trees": [tree_shown(tree) for tree in book.forest.trees],
                "rules": [rule_shown(book, rule) for rule in book.rules],
                "lessons": [
                    {"id": told.id, "rule": told.rule, "given": told.given, "about": told.about}
                    for told in self.live.pupil.told[::-1][:HISTORY]
                ],
                "numbers": list(self.live.pupil.vocabulary.names),
            }
        )


def tried_shown(tried: Tried) -> dict[str, Any]:
    """What a lesson would do."""
    return {
        "lesson": tried.told.id,
        "sentence": sentence_of(tried),
        "moves": [event.why for event in tried.taken.events][:HISTORY],
        "followed": tried.is_followed,
        "stretches": [stretch.sentence for stretch in tried.stretches][:HISTORY],
        "broken": [told.id for told in tried.broken],
        "mended": [told.id for told in tried.mended],
    }


def sentence_of(tried: Tried) -> str:
    """What a lesson says."""
    return f"{said_of(tried.told.action)} is right here"


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
