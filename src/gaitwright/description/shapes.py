"""Which shapes of a model are kept: those that give a body its mass, or are the only one that it has."""

from pathlib import Path

import mujoco

from gaitwright.description.meshes import Meshes, is_read_by_mujoco
from gaitwright.description.vertices import vertices_of
from gaitwright.errors import BadFile


def drop_meshes(spec: mujoco.MjSpec, meshes: Meshes) -> None:
    """Deletes the meshes that no mass hangs on and that are not the only shape of their body.

    Those that stay must be files that may be read. Raises `BadFile` where a mass hangs on one that is not: of
    those that we read and MuJoCo does not there are corners only.
    """
    files = {mesh.name: mesh_file(spec, mesh, meshes) for mesh in spec.meshes}
    names = {mesh.name: mesh.file for mesh in spec.meshes}
    for geom in list(spec.geoms):
        if geom.type in (mujoco.mjtGeom.mjGEOM_HFIELD, mujoco.mjtGeom.mjGEOM_SDF):
            spec.delete(geom)
        elif geom.meshname:
            path = files.get(geom.meshname)
            there = path is not None
            if weighs(spec, geom) and not (there and (path == "" or is_read_by_mujoco(Path(path)))):
                why = meshes.why(names.get(geom.meshname, geom.meshname))
                raise BadFile(f"body {geom.parent.name!r} takes its mass from mesh {geom.meshname!r}: {why}")
            if not there and is_only_shape(geom):
                meshes.lost[geom.parent.name] = names.get(geom.meshname, geom.meshname)
            if not weighs(spec, geom) and not (there and is_only_shape(geom)):
                spec.delete(geom)
    used = {geom.meshname for geom in spec.geoms}
    for mesh in list(spec.meshes):
        if mesh.name not in used:
            spec.delete(mesh)
        elif path := files[mesh.name]:
            put_mesh(mesh, Path(path))
    spec.meshdir, spec.strippath = "", False


def let_be_flat(spec: mujoco.MjSpec) -> None:
    """Wants no volume of meshes that weigh nothing: flat ones have none."""
    weighing = {geom.meshname for geom in spec.geoms if weighs(spec, geom)}
    for mesh in spec.meshes:
        if mesh.name not in weighing:
            mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL


def put_mesh(mesh, path: Path) -> None:
    """Lets MuJoCo read a mesh from its file, or hands it the corners where it cannot."""
    corners = None if is_read_by_mujoco(path) else vertices_of(path)
    if corners is None:
        mesh.file = str(path)
    else:
        mesh.file, mesh.uservert = "", corners.ravel()


def mesh_file(spec: mujoco.MjSpec, mesh, meshes: Meshes) -> str | None:
    """Absolute path of a mesh that may be read; empty for one that is written out; `None` if unusable."""
    if not mesh.file:
        return ""
    path = meshes.find(Path(mesh.file).name if spec.strippath else mesh.file, spec.meshdir)
    return None if path is None else str(path)


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
