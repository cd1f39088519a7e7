"""Command lines to be damaged, over sound files that `case.prepared` lays out."""

import json
from random import Random

from gaitwright.bench.fuzz.mutations import damaged_command

COMMANDS: tuple[tuple[str, ...], ...] = (
    ("skill", "--seconds", "0.01", "--skill", "trot", "--speed", "0.4", "--turn", "0.1", "--seed", "3"),
    ("skill", "--seconds", "0.01", "--scene", "rough:0.03", "--lateral", "0.1", "--push", "0.2", "90"),
    ("skill", "--seconds", "0.01", "--cycle", "climb", "--json", "figures.json", "--robot", "hexapod"),
    ("skill", "--seconds", "0.01", "--plant", "kinematic", "--driver", "kinematic", "--scene", "blocks"),
    (
        "mission",
        "--seconds",
        "0.01",
        "--goal",
        "2",
        "0",
        "--start",
        "0",
        "0",
        "0.1",
        "--scene",
        "stairs:0.08",
    ),
    ("mission", "--seconds", "0.01", "--waypoints", "1,0.2", "2,-1", "--speed", "0.5", "--scene", "gap"),
    ("mission", "--seconds", "0.01", "--goal", "2", "0", "--driver", "hybrid", "--skillbook", "sound.skills"),
    ("mission", "--seconds", "0.01", "--goal", "2", "0", "--sight", "camera", "--skillbook", "sound.skills"),
    ("mission", "--seconds", "0.01", "--route", "sound.csv", "--scene", "flat", "--speed", "0.3"),
    (
        "mission",
        "--seconds",
        "0.01",
        "--velocity",
        "sound.steer",
        "--sight",
        "camera",
        "--strategy",
        "thesis",
    ),
    ("books", "map", "sound.skills", "a block (seed 0)"),
    ("skills", "--robot", "hexapod"),
    ("skills", "--cycle", "trot", "--robot", "go2"),
    ("scenes", "--json", "-"),
    ("robots", "--json", "robots.json"),
    ("explain", "sound.skills", "--rule", "trot"),
    ("explain", "sound.skills", "--situation", "road=flat", "pace=0.4", "--not", "climb"),
    ("explain", "sound.skills", "--history", "trot", "--json", "-"),
    ("explain", "sound.skills", "--recording", "sound.npz", "--at", "0.02"),
    ("scanner", "sound.npz", "--at", "0.02", "--json", "-"),
    ("scanner", "sound.npz", "--plot", "--out", "held.png"),
    ("books", "export", "sound.skills", "--out", "text.txt"),
    ("books", "import", "sound.txt", "--out", "again.skills"),
    ("books", "merge", "sound.skills", "sound.skills", "--out", "both.skills"),
    ("books", "confirm", "sound.skills", "nothing"),
    ("books", "forget", "sound.skills", "nothing"),
    ("balance", "sound.json", "--forget", "left+:stop", "--out", "rest.json"),
    ("scenes", "--plot", "nothing", "sound.json", "sound.png", "--out", "there.png"),
    ("bench", "walks", "--nothing"),
    ("reproduce", "nothing", "--out", "there"),
    ("teach", "--robot", "nothing", "--out", "new.skills", "--trips", "1"),
)
"""Command lines to be damaged; what takes long is wrong from the start."""


def command_lines() -> tuple[bytes, ...]:
    return tuple(json.dumps(words).encode() for words in COMMANDS)


def damaged_line(chance: Random, content: bytes) -> bytes:
    """A damaged command line that is over soon: it simulates for some ticks, and teaches nothing."""
    words = damaged_command(chance, json.loads(content))
    if words[:1] != ["teach"] or "nothing" in words:
        quick = [word for word in words if word not in ("bench", "reproduce", "demo", "--check")]
        slow = len(quick) < len(words) and "nothing" not in words and "--nothing" not in words
        words = [*words, "--nothing"] if slow else words
    else:
        words = [*words, "--nothing"]
    if words[:1] and words[0] in ("skill", "mission"):
        words = [*words, "--seconds", "0.01"]
    return json.dumps(words).encode()
