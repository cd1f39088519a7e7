"""At a first run kernels are compiled, which takes a minute: a second process takes half of that on itself.

numba compiles in one thread. What the numerical controller and the watch are made of is known before
anything moves; so while a run compiles what comes before them, `python -m gaitwright.compiled_ahead` compiles
these, and the run finds them done (`numerics.compiled.alone`). After that it compiles what other drivers
need, which may be asked for later.
"""

import subprocess
import sys
from contextlib import suppress

import numpy as np

from gaitwright.control.numerical import NumericalController
from gaitwright.description.load import load_robot
from gaitwright.ground.scene import load_scene
from gaitwright.locomotion import Brain
from gaitwright.numerics.compiled import is_warm
from gaitwright.perception.watch import Watch
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.session import walk
from gaitwright.signals import Measured, Mission, MotionTarget
from gaitwright.workers import cores


def begin() -> bool:
    """Whether there is something to compile; then it is begun where there is a core for it, and nobody waits
    for its end."""
    if is_warm():
        return False
    if cores() < 2:
        return True
    command, quiet = [sys.executable, "-P", "-m", "gaitwright.compiled_ahead"], subprocess.DEVNULL
    with suppress(OSError):  # then the run does it all
        subprocess.Popen(command, stdin=quiet, stdout=quiet, stderr=quiet)
    return True


def compile_control() -> None:
    """A tick of control and two of the watch, for a robot that floats at the origin: any numbers do."""
    robot = load_robot("go2")
    row = np.zeros(Measured.layout.size(robot.n))
    measured = Measured.of_row(row, time=0.0, specific_force_b=(0.0, 0.0, 9.81))
    measured.orientation_wb[0] = 1.0
    target = MotionTarget.of_row(np.zeros(MotionTarget.layout.size(robot.n)))
    target.rotation_wb[:] = np.eye(3)
    target.stance[:] = 1.0
    command, _ = NumericalController(robot).command(target, measured)
    watch = Watch(robot, 0.002)
    _, memory = watch.check(measured, measured, None)
    watch.check(measured, measured, watch.heard(memory, target, command, measured))


def compile_drivers() -> None:
    """Some ticks of a walk by drivers that do not solve the dynamics."""
    robot, scene = load_robot("go2"), load_scene("flat")
    for driver in ("kinematic", "programmed"):
        walk(Brain.of(robot, scene), MujocoPlant(robot, scene), Mission(((1.0, 0.0),), driver=driver), 0.02)


if __name__ == "__main__":
    compile_control()
    compile_drivers()
