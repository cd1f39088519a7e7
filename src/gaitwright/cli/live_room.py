"""A lesson in a terminal: the words that a person may say, and what each does."""

import shlex
from collections.abc import Callable

from gaitwright.cli.console import remark, show_pairs, show_prose
from gaitwright.cli.live_text import Said, number, tell_events, tell_tried
from gaitwright.errors import BadFile, GaitwrightError, WrongUse, unknown
from gaitwright.knowledge.consult import consult
from gaitwright.knowledge.explain import why_not
from gaitwright.knowledge.memory import said_of
from gaitwright.knowledge.sentences import because, counted, sentence_of
from gaitwright.learning.live import LiveLessons, Tried
from gaitwright.learning.live_sources import Played, Running
from gaitwright.learning.said_action import said_action
from gaitwright.learning.teacher import Shown
from gaitwright.model.robot import Robot
from gaitwright.skills.book_trees import in_trees_of
from gaitwright.skills.what_if import what_if

AT_ONCE = 10.0
"""`go` goes on so long at most, unless a time is named [s]."""
HELP = (
    ("go [SECONDS]", "on, to where another skill is used, or by so many seconds"),
    ("at SECONDS", "to that moment of a recording"),
    (
        "right SKILL …",
        "what would be right here: right walk, right walk 0.1 0.25 (m/s, of a robot 0.29 m tall), and, where "
        "you like, because NUMBER (what decides), as NAME (what the rule is called), until 'TREE is VALUE', "
        "note NAME and drop NAME (what it remembers, or no more; rules may go by it: because NAME)",
    ),
    ("ok", "what it does here is right"),
    ("keep, back", "learn what was just tried, or not"),
    ("why [RULE]", "why it does what it does, or why a rule does not fire"),
    ("look", "the numbers of this moment"),
    ("rules", "what was learned so far, in order"),
    ("lessons", "what you taught, the last first"),
    ("undo, forget LESSON", "takes back the last lesson, or that one"),
    ("quit", "ends the lesson; everything kept is in the book"),
)


