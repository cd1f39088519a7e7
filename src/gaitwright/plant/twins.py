"""A plant like another one, as it is now, that can be stepped without the other's notice."""

import copy

from gaitwright.errors import WrongUse
from gaitwright.model.robot import Robot
from gaitwright.plant.faults import FaultyPlant
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.plant.mujoco.twin import placed_as, twin_of
from gaitwright.plant.seeing import SeeingPlant
from gaitwright.signals import Measured
from gaitwright.stages import Plant, SimulatedPlant


def twin(plant: Plant, robot: Robot, measured: Measured) -> SimulatedPlant:
    """What would happen on a plant, to be seen in physics; `measured`: by it, just now.

    A camera is left out, since what is not on the map yet is not there for the robot; breakdowns and
    imperfect sensors stay. What is no MuJoCo plant is taken over into one as it was measured. Raises
    `WrongUse` for a plant of which nobody knows where it is.
    """
    if isinstance(plant, SeeingPlant):
        return twin(plant.plant, robot, measured)
    if isinstance(plant, FaultyPlant):
        return broken_alike(plant, twin(plant.plant, robot, plant.truth))
    if isinstance(plant, MujocoPlant):
        return twin_of(plant)
    scene = getattr(plant, "scene", None)
    if scene is None:
        raise WrongUse(f"a {type(plant).__name__} tells nobody what is around it: there is no preview")
    return placed_as(robot, scene, measured, plant.dt)


def broken_alike(plant: FaultyPlant, inner: SimulatedPlant) -> FaultyPlant:
    """What is broken before an inner plant as before another one, up to the next random number."""
    out = copy.copy(plant)
    out.plant, out.random = inner, copy.deepcopy(plant.random)
    out.old, out.kept = plant.old.copy(), plant.kept.copy()
    out.differs, out.shown = plant.differs.copy(), plant.shown.copy()
    return out
