"""`gaitwright explain`: what a rulebook knows, why a rule fires or not, and what moved its marks."""

import json
import re
from argparse import Namespace
from collections.abc import Sequence
from dataclasses import asdict
from importlib import import_module
from pathlib import Path

from gaitwright.cli.book_files import rules_and_lessons
from gaitwright.cli.console import (
    remark,
    show_heading,
    show_pairs,
    show_prose,
    show_table,
    working,
)
from gaitwright.cli.output import check_json, write_json
from gaitwright.cli.situation_args import RECORDED, SAID, Asked, asked, said, whatever
from gaitwright.errors import WrongUse
from gaitwright.knowledge.consult import Decision, consult
from gaitwright.knowledge.explain import forest_text
from gaitwright.knowledge.memory import Memory, remembered
from gaitwright.knowledge.rules import Rulebook, status
from gaitwright.knowledge.sentences import (
    because,
    changes,
    facts_of,
    history_lines,
    movers,
    opening,
    others,
    reasons_against,
    sentence_of,
    title,
    verdict,
)
from gaitwright.knowledge.told import Told
from gaitwright.screen import show

RULES = ("", "rule", "status", "right", "wrong", "it …")
MARKS = ("tree", "here", "▲ upper mark", "▲ moved there by", "▼ lower mark", "▼ moved there by")


def run(args: Namespace) -> int:
    check_json(args.json)
    if args.out is not None:
        args.out = import_module("gaitwright.cli.skills").check_picture(args.out)
    if args.at is not None and not args.recording:
        raise WrongUse("--at is a moment of a recording: name its file with --recording")
    rulebook, told = rules_and_lessons(args.book)
    name = args.rule or args.why_not or args.history or ""
    if name:
        rulebook[name]
    figures: dict = {
        "book": args.book,
        "lessons": rulebook.lessons,
        "trees": {tree.name: tree.leaves for tree in rulebook.forest.trees},
        "rules": [facts_of(rulebook, rule) for rule in rulebook.rules],
    }
    aside, decision = args.json == "-", None
    if args.situation or args.recording or args.why_not:
        at, facts = situation_asked(rulebook, told, args, figures)
        decision = consult(rulebook, at.situation)
        tell_decision(rulebook, at, facts, decision, args.rule or args.why_not or "", figures, aside)
    elif args.rule:
        tell_rule(rulebook, name, aside)
    elif not args.history:
        tell_book(rulebook, args.book, aside)
    if args.history:
        tell_history(rulebook, name, figures, aside)
    if args.plot or args.out is not None:
        picture(args, rulebook, name, decision, figures)
    write_json(args.json, json.dumps(figures, indent=2, ensure_ascii=False))
    return 0


# --- what the book knows ---------------------------------------------------------------------------
def tell_book(rulebook: Rulebook, path: str, aside: bool) -> None:
    """All rules in their order."""
    if aside:
        return
    show_prose(opening(rulebook, Path(path).name))
    rows = [
        (str(k), rule.name, status(rule), str(len(rule.positives)), str(len(rule.negatives)),
         sentence_of(rulebook, rule))
        for k, rule in enumerate(rulebook.rules, start=1)
    ]  # fmt: skip
    if rows:
        show_table(RULES, rows, right=("", "right", "wrong"), prose=("it …",))


def tell_rule(rulebook: Rulebook, name: str, aside: bool) -> None:
    """One rule with its trees."""
    if aside:
        return
    rule = rulebook[name]
    show_prose(f"{title(rule)}: {sentence_of(rulebook, rule)}.")
    show_prose(
        "▲ outside this value it may not fire; ▼ below this value it was seen right. + yes, ? grey, − no."
    )
    show(["", *forest_text(rulebook, name).split("\n")])


def tell_history(rulebook: Rulebook, name: str, figures: dict, aside: bool) -> None:
    """Every lesson that moved a rule, the oldest first."""
    events = figures["history"] = history_lines(rulebook, name)
    if aside:
        return
    show_prose(f"{title(rulebook[name])}:")
    for event in events:
        show_prose(f"{event}.", 2)


# --- what it decides -------------------------------------------------------------------------------
def situation_asked(
    rulebook: Rulebook, told: Sequence[Told], args: Namespace, figures: dict
) -> tuple[Asked, Memory]:
    """The situation from the options, and the measurements behind it as far as there are some; the moment it
    was recorded at goes to the figures."""
    facts: Memory = remembered({})
    if args.recording:
        moment = import_module("gaitwright.cli.recorded_moment")  # only now: it knows MuJoCo
        figures["at_s"], facts = moment.recorded_facts(args.recording, args.at)
    facts_at = {one.id: one.facts for one in reversed(told)}
    skills = import_module("gaitwright.skills.book_trees") if told else None
    taught = [(n, skills.situation_in(rulebook, f)) for n, f in facts_at.items()] if skills else []
    at = asked(rulebook, said(args.situation or (), rulebook.forest), facts, taught)
    if args.recording and not any((tree.source or tree.name) in facts for tree in rulebook.forest.trees):
        raise WrongUse(
            f"{args.recording} tells {', '.join(facts)}, and of these no tree reads one; "
            f"the trees are {', '.join(rulebook.forest.names)}"
        )
    if args.recording and not args.situation:
        return at, facts
    same = next((facts_at[name] for name, situation in taught if situation == at.situation), {})
    return at, remembered(same)


