"""`gaitwright books trust`: how far the learned controller is trusted with each skill, why, and otherwise."""

import json
from argparse import Namespace
from typing import Any

from gaitwright.cli.book_files import skillbook_of
from gaitwright.cli.console import remark, show_pairs, show_table
from gaitwright.cli.output import write_json
from gaitwright.errors import WrongUse, unknown
from gaitwright.knowledge.trust import GRADES, PARTNER, UNTOLD, Experience, grade_of, moved, trust_in
from gaitwright.skillbook.book import Skillbook
from gaitwright.skillbook.writer import open_for_learning

HEAD = ("skill", "grade", "trust", "driven [s]", "motion bugs", "last")
ENTRY = ("what", "seconds", "trust", "grade", "why")
UNKNOWN = "it has no history: it was taught before there was one, and is driven as by a partner"
BY_HAND = "a person said so"


def run(args: Namespace) -> None:
    """All skills; with a skill its history; with a grade too it is set to that."""
    path, *asked = args.files
    book = skillbook_of(path)
    if asked:
        check_skill(book, path, asked[0])
    if len(asked) > 1:
        book = with_grade(path, *asked)
    skills = asked[:1] or skills_in(book)
    figures = {"book": path, "skills": {name: figures_of(book, name) for name in skills}}
    write_json(args.json, json.dumps(figures, indent=2, ensure_ascii=False))
    if args.json == "-":
        return
    if asked:
        show_history(book, asked[0])
    elif skills:
        show_table(HEAD, [row_of(book, name) for name in skills], right=HEAD[2:5])
    else:
        remark(f"{path} holds no torque profiles: there is nothing to trust yet")


def with_grade(path: str, skill: str, grade: str) -> Skillbook:
    """Raises or lowers a skill, which is an entry of its history. Raises `WrongUse` for another grade."""
    if grade not in GRADES:
        raise unknown("grade", grade, GRADES)
    with open_for_learning(path) as ledger:
        return ledger.trust([Experience(skill, "set", grade=grade, why=BY_HAND)])


def check_skill(book: Skillbook, path: str, skill: str) -> None:
    """`WrongUse` for a skill that the book has no profiles of."""
    if not skills_in(book):
        raise WrongUse(f"{path} holds no torque profiles: there is nothing to trust yet")
    if skill not in skills_in(book):
        raise unknown(f"skill in {path}", skill, skills_in(book))


def skills_in(book: Skillbook) -> list[str]:
    """The skills that it has profiles or a history of."""
    return list(dict.fromkeys([*(p.skill for p in book.profiles), *(e.skill for e in book.trust)]))


def history_of(book: Skillbook, skill: str) -> list[tuple[Experience, float]]:
    """The entries of a skill, and the trust after each."""
    trust, found = UNTOLD, []
    for entry in book.trust:
        if entry.skill == skill:
            trust = moved(trust, entry)
            found.append((entry, trust))
    return found


def figures_of(book: Skillbook, skill: str) -> dict[str, Any]:
    """A skill as plain values."""
    history = history_of(book, skill)
    return {
        "grade": grade_of(history[-1][1]) if history else PARTNER,
        "trust": round(trust_in(book.trust).get(skill, 0.0), 4) if history else None,
        "driven_s": round(sum(entry.seconds for entry, _ in history if entry.how == "drove"), 3),
        "motion_bugs": sum(entry.how == "bug" for entry, _ in history),
        "history": [
            {"what": entry.how, "seconds": entry.seconds, "trust": round(trust, 4), "why": entry.why}
            for entry, trust in history
        ],
    }


def row_of(book: Skillbook, skill: str) -> tuple[str, ...]:
    """A line of the table."""
    told = figures_of(book, skill)
    if not told["history"]:
        return skill, PARTNER, "–", "–", "–", "no history yet"
    last = told["history"][-1]
    numbers = f"{told['trust']:.2f}", f"{told['driven_s']:.1f}", str(told["motion_bugs"])
    return skill, told["grade"], *numbers, f"{last['what']}: {last['why']}" if last["why"] else last["what"]


def show_history(book: Skillbook, skill: str) -> None:
    """Every entry of a skill, and what trust came to."""
    history = history_of(book, skill)
    rows = [
        (
            entry.how,
            f"{entry.seconds:.1f}" if entry.seconds else "",
            f"{trust:.2f}",
            grade_of(trust),
            entry.why,
        )
        for entry, trust in history
    ]
    if rows:
        show_table(ENTRY, rows, right=ENTRY[1:3])
    grade = grade_of(history[-1][1]) if history else PARTNER
    show_pairs("", [(skill, grade if history else f"{grade}; {UNKNOWN}")], to_stderr=False)
