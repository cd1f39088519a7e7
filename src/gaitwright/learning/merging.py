"""Two skillbooks that went apart, made one: what theirs was told since is told to our pupil."""

from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import takewhile

from gaitwright.errors import WrongUse
from gaitwright.knowledge.memory import Action, said_of
from gaitwright.knowledge.told import Told
from gaitwright.knowledge.trust import History
from gaitwright.learning.map_books import maps_of_both
from gaitwright.learning.notes import pupil_of, with_steps
from gaitwright.learning.older_books import told_by
from gaitwright.learning.skill_pupil import SkillPupil
from gaitwright.skillbook.book import Skillbook, content_hash
from gaitwright.skillbook.history import (
    Ancestor,
    Step,
    all_told,
    forgotten,
    free_name,
    names_told,
    that_count,
)
from gaitwright.skillbook.operator_notes import OperatorNotes
from gaitwright.skillbook.profile_notes import ProfileNotes, name_of


@dataclass(frozen=True, slots=True)
class Conflict:
    """What the joined book does not do as a book was told: `rule` as that one's teacher calls it, `ours` and
    `theirs` the names of the lessons that speak of it, in their own books."""

    rule: str
    ours: tuple[str, ...]
    theirs: tuple[str, ...]
    sentence: str


@dataclass(frozen=True, slots=True)
class Merged:
    """The joined book, and every sentence on what it does not do as one of the two was told."""

    book: Skillbook
    conflicts: tuple[Conflict, ...] = ()


def merge(ours: Skillbook, theirs: Skillbook, base: Skillbook | None = None) -> Merged:
    """Our book with what theirs was told since they went apart, and without what theirs forgot.

    Where both were told different things at the very same moment ours stays. Whatever either was told since
    then and does by itself, the joined book does too, or a conflict says what it does instead. `base` is the
    book that both come from; it is found without being named, and checked where it is. Of each skill the
    torque profiles are ours, or theirs where ours has none; what was lived through with them comes with
    them, from both where both have the same. Their terrain operators of other names come behind ours. Of a
    place of which both have a map the joined book knows what either does. Raises `WrongUse` where `base` is
    no such book, or for a book whose rules rest on no lessons that can be told.
    """
    merged = told_both(ours, theirs, base)
    profiles, trust = profiles_of_both(ours, theirs), trust_of_both(ours, theirs)
    operators, maps = operators_of_both(ours, theirs), maps_of_both(ours.maps, theirs.maps)
    news = {"profiles": profiles, "trust": trust, "operators": operators, "maps": maps}
    if all(some == getattr(ours, what) for what, some in news.items()):
        return merged
    ancestors = with_ancestor(merged.book.ancestors, theirs)
    return replace(merged, book=replace(merged.book, **news, ancestors=ancestors))


def told_both(ours: Skillbook, theirs: Skillbook, base: Skillbook | None) -> Merged:
    """Our book with theirs, but for its profiles."""
    both = shared_steps(ours, theirs)
    if base is not None and shared_steps(base, ours) + shared_steps(base, theirs) < 2 * len(base.steps):
        raise WrongUse(f"the books do not both go on from {base.name!r}")
    if both == len(theirs.steps):
        return Merged(ours)
    if both == len(ours.steps):  # nothing was told to ours since: theirs goes on from it
        went_on = replace(ours, rulebook=theirs.rulebook, steps=theirs.steps, pupil=theirs.pupil)
        return Merged(replace(went_on, ancestors=with_ancestor(ours.ancestors, theirs)))
    joining = Joining(ours, theirs)
    if not joining.news:
        return Merged(ours)
    merged = joining.joined()
    if not joining.steps:
        return Merged(ours, merged.conflicts)
    ancestors = with_ancestor(with_ancestor(ours.ancestors, ours), theirs)
    return Merged(replace(merged.book, ancestors=ancestors), merged.conflicts)


