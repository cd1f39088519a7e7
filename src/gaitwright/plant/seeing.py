"""Measured with the frames of a camera that looks at the plant's own world.

A `SeeingPlant` stands before any simulated plant, sound or faulty: what its camera sees is where the robot
truly is, whatever its other sensors say.
"""

from gaitwright.ground.scene import Scene
from gaitwright.model.camera import Camera
from gaitwright.plant.eyes import Eyes
from gaitwright.signals import Measured, MotorCommand
from gaitwright.stages import SimulatedPlant


class SeeingPlant:
    """A simulated plant with a camera, which looks as often as its rate says and first before the start."""

    def __init__(self, plant: SimulatedPlant, camera: Camera, scene: Scene) -> None:
        self.plant, self.camera, self.dt = plant, camera, plant.dt
        self.has_mechanics = getattr(plant, "has_mechanics", True)
        self.every = max(1, round(1.0 / (camera.rate * plant.dt)))
        """Ticks from frame to frame."""
        self.eyes = Eyes(camera, scene)
        self.tick = 0

    @property
    def scene(self) -> Scene:
        """Where it looks."""
        return self.eyes.scene

    def reset(self, seed: int = 0, vary: bool = True) -> Measured:
        """The robot at its start, with its first look."""
        self.eyes.seed, self.tick = seed, 0
        return self.looked(self.plant.reset(seed, vary))

    def step(self, command: MotorCommand) -> Measured:
        """One control period under a command, and a frame where one is due."""
        self.tick += 1
        return self.looked(self.plant.step(command))

    def looked(self, measured: Measured) -> Measured:
        """What was measured, with a frame where one is due."""
        if self.tick % self.every:
            return measured
        frame = self.eyes.see(getattr(self.plant, "truth", measured), self.tick)
        return Measured.of_row(
            measured.row, time=measured.time, specific_force_b=measured.specific_force_b, frame=frame
        )

    def push(self, force_w: tuple[float, float, float]) -> None:
        """A force [N] on the base's centre of mass from now on, world axes."""
        self.plant.push(force_w)

    def rearrange(self, scene: Scene) -> None:
        """Another arrangement of what stands around the robot; the camera sees it when it looks."""
        self.plant.rearrange(scene)
        self.eyes.rearrange(scene)
