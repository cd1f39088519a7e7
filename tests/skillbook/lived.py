"""Entries of trust as skillbooks hold them."""

from gaitwright.knowledge.trust import Experience, History


def some_history() -> History:
    """One of each kind."""
    return (
        Experience("trot", "taught"),
        Experience("trot", "drove", 5.0, why="tried on the flat after it was taught"),
        Experience("walk-backward", "set", grade="apprentice", why="a person said so"),
        Experience(
            "trot",
            "bug",
            why="rough:0.07 (seed 3): it fell at 4.2 s – »twice«",
            facts={"slope": 1.5, "goal": "far"},
        ),
        Experience("trot", "returned", why="stairs (seed 0): handed back", facts={"slope": 2.0}),
        Experience("walk-backward", "watched", 12.5, why="flat (seed 0)"),
    )
