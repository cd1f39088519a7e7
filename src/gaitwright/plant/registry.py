"""A plant by its name: only the one that is asked for is imported."""

from importlib import import_module

from gaitwright.errors import WrongUse, unknown
from gaitwright.ground.scene import Scene
from gaitwright.model.robot import Robot
from gaitwright.plant.names import PLANTS
from gaitwright.stages import SimulatedPlant

HOMES = {
    "mujoco": ("gaitwright.plant.mujoco.simulation", "MujocoPlant"),
    "armstrong": ("gaitwright.plant.armstrong.simulation", "ArmstrongPlant"),
    "kinematic": ("gaitwright.plant.kinematic", "KinematicPlant"),
}


def make_plant(  # noqa: PLR0913 - the door to every plant; most calls name three of these
    name: str,
    robot: Robot,
    scene: Scene,
    dt: float = 0.002,
    integrator: str | None = None,
    timestep: float | None = None,
    check: bool = False,
    refresh: int | None = None,
) -> SimulatedPlant:
    """The plant of that name (`offers.PLANTS`) with a robot in a scene; `dt`: control period [s].

    `integrator`, `refresh` and `check` are for plant `armstrong` alone; `timestep` [s] divides `dt`. Raises
    `WrongUse` for what does not exist or does not fit.
    """
    if name not in PLANTS:
        raise unknown("plant", name, PLANTS)
    asked = {"timestep": timestep, "integrator": integrator, "refresh": refresh}
    options: dict[str, object] = {word: value for word, value in asked.items() if value is not None}
    if name == "kinematic" and options:
        raise WrongUse(
            f"plant kinematic has no mechanics to step through: it takes no {' or '.join(options)}"
        )
    if name == "armstrong":
        options["check"] = check
    elif integrator is not None:
        raise WrongUse(
            f"plant {name} steps through time in its own way; {integrator!r} goes with plant armstrong"
        )
    elif refresh is not None:
        raise WrongUse(
            f"plant {name} has no slow coefficients to refresh at every {refresh}. step; plant armstrong has"
        )
    module, cls = HOMES[name]
    return getattr(import_module(module), cls)(robot, scene, dt, **options)
