"""Sound content → damaged content: of bytes, of JSON, of XML, of words. All by chance, the same by a seed."""

import json
from collections.abc import Sequence
from random import Random
from typing import Any

NUMBERS = (
    0, 1, -1, 2, 0.5, -0.0, 1e-9, 1e-310, 5e-324, 1e9, 1e18, 1e300, -1e300, 2**31, 2**53, 2**63, -(2**63),
    10**30, float("nan"), float("inf"), float("-inf"),
)  # fmt: skip
TEXTS = (
    "", " ", "x" * 5000, "\x1b[31mred\x1b[0m", "a\nb", "\x00", "[/bold]", "[red]", "ü", "\u202e", "\ud800",
    "{}", "%s", "-1", "NaN", "../..", "/", "/dev/null", "go2", "any", "trot",
)  # fmt: skip
"""What text may hold that does something somewhere."""
VALUES: tuple[Any, ...] = (*NUMBERS, *TEXTS, None, True, False, [], {}, [[]], [0, 0], {"a": 1})
PIECES = (
    b"\x00",
    b"\xff",
    b"\xc3\x28",
    b"\n",
    b'"',
    b"{",
    b"[",
    b"}",
    b"]",
    b"<",
    b">",
    b"\x1b[2J",
    b"1e999",
    b"-",
)


def damaged_bytes(chance: Random, content: bytes) -> bytes:
    """Content with a few bytes changed, lost, doubled or added."""
    data = bytearray(content)
    for _ in range(chance.choice((1, 1, 1, 2, 4, 16))):
        at = chance.randrange(len(data) + 1)
        length = chance.choice((1, 1, 4, 64, 1024))
        how = chance.randrange(6)
        if how == 0 and at < len(data):
            data[at] ^= 1 << chance.randrange(8)
        elif how == 1:
            data[at:at] = chance.choice(PIECES)
        elif how == 2:
            del data[at : at + length]
        elif how == 3:
            data[at:at] = data[at : at + length]
        elif how == 4:
            data[at : at + length] = chance.randbytes(min(length, 64))
        elif at:
            del data[at:]
    return bytes(data)


def damaged_json(chance: Random, content: bytes) -> bytes:
    """JSON in which something else stands, is missing, or stands twice; now and then damaged as text too."""
    plain = json.loads(content)
    for _ in range(chance.choice((1, 1, 2, 3))):
        plain = damaged_value(chance, plain)
    text = json.dumps(plain, ensure_ascii=chance.random() < 0.8)
    if chance.random() < 0.1 and text.count('"') > 3:
        start = text.index('"')
        text = text[:start] + '"seed": 1, "seed": 2, ' + text[start:]
    done = text.encode("utf-8", "surrogatepass")
    return damaged_bytes(chance, done) if chance.random() < 0.15 else done


def damaged_value(chance: Random, value: Any) -> Any:
    """A JSON value with one place in it changed, the outermost seldom."""
    if isinstance(value, dict) and value and chance.random() < 0.95:
        key = chance.choice(list(value))
        how = chance.random()
        if how < 0.1:
            return {name: held for name, held in value.items() if name != key}
        if how < 0.15:
            return value | {chance.choice(TEXTS): value[key]}
        return value | {key: damaged_value(chance, value[key])}
    if isinstance(value, list) and value and chance.random() < 0.9:
        at = chance.randrange(len(value))
        how = chance.random()
        if how < 0.1:
            return value[:at] + value[at + 1 :]
        if how < 0.2:
            return value[: at + 1] * chance.choice((1, 2, 3, 100)) + value[at:]
        return [*value[:at], damaged_value(chance, value[at]), *value[at + 1 :]]
    if isinstance(value, int | float) and not isinstance(value, bool) and chance.random() < 0.5:
        return value * chance.choice((-1, 0, 2, 0.5, 1e-3, 1e3, 1e6, 1.0001))
    return chance.choice(VALUES)


def damaged_xml(chance: Random, content: bytes) -> bytes:
    """XML with numbers, names and elements changed; now and then damaged as text."""
    if chance.random() < 0.25:
        return damaged_bytes(chance, content)
    parts = content.decode().split('"')
    for _ in range(chance.choice((1, 1, 2, 4))):
        at = 2 * chance.randrange(len(parts) // 2) + 1
        parts[at] = damaged_words(chance, parts[at])
    text = '"'.join(parts)
    if chance.random() < 0.3:
        lines = text.split("\n")
        at = chance.randrange(len(lines))
        lines[at : at + chance.choice((1, 1, 3))] = [lines[at]] * chance.choice((0, 2, 2, 20))
        text = "\n".join(lines)
    return text.encode("utf-8", "surrogatepass")


def damaged_words(chance: Random, value: str) -> str:
    """An attribute with one of its words changed, lost or doubled."""
    words = value.split() or [""]
    at = chance.randrange(len(words))
    how = chance.random()
    if how < 0.1:
        return " ".join(words[:at] + words[at + 1 :])
    if how < 0.2:
        return " ".join([*words, words[at]])
    try:
        words[at] = repr(float(words[at]) * chance.choice((-1, 0, 10, 0.1, 1e-6, 1e6, 1e-310)))
    except ValueError:
        words[at] = str(chance.choice(VALUES)).replace('"', "'").replace("<", "").replace("&", "")
    if how < 0.4:
        words[at] = str(chance.choice(NUMBERS))
    return " ".join(words)


PATHS = (
    "sound.skills", "sound.txt", "sound.npz", "sound.json", "sound.xml", "pipe", "/dev/full", "two words",
    "/dev/zero", "missing/../there", "missing/there", "there/..", "/proc/self/mem", "/", ".", "l" * 250,
    "x" * 5000,
)  # fmt: skip
"""What may stand where a file is named: some of these are there, see `case.prepared`."""


def damaged_command(chance: Random, words: Sequence[str]) -> list[str]:
    """A command line with other values behind its options, and now and then words lost, doubled or added."""
    out = list(words)
    for _ in range(chance.choice((1, 1, 2, 3))):
        values = [at for at, word in enumerate(out) if at and not word.startswith("--")] or [0]
        at = chance.choice(values) if chance.random() < 0.85 else chance.randrange(len(out))
        how = chance.random()
        if how < 0.85:
            out[at] = another_word(chance, out[at])
        elif how < 0.9 and len(out) > 1:
            del out[at]
        elif how < 0.95:
            out.insert(at, out[at])
        else:
            out.append(str(chance.choice(TEXTS)))
    return out


def another_word(chance: Random, word: str) -> str:
    """Another number for a number, mostly; another path, text or number for anything else."""
    try:
        number = float(word)
    except ValueError:
        pool = chance.choice(
            (PATHS, PATHS, TEXTS, NUMBERS, (word[: len(word) // 2], word + ":0.1", word * 2))
        )
        return str(chance.choice(pool))
    if chance.random() < 0.6:
        return f"{number * chance.choice((-1, 0, 0.1, 0.5, 1.5, 3, 10, 1e3)):g}"
    return str(chance.choice((*NUMBERS, *TEXTS)))
