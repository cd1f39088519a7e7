"""An XML file of unknown origin → a plain MJCF tree (URDF: `urdf.py`) that opens nothing and runs nothing.

Only what bears on the numbers of a robot is kept. Includes are spliced in here, so that MuJoCo sees one
text; meshes are still named, `shapes.py` decides which of them are opened.
"""

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from pathlib import Path
from xml.parsers import expat

from gaitwright.errors import BadFile

MAX_BYTES = 20_000_000
"""Largest file that is read, with all that it includes [bytes]."""
MAX_DEPTH = 100
"""Deepest nesting of elements."""

MJCF_SECTIONS = {"compiler", "default", "asset", "worldbody", "actuator", "keyframe"}
MJCF_DROPPED = {
    "camera",
    "light",
    "plugin",
    "material",
    "texture",
    "hfield",
    "skin",
    "model",
    "tendon",
    "equality",
    "pair",
}
MJCF_REFUSED = {"attach", "composite", "flexcomp"}
SHORTEST_AXIS = 1e-14
"""An axis shorter than this has no direction, here as in MuJoCo."""


def read_tree(path: Path, allowed: Sequence[Path] = ()) -> ET.Element:
    """The whole tree of an MJCF or URDF file with what it includes. Raises `BadFile`, without its name.

    `allowed`: folders in which what it includes may be, beside its own.
    """
    reader = Reader(path.parent, allowed)
    root = reader.read(path)
    if root.tag == "mujoco":
        root[:] = reader.expanded(root)
    elif root.tag != "robot":
        raise BadFile(f"its outermost element is <{root.tag}>; expected <mujoco> (MJCF) or <robot> (URDF)")
    return root


def check_numbers(root: ET.Element) -> None:
    """Raises `BadFile` where an attribute holds a number that is none, or a joint's axis has no length."""
    for element, where in placed(root):
        for name, value in element.attrib.items():
            if not all(map(is_finite, value.split())):
                raise BadFile(f"{name}={value!r} of {where} is not finite")
        axis = element.get("axis") or (element.get("xyz") if element.tag == "axis" else None)
        if axis is not None and all(abs(x) < SHORTEST_AXIS for x in numbers_in(axis)):
            raise BadFile(f"the axis {axis!r} of {where} has no length; expected the direction of the hinge")


def placed(element: ET.Element, owner: str = "") -> Iterator[tuple[ET.Element, str]]:
    """An element and all below it, each with the words that say where it is: itself or what it is inside."""
    name = element.get("name")
    where = f"{element.tag} {name!r}" if name else f"<{element.tag}>{owner}"
    yield element, where
    for child in element:
        yield from placed(child, f" in {where}" if name else owner)


def is_finite(word: str) -> bool:
    """Whether a word of an attribute is a finite number, or no number."""
    try:
        return math.isfinite(float(word))
    except ValueError:
        return True


def numbers_in(value: str) -> list[float]:
    """The numbers of an attribute; if they are not numbers, one that is none: MuJoCo will say so."""
    try:
        return [float(word) for word in value.split()]
    except ValueError:
        return [math.nan]


class Reader:
    """Reads the files of a folder and of those allowed, each once, up to `MAX_BYTES` in all."""

    def __init__(self, folder: Path, allowed: Sequence[Path] = ()):
        self.folder, self.allowed = folder, (folder, *allowed)
        self.seen: set[Path] = set()
        self.left = MAX_BYTES

    def read(self, path: Path) -> ET.Element:
        """The element tree of one file."""
        size = path.stat().st_size
        if size > self.left:
            raise BadFile(f"{size} bytes of XML in {path.name!r}; expected at most {MAX_BYTES} in all")
        self.seen.add(path.resolve())
        data = path.read_bytes()
        self.left -= len(data)
        return parsed(declared_first(data))

    def expanded(self, element: ET.Element) -> list[ET.Element]:
        """The children of an element with every `include` replaced by what it names."""
        children = []
        for child in element:
            if child.tag == "include":
                children += self.expanded(self.included(child.get("file", "")))
            else:
                child[:] = self.expanded(child)
                children.append(child)
        return children

    def included(self, name: str) -> ET.Element:
        """The tree of an included file, by its place seen from the first one."""
        path = inside(self.folder, name, self.allowed)
        if path is None:
            raise BadFile(
                f"it includes {name!r}, which is not a file inside its own folder or package; "
                "--package NAME=FOLDER names one more folder"
            )
        if path in self.seen:
            raise BadFile(f"it includes {name!r} twice")
        return self.read(path)


def inside(folder: Path, name: str, allowed: Sequence[Path]) -> Path | None:
    """The existing file `name` seen from a folder; `None` where it is missing or in no folder `allowed`."""
    if not name or "\0" in name or "://" in name:
        return None
    path = (folder / name).resolve()
    may = any(path.is_relative_to(root.resolve()) for root in allowed)
    return path if may and path.is_file() else None


def declared_first(data: bytes) -> bytes:
    """A text with its XML declaration first: many a file has a comment or an empty line before it."""
    end = 0
    while end >= 0 and data[end:].lstrip()[:4] == b"<!--":
        end = data.find(b"-->", end) + 3 or -1
    start = len(data) - len(data[end:].lstrip()) if end >= 0 else 0
    stop = data.find(b"?>", start) + 2
    if start == 0 or data[start : start + 6] != b"<?xml " or stop < 2:
        return data
    return data[start:stop] + data[:start] + data[stop:]


def parsed(data: bytes) -> ET.Element:
    """The tree of an XML text, prefixes of names as written: readers of robots take no notice of namespaces.

    Raises `BadFile` where `data` is not XML, declares a document type or nests too deep.
    """
    builder, depth = ET.TreeBuilder(), 0

    def refuse_doctype(*_):
        raise BadFile("it has a DOCTYPE; expected plain XML without entities")

    def enter(tag, attributes):
        nonlocal depth
        depth += 1
        if depth > MAX_DEPTH:
            raise BadFile(f"its elements nest deeper than {MAX_DEPTH}")
        builder.start(tag, {name: value for name, value in attributes.items() if name[:5] != "xmlns"})

    def leave(tag):
        nonlocal depth
        depth -= 1
        builder.end(tag)

    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = refuse_doctype
    parser.StartElementHandler = enter
    parser.EndElementHandler = leave
    parser.CharacterDataHandler = builder.data
    try:
        parser.Parse(data, True)
    except (expat.ExpatError, ValueError, LookupError) as error:
        raise BadFile(f"not XML: {error}") from error
    return builder.close()


def plain_mjcf(root: ET.Element) -> ET.Element:
    """An MJCF tree with bodies, joints, shapes, joint actuators and keyframes, and nothing else."""
    for element in root.iter():
        if element.tag in MJCF_REFUSED:
            raise BadFile(f"<{element.tag}> is not supported; expected bodies written out")
    keep(root, lambda child: child.tag in MJCF_SECTIONS)
    for element in list(root.iter()):
        keep(element, lambda child: child.tag not in MJCF_DROPPED)
        element.attrib.pop("material", None)
        if element.tag == "joint" and element.get("type") in ("free", "ball"):
            element.attrib.pop("axis", None)
    for actuators in root.findall("actuator"):
        keep(actuators, lambda child: "joint" in child.attrib or "jointinparent" in child.attrib)
    for keyframe in root.findall("keyframe"):
        for key in keyframe:
            key.attrib = {name: value for name, value in key.attrib.items() if name in ("name", "qpos")}
    return root


def keep(element: ET.Element, wanted) -> None:
    """Removes the children that are not wanted."""
    element[:] = [child for child in element if wanted(child)]
