"""Every claim of the project, measured: one module per claim, peers in the same run.

A claim's module has `measure(context)`, which yields its figures one after the other, and `NOTE` where
something has to be known about how they are measured.
"""

from pathlib import Path

from gaitwright.errors import unknown

GROUPS = {
    "spine": ("walks", "ground", "pushes", "lp", "robots", "missions", "tick", "speed", "memory"),
    "skills": ("skills", "transitions", "terrain", "anyrobot", "cost"),
    "mechanics": ("dynamics", "sharing", "streaming", "armstrong"),
    "rules": ("rules", "school", "lessons", "teachers", "kills"),
    "learned": ("learned", "learned_parts", "learned_pushes", "learned_courses", "learned_switches"),
    "takeover": (
        "playing",
        "profiles",
        "operators",
        "sensing",
        "hybrid",
        "growth",
        "balance",
        "newcomers",
    ),
    "unknown": ("worlds", "maps", "eyes", "seeing", "moving"),
    "studio": ("studio",),
    "outside": ("strangers", "fuzz", "faults"),
}
"""Groups of claims, each claim the name of a module here, in the order in which they are measured."""


def run(
    names: list[str],
    quick: bool = False,
    json_path: str | None = None,
    seed: int = 0,
    workers: int | None = None,
    robots: Path | None = None,
) -> int:
    """Measures claims or groups of claims, all where `names` is empty; prints and writes what was measured.

    Returns 0 where every wanted figure is reached, 1 where one is not, 130 after an interrupt, which keeps
    what was finished. `workers`: processes that simulate side by side (one for each core); figures of walks
    do not depend on it. `robots`: a folder of robot files for the claim `strangers`. Raises `WrongUse` for a
    name that does not exist.
    """
    asked = claims_named(names)
    from gaitwright.bench.runs import measure_claims  # noqa: PLC0415 - heavy: names first

    return measure_claims(asked, quick, json_path, seed, workers, robots)


def claims_named(names: list[str]) -> list[tuple[str, str]]:
    """(group, claim) of everything that the names ask for, each once, in the order of `GROUPS`."""
    everything = [(group, claim) for group, members in GROUPS.items() for claim in members]
    known = dict.fromkeys([*GROUPS, *(claim for _, claim in everything)])
    for name in names:
        if name not in known:
            raise unknown("bench", name, known)
    return [pair for pair in everything if not names or set(pair) & set(names)]