class Room:
    """One lesson: what is looked at, what was tried, and the words that a person may say."""

    def __init__(self, robot: Robot, source: Running | Played, lessons: LiveLessons) -> None:
        self.robot, self.source, self.lessons = robot, source, lessons
        self.tried: Tried | None = None
        self.kept = 0
        self.words: dict[str, Callable[[list[str]], None]] = {
            "go": self.go, "at": self.at, "right": self.right, "ok": self.ok, "keep": self.keep,
            "back": self.back, "why": self.why, "look": self.look, "rules": self.rules,
            "lessons": self.told, "undo": self.undo, "forget": self.forget, "help": self.help,
        }  # fmt: skip

    def hears(self, line: str) -> bool:
        """Does what a line says; whether the lesson goes on. What makes no sense is told, and changes
        nothing."""
        try:
            words = shlex.split(line, comments=True)
        except ValueError as error:
            remark(f"{line.strip()!r} is no line of words: {error}")
            return True
        if not words:
            return True
        if words[0] in ("quit", "exit"):
            return False
        try:
            if words[0] not in self.words:
                raise unknown("word", words[0], [*self.words, "quit"])
            self.words[words[0]](words[1:])
        except BadFile:
            raise
        except GaitwrightError as error:
            remark(f"{error}")
        return True

    # --- going on ----------------------------------------------------------------------------------
    def welcome(self) -> None:
        show_prose(
            f"{self.source.name}: `go` goes on, `right SKILL` says what would be right here, `help` lists "
            "all words."
        )
        self.tell_moment()

    def go(self, words: list[str]) -> None:
        seconds = number(words[0], "go") if words else AT_ONCE
        if self.source.over:
            raise WrongUse(f"it is over: {self.source.over}")
        self.tried = None
        self.lessons.seen += self.source.go(seconds, until_change=not words)
        self.tell_moment()

    def at(self, words: list[str]) -> None:
        if not isinstance(self.source, Played):
            raise WrongUse(
                "what is over cannot be gone back to in a mission that runs: teach from its recording"
            )
        if not words:
            raise WrongUse("at which moment? e.g. at 3.2")
        self.source.at(number(words[0], "at"))
        self.tried = None
        self.tell_moment()

    def tell_moment(self) -> None:
        """Where it is, what is used, what the rules say."""
        seen, over = self.source.here(), self.source.over
        chosen = self.lessons.pupil.choose(seen.moment)
        says = "nothing yet" if chosen.action is None else said_of(chosen.action)
        sure = ", and that is sure" if chosen.sure else ""
        show_prose(f"{seen.time:.2f} s: {seen.skill}; the rules say {says}{sure}.")
        if over:
            show_prose(f"It is over: {over}.")

    # --- teaching ----------------------------------------------------------------------------------
    def right(self, words: list[str]) -> None:
        said = Said(words)
        pupil = self.lessons.pupil
        action = said_action(said.words, self.robot, pupil.actions)
        if said.about and said.about not in pupil.vocabulary.names:
            raise unknown("number", said.about, pupil.vocabulary.names)
        self.try_out(
            self.lessons.correction(
                self.source.here(), Shown(said.name, action, about=said.about), self.source.name
            )
        )

    def ok(self, words: list[str]) -> None:
        """What the robot does is right."""
        self.try_out(self.lessons.confirmation(self.source.here(), self.robot, self.source.name))
        self.keep([])

    def try_out(self, tried: Tried) -> None:
        self.tried = tried
        tell_tried(tried, self.source.here())

    def keep(self, words: list[str]) -> None:
        if self.tried is None:
            raise WrongUse("there is nothing to keep: say what is right first")
        self.lessons.keep(self.tried)
        self.kept += 1
        show_prose(f"Learned as {self.tried.told.id!r}.")
        self.tried = None
        self.source.drive_by(self.lessons.ledger.book.rulebook)

    def back(self, words: list[str]) -> None:
        self.tried = None
        show_prose("Not learned.")

    def undo(self, words: list[str]) -> None:
        self.take_back("")

    def forget(self, words: list[str]) -> None:
        if not words:
            raise WrongUse("forget which lesson? `lessons` lists them")
        self.take_back(" ".join(words))

    def take_back(self, name: str) -> None:
        name, events = self.lessons.forget(name)
        show_prose(f"Forgotten: {name}.")
        tell_events(events)
        self.tried = None
        self.source.drive_by(self.lessons.ledger.book.rulebook)

    # --- asking ------------------------------------------------------------------------------------
    def why(self, words: list[str]) -> None:
        book, moment = self.lessons.ledger.book.rulebook, self.source.here().moment
        situation = in_trees_of(book, moment.situation, moment.facts)
        if words:
            show_prose(why_not(book, " ".join(words), situation))
            return
        decision = consult(book, situation)
        sentence = because(book, decision)
        show_prose(sentence if sentence.endswith(".") else f"{sentence}.")
        if decision.rule is not None:
            show_prose(f"{what_if(book, moment.facts).sentence}.")

    def look(self, words: list[str]) -> None:
        facts = self.source.here().moment.facts
        pairs = [(n, f if isinstance(f, str) else f"{f:.3g}") for n, f in facts.items()]
        show_pairs("", pairs, to_stderr=False)

    def rules(self, words: list[str]) -> None:
        book = self.lessons.ledger.book.rulebook
        if not book.rules:
            show_prose("No rules yet.")
        for place, rule in enumerate(book.rules, start=1):
            show_prose(f"{place}. {rule.name} {sentence_of(book, rule)}.")

    def told(self, words: list[str]) -> None:
        last = self.lessons.pupil.told[::-1][:20]
        show_prose(f"{counted(len(self.lessons.pupil.told), 'lesson')}; the last first:")
        for told in last:
            reason = f", because of {told.about}" if told.about else ""
            show_prose(f"{told.id}: {told.rule} ({told.given}{reason})", 2)

    def help(self, words: list[str]) -> None:
        show_pairs("", HELP, to_stderr=False)

    def leave(self) -> None:
        """The end of the lesson: how much was taught."""
        book = self.lessons.ledger.book
        if isinstance(self.source, Running):
            self.source.session.close()
        lessons, rules = counted(self.kept, "lesson"), counted(len(book.rulebook.rules), "rule")
        show_prose(f"{lessons} kept; the book has {rules}.")
