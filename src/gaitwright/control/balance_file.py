"""Rules of balance as a JSON file that people read, edit and share.

```json
{"bands": {"height": 0.2, "roll": 0.4, "pitch": 0.3, "forward": 0.6, "left": 0.2, "turn": 0.5},
 "rules": [{"if": {"left": 1}, "in": ["walk"], "then": "go-with-it", "met": 40, "saved": 9, "lost": 1}]}
```
Bands are in the robot's own units: over its height, radians, over √(g h) and √(g/h). `in`, and the counts of
pushed runs, may be left out.
"""

from pathlib import Path
from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from gaitwright.control.balance_rules import BalanceRule, BalanceRules
from gaitwright.control.comparator import QUANTITIES, Pattern
from gaitwright.errors import BadFile, WrongUse, short
from gaitwright.files import content_of, json_of

MAX_BYTES = 100_000
Name = Annotated[str, Meta(max_length=60)]
Count = Annotated[int, Meta(ge=0, le=1_000_000_000)]
Width = Annotated[float, Meta(gt=0.0, le=100.0)]


class RuleEntry(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """A rule."""

    when: dict[Name, Literal[-1, 1]] = msgspec.field(name="if")
    then: Name
    skills: Annotated[tuple[Name, ...], Meta(max_length=50)] = msgspec.field(name="in", default=())
    met: Count = 0
    saved: Count = 0
    lost: Count = 0


class RulesEntry(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A file."""

    bands: dict[Name, Width]
    rules: Annotated[tuple[RuleEntry, ...], Meta(max_length=200)] = ()


def load_balance(path: str | Path) -> BalanceRules:
    """The rules in a file. Raises `BadFile` with one sentence."""
    asked = f"balance rules {short(str(path))}"
    try:
        entry = json_of(content_of(path, "balance rules", MAX_BYTES), RulesEntry, asked)
        return BalanceRules(entry.bands, tuple(rule_of(one) for one in entry.rules))
    except (msgspec.ValidationError, WrongUse) as error:
        raise BadFile(f"{asked}: {error}") from None


def rule_of(entry: RuleEntry) -> BalanceRule:
    """A rule of a file. Raises `WrongUse` for a quantity or an action that there is not."""
    for name in entry.when:
        if name not in QUANTITIES:
            raise WrongUse(f"{name!r} is not compared; there is: {', '.join(QUANTITIES)}")
    pattern = tuple(entry.when.get(name, 0) for name in QUANTITIES)
    return BalanceRule(pattern, entry.then, entry.skills, entry.met, entry.saved, entry.lost)


def named(pattern: Pattern) -> dict[str, Literal[-1, 1]]:
    """What is off in a pattern."""
    return {name: 1 if sign > 0 else -1 for name, sign in zip(QUANTITIES, pattern, strict=True) if sign}


def as_text(rules: BalanceRules) -> str:
    """The rules as a file holds them, a rule a line."""
    entries = [
        RuleEntry(
            named(rule.when),
            rule.action,
            rule.skills,
            rule.met,
            rule.saved,
            rule.lost,
        )
        for rule in rules.rules
    ]
    bands = msgspec.json.encode(dict(rules.bands)).decode()
    lines = ",\n  ".join(msgspec.json.encode(entry).decode() for entry in entries)
    return f'{{"bands": {bands},\n "rules": [{lines}]}}\n'
