"""Scenes in the size of a robot, and the scene that a recording was made in."""

from dataclasses import replace

from gaitwright.errors import GaitwrightError
from gaitwright.ground.scene import Scene, load_scene
from gaitwright.model.robot import Robot
from gaitwright.record.recording import Recording
from gaitwright.skills.library import REFERENCE_HEIGHT

DOG_SIZED = 0.6
"""Robots up to this height [m] walk in scenes as they are."""


def scene_scale(robot: Robot) -> float:
    """What the lengths of built-in scenes are multiplied by: the robot's height / 0.29 m, but for dogs."""
    return 1.0 if robot.height <= DOG_SIZED else float(round(robot.height / REFERENCE_HEIGHT))


def scene_for(robot: Robot, name_or_path: str, seed: int = 0) -> Scene:
    """A scene of that name in a robot's size, or one from a file as it is."""
    return load_scene(name_or_path, seed, scene_scale(robot))


def scene_of(recording: Recording) -> Scene | str:
    """The scene that a recording names, or a sentence on why it cannot be had.

    A recording has the name of its scene and the seed, which is all of a built-in one; of a scene from a
    file it has the name alone.
    """
    try:
        return rearranged(scene_for(recording.robot, recording.scene, recording.seed), recording)
    except GaitwrightError as error:
        return str(error)


def rearranged(scene: Scene, recording: Recording) -> Scene:
    """A scene with what stood and moved in it while it was recorded."""
    boxes = scene.boxes if recording.boxes is None else recording.boxes
    return replace(scene, boxes=boxes, movers=recording.movers)
