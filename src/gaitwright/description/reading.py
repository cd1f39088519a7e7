"""A robot's file → `Robot` and its notes: the one place where the sentences of all steps come together."""

from collections.abc import Mapping
from pathlib import Path

from gaitwright.description.aside import listed
from gaitwright.description.derive import derive
from gaitwright.description.feet import NoFoot
from gaitwright.description.mujoco_model import ModelRead, read_model
from gaitwright.errors import BadFile
from gaitwright.model.robot import Robot


def read_robot(path: Path, packages: Mapping[str, Path] | None = None) -> tuple[Robot, tuple[str, ...]]:
    """The robot in an MJCF or URDF file, and a sentence about each thing that was mended or derived.

    `packages`: folders in which its meshes may be too, by name. Raises `BadFile` with what is wrong, without
    the file's name.
    """
    read = read_model(path, packages)
    try:
        return described(read, path.stem)
    except NoFoot:
        read = read_model(path, packages, visuals=True)
    robot, notes = described(read, path.stem)
    return robot, (
        *notes,
        "where links have no collision shape of their own, feet are found on their visual ones",
    )


def described(read: ModelRead, name: str) -> tuple[Robot, tuple[str, ...]]:
    """The robot in a model; where it has none, the error says what of the file was left out."""
    try:
        robot, notes = derive(read.model, name, read.aside.rates)
    except NoFoot as error:
        lost = [link for link in error.links if link in read.meshes.lost]
        if not lost:
            raise
        why = read.meshes.why(read.meshes.lost[lost[0]])
        raise NoFoot(f"{error}; of link {lost[0]!r}, {why}", error.links) from error
    except BadFile as error:
        if not read.aside.loops:
            raise
        raise BadFile(f"{error}; its file closes loops of links ({listed(read.aside.loops)})") from error
    return robot, read.notes + notes
