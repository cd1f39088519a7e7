"""A robot's file → a compiled MuJoCo model with no more meshes than its numbers need (row R2)."""

import re
import xml.etree.ElementTree as ET
from pathlib import Path

import mujoco

from gaitwright.description.xmlfile import inside, read_tree
from gaitwright.errors import BadFile

MESH_SUFFIXES = (".obj", ".stl", ".msh")


def compiled(path: Path) -> mujoco.MjModel:
    """The model in an MJCF or URDF file. Raises `BadFile`, without the file's name."""
    return read_model(path)[0]


def read_model(path: Path) -> tuple[mujoco.MjModel, tuple[str, ...]]:
    """The model in an MJCF or URDF file, and a sentence about each thing that had to be mended.

    Raises `BadFile`, without the file's name.
    """
    tree = read_tree(path)
    text = ET.tostring(tree, encoding="unicode")
    try:
        spec = mujoco.MjSpec.from_string(text)
    except (ValueError, mujoco.FatalError) as error:
        raise refused(error) from error
    if tree.tag == "robot":
        let_float(spec)
    drop_meshes(spec, path.parent)
    try:
        return spec.compile(), ()
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


def drop_meshes(spec: mujoco.MjSpec, folder: Path) -> None:
    """Deletes the meshes that no mass hangs on and that are not the only shape of their body.

    Those that stay must be files of the folder. Raises `BadFile` where a mass hangs on one that is not.
    """
    files = {mesh.name: mesh_file(spec, mesh, folder) for mesh in spec.meshes}
    for geom in list(spec.geoms):
        if geom.type in (mujoco.mjtGeom.mjGEOM_HFIELD, mujoco.mjtGeom.mjGEOM_SDF):
            spec.delete(geom)
        elif geom.meshname:
            there = files.get(geom.meshname) is not None
            if weighs(spec, geom) and not there:
                raise BadFile(
                    f"body {geom.parent.name!r} takes its mass from mesh {geom.meshname!r}, "
                    "which is not an OBJ, STL or MSH file inside the file's own folder"
                )
            if not weighs(spec, geom) and not (there and is_only_shape(geom)):
                spec.delete(geom)
    used = {geom.meshname for geom in spec.geoms}
    for mesh in list(spec.meshes):
        if mesh.name not in used:
            spec.delete(mesh)
        elif mesh.file:
            mesh.file = files[mesh.name]
    spec.meshdir, spec.strippath = "", False


def mesh_file(spec: mujoco.MjSpec, mesh, folder: Path) -> str | None:
    """Absolute path of a mesh inside the folder; empty for one that is written out; `None` if unusable."""
    if not mesh.file:
        return ""
    name = Path(mesh.file).name if spec.strippath else mesh.file
    path = inside(folder, str(Path(spec.meshdir) / name))
    return str(path) if path is not None and path.suffix.lower() in MESH_SUFFIXES else None


def weighs(spec: mujoco.MjSpec, geom) -> bool:
    """Whether MuJoCo will take mass from a shape."""
    rule = spec.compiler.inertiafromgeom
    asked = rule == 1 or (rule == 2 and not geom.parent.explicitinertial)
    low, high = spec.compiler.inertiagrouprange
    return bool(asked and low <= geom.group <= high and geom.mass != 0.0 and geom.density != 0.0)


def is_only_shape(geom) -> bool:
    """Whether no plain solid shape stands for the body that has this mesh."""
    plain = [g for g in geom.parent.geoms if not g.meshname and (g.contype or g.conaffinity)]
    return not plain
