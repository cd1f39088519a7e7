"""What is sound: small files of each kind, made when they are first asked for."""

import io
import json
import tempfile
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
from PIL import Image

from gaitwright.bench.evidence.learner import unkilled
from gaitwright.control.balance_file import as_text
from gaitwright.control.balance_rules import BalanceRule, BalanceRules
from gaitwright.control.comparator import QUANTITIES
from gaitwright.description.load import load_robot
from gaitwright.gait.leg_cycles.files import BUILT_IN
from gaitwright.ground.scene import load_scene
from gaitwright.knowledge.json_form import dumps
from gaitwright.learning.map_books import notes_of
from gaitwright.locomotion import Brain
from gaitwright.model.catalogue import robot_file, robot_names
from gaitwright.model.urdf import write_urdf
from gaitwright.navigation.learned_map import LearnedMap
from gaitwright.plant.kinematic import KinematicPlant
from gaitwright.session import walk
from gaitwright.signals import Mission
from gaitwright.skillbook.book import Skillbook, export_text
from gaitwright.skills.chooser import fixed_skill

LESSONS = 12
BOXES = [
    {"x": 1.0 + 0.4 * k, "y": 0.3 * k - 0.6, "yaw": 0.2 * k, "lx": 0.3, "ly": 0.2, "height": 0.05 * k + 0.02}
    for k in range(6)
]  # fmt: skip
SCENES = (
    {},
    {"name": "yard", "surface": {"type": "slope", "pitch": 0.1, "cross": -0.05}, "friction": 0.6},
    {"boxes": BOXES, "bounds": [-3, -3, 6, 3], "start": [0, 0, 0.2]},
    {"surface": {"type": "heights", "x_min": -4, "y_min": -4, "spacing": 2.0, "heights": [[0, 0.1] * 4] * 5}},
)


ROUND_HOLE = {"outline": {"type": "circle", "x": 2, "y": 1, "radius": 0.3}, "depth": 0.3}
CORNERED = [[3, -1], [4, -1], [4, 0], [3.5, -0.7], [3, 0]]
SHAPES = [
    {"type": "cylinder", "x": 1, "y": 1, "radius": 0.2, "height": 0.5},
    {"type": "pyramid", "x": 2, "y": -2, "yaw": 0.3, "lx": 1, "ly": 0.8, "height": 0.2, "top": 0.4},
    {"type": "wedge", "x": 4, "y": 2, "lx": 1, "ly": 0.8, "height": 0.2},
    {"type": "sphere", "x": -2, "y": 1, "radius": 0.4, "height": 0.3},
    {"type": "prism", "outline": CORNERED, "height": 0.3, "base": 0.1},
    {"type": "box", "x": 5, "y": -2, "lx": 0.3, "ly": 0.2, "height": 0.05},
]
NET = {"x_min": -4, "y_min": -4, "spacing": 2.0, "heights": [[0, 0.1, 0.0, 0.2, 0, 0.1, 0]] * 4}
SCENES += (
    {"shapes": SHAPES, "goal": [5, 1]},
    {"holes": [ROUND_HOLE, {"outline": CORNERED, "depth": 0.2}], "surface": {"type": "slope", "pitch": 0.1}},
    {"surface": {"type": "cardinal", "tension": 0.3, **NET}, "holes": [ROUND_HOLE]},
    {"surface": {"type": "bezier", **NET}, "patches": [{"outline": CORNERED, "friction": 0.2}]},
    {
        "surface": {
            "type": "image",
            "file": "sound.png",
            "across": 14,
            "relief": 0.5,
            "x_min": -4,
            "y_min": -4,
        }
    },
)


def scenes() -> tuple[bytes, ...]:
    return tuple(json.dumps(scene).encode() for scene in SCENES)


@cache
def height_maps() -> tuple[bytes, ...]:
    """Grey pictures of 8 and of 16 bits."""
    grey = np.add.outer(np.arange(12), np.arange(16)) / 26.0
    return tuple(
        png(Image.fromarray((grey * white).astype(kind)))
        for kind, white in ((np.uint8, 255), (np.uint16, 65535))
    )


def png(image: Image.Image) -> bytes:
    """A picture as a PNG file."""
    out = io.BytesIO()
    image.save(out, format="PNG")
    return out.getvalue()


def cycles() -> tuple[bytes, ...]:
    return tuple(path.read_bytes() for path in sorted(BUILT_IN.glob("*.json")))


def mjcfs() -> tuple[bytes, ...]:
    return tuple(robot_file(name).read_bytes() for name in robot_names())


@cache
def urdfs() -> tuple[bytes, ...]:
    return tuple(write_urdf(load_robot(name)).encode() for name in ("go2", "hexapod"))


@cache
def book() -> Skillbook:
    """A book of some lessons, and with a map."""
    block = [(1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0)]
    learned = LearnedMap.of_polygons((-1.0, -1.0, 3.0, 3.0), 0.2, [block]).walked([(0.0, 0.0), (0.0, 2.0)])
    return replace(unkilled(1, LESSONS), maps=(notes_of(learned, "a block (seed 0)"),))


def texts() -> tuple[bytes, ...]:
    return (export_text(book()).encode(),)


def rulebooks() -> tuple[bytes, ...]:
    return (dumps(book().rulebook),)


@cache
def skillbooks() -> tuple[bytes, ...]:
    with tempfile.TemporaryDirectory() as folder:
        return (book().save(Path(folder) / "sound.skills").read_bytes(),)


def routes() -> tuple[bytes, ...]:
    """A route as CSV and as JSON."""
    stops = [{"x": 1.0, "y": 0.2, "speed": 0.4}, {"x": 2.0, "y": -0.5, "wait": 1.5}]
    csv = b"# rounds\nx,y,speed,wait\n1,0.2,0.4,\n2,-0.5,,1.5\n-1,0,0.6,0\n"
    return csv, json.dumps({"stops": stops}).encode()


def commands() -> tuple[bytes, ...]:
    """A person's commands as CSV and as JSON."""
    rows = [{"time": 0, "forward": 0.4}, {"time": 1.5, "left": -0.1, "turn": 0.3}, {"time": 3}]
    csv = b"time,forward,left,turn\n0,0.4,0,0\n1.5,0,-0.1,0.3\n3,0,0,0\n"
    return csv, json.dumps({"commands": rows}).encode()


def balances() -> tuple[bytes, ...]:
    """Rules of balance, in two skills and in all."""
    bands = dict.fromkeys(QUANTITIES, 0.2)
    rules = (
        BalanceRule((0, 0, 0, 0, 1, 0), "stop"),
        BalanceRule((0, 1, 0, 0, 0, -1), "slower", ("walk", "run")),
    )
    return (as_text(BalanceRules(bands, rules)).encode(),)


@cache
def recordings() -> tuple[bytes, ...]:
    """A walk of some ticks, without mechanics, with what the terrain scanner held."""
    robot, scene = load_robot("go2"), load_scene("flat")
    brain = Brain.of(robot, scene, fixed_skill(robot, "walk", 0.2, 0.0, 0.0, "kinematic"))
    mission = Mission((), driver="kinematic")
    done = walk(brain, KinematicPlant(robot, scene), mission, 0.06, scene="flat", previews=True)
    with tempfile.TemporaryDirectory() as folder:
        return (done.save(Path(folder) / "sound.npz").read_bytes(),)