def different_facts(rulebook: Rulebook, at: Asked, facts: Memory, names: list[str]) -> list[dict]:
    """What would have to be different: in the measurements where there are some that a rule may go by, else
    in the values of the trees."""
    if "doing" not in facts or "slope" not in facts:
        return [counterfactual_figures(change) for _, change in changes(rulebook, at.situation, names)]
    first, *others = import_module("gaitwright.skills.what_if").what_ifs(rulebook, facts, ("", *names))
    found = [first, *(answer for name, answer in zip(names, others, strict=True) if name != first.rule)]
    return [
        {
            "sentence": answer.sentence,
            "changes": [{"tree": c.fact, "before": c.before, "after": c.after} for c in answer.changes],
            "tried": answer.rule or None,
        }
        for answer in found
    ]


def tell_decision(  # noqa: PLR0913 - all that is told of a decision
    rulebook: Rulebook,
    at: Asked,
    facts: Memory,
    decision: Decision,
    name: str,
    figures: dict,
    aside: bool,
) -> None:
    """Why, why not, what would have to be different, and which lessons are behind it."""
    names = others(rulebook, decision, "" if name == decision.rule else name)
    against, different = (
        reasons_against(rulebook, decision, names),
        different_facts(rulebook, at, facts, names),
    )
    marks = [] if decision.rule is None else list(movers(rulebook, rulebook[decision.rule], at.situation))
    left_open = whatever(rulebook, at) if at.open else ""
    figures |= {
        "situation": dict(at.situation.items()),
        "taken_from": dict(zip(at.situation.trees, at.sources, strict=True)),
        "left_open": left_open,
        "decision": {"rule": decision.rule, "certainty": decision.certainty, "grey": decision.grey},
        "could_fire": decision.conflict,
        "because": because(rulebook, decision),
        "why_not": dict(against),
        "counterfactuals": different,
        "marks": [dict(zip(MARKS_KEYS, row, strict=True)) for row in marks],
    }
    if aside:
        return
    tell_situation(at)
    show_prose(f"{verdict(decision)} {left_open}")
    section("why", [figures["because"]])
    section("why not another", [sentence for _, sentence in against])
    section(
        "what would have to be different (each change was tried)",
        [f"{change['sentence']}." for change in different],
    )
    if marks:
        show_heading(f"marks of {decision.rule}")
        show_table(MARKS, marks)


MARKS_KEYS = ("tree", "here", "upper", "upper_moved_by", "lower", "lower_moved_by")


def counterfactual_figures(change) -> dict:
    """A change as figures; `tried` is what consulting the book decides after it."""
    return {
        "sentence": change.sentence,
        "changes": [asdict(part) for part in change.changes],
        "tried": change.decision and change.decision.rule,
    }


def tell_situation(at: Asked) -> None:
    """The situation: what was said or recorded tree by tree, and the rest by the lesson it is taken from."""
    told = [(*pair, source) for pair, source in zip(at.situation.items(), at.sources, strict=True)]
    pairs = [(tree, str(value)) for tree, value, source in told if source in (SAID, RECORDED)]
    for source in dict.fromkeys(source for *_, source in told if source not in (SAID, RECORDED)):
        rest = "; ".join(f"{tree} {value}" for tree, value, here in told if here == source)
        pairs.append((source, rest))
    show_pairs("the situation", pairs, to_stderr=False)
    show([""])


def section(head: str, sentences: list[str]) -> None:
    """A bold head and its sentences."""
    if sentences:
        show_heading(head)
        for sentence in sentences:
            show_prose(sentence, 2)


# --- the picture -----------------------------------------------------------------------------------
def picture(args: Namespace, rulebook: Rulebook, name: str, decision: Decision | None, figures: dict) -> None:
    """Draws the forest, and the trees of the rule that was asked for or fires; says where."""
    if not import_module("gaitwright.cli.trips").has("matplotlib", "the picture", "plot"):
        return
    stem = re.sub(r"[^A-Za-z0-9_-]+", "-", Path(args.book).stem)
    path = Path(args.out or f"runs/explain-{stem}.png")
    with working("drawing the trees", worth_a_line=False):
        from gaitwright.pictures.forest import forest_picture  # noqa: PLC0415 - an extra

        rule = name or (decision.rule if decision else "") or ""
        forest_picture(rulebook, path, rule, decision)
    figures["picture"] = str(path)
    remark(f"picture: {path}")
