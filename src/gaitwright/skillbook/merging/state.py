"""Our book on its way to the joined one: their lessons taught to it, and what stands against them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from gaitwright.knowledge.correction import teach
from gaitwright.knowledge.forest import Situation
from gaitwright.knowledge.memory import Action
from gaitwright.knowledge.modifier import Inconsistency, Lesson, learn, values_text
from gaitwright.knowledge.repair import mend
from gaitwright.knowledge.rules import Event, Rulebook
from gaitwright.knowledge.widen import widened
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.history import How, Step
from gaitwright.skillbook.merging.translate import differing, lesson_over

TRIES = 10
"""So often a lesson is mended and taught again before it counts as a contradiction."""


@dataclass(frozen=True)
class Conflict:
    """What the joined book does not do as a book taught it: `trees` are those in which the situations of the
    lessons differ (none: they are the same), `ours` and `theirs` the ids of lessons that contradict."""

    rule: str
    trees: tuple[str, ...]
    ours: tuple[str, ...]
    theirs: tuple[str, ...]
    sentence: str


class Joining:
    """`rulebook`, `steps` and `conflicts` so far; `given_up` are ids of lessons that conflicts report."""

    def __init__(self, ours: Skillbook, theirs: Skillbook, shared: int) -> None:
        self.ours, self.theirs, self.shared = ours, theirs, shared
        self.rulebook, self.steps = ours.rulebook, list(ours.steps)
        self.conflicts: list[Conflict] = []
        self.given_up: set[str] = set()
        self.their_name = theirs.name if theirs.name != ours.name else f"the other {theirs.name or 'book'}"
        self.our_ids = {step.lesson.id for step in ours.steps if step.lesson}
        self.renamed: dict[str, str] = {}

    def has(self, rule: str) -> bool:
        return any(known.name == rule for known in self.rulebook.rules)

    def report(self, conflict: Conflict) -> None:
        self.conflicts.append(conflict)

    def prepare(self) -> None:
        """Our trees and those that only they have; names that mean two things."""
        for tree in differing(self.rulebook.forest, self.theirs.rulebook.forest):
            our, their = (book.rulebook.forest[tree] for book in (self.ours, self.theirs))
            sentence = (
                f"{tree} is {' or '.join(our.leaves)} in our book and {' or '.join(their.leaves)} in "
                f"{self.their_name}: ours stays, and what theirs knows by other values is reported"
            )
            self.report(Conflict("", (tree,), (), (), sentence))
        wider = widened(self.rulebook, self.theirs.rulebook.forest.trees)
        if wider is not self.rulebook:
            new = ", ".join(wider.forest.names[len(self.rulebook.forest.names) :])
            self.edit(wider, f"{new}: known in {self.their_name}")
        actions = {rule.name: rule.action for rule in self.rulebook.rules}
        for rule in self.theirs.rulebook.rules:
            if actions.get(rule.name, rule.action) != rule.action:
                new = self.renamed[rule.name] = self._free(f"{rule.name} of {self.their_name}")
                sentence = f"{rule.name} does different things in the two books: theirs is called {new} now"
                self.report(Conflict(rule.name, (), (), (), sentence))

    def take(self, step: Step, given: Lesson) -> None:
        """Takes in one of their lessons, unless ours teaches otherwise."""
        lesson = self.restated(given)
        if isinstance(lesson, str):
            self.report(Conflict(given.rule, (), (), (given.id,), lesson))
        elif step.how == "learned" or not self._opposed(lesson):
            self.teach(lesson, "learned" if step.how == "learned" else "taught")

    def restated(self, lesson: Lesson, theirs: bool = True) -> Lesson | str:
        """A lesson over the joined forest, under a name of its own, with the action it means; or why not."""
        stated = lesson_over(self.rulebook.forest, lesson)
        if isinstance(stated, str):
            return f"{lesson.id} of {self.their_name} has a value in {stated} that is not known here"
        named = replace(stated, action=action_of((self.theirs if theirs else self.ours).rulebook, lesson))
        if not theirs:
            return named
        if named.action is None and not self.has(lesson.rule):
            return f"{lesson.id} of {self.their_name} is about {lesson.rule}, and nothing says what that does"
        name = lesson.id if lesson.id not in self.our_ids else f"{lesson.id} of {self.their_name}"
        return replace(named, id=name, rule=self.renamed.get(lesson.rule, lesson.rule))

    def teach(self, lesson: Lesson, how: How, again: bool = False) -> None:
        """Teaches until nothing contradicts, mending what does; else that is a conflict, unless it is only
        taught again."""
        trouble = None
        for _ in range(TRIES):
            learned = (learn if how == "learned" else teach)(self.rulebook, lesson)
            trouble = learned.trouble
            self.step(Step(how, lesson, None, trouble.sentence if trouble else ""), learned.rulebook)
            if trouble is None:
                return
            mended = mend(self.rulebook, trouble, lesson.blame)
            self.step(Step("mended", lesson, None, mended.sentence), mended.rulebook)
            if mended.how == "none":
                break
            if how == "learned":  # what is mended is learned
                return
        if trouble is not None and not again:
            self.report(self._contradicted(lesson, trouble))
            self.given_up.add(lesson.id)

    def edit(self, rulebook: Rulebook, note: str, events: tuple[Event, ...] = ()) -> None:
        """One more step that holds a whole rulebook, with events that the rulebook does not have yet."""
        full = replace(rulebook, events=(*rulebook.events, *events))
        self.step(Step("edited", None, replace(full, events=()), note), full)

    def step(self, step: Step, rulebook: Rulebook) -> None:
        events = rulebook.events[len(self.rulebook.events) :]
        self.steps.append(replace(step, events=events))
        self.rulebook = rulebook

    def sides(self, ids: Sequence[str]) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """Ids of lessons: ours, and theirs."""
        return (
            tuple(name for name in ids if name in self.our_ids),
            tuple(name for name in ids if name not in self.our_ids),
        )

    def _opposed(self, lesson: Lesson) -> bool:
        """Whether our book was taught something else in the very same situation, since they went apart."""
        for step in reversed(self.ours.steps[self.shared :]):
            other = self.restated(step.lesson, False) if step.lesson and step.how == "taught" else ""
            if isinstance(other, str) or other.situation != lesson.situation:
                continue
            if other.action == lesson.action:
                return False
            where = values_text(self.rulebook.forest, lesson.situation)
            sentence = (
                f"where {where}, {other.id} of ours teaches {other.rule} and {lesson.id} of "
                f"{self.their_name} {lesson.rule}: ours stays"
            )
            self.report(Conflict(lesson.rule, (), (other.id,), (lesson.id,), sentence))
            self.given_up.add(lesson.id)
            return True
        return False

    def _contradicted(self, lesson: Lesson, trouble: Inconsistency) -> Conflict:
        against = tuple(instance.id for instance in trouble.inside)
        trees = apart(lesson.situation, [instance.situation for instance in trouble.inside])
        sentence = f"{lesson.id} cannot be learned beside {', '.join(against)}: {trouble.sentence}"
        return Conflict(trouble.rule, trees, *self.sides((lesson.id, *against)), sentence)

    def _free(self, name: str) -> str:
        taken = {rule.name for rule in (*self.rulebook.rules, *self.theirs.rulebook.rules)}
        while name in taken:
            name += " (2)"
        return name


def action_of(rulebook: Rulebook, lesson: Lesson) -> Action | None:
    """What a lesson's rule does: as the book has it, or as the lesson says."""
    return next((rule.action for rule in rulebook.rules if rule.name == lesson.rule), lesson.action)


def apart(situation: Situation, others: Sequence[Situation]) -> tuple[str, ...]:
    """The trees in which a situation differs from any of others in the same forest."""
    return tuple(tree for tree, value in situation.items() if any(other[tree] != value for other in others))