class Joining:
    """Two books on their way to one: our pupil hears what theirs was told, step by step."""

    def __init__(self, ours: Skillbook, theirs: Skillbook) -> None:
        self.ours, self.theirs = told_again(ours), told_again(theirs)
        self.shared = shared_steps(self.ours, self.theirs)
        self.our_name = f"{ours.name} (ours)" if ours.name else "our book"
        self.their_name = (
            theirs.name if theirs.name not in ("", ours.name) else f"the other {theirs.name or 'book'}"
        )
        self.mine, self.other = (told_since(book, self.shared) for book in (self.ours, self.theirs))
        self.at = {moment_of(told): told for told in self.mine}
        """What ours was told last at each moment, since they went apart."""
        self.steps: list[Step] = []
        """What is added to ours."""
        self.taken = names_told(self.ours.steps)
        self.opposed: dict[str, Conflict] = {}
        """By the names, in theirs, of lessons that ours was told otherwise."""
        self.news = self.found_news()

    def found_news(self) -> list[Step]:
        """The steps of theirs that ours has not been through: told and still counting there, or forgotten of
        what both were told."""
        gone, ours_gone = forgotten(self.theirs.steps), forgotten(self.ours.steps)
        both = names_told(self.ours.steps[: self.shared]) - ours_gone
        known = {key_of(told) for told in that_count(self.ours.steps) if told.id not in gone & both}
        return [
            step
            for step in self.theirs.steps[self.shared :]
            if (step.told is not None and step.told.id not in gone and key_of(step.told) not in known)
            or (step.how == "forgotten" and step.note in both)
        ]

    def joined(self) -> Merged:
        """The joined book, without steps of its own where all that is new stands against what ours was
        told."""
        pupil = pupil_of(self.ours)
        mine, other = followed(pupil, self.mine), followed(pupil_of(self.theirs), self.other)
        for step in self.news:
            self.take(pupil, step)
        known = {key_of(told) for told in mine}
        other = [told for told in other if told.id not in self.opposed and key_of(told) not in known]
        conflicts = (*self.opposed.values(), *self.lost(pupil, mine, True), *self.lost(pupil, other, False))
        return Merged(with_steps(self.ours, pupil, self.steps), conflicts)

    def take(self, pupil: SkillPupil, step: Step) -> None:
        """Takes one of their steps, unless ours was told otherwise at the very same moment."""
        told = step.told
        if told is None:
            self.steps.append(replace(step, events=pupil.forget(step.note)))
            return
        other = self.at.get(moment_of(told))
        if other is not None and other.action != told.action:
            self.opposed[told.id] = self.opposition(other, told)
            return
        if told.id in self.taken:
            told = replace(told, id=free_name(f"{told.id} of {self.their_name}", self.taken))
        self.taken.add(told.id)
        self.steps.append(Step("told", told=told, events=pupil.hear(told).events))

    def opposition(self, mine: Told, other: Told) -> Conflict:
        """That both were told different things at the very same moment."""
        ours, theirs = mine.rule, other.rule
        if ours == theirs:
            ours, theirs = said_of(mine.action), said_of(other.action)
        sentence = (
            f"at one and the same moment {mine.id} of {self.our_name} teaches {ours} and {other.id} of "
            f"{self.their_name} {theirs}: ours stays"
        )
        return Conflict(other.rule, (mine.id,), (other.id,), sentence)

    def lost(self, pupil: SkillPupil, lessons: Sequence[Told], of_ours: bool) -> Iterator[Conflict]:
        """A conflict for each of some lessons that the joined pupil does not follow."""
        book = self.our_name if of_ours else self.their_name
        for told, action in zip(lessons, decided(pupil, lessons), strict=True):
            if action is not None and action != pupil.learned(told.action):
                instead = action.skill if action.skill != told.action.skill else said_of(action)
                sentence = (
                    f"{told.id} of {book} teaches {told.rule}, and the joined book does {instead} there"
                )
                names = ((told.id,), ()) if of_ours else ((), (told.id,))
                yield Conflict(told.rule, *names, sentence)


