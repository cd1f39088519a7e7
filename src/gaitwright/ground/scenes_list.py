"""The built-in scenes by name: what `gaitwright scenes` prints. Imports neither numpy nor MuJoCo."""

from typing import NamedTuple

from gaitwright.errors import WrongUse, unknown


class Offer(NamedTuple):
    """A built-in scene, and the number that may follow its name after a colon."""

    line: str
    """What it is, in one line."""
    takes: str = ""
    """What the number means and its unit; empty where there is none."""
    default: float = 0.0
    low: float = 0.0
    high: float = 0.0


DIFFICULTY = ("a difficulty", 0.5, 0.0, 1.0)

OFFERS = {
    "flat": Offer("level ground"),
    "slippery": Offer("level ground with little grip", "a coefficient of friction", 0.3, 0.05, 2.0),
    "slope": Offer("a plane that rises (+) or falls (-) ahead", "an angle in degrees", 10.0, -45.0, 45.0),
    "cross-slope": Offer(
        "a plane that rises to the left (+) or right (-)", "an angle in degrees", 10.0, -45.0, 45.0
    ),
    "rough": Offer("random hills 0.2 m apart, level at the start", "an amplitude in metres", 0.03, 0.0, 0.5),
    "blocks": Offer("low blocks to step on, high ones to walk around, between (0, 0) and the goal (6, 0)"),
    "stairs": Offer("five steps up and five down", "the height of a step in metres", 0.10, 0.01, 0.5),
    "stairway": Offer(
        "the thesis's: six steps up at 45° and six down", "the height of a step in metres", 0.11, 0.01, 0.5
    ),
    "ramp": Offer("a ramp up, a platform, a ramp down", "an angle in degrees", 20.0, 1.0, 45.0),
    "gap": Offer("three gaps in the ground, half a metre deep", "a width in metres", 0.2, 0.01, 1.0),
    "boxes": Offer("two boxes across the way", "their height in metres", 0.08, 0.01, 0.5),
    "holes": Offer("holes in level ground, on the way to the goal (12, 0)", *DIFFICULTY),
    "trench": Offer("three trenches across the way, on it to the goal (6, 0)", *DIFFICULTY),
    "waves": Offer("long waves of the ground, a Cardinal spline; goal (12, 0)", *DIFFICULTY),
    "hills": Offer("hills and hollows, of Bézier patches; goal (12, 0)", *DIFFICULTY),
    "forest": Offer("trunks, boulders and stumps; goal (12, 0)", *DIFFICULTY),
    "streets": Offer(
        "streets from east to west and north to south between houses, some shut; goal (12, 0)", *DIFFICULTY
    ),
    "rooms": Offer("rooms with doors; goal (12, 0)", *DIFFICULTY),
    "maze": Offer("a maze; goal (12, 0)", *DIFFICULTY),
    "bugtrap": Offer("a bay in the straight way, out of which one must turn back; goal (12, 0)", *DIFFICULTY),
    "crossing": Offer("things that go to and fro across the way to the goal (12, 0)", *DIFFICULTY),
    "plaza": Offer("things that wander about, and some that come and go; goal (12, 0)", *DIFFICULTY),
    "mixed": Offer("blocks, holes, a ramp, steps and rough ground; goal (15, 0)", *DIFFICULTY),
}


def scene_names() -> dict[str, str]:
    """Names of the built-in scenes with what they are."""
    return {name: _line(offer) for name, offer in OFFERS.items()}


def _line(offer: Offer) -> str:
    return f"{offer.line}; takes {offer.takes} (default {offer.default:g})" if offer.takes else offer.line


def parse(asked: str) -> tuple[str, float]:
    """Name and number of a built-in scene, from `name` or `name:number`.

    Raises `WrongUse` for a name that does not exist and for a number out of its range.
    """
    name, colon, text = asked.partition(":")
    if name not in OFFERS:
        raise unknown("scene", asked, [*OFFERS, "or the path of a .json or .png file"])
    offer = OFFERS[name]
    if not colon:
        return name, offer.default
    if not offer.takes:
        raise WrongUse(f"scene {name!r} takes no number, but {asked!r} gives one")
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not offer.low <= value <= offer.high:
        raise WrongUse(
            f"scene {name!r} takes {offer.takes} from {offer.low:g} to {offer.high:g}, not {text!r}"
        )
    return name, value
