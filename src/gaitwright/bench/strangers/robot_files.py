"""Which files of a folder are whole robots, and which have legs of three hinges, by their XML alone.

What is counted here does not go by what `description` makes of a file: one that is refused counts as well.
"""

import hashlib
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from gaitwright.description.xmlfile import MAX_BYTES, Reader, read_tree
from gaitwright.errors import BadFile

SUFFIXES = (".urdf", ".xml", ".mjcf")
LEGS = (4, 6, 8)
"""A robot with so many limbs of three hinges has legs of them."""
LEG = 3
"""Hinges of a leg."""
STILL = ("fixed", "floating")
"""Joints of a URDF that are no hinges."""


@dataclass(frozen=True, slots=True)
class RobotFile:
    """A file that is a whole robot: it has joints that move, and is no copy of another one."""

    path: Path
    name: str
    """Its path within the folder."""
    legs: int
    """Limbs of exactly three hinges in a row."""


@dataclass(frozen=True, slots=True)
class Limbs:
    """The joints that hang on one body, limb by limb: how many there are, and whether they are in a row."""

    joints: int
    in_a_row: bool

    @property
    def is_leg(self) -> bool:
        return self.in_a_row and self.joints == LEG


def robot_files(folder: Path) -> tuple[list[RobotFile], int]:
    """The whole robots below a folder, each once, by name; and how many other files lie there.

    Others are parts of robots, scenes around them, objects, what is no XML, and copies.
    """
    paths = sorted(path for path in folder.rglob("*") if path.suffix.lower() in SUFFIXES and path.is_file())
    found, seen = [], set()
    for path in paths:
        legs = legs_in(path)
        content = hashlib.sha256(path.read_bytes()).digest() if legs is not None else b""
        if legs is not None and content not in seen:
            seen.add(content)
            found.append(RobotFile(path, path.relative_to(folder).as_posix(), legs))
    return found, len(paths) - len(found)


def legs_in(path: Path) -> int | None:
    """How many limbs of three hinges a file has; `None` where it is no robot of its own."""
    try:
        if path.stat().st_size > MAX_BYTES or is_scene(path):
            return None
        tree = read_tree(path)
        return of_mjcf(tree) if tree.tag == "mujoco" else of_urdf(tree)
    except (BadFile, OSError, RecursionError):
        return 0 if path.suffix.lower() == ".urdf" else None


def is_scene(path: Path) -> bool:
    """Whether a file puts other ones together and has no joints of its own: ground and light, or parts."""
    root = Reader(path.parent).read(path)
    includes = next(root.iter("include"), None) is not None
    return (
        root.tag == "mujoco" and includes and not any(b.find("joint") is not None for b in root.iter("body"))
    )


# --- URDF ------------------------------------------------------------------------------------------
def of_urdf(root: ET.Element) -> int | None:
    """Limbs of three hinges of a URDF's root link, or of one of several."""
    joints = [(end(j, "parent"), end(j, "child"), j.get("type") in STILL) for j in root.findall("joint")]
    if all(still for _, _, still in joints):
        return None
    children: dict[str, list[tuple[str, bool]]] = {}
    for parent, child, still in joints:
        children.setdefault(parent, []).append((child, still))
    roots = children.keys() - {child for _, child, _ in joints}
    return max((sum(limb.is_leg for limb in limbs(root, children)) for root in roots), default=0)


def end(joint: ET.Element, which: str) -> str:
    found = joint.find(which)
    return "" if found is None else found.get("link", "")


def limbs(
    link: str, children: dict[str, list[tuple[str, bool]]], above: tuple[str, ...] = ()
) -> Iterator[Limbs]:
    """What hangs on a link and what is fixed to it; `above`: links that a loop would come back to."""
    trunk = [link]
    for part in trunk:
        for child, still in children.get(part, ()):
            if child in trunk or child in above:
                continue
            if still:
                trunk.append(child)
            else:
                below = list(limbs(child, children, (*above, *trunk)))
                yield Limbs(1 + sum(limb.joints for limb in below), is_row(below))


def is_row(below: list[Limbs]) -> bool:
    """Whether what follows a joint is one row of joints at most."""
    return len(below) <= 1 and all(limb.in_a_row for limb in below)


# --- MJCF ------------------------------------------------------------------------------------------
def of_mjcf(root: ET.Element) -> int | None:
    """Limbs of three hinges of the world, what stands in it or floats, the most; `None` without hinges."""
    worlds = root.findall("worldbody")
    bodies = [body for world in worlds for body in world.iter("body")]
    if not any(hinges_of(body) for body in bodies):
        return None
    standing = [body for world in worlds for body in world.findall("body")]
    floating = [body for body in bodies if body.find("freejoint") is not None]
    return max(sum(limb.is_leg for limb in limbs_of(body)) for body in [*worlds, *standing, *floating])


def hinges_of(body: ET.Element) -> int:
    """Joints of one body by which a limb moves."""
    return sum(joint.get("type") not in ("free", "ball") for joint in body.findall("joint"))


def limbs_of(body: ET.Element) -> Iterator[Limbs]:
    """What hangs on a body and what is fixed to it."""
    trunk = [body]
    for part in trunk:
        for child in part.findall("body"):
            if hinges_of(child):
                yield limb_of(child)
            elif child.find("freejoint") is None and child.find("joint") is None:
                trunk.append(child)


def limb_of(body: ET.Element) -> Limbs:
    """The limb that begins with a body's joints."""
    below = list(limbs_of(body))
    joints = hinges_of(body) + sum(limb.joints for limb in below)
    return Limbs(joints, is_row(below))
