"""New rules from old, for robots (row L12): descend from climb, left from right, walk-backward from walk.

What was taught of one skill is told again the other way round: in the numbers, not in the rules, so that
what comes of it is learned, shown and taken back like anything else. It is only proposed until a person
confirms it.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from gaitwright.errors import WrongUse
from gaitwright.knowledge.memory import Fact
from gaitwright.knowledge.told import Told
from gaitwright.learning.skill_pupil import SkillPupil

MOST = 12
"""So many lessons are told the other way round at most, evenly taken."""

Facts = Mapping[str, Fact]


@dataclass(frozen=True, slots=True)
class Analogy:
    """A skill that is another one the other way round, and how the numbers of a moment look there."""

    skill: str
    new: str
    turned: Callable[[Facts], dict[str, Fact]]


@dataclass(frozen=True, slots=True)
class Proposal:
    """A skill that could be used by analogy: what would be told, and a sentence on it."""

    skill: str
    told: tuple[Told, ...]
    sentence: str


def negated(*names: str) -> Callable[[Facts], dict[str, Fact]]:
    """Numbers with their signs changed."""

    def turned(facts: Facts) -> dict[str, Fact]:
        return {n: -f if n in names and not isinstance(f, str) else f for n, f in facts.items()}

    return turned


def upside_down(facts: Facts) -> dict[str, Fact]:
    """Uphill for downhill, steps up for steps down."""
    names = {"step up": "step down", "step down": "step up"}
    return {names.get(name, name): fact for name, fact in negated("slope")(facts).items()}


def about_face(facts: Facts) -> dict[str, Fact]:
    """The path behind instead of ahead."""
    off = facts.get("off the path")
    if off is None or isinstance(off, str):
        return dict(facts)
    return {**facts, "off the path": off - 180.0 if off > 0.0 else off + 180.0}


to_the_other_side = negated("off the path")
ANALOGIES = (
    Analogy("walk", "walk-backward", about_face),
    Analogy("climb", "descend", upside_down),
    Analogy("descend", "climb", upside_down),
    Analogy("turn-left", "turn-right", to_the_other_side),
    Analogy("turn-right", "turn-left", to_the_other_side),
)


def proposals(pupil: SkillPupil) -> tuple[Proposal, ...]:
    """The skills that could be used by analogy to one that was taught, and were not taught themselves."""
    taught = {told.action.skill for told in pupil.told}
    made = []
    for analogy in ANALOGIES:
        lessons = [told for told in pupil.told if told.action.skill == analogy.skill]
        if lessons and analogy.new not in taught:
            told = tuple(other_way_round(one, analogy) for one in evenly(lessons))
            made.append(
                Proposal(
                    analogy.new,
                    told,
                    f"{analogy.new} as the counterpart of {analogy.skill}: nobody has seen it yet; "
                    "`gaitwright books confirm` takes it in",
                )
            )
    return tuple(made)


def proposal_of(pupil: SkillPupil, skill: str) -> Proposal:
    """The proposal of a skill. Raises `WrongUse` naming those that there are."""
    made = {proposal.skill: proposal for proposal in proposals(pupil)}
    if skill not in made:
        there = ", ".join(made) or "none"
        raise WrongUse(f"nothing is proposed for {skill!r}: proposed are {there}")
    return made[skill]


def other_way_round(told: Told, analogy: Analogy) -> Told:
    """A lesson of the counterpart."""
    action = replace(told.action, skill=analogy.new)
    because = f"the counterpart of {told.rule}"
    name = f"{told.id}, the other way round"
    facts = analogy.turned(told.facts)
    return Told(name, facts, analogy.new, action, because, told.about, told.scene, "by analogy")


def evenly(lessons: Sequence[Told]) -> list[Told]:
    """At most `MOST` of some lessons, from the first to the last."""
    step = max(1, len(lessons) // MOST)
    return list(lessons[::step])[:MOST]
