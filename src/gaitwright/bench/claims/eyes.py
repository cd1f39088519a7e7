"""Claim: a frame of 64 × 48 rays is in the map within 1.5 ms, as quick among 2,000 boxes, right to 1 cm."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from time import thread_time_ns

import numpy as np
import shapely
from jaxtyping import Float

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.lone_things import KINDS, lone
from gaitwright.bench.measurement import Figure, Wanted, at_least, at_most
from gaitwright.bench.trial import robot_named
from gaitwright.ground.scene import Scene
from gaitwright.ground.terrain import Box, Flat
from gaitwright.model.camera import Camera
from gaitwright.model.robot import Robot
from gaitwright.numerics.geometry import from_roll_pitch_yaw, quaternion_of
from gaitwright.perception.elevation_map import ElevationMap, fused, standing
from gaitwright.perception.fusing import VARIANCE
from gaitwright.perception.primitives import recognised
from gaitwright.perception.seen_ground import footholds_of
from gaitwright.perception.walls import sight_of
from gaitwright.plant.eyes import Eyes
from gaitwright.plant.mujoco.depth import depth_frame
from gaitwright.plant.mujoco.simulation import MujocoPlant
from gaitwright.signals import DepthFrame, Sensed, Sight

BOXES = (20, 200, 2000)
FIELD, STRIP = 7.0, 0.3
"""Half the side of the field, half the width of the strip along x in which no box has its middle [m]."""
WALK, SPEED = 4.0, 0.4
"""Way of the robot along x [m], and how fast it goes [m/s]."""
CENTIMETRE = 0.01
FINE = 7
"""Places along each side of a cell, from rim to rim, that are asked for their true height."""
SURE = 1e-4
"""Variance below which a height was seen, not only supposed [m²]."""
TRIES = 8
"""Things of each kind to be recognised."""
NOISE, LOST = 0.02, 0.3
"""Of the second row: standard deviation of a range [m], share of the rays that are lost."""
NOTE = (
    "Go2's camera, 3.3 m, 90° by 67.5°, 0.5 m up, moved along x with the sway of a trot over level ground "
    "with boxes of 3 to 45 cm, 14 m by 14 m, so that 2,000 stand ten to a square metre; cells of 2.1 cm. A "
    "frame's time is CPU time, its median over the walk after a warm-up; `mj_multiRay` casts the same rays "
    "in the same world. Cells of one height: seen, and every one of 49 places in them as high."
)


@dataclass(frozen=True)
class Walk:
    """What a walk through a field was like."""

    robot: Robot
    camera: Camera
    scene: Scene
    seen: ElevationMap
    """The map at its end."""
    sights: tuple[Sight, ...]
    times: dict[str, Float[np.ndarray, "frames"]]
    """What each part of a frame took, CPU time [ms]."""


def measure(context: Context) -> Iterator[Figure]:
    """Times and errors among 20, 200 and 2,000 boxes, without and with noise and drop-outs."""
    robot = robot_named("go2")
    clean = Camera.for_robot(robot)
    noisy = replace(clean, noise=NOISE, dropouts=LOST)
    walk(robot, clean, crowd(BOXES[0], context.seed), 0.3)
    for camera, about in ((clean, ""), (noisy, f", {100 * NOISE:g} cm noise, {LOST:.0%} lost")):
        yield recognised_of(context, robot, camera, about)
        for boxes in BOXES:
            context.voice.say(f"eyes: among {boxes} boxes{about}", now=False)
            scene = crowd(boxes, context.seed)
            taken = walk(robot, camera, scene, context.seconds(WALK, 1.0))
            yield from times_of(taken, f"{boxes} boxes{about}")
            yield from errors_of(taken, f"{boxes} boxes{about}", camera is clean)
            if camera is clean:
                yield from against_mujoco(taken, f"{boxes} boxes")


def crowd(boxes: int, seed: int) -> Scene:
    """Level ground with so many boxes, low ones and high ones, and a strip to walk along."""
    rng = np.random.default_rng(seed)
    blocks = []
    while len(blocks) < boxes:
        x, y = rng.uniform(-FIELD, FIELD, 2)
        if abs(y) >= STRIP:
            sides, height = rng.uniform(0.1, 0.5, 2), float(rng.choice([0.03, 0.06, 0.3, 0.45]))
            yaw, (lx, ly) = float(rng.uniform(-3.0, 3.0)), map(float, sides)
            blocks.append(Box(float(x), float(y), yaw, lx, ly, height))
    return Scene(f"{boxes} boxes", Flat(), tuple(blocks), (-FIELD, -FIELD, FIELD, FIELD))


def place_at(robot: Robot, scene: Scene, x: float, k: int, period: float) -> Sensed:
    """Where a robot is at frame k of a walk along x: over the ground at its height, swaying."""
    angles = np.array([0.02 * np.cos(2.3 * k), 0.03 * np.sin(1.7 * k), 0.1 * np.sin(0.3 * k)])
    position = np.array([x, 0.0, float(scene.height(x, 0.0)) + robot.height])
    still, joints = np.zeros(3), np.zeros((robot.n, 3))
    turn = quaternion_of(from_roll_pitch_yaw(angles))
    return Sensed(k * period, position, turn, still, still, joints, joints, np.ones(robot.n))


def walk(robot: Robot, camera: Camera, scene: Scene, far: float) -> Walk:
    """Walks along x, a frame after the other, with a stopwatch at each part."""
    eyes, period = Eyes(camera, scene), 1.0 / camera.rate
    xs = np.arange(-0.5 * far, 0.5 * far, SPEED * period)
    sensed = place_at(robot, scene, float(xs[0]), 0, period)
    feet = sensed.position_w + robot.nominal_feet - np.outer(robot.foot_radius, [0.0, 0.0, 1.0])
    seen, sights = standing(robot, sensed, feet), []
    times: dict[str, list[float]] = {name: [] for name in ("cast", "fuse", "feet", "sight")}

    def timed(name: str, function: Callable, *given):
        began = thread_time_ns()
        out = function(*given)
        times[name].append((thread_time_ns() - began) / 1e6)
        return out

    for k, x in enumerate(xs):
        sensed = place_at(robot, scene, float(x), k, period)
        frame: DepthFrame = timed("cast", eyes.see, sensed, k)
        seen = timed("fuse", fused, seen, frame, camera, sensed)
        timed("feet", footholds_of, seen)
        sights.append(timed("sight", sight_of, seen, frame, camera, sensed, robot.step_limit))
    columns = {name: np.array(column) for name, column in times.items()}
    return Walk(robot, camera, scene, seen, tuple(sights), columns)


def times_of(taken: Walk, what: str) -> Iterator[Figure]:
    """What a frame costs, part by part."""
    times, frames = taken.times, len(taken.times["cast"])

    def figure(name: str, each: np.ndarray, unit: str, wanted: Wanted | None) -> Figure:
        low, high = np.percentile(each, [50, 99])
        note = f"p99 {high:.2f} {unit}"
        return Figure(f"{what}: {name}", float(low), unit, wanted, frames, note, {"each": each.tolist()})

    yield figure("cast", times["cast"], "ms", None)
    yield figure("a frame into the map", times["fuse"], "ms", at_most(1.1))
    yield figure("… cast included", times["cast"] + times["fuse"], "ms", at_most(1.5))
    whole = times["fuse"] + times["feet"] + times["sight"]
    yield figure("… ground for feet and walls included", whole, "ms", None)
    yield figure("… all but the cast, at 10 Hz", 100.0 * whole * taken.camera.rate / 1e3, "%", at_most(2.0))


def errors_of(taken: Walk, what: str, clean: bool) -> Iterator[Figure]:
    """How near heights and walls are to the true ones."""
    seen, scene = taken.seen, taken.scene
    x, y = seen.places()
    inner = np.linspace(-0.5, 0.5, FINE) * seen.spacing
    low, high = np.full((2, seen.n, seen.n), np.inf) * [[[1.0]], [[-1.0]]]
    for a in inner:
        for b in inner:
            heights = scene.height(x[None, :] + a, y[:, None] + b)
            low, high = np.minimum(low, heights), np.maximum(high, heights)
    looked_at = seen.layer(VARIANCE) < SURE + taken.camera.noise**2
    one, two = looked_at & (low == high), looked_at & (high - low > seen.edge)
    right = np.abs(seen.heights - low)[one] <= CENTIMETRE
    wanted = at_least(99.0) if clean else None
    note = f"{one.sum()} cells seen, {two.sum()} more with an edge in them"
    yield Figure(
        f"{what}: cells of one height right to 1 cm", 100 * float(right.mean()), "%", wanted, 1, note
    )
    if clean:
        note = "of those with an edge in them: seen from one side only, they hold what was seen"
        yield Figure(
            f"{what}: cells that hold two heights", 100 * float(seen.split[two].mean()), "%", None, 1, note
        )
    yield walls_of(taken, what, clean)


def walls_of(taken: Walk, what: str, clean: bool) -> Figure:
    """How far pieces of edges are from the nearest thing that is too high to step on."""
    high = [shapely.Polygon(box.corners()) for box in taken.scene.obstacles(taken.robot.step_limit)]
    truth = shapely.union_all(high)
    pieces = np.concatenate([sight.pieces for sight in taken.sights]).reshape(-1, 2, 2)
    ends = np.asarray(shapely.distance(truth, shapely.points(pieces.reshape(-1, 2))))
    near = ends <= (0.5 if clean else 1.0) * taken.seen.spacing
    note = f"of {len(ends)}; farthest {100 * ends.max(initial=0.0):.1f} cm"
    unit, name = "%", f"ends of pieces of walls within {'half a' if clean else 'one'} cell of one"
    return Figure(f"{what}: {name}", 100 * float(near.mean()), unit, None, len(taken.sights), note)


def recognised_of(context: Context, robot: Robot, camera: Camera, about: str) -> Figure:
    """How often a thing alone is taken for what it is after a walk towards it."""
    right, asked, taken_for = 0, 0, {}
    for kind in KINDS:
        context.voice.say(f"eyes: {kind}s recognised{about}", now=False)
        for seed in context.seeds(TRIES):
            found = recognised(walk(robot, camera, lone(kind, seed)[0], 1.2).seen)
            name = found[0].kind if found else "nothing"
            right, asked = right + (name == kind), asked + 1
            if name != kind:
                taken_for[f"{kind} for {name}"] = taken_for.get(f"{kind} for {name}", 0) + 1
    note = ", ".join(f"{times} {what}" for what, times in taken_for.items()) or "every one"
    what = f"box, cylinder, pyramid, wedge or sphere recognised{about}"
    return Figure(what, float(right), f"of {asked}", None, asked, note, {"taken_for": taken_for})


def against_mujoco(taken: Walk, what: str) -> Iterator[Figure]:
    """The same rays by MuJoCo: how many end elsewhere, and what they cost."""
    plant, eyes = MujocoPlant(taken.robot, taken.scene), Eyes(taken.camera, taken.scene)
    measured, times = plant.reset(0, vary=False), []
    frame = depth_frame(plant.world, taken.camera)
    for _ in range(9):
        began = thread_time_ns()
        depth_frame(plant.world, taken.camera)
        times.append((thread_time_ns() - began) / 1e6)
    ours = eyes.see(measured).ranges
    cell = float(eyes.facets.place[2])
    off = np.abs(ours - frame.ranges)
    share = float((off[np.isfinite(off)] > 1.5 * cell).mean())
    note = f"a cell is {100 * cell:.1f} cm; {np.isfinite(off).sum()} rays"
    yield Figure(f"{what}: rays more than a cell off MuJoCo's", 100 * share, "%", at_most(2.5), 1, note)
    yield Figure(f"{what}: MuJoCo's cast", float(np.median(times)), "ms", None, len(times))
