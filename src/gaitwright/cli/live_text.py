"""What a person says in a lesson, and what she is told of it."""

from gaitwright.cli.console import show_prose
from gaitwright.errors import WrongUse
from gaitwright.knowledge.memory import said_of
from gaitwright.knowledge.rules import Event
from gaitwright.knowledge.sentences import counted
from gaitwright.knowledge.told import Told
from gaitwright.learning.live import Seen, Tried
from gaitwright.learning.said_action import Words

FEW = 3
"""So many lessons and stretches are named."""
CLAUSES = {"because": "about", "as": "name", "until": "until", "note": "notes", "drop": "drops"}
"""Words that may follow a skill, and what they say; notes more than once."""
CLAUSES_SAID = "because NUMBER, as NAME, note NAME, drop NAME, or until 'TREE is VALUE'"


class Said:
    """What stands behind `right`: a skill, its speeds, and what else a person cares to say. Raises `WrongUse`
    for words that make no sense."""

    def __init__(self, words: list[str]) -> None:
        if not words:
            raise WrongUse("right is which skill? e.g. right walk")
        self.skill, rest = words[0], words[1:]
        self.speed: tuple[float, float] | None = None
        self.about = self.name = self.until = ""
        self.notes: tuple[str, ...] = ()
        self.drops: tuple[str, ...] = ()
        if rest and rest[0] not in CLAUSES:
            fastest = number(rest[1], "right") if len(rest) > 1 and rest[1][:1].isdigit() else None
            slowest = number(rest[0], "right")
            self.speed = slowest, slowest if fastest is None else fastest
            rest = rest[1 if fastest is None else 2 :]
        while rest:
            word, value = rest[0], []
            for value_word in rest[1:]:
                if value_word in CLAUSES:
                    break
                value.append(value_word)
            if word not in CLAUSES or not value:
                raise WrongUse(f"{' '.join(rest)!r}: write {CLAUSES_SAID}")
            said, before = " ".join(value), getattr(self, CLAUSES[word])
            setattr(self, CLAUSES[word], (*before, said) if isinstance(before, tuple) else said)
            rest = rest[1 + len(value) :]

    @property
    def words(self) -> Words:
        """What is said of the action."""
        return Words(self.skill, self.speed, self.until, self.notes, self.drops)


def number(word: str, of: str) -> float:
    """A number that was typed. Raises `WrongUse` for what is none, or not finite and positive."""
    try:
        value = float(word)
    except ValueError:
        raise WrongUse(f"{of} {word}: a number is wanted") from None
    if not 0.0 <= value < 1e6:
        raise WrongUse(f"{of} {word}: a number from 0 on is wanted")
    return value


# --- in words --------------------------------------------------------------------------------------
def tell_tried(tried: Tried, seen: Seen) -> None:
    """What a lesson would do, before it is kept."""
    told = tried.told
    reason = f", because of {told.about} ({fact_text(told)})" if told.about else ""
    show_prose(f"At {seen.time:.2f} s {said_of(told.action)} is right{reason}.")
    if not tried.is_followed:
        show_prose("She would set that aside: it contradicts too much of what was taught.", 2)
    tell_events(tried.taken.events)
    if tried.stretches:
        show_prose("Over what you have seen here:", 2)
        for stretch in tried.stretches[:FEW]:
            show_prose(stretch.sentence, 4)
        if len(tried.stretches) > FEW:
            show_prose(f"and {len(tried.stretches) - FEW} more", 4)
    for what, some in (("not followed any more", tried.broken), ("followed now", tried.mended)):
        if some:
            names = ", ".join(one.id for one in some[:FEW])
            show_prose(f"{counted(len(some), 'earlier lesson')} {what}: {names}", 2)
    if not tried.broken:
        show_prose("No earlier lesson breaks.", 2)
    show_prose("`keep` it, or `back`?")


def tell_events(events: tuple[Event, ...]) -> None:
    """What moved, rule by rule."""
    for event in events:
        show_prose(f"{event.why}.", 2)


def fact_text(told: Told) -> str:
    """The number that decided, as it was."""
    fact = told.facts.get(told.about)
    return "not measured" if fact is None else fact if isinstance(fact, str) else f"{fact:.3g}"