def told_again(book: Skillbook) -> Skillbook:
    """An older book with its lessons told again, for a pupil to hear. Raises `WrongUse` where its rules rest
    on no lessons that can be told."""
    if all_told(book.steps):
        return book
    told = told_by(book)
    if book.rulebook.rules and not told:
        raise WrongUse(
            f"the rules of {book.name or 'a book without a name'} rest on no lessons with measurements: "
            "nobody can be told them, so it cannot be joined with another"
        )
    rulebook = replace(book.rulebook, lessons=book.rulebook.lessons + len(told))
    return replace(book, steps=(*book.steps, *(Step("told", told=one) for one in told)), rulebook=rulebook)


# --- lessons ---------------------------------------------------------------------------------------
def told_since(book: Skillbook, shared: int) -> list[Told]:
    """What a book was told after its first steps, and has not forgotten."""
    gone = forgotten(book.steps)
    return [told for told in all_told(book.steps[shared:]) if told.id not in gone]


def moment_of(told: Told) -> Hashable:
    """All that was measured at a lesson's moment."""
    return frozenset(told.facts.items())


def key_of(told: Told) -> Hashable:
    """What a lesson teaches, whatever it is called."""
    return moment_of(told), told.action, told.about


def followed(pupil: SkillPupil, lessons: Sequence[Told]) -> list[Told]:
    """Those of some lessons at whose moments a pupil does what they say."""
    done = decided(pupil, lessons)
    return [told for told, action in zip(lessons, done, strict=True) if action == pupil.learned(told.action)]


def decided(pupil: SkillPupil, lessons: Sequence[Told]) -> list[Action | None]:
    """What a pupil does at the moments of some lessons; `None` before her first one."""
    return [choice.action for choice in pupil.choose_at([told.facts for told in lessons])]


# --- books -----------------------------------------------------------------------------------------
def shared_steps(a: Skillbook, b: Skillbook) -> int:
    """How many steps both begin with."""
    count = 0
    for mine, other in zip(a.steps, b.steps, strict=False):
        if mine != other:
            break
        count += 1
    return count


def profiles_of_both(ours: Skillbook, theirs: Skillbook) -> tuple[ProfileNotes, ...]:
    """Our torque profiles, and theirs of the skills that ours has none of, where both are of one robot."""
    if ours.robot != theirs.robot:
        return ours.profiles
    known = {profile.skill for profile in ours.profiles}
    others = [profile for profile in theirs.profiles if profile.skill not in known]
    return tuple(sorted((*ours.profiles, *others), key=name_of))


def trust_of_both(ours: Skillbook, theirs: Skillbook) -> History:
    """Our history of trust, and what theirs went through since with profiles that the joined book has too."""
    if ours.robot != theirs.robot:
        return ours.trust
    mine, others = (by_skill(book) for book in (ours, theirs))
    shared = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(ours.trust, theirs.trust)))  # noqa: B905
    known = list(ours.trust[shared:])
    news = []
    for entry in theirs.trust[shared:]:
        if entry in known:  # joined before
            known.remove(entry)
        elif mine.get(entry.skill) in (None, others.get(entry.skill)):
            news.append(entry)
    return (*ours.trust, *news)


def by_skill(book: Skillbook) -> dict[str, set[ProfileNotes]]:
    """The torque profiles of each skill."""
    found: dict[str, set[ProfileNotes]] = {}
    for profile in book.profiles:
        found.setdefault(profile.skill, set()).add(profile)
    return found


def operators_of_both(ours: Skillbook, theirs: Skillbook) -> tuple[OperatorNotes, ...]:
    """Our terrain operators, and behind them theirs of other names, where both are of one robot."""
    if ours.robot != theirs.robot:
        return ours.operators
    known = {operator.name for operator in ours.operators}
    return (*ours.operators, *(operator for operator in theirs.operators if operator.name not in known))


def with_ancestor(ancestors: tuple[Ancestor, ...], book: Skillbook) -> tuple[Ancestor, ...]:
    """The lineage with one more book, and with those that it came from."""
    met = Ancestor("merged", book.name, content_hash(book))
    return tuple(dict.fromkeys((*ancestors, *book.ancestors, met)))
