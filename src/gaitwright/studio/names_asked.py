"""What a page asks for in a reset → what the next run is of: of names those that come along, and what the
command line named."""

from dataclasses import fields, replace

from gaitwright.errors import unknown
from gaitwright.ground.scenes_list import parse
from gaitwright.model.catalogue import robot_names
from gaitwright.studio.messages import Reset
from gaitwright.studio.setup import Setup


def setup_asked(said: Reset, now: Setup, own: Setup) -> Setup:
    """What is so `now`, with what is asked for; `own`: of the command line. Raises `WrongUse` for a file that
    this did not name: a page names none."""
    if said.robot not in (None, own.robot, *robot_names()):
        raise unknown("robot", str(said.robot), robot_names())
    if said.scene not in (None, own.scene):
        parse(str(said.scene))
    asked = {field.name: getattr(said, field.name) for field in fields(Setup)}
    return replace(now, **{name: value for name, value in asked.items() if value is not None})
