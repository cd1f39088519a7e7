"""`gaitwright books`: two skillbooks joined to one; one as text and back; lessons taken back; trust, maps."""

import json
import sys
from argparse import Namespace
from dataclasses import asdict, replace
from pathlib import Path

from gaitwright.cli import book_lessons, maps, profiles, trust
from gaitwright.cli.book_files import SQLITE, check_there, facts_of, new_file, skillbook_of
from gaitwright.cli.console import remark, show_pairs, show_prose, working
from gaitwright.cli.output import check_json, write_json, write_whole
from gaitwright.errors import BadFile, WrongUse
from gaitwright.files import content_of, text_of
from gaitwright.knowledge.json_form import MAX_BYTES, loads
from gaitwright.knowledge.sentences import counted
from gaitwright.learning.merging import Merged, merge
from gaitwright.learning.notes import relearned
from gaitwright.skillbook.book import Skillbook, content_hash, export_text, import_text
from gaitwright.skillbook.history import all_told

FILES = {
    "merge": ("OURS", "THEIRS"),
    "export": ("BOOK",),
    "import": ("TEXT",),
    "confirm": ("BOOK", "SKILL"),
    "undo": ("BOOK",),
    "forget": ("BOOK", "LESSON"),
    "edit": ("BOOK", "TABLE"),
    "trust": ("BOOK", "[SKILL", "[GRADE]]"),
    "map": ("BOOK", "[PLACE]"),
}
"""What each task is given; in brackets what may be left out."""

HEARD_AGAIN = "its lessons, heard again, make these rules"
MADE_OTHERS = "its lessons, heard again, make other rules: the text was changed, or another version taught it"
OLDER = "its lessons are of an older kind, which nobody hears any more: its rules are taken as they stand"
NO_LESSONS = "there are no lessons in it: its rules are taken as they stand"


def run(args: Namespace) -> int:
    check_json(args.json)
    wanted = FILES[args.task]
    least = sum(not word.startswith("[") for word in wanted)
    if not least <= len(args.files) <= len(wanted):
        given, number = " ".join(args.files) or "none", f"{least} to {len(wanted)}"
        number = number if least < len(wanted) else str(least)
        raise WrongUse(f"books {args.task} takes {number}: {' '.join(wanted)}; got {given}")
    if args.base is not None and args.task != "merge":
        raise WrongUse(f"--base is the book that two come from: books {args.task} has no use for it")
    if args.accept and args.task != "edit":
        raise WrongUse(f"--accept takes an edited profile in: books {args.task} has no use for it")
    if args.out is not None and args.task in IN_PLACE:
        raise WrongUse(f"books {args.task} changes {wanted[0]} itself: leave --out out")
    TASKS[args.task](args)
    return 0


# --- two to one ------------------------------------------------------------------------------------
def merge_books(args: Namespace) -> None:
    """Both books in a new one, and every sentence on what that does not do as one of them."""
    out = new_file(out_of(args), "skillbook")
    ours, theirs = (skillbook_of(path) for path in args.files)
    base = None if args.base is None else skillbook_of(args.base)
    with working(f"joining {args.files[0]} and {args.files[1]}"):
        merged = merge(ours, theirs, base)
        book = replace(merged.book, name=out.stem)
    book.save(out)
    tell_merge(ours, theirs, replace(merged, book=book), args)


def tell_merge(ours: Skillbook, theirs: Skillbook, merged: Merged, args: Namespace) -> None:
    """What was joined, what is in conflict, and what can be done about it."""
    book, aside = merged.book, args.json == "-"
    mine, other = args.files
    known = {rule.name for rule in ours.rulebook.rules}
    rules = [rule.name for rule in book.rulebook.rules]
    new = [name for name in rules if name not in known]
    steps, profiles = len(book.steps) - len(ours.steps), len(book.profiles) - len(ours.profiles)
    places = sum(notes not in ours.maps for notes in book.maps)
    news = ((steps, "step"), (profiles, "torque profile"), (places, "map"))
    taken = [counted(n, what) for n, what in news if n]
    figures = {
        "book": args.out,
        "ours": mine,
        "theirs": other,
        "rules": rules,
        "new_rules": new,
        "new_steps": steps,
        "new_profiles": profiles,
        "new_maps": places,
        "conflicts": [asdict(conflict) for conflict in merged.conflicts],
        "hash": content_hash(book),
    }
    write_json(args.json, json.dumps(figures, indent=2, ensure_ascii=False))
    rows = [
        ("ours", f"{mine}, {introduced(ours)}"),
        ("theirs", f"{other}, {introduced(theirs)}"),
        ("taken from theirs", ", ".join(taken) or "nothing: ours has all that it was taught"),
        ("new rules", ", ".join(new) or "none"),
        ("conflicts", str(len(merged.conflicts)) if merged.conflicts else "none"),
    ]
    show_pairs(f"{args.out} holds both", rows, to_stderr=aside)
    if merged.conflicts:
        for conflict in merged.conflicts:
            show_prose(f"– {conflict.sentence}.", 2, to_stderr=aside)
        show_pairs("", what_to_do(merged, args), to_stderr=aside)


