"""What people write in a URDF that its readers disagree about: elements twice, numbers too many, no sizes."""

import math
import xml.etree.ElementTree as ET

from gaitwright.description.aside import listed
from gaitwright.description.xmlfile import keep, placed
from gaitwright.errors import BadFile

SINGLE = {
    "link": {"inertial"},
    "inertial": {"origin", "mass", "inertia"},
    "visual": {"origin", "geometry"},
    "collision": {"origin", "geometry"},
    "joint": {"origin", "parent", "child", "axis", "limit", "dynamics", "mimic"},
}
"""What an element has one of: readers take the first, MuJoCo none."""
THREE = ("xyz", "rpy", "scale", "size")
"""Attributes of three numbers."""
WORLD = "world"
SIZES = {"sphere": ("radius",), "cylinder": ("radius", "length"), "box": ("size",), "mesh": ("filename",)}
"""Attributes without which a shape has no size."""


def first_of_each(root: ET.Element) -> tuple[str, ...]:
    """Leaves out what is there twice and may be there once, but for the first; a sentence about it."""
    dropped = []
    for element, where in list(placed(root)):
        seen: set[str] = set()
        for child in list(element):
            if child.tag in seen:
                element.remove(child)
                dropped.append(f"<{child.tag}> of {where}")
            elif child.tag in SINGLE.get(element.tag, ()):
                seen.add(child.tag)
    return (f"of what is there twice, the first one counts: {listed(dropped)}",) if dropped else ()


def check_words(root: ET.Element) -> tuple[str, ...]:
    """Raises `BadFile` for a joint whose links are not in the file, and for too few numbers.

    What hangs on the world is the root, also where the world is no link of the file. Of more than three
    numbers the first three count; a sentence about it.
    """
    links = {link.get("name") for link in root.findall("link")}
    if WORLD not in links:
        keep(root, lambda child: child.tag != "joint" or parent_of(child) != WORLD)
    for joint in root.findall("joint"):
        for which in ("parent", "child"):
            found = joint.find(which)
            named = None if found is None else found.get("link")
            if named not in links:
                what = "none" if named is None else f"{named!r}, which is not in the file"
                raise BadFile(f"the {which} link of joint {joint.get('name', '')!r} is {what}")
    long = []
    for element, where in placed(root):
        for name in THREE:
            words = element.get(name, "0 0 0").split()
            if len(words) < 3:
                raise BadFile(
                    f"{name}={element.get(name)!r} of {where}: expected three numbers apart by spaces"
                )
            if len(words) > 3:
                element.set(name, " ".join(words[:3]))
                long.append(f"{name} of {where}")
    return (f"of more than three numbers the first three count: {listed(long)}",) if long else ()


def parent_of(joint: ET.Element) -> str | None:
    """The link that a joint hangs on."""
    parent = joint.find("parent")
    return None if parent is None else parent.get("link")


def is_sized(shape: ET.Element) -> bool:
    """Whether a collision or visual shape has a size; one that has none is as if it were not there."""
    form = next(iter(shape.find("geometry") or ()), None)
    if form is None or form.tag not in SIZES:
        return form is not None
    values = [form.get(name, "") for name in SIZES[form.tag]]
    return all(values) and (form.tag == "mesh" or all(map(is_positive, " ".join(values).split())))


def is_positive(word: str) -> bool:
    """Whether a word is a number above zero; what is no number is for others to refuse."""
    try:
        return float(word) > 0.0 or math.isnan(float(word))
    except ValueError:
        return True
