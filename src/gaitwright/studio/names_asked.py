"""Whether a page may ask for a robot or a scene: those that come along, and what the command line named."""

from gaitwright.errors import unknown
from gaitwright.ground.scenes_list import parse
from gaitwright.model.catalogue import robot_names
from gaitwright.studio.messages import Reset
from gaitwright.studio.setup import Setup


def check_names(said: Reset, own: Setup) -> None:
    """Raises `WrongUse` for a file that the command line did not name: a page names none."""
    if said.robot not in (None, own.robot, *robot_names()):
        raise unknown("robot", str(said.robot), robot_names())
    if said.scene not in (None, own.scene):
        parse(str(said.scene))
