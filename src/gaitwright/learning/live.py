"""Teaching by a person, in the middle of a mission or over a recording: say what is right, look, keep it.

The one door for whoever talks with the person: a terminal, or a page.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from gaitwright.errors import WrongUse
from gaitwright.knowledge.memory import Action, said_of
from gaitwright.knowledge.rules import Event
from gaitwright.knowledge.told import Told
from gaitwright.learning.decision_point import DecisionPoint
from gaitwright.learning.notes import forget, settle
from gaitwright.learning.said_action import Words, said_action
from gaitwright.learning.skill_pupil import Choice, SkillPupil, Taken, told_at
from gaitwright.learning.teacher import Shown
from gaitwright.model.robot import Robot
from gaitwright.skillbook.history import free_name, names_told
from gaitwright.skillbook.writer import Ledger


@dataclass(frozen=True, slots=True)
class Seen:
    """A moment that the person could look at: when it was [s], and the skill in use."""

    time: float
    moment: DecisionPoint
    skill: str


@dataclass(frozen=True, slots=True)
class Stretch:
    """From when to when [s] something else is decided than before."""

    begin: float
    end: float
    before: Action | None
    after: Action | None

    @property
    def sentence(self) -> str:
        """When, and what instead of what."""
        when = f"{self.begin:.1f} s" if self.begin == self.end else f"{self.begin:.1f} to {self.end:.1f} s"
        old, new = ("nothing" if a is None else said_of(a) for a in (self.before, self.after))
        return f"{when}: {new} instead of {old}"


@dataclass(frozen=True, slots=True)
class Tried:
    """What a lesson would do, tried on a copy of the pupil: nothing is learned until it is kept."""

    told: Told
    pupil: SkillPupil
    taken: Taken
    is_followed: bool
    """Whether she then does what she was told."""
    stretches: tuple[Stretch, ...]
    """Where the rules decide differently over what was seen."""
    broken: tuple[Told, ...]
    """Earlier lessons that were followed and are not any more."""
    mended: tuple[Told, ...]
    """Earlier lessons that were not followed and are now."""


@dataclass
class LiveLessons:
    """A person's lessons to the pupil of a book, each durable once it is kept."""

    ledger: Ledger
    pupil: SkillPupil
    seen: list[Seen] = field(default_factory=list)

    def tried(self, told: Told) -> Tried:
        """What a lesson would do. Raises `WrongUse` where one of that name counts already; one that was
        forgotten keeps its name, and this gets another."""
        if told.id in {one.id for one in self.pupil.told}:
            raise WrongUse(f"{told.id} was taught before: `forget` it first, or go on a little")
        told = replace(told, id=self.unused(told.id))
        before, after = self.pupil, self.pupil.copied()
        taken = after.hear(told)
        moments = [seen.moment for seen in self.seen]
        was, now = (pupil.choose_all(moments) for pupil in (before, after))
        old, new = before.pupil.standing.right, after.pupil.standing.right
        return Tried(
            told,
            after,
            taken,
            bool(new[-1]),
            tuple(stretches(self.seen, was, now)),
            tuple(before.told[k] for k in range(len(old)) if old[k] and not new[k]),
            tuple(before.told[k] for k in range(len(old)) if new[k] and not old[k]),
        )

    def correction(self, seen: Seen, right: Shown, source: str) -> Tried:
        """What it would do to be told what is right at a moment; `source` says where that was."""
        pupil = self.pupil
        name = right.rule or pupil.name_of(right.action)
        is_right = pupil.choose(seen.moment).action == pupil.learned(right.action)
        given = "confirmed" if is_right else "corrected"
        return self.tried(told_at(seen.moment, replace(right, rule=name), source, given))

    def confirmation(self, seen: Seen, robot: Robot, source: str) -> Tried:
        """What it would do to be told that what is done at a moment is right."""
        action = self.pupil.choose(seen.moment).action
        if action is None or action.skill != seen.skill:
            action = said_action(Words(seen.skill), robot, self.pupil.actions)
        return self.correction(seen, Shown("", action), source)

    def keep(self, tried: Tried) -> None:
        """Learns it: lesson, rules and notes are in the book when this returns."""
        self.ledger.tell(tried.told, tried.taken.events)
        self.pupil = tried.pupil
        settle(self.ledger, self.pupil)

    def forget(self, name: str = "") -> tuple[str, tuple[Event, ...]]:
        """Takes back what was told under a name, else the last that counts; its name and what that moved.

        Raises `WrongUse` where there is none.
        """
        if not name and not self.pupil.told:
            raise WrongUse("nothing was taught yet that could be taken back")
        name = name or self.pupil.told[-1].id
        after = self.pupil.copied()
        events = forget(self.ledger, after, name)
        self.pupil = after
        return name, events

    def unused(self, name: str) -> str:
        """A name for a lesson that none in the book has yet."""
        return free_name(name, names_told(self.ledger.book.steps))


def stretches(seen: Sequence[Seen], was: Sequence[Choice], now: Sequence[Choice]) -> list[Stretch]:
    """Where two pupils decide differently, moments in a row taken together."""
    found: list[Stretch] = []
    open_ = False
    for one, old, new in zip(seen, was, now, strict=True):
        if old.action == new.action:
            open_ = False
            continue
        last = found[-1] if found and open_ else None
        if last is not None and (last.before, last.after) == (old.action, new.action):
            found[-1] = Stretch(last.begin, one.time, last.before, last.after)
        else:
            found.append(Stretch(one.time, one.time, old.action, new.action))
        open_ = True
    return found
