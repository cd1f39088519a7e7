"""MuJoCo's world + pose → DepthFrame: the same camera by another source, one ray against every geom."""

import mujoco
import numpy as np

from gaitwright.model.camera import Camera
from gaitwright.plant.eyes import imperfect
from gaitwright.plant.mujoco.simulation import MujocoWorld
from gaitwright.signals import DepthFrame


def depth_frame(world: MujocoWorld, camera: Camera, i: int = 0, seed: int = 0, tick: int = 0) -> DepthFrame:
    """What a camera on robot `i` sees of the ground, the boxes and the other robots, where they are now.

    Rays that meet the robot's own trunk go through it, those that meet its own legs come back with nothing: a
    real camera has a mask for them. Slower the more geoms there are, which `plant.eyes` is not.
    """
    model, data, at = world.model, world.data, world.addresses[i]
    R_wb = data.xmat[at.base].reshape(3, 3)
    rays = camera.rays @ R_wb.T
    geoms, ranges = np.empty(len(rays), np.int32), np.empty(len(rays))
    eye = camera.eye(data.xpos[at.base], R_wb)
    mujoco.mj_multiRay(
        model, data, eye, rays.ravel(), None, True, at.base, geoms, ranges, None, len(rays), camera.range
    )
    own = model.body_rootid[model.geom_bodyid[geoms]] == at.base
    ranges[(geoms < 0) | own | (ranges > camera.range)] = np.nan
    return DepthFrame(imperfect(ranges, camera, seed, tick), float(data.time))
