"""Gaitwright teaches legged robots to move, by rules you can read.

    Mission ─► navigation ─► Route ─► skills ─► SkillCall ─► gait ─► MotionTarget ─► control ─► MotorCommand
                   ▲                    ▲                     ▲                         ▲                │
                   └────────────────────┴─ Sensed, GroundMap ─┴─────────────────────────┘              plant
                                                   ▲                                                     │
                                               perception ◄──────────────── Measured ◄───────────────────┘

One frozen value per arrow (`signals`), one folder per stage, one lap in `locomotion.think`. Names are
loaded when they are first used: importing this package costs milliseconds.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gaitwright.description.load import load_robot as load_robot
    from gaitwright.errors import BadFile as BadFile
    from gaitwright.errors import GaitwrightError as GaitwrightError
    from gaitwright.errors import WrongUse as WrongUse
    from gaitwright.gait.leg_cycles.files import load_cycle as load_cycle
    from gaitwright.gait.leg_cycles.leg_cycle import LegCycle as LegCycle
    from gaitwright.ground.scene import Scene as Scene
    from gaitwright.ground.scene import load_scene as load_scene
    from gaitwright.locomotion import Brain as Brain
    from gaitwright.missions import Programme as Programme
    from gaitwright.missions import Steering as Steering
    from gaitwright.missions import Stop as Stop
    from gaitwright.missions import Velocity as Velocity
    from gaitwright.model.robot import Robot as Robot
    from gaitwright.plant.mujoco.simulation import MujocoPlant as MujocoPlant
    from gaitwright.record.recording import Recording as Recording
    from gaitwright.record.recording import Report as Report
    from gaitwright.session import Session as Session
    from gaitwright.session import walk as walk
    from gaitwright.signals import Gait as Gait
    from gaitwright.signals import GroundMap as GroundMap
    from gaitwright.signals import Measured as Measured
    from gaitwright.signals import Mission as Mission
    from gaitwright.signals import MotionTarget as MotionTarget
    from gaitwright.signals import MotorCommand as MotorCommand
    from gaitwright.signals import Route as Route
    from gaitwright.signals import Sensed as Sensed
    from gaitwright.signals import SkillCall as SkillCall
    from gaitwright.signals import Torques as Torques
    from gaitwright.skillbook.book import Skillbook as Skillbook

    __version__: str

_ROOMS = {
    "errors": ("BadFile", "GaitwrightError", "WrongUse"),
    "gait.leg_cycles.files": ("load_cycle",),
    "gait.leg_cycles.leg_cycle": ("LegCycle",),
    "locomotion": ("Brain",),
    "missions": ("Programme", "Steering", "Stop", "Velocity"),
    "model.robot": ("Robot",),
    "ground.scene": ("Scene", "load_scene"),
    "description.load": ("load_robot",),
    "plant.mujoco.simulation": ("MujocoPlant",),
    "record.recording": ("Recording", "Report"),
    "session": ("Session", "walk"),
    "signals": (
        *("Gait", "GroundMap", "Measured", "Mission", "MotionTarget", "MotorCommand"),
        *("Route", "Sensed", "SkillCall", "Torques"),
    ),
    "skillbook.book": ("Skillbook",),
}
_HOME = {name: f"gaitwright.{room}" for room, names in _ROOMS.items() for name in names}


def __getattr__(name: str) -> object:
    """A public name, fetched from its home at first use."""
    if name == "__version__":
        from importlib.metadata import version  # noqa: PLC0415 - costs more than all the rest here

        value = version("gaitwright")
    elif name in _HOME:
        value = getattr(import_module(_HOME[name]), name)
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOME, "__version__"})
