"""A robot's file → `Robot` and its notes: the one place where the sentences of all steps come together."""

from pathlib import Path

from gaitwright.description.derive import derive
from gaitwright.description.mujoco_model import read_model
from gaitwright.model.robot import Robot


def read_robot(path: Path) -> tuple[Robot, tuple[str, ...]]:
    """The robot in an MJCF or URDF file, and a sentence about each thing that was mended or derived.

    Raises `BadFile` with what is wrong, without the file's name.
    """
    model, of_file = read_model(path)
    robot, of_robot = derive(model, path.stem)
    return robot, of_file + of_robot
