"""`gaitwright scenes --plot`: scenes by name or file, drawn from above."""

from argparse import Namespace
from pathlib import Path

from gaitwright.cli.console import remark, working
from gaitwright.cli.trips import find_robot, find_scene, has
from gaitwright.errors import WrongUse

PICTURE = "runs/scenes.png"
MOST = 60
"""Scenes in one picture."""


def draw(names: list[str], args: Namespace) -> None:
    """Draws scenes by name or file into one picture; says where it is."""
    if len(names) > MOST:
        raise WrongUse(f"--plot draws at most {MOST} scenes into a picture, not {len(names)}")
    robot = find_robot(args.robot)
    scenes = [find_scene(name, args.seed, robot) for name in names]
    if not has("matplotlib", "the picture", "plot"):
        return
    path = Path(args.out or PICTURE)
    with working("drawing the scenes", worth_a_line=None):
        from gaitwright.pictures.scenes import scenes_picture  # noqa: PLC0415 - an extra

        scenes_picture(scenes, robot.step_limit, path)
    remark(f"picture: {path}")