def introduced(book: Skillbook) -> str:
    """What a book is called, on which robot it was taught, and how much it knows."""
    rules = book.rulebook
    about = f"{counted(len(rules.rules), 'rule')} from {counted(rules.lessons, 'lesson')}"
    return f"called {book.name or 'nothing'}, of {book.robot or 'no robot'}: {about}"


def what_to_do(merged: Merged, args: Namespace) -> list[tuple[str, str]]:
    """Commands that tell more of the conflicts, or turn them round."""
    named = {rule.name for rule in merged.book.rulebook.rules}
    about = [conflict.rule for conflict in merged.conflicts if conflict.rule in named]
    rows = [("theirs instead", f"gaitwright books merge {args.files[1]} {args.files[0]} --out NEW")]
    if about:
        rows.append(("look closer", f"gaitwright explain {args.out} --history {about[0]!r}"))
    return rows


# --- text ------------------------------------------------------------------------------------------
def export_book(args: Namespace) -> None:
    """The book as text, to a new file or the standard output."""
    to_screen = args.out in (None, "-")
    if to_screen and args.json == "-":
        raise WrongUse("text and --json cannot both go to the standard output: name a file with --out")
    out = None if to_screen else new_file(args.out, "file")
    book = skillbook_of(args.files[0])
    content = export_text(book)
    if out is None:
        sys.stdout.write(content)
    else:
        write_whole(out, content)
        remark(f"{args.files[0]} is text in {out}: {content.count(chr(10))} lines")
    write_json(args.json, json.dumps(facts_of(book, args.files[0]), indent=2, ensure_ascii=False))


def import_book(args: Namespace) -> None:
    """The book of a text in a new file; rules as JSON become a book that begins with them."""
    out = new_file(out_of(args), "skillbook")
    source = args.files[0]
    check_there(source, "what `gaitwright books export` wrote")
    content = content_of(source, "text", MAX_BYTES)
    if content.startswith(SQLITE):
        raise BadFile(f"{source} is a skillbook already: only text is imported")
    if content.lstrip()[:1] == b"{":
        book = Skillbook.new(loads(content, source), name=Path(source).stem)
    else:
        book = import_text(text_of(content, source), source)
    history = checked_again(book)
    book.save(out)
    write_json(args.json, json.dumps(facts_of(book, args.out), indent=2, ensure_ascii=False))
    rules = book.rulebook
    rows = [
        ("name", book.name),
        ("rules", ", ".join(rule.name for rule in rules.rules) or "none"),
        ("lessons", str(rules.lessons)),
        ("history", history),
        ("next", f"gaitwright explain {args.out}"),
    ]
    show_pairs(f"{args.out} holds what {source} says", rows, to_stderr=args.json == "-")


def checked_again(book: Skillbook) -> str:
    """Whether the rules of a book are what its lessons make, in words: they are heard again, which can take
    a minute for a thousand."""
    if book.pupil is None:  # nobody has made rules of what was told
        return OLDER if any(step.lesson is not None for step in book.steps) else NO_LESSONS
    heard = min(book.pupil.heard, len(all_told(book.steps)))
    with working(f"hearing its {counted(heard, 'lesson')} again", worth_a_line=None):
        same = relearned(book).rules == book.rulebook.rules
    return HEARD_AGAIN if same else MADE_OTHERS


def out_of(args: Namespace) -> str:
    """The new book's file. Raises `WrongUse` where none is named."""
    if args.out in (None, "-"):
        raise WrongUse(f"books {args.task} makes a new skillbook: name its file with --out")
    return args.out


IN_PLACE = {
    "confirm": book_lessons.confirm,
    "undo": book_lessons.undo,
    "forget": book_lessons.forget,
    "edit": profiles.edit,
    "trust": trust.run,
}
"""The tasks that change a book itself."""
TASKS = {"merge": merge_books, "export": export_book, "import": import_book, "map": maps.run, **IN_PLACE}
