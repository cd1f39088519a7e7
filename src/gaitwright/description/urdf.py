"""A URDF tree → one of links, joints and collision shapes alone, whose meshes have absolute paths."""

import xml.etree.ElementTree as ET

from gaitwright.description.aside import listed
from gaitwright.description.meshes import Meshes
from gaitwright.description.urdf_words import check_words, first_of_each, is_sized
from gaitwright.description.xmlfile import is_finite, keep
from gaitwright.errors import BadFile

URDF_SECTIONS = {"link", "joint", "mujoco"}
URDF_MENDERS = {"balanceinertia", "boundmass", "boundinertia"}
"""MuJoCo's own remedies for the inertias of a URDF, in `<mujoco><compiler …/></mujoco>`."""
URDF_DROPPED = {"visual", "mimic", "safety_controller", "calibration"}
AXISLESS = ("fixed", "floating")
"""Joints whose axes mean nothing."""


def plain_urdf(root: ET.Element, meshes: Meshes, visuals: bool) -> tuple[ET.Element, tuple[str, ...]]:
    """A URDF tree with links, joints and collision shapes and nothing else, and sentences on what was mended.

    Where `visuals`, what a link looks like stands for collision shapes that it lacks.
    """
    if any("xacro" in str(element.tag) for element in root.iter()):
        raise BadFile("it is a xacro template; expected the URDF that xacro makes of it")
    keep(root, lambda child: child.tag in URDF_SECTIONS)
    notes = first_of_each(root) + check_words(root)
    for link in root.findall("link"):
        choose_shapes(link, meshes, visuals)
    for element in list(root.iter()):
        keep(element, lambda child: child.tag not in URDF_DROPPED)
    one_compiler(root)
    for joint in root.findall("joint"):
        if joint.get("type") in AXISLESS:
            keep(joint, lambda child: child.tag != "axis")
    for limit in root.findall("joint/limit"):
        limit.attrib = {name: value for name, value in limit.attrib.items() if is_finite(value)}
    return root, notes + let_go(root)


def one_compiler(root: ET.Element) -> None:
    """One `<mujoco>` section in place of those of the file, with what we tell MuJoCo and its remedies."""
    wanted = {"strippath": "false"}
    for compiler in root.findall("mujoco/compiler"):
        wanted |= {name: value for name, value in compiler.attrib.items() if name in URDF_MENDERS}
    keep(root, lambda child: child.tag != "mujoco")
    ET.SubElement(ET.SubElement(root, "mujoco"), "compiler", wanted)


# --- floating joints -------------------------------------------------------------------------------
def let_go(root: ET.Element) -> tuple[str, ...]:
    """Makes the child of a floating joint the root link, for what is above it is the world; sentences.

    What floats beside the robot and has no joints that move is left out. Raises `BadFile` where several
    parts of a robot float.
    """
    floating = [joint for joint in root.findall("joint") if joint.get("type") == "floating"]
    if not floating:
        return ()
    outwards = {end(joint, "parent"): [] for joint in root.findall("joint")}
    for joint in root.findall("joint"):
        outwards[end(joint, "parent")].append(joint)
    robots = [joint for joint in floating if any(map(moves, below(joint, outwards)))]
    if len(robots) > 1:
        names = listed([repr(joint.get("name", "")) for joint in robots])
        raise BadFile(f"the joints {names} all let a part of it float; expected one robot with one trunk")
    loose = [joint for joint in floating if joint not in robots]
    adrift = loose + [after for joint in loose for after in below(joint, outwards)]
    gone = {end(joint, "child") for joint in adrift}
    keep(root, lambda child: child.tag == "mujoco" or (child not in adrift and owner(child) not in gone))
    if robots:
        links = {end(joint, "child") for joint in [robots[0], *below(robots[0], outwards)]}
        keep(root, lambda child: child.tag == "mujoco" or owner(child) in links)
    names = listed([repr(end(joint, "child")) for joint in loose])
    return (f"the links {names} float beside the robot and are left out",) if loose else ()


def owner(child: ET.Element) -> str | None:
    """The link that a link or joint belongs to."""
    return child.get("name") if child.tag == "link" else end(child, "parent")


def moves(joint: ET.Element) -> bool:
    """Whether a joint is one of a limb."""
    return joint.get("type") not in AXISLESS


def below(joint: ET.Element, outwards: dict[str, list[ET.Element]]) -> list[ET.Element]:
    """All joints that follow one."""
    found, links = [], [end(joint, "child")]
    for link in links:
        following = [after for after in outwards.get(link, ()) if after not in found]
        found += following
        links += [end(after, "child") for after in following]
    return found


def end(joint: ET.Element, which: str) -> str:
    """Name of the `parent` or `child` link of a URDF joint."""
    link = joint.find(which)
    return "" if link is None else link.get("link", "")


def choose_shapes(link: ET.Element, meshes: Meshes, visuals: bool) -> None:
    """Keeps the collision shapes of a link whose meshes are there, by their absolute paths.

    A link whose only shapes are meshes that are missing is entered in `meshes.lost`.
    """
    kept, missing = usable(link.findall("collision"), meshes)
    if not kept and (visuals or missing):
        kept, more = usable(link.findall("visual"), meshes) if visuals else ([], [])
        missing = missing or more
        for shape in kept:
            shape.tag = "collision"
        if not kept and missing:
            meshes.lost[link.get("name", "")] = missing[0]
    keep(link, lambda child: child.tag not in ("collision", "visual") or child in kept)


def usable(shapes: list[ET.Element], meshes: Meshes) -> tuple[list[ET.Element], list[str]]:
    """Those shapes that have a size and are not missing, and the names of the meshes that are."""
    kept, missing = [], []
    for shape in filter(is_sized, shapes):
        mesh = shape.find("geometry/mesh")
        if mesh is not None:
            name = mesh.get("filename", "")
            path = meshes.find(name)
            if path is None:
                missing.append(name)
                continue
            mesh.set("filename", str(path))
        kept.append(shape)
    return kept, missing
