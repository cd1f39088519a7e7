"""Two books that went apart, made one: what they teach alike is joined, what they contradict is reported."""

from dataclasses import dataclass, replace

from gaitwright.errors import WrongUse
from gaitwright.skillbook.book import Skillbook, content_hash
from gaitwright.skillbook.entries import encoded, step_entry
from gaitwright.skillbook.history import Ancestor, Step, replayed
from gaitwright.skillbook.merging.check import settle
from gaitwright.skillbook.merging.edits import take_edit
from gaitwright.skillbook.merging.state import Conflict, Joining


@dataclass(frozen=True)
class Merged:
    """The joined book, and everything of theirs or ours that it does not do."""

    book: Skillbook
    conflicts: tuple[Conflict, ...] = ()


def merge(ours: Skillbook, theirs: Skillbook, base: Skillbook | None = None) -> Merged:
    """Our book with what theirs was taught since they went apart: their lessons are taught to it again.

    Whatever either was taught since then, and decides by itself, the joined book decides so too, or a
    conflict says why not; where both were taught different things in the very same situation ours stays.
    `base` is the book that both come from; it is found without being named, and checked where it is. Raises
    `WrongUse` where it is no such book.
    """
    shared = _shared(ours, theirs)
    if base is not None and _shared(base, ours) + _shared(base, theirs) < 2 * len(base.steps):
        raise WrongUse(f"the books do not both go on from {base.name!r}")
    known = {_key(step) for step in ours.steps[shared:]}
    news = [
        (place, step)
        for place, step in enumerate(theirs.steps)
        if place >= shared and step.how != "mended" and _key(step) not in known
    ]
    if not news:
        return Merged(ours)
    if shared == len(ours.steps):  # nothing was taught to ours since: theirs goes on from it
        ancestors = _with_ancestor(ours.ancestors, theirs)
        return Merged(replace(ours, rulebook=theirs.rulebook, steps=theirs.steps, ancestors=ancestors))
    joining = Joining(ours, theirs, shared)
    joining.prepare()
    for place, step in news:
        if step.rulebook is not None:
            take_edit(joining, replayed(theirs.steps[:place]) if place else None, step.rulebook)
        elif step.lesson is not None:
            joining.take(step, step.lesson)
    settle(joining)
    ancestors = _with_ancestor(_with_ancestor(ours.ancestors, ours), theirs)
    book = replace(ours, rulebook=joining.rulebook, steps=tuple(joining.steps), ancestors=ancestors)
    return Merged(book, tuple(dict.fromkeys(joining.conflicts)))


def _shared(a: Skillbook, b: Skillbook) -> int:
    """How many steps both begin with."""
    count = 0
    for mine, other in zip(a.steps, b.steps, strict=False):
        if mine != other:
            break
        count += 1
    return count


def _key(step: Step) -> str:
    """What a step teaches, without what it is called and what it moved."""
    lesson = step.lesson and replace(step.lesson, id="")
    return encoded(step_entry(replace(step, lesson=lesson, note="", events=())))


def _with_ancestor(ancestors: tuple[Ancestor, ...], book: Skillbook) -> tuple[Ancestor, ...]:
    """The lineage with one more book, and with those that it came from."""
    met = Ancestor("merged", book.name, content_hash(book))
    return tuple(dict.fromkeys((*ancestors, *book.ancestors, met)))
