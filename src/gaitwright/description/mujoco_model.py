"""A robot's file → a compiled MuJoCo model, mended where files often are wrong, and notes of it (row R2)."""

import re
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import mujoco

from gaitwright.description.aside import Aside, aside_of, notes_of
from gaitwright.description.floating import let_trunk_float
from gaitwright.description.inertias import give_masses, mend_inertias, take_masses
from gaitwright.description.locking import lock
from gaitwright.description.meshes import Meshes
from gaitwright.description.shapes import drop_meshes, let_be_flat
from gaitwright.description.urdf import plain_urdf
from gaitwright.description.xmlfile import check_numbers, plain_mjcf, read_tree
from gaitwright.errors import BadFile

NO_VOLUME = "volume is too small"
"""What MuJoCo says of a flat mesh."""


class ModelRead(NamedTuple):
    """A model, and what was found out on the way to it."""

    model: mujoco.MjModel
    notes: tuple[str, ...]
    """A sentence about each thing that had to be mended."""
    aside: Aside
    meshes: Meshes


def compiled(path: Path) -> mujoco.MjModel:
    """The model in an MJCF or URDF file. Raises `BadFile`, without the file's name."""
    return read_model(path).model


def read_model(path: Path, packages: Mapping[str, Path] | None = None, visuals: bool = False) -> ModelRead:
    """The model in an MJCF or URDF file. Raises `BadFile`, without the file's name.

    `packages`: folders in which meshes may be too, by name; `visuals`: in a URDF, what a link looks like
    stands for collision shapes that it lacks.
    """
    meshes = Meshes(path.parent, packages or {})
    tree = read_tree(path, meshes.allowed)
    aside = aside_of(tree)
    mended: tuple[str, ...] = ()
    if tree.tag == "mujoco":
        tree = plain_mjcf(tree)
    else:
        tree, mended = plain_urdf(tree, meshes, visuals)
    check_numbers(tree)
    try:
        spec = mujoco.MjSpec.from_string(ET.tostring(tree, encoding="unicode"))
    except (ValueError, mujoco.FatalError) as error:
        raise refused(error) from error
    if tree.tag == "robot":
        let_float(spec)
    drop_meshes(spec, meshes)
    notes, given = mended + mend_inertias(spec), give_masses(spec)
    model = compile_(spec)
    for change in (let_trunk_float, lambda spec, m: lock(spec, m, aside)):
        changed = change(spec, model)
        if changed:
            notes, model = notes + changed, compile_(spec)
    if given:
        notes += take_masses(spec, given)
        model = compile_(spec)
    return ModelRead(model, notes + notes_of(aside), aside, meshes)


def compile_(spec: mujoco.MjSpec) -> mujoco.MjModel:
    """The model that a spec is of; a mesh that is flat is taken as a shell."""
    try:
        return spec.compile()
    except (ValueError, mujoco.FatalError) as error:
        if NO_VOLUME not in str(error):
            raise refused(error) from error
    let_be_flat(spec)
    try:
        return spec.compile()
    except (ValueError, mujoco.FatalError) as error:
        raise refused(error) from error


def refused(error: Exception) -> BadFile:
    """MuJoCo's own first line, and the element it names further down, as our error."""
    lines = str(error).strip().splitlines() or ["no reason given"]
    named = re.search(r"Element name '(.+?)'", str(error))
    where = f" (element {named[1]!r})" if named else ""
    reason = lines[0].removeprefix("XML Error: ").removeprefix("Error: ")
    return BadFile(f"MuJoCo refuses it: {reason}{where}")


def let_float(spec: mujoco.MjSpec) -> None:
    """URDF's view of things: the root link floats, fixed links keep their names, shapes weigh nothing."""
    spec.compiler.fusestatic = False
    root = spec.worldbody.first_body()
    free = mujoco.mjtJoint.mjJNT_FREE
    if root is None:
        raise BadFile("it has one link only; expected a floating body with legs")
    if not any(joint.type == free for joint in spec.joints):
        root.add_freejoint()
    for geom in spec.geoms:
        geom.mass = 0.0
