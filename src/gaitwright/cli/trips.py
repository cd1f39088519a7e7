"""What `mission`, `skill` and `demo` share: robot and scene by name, the run, its progress, the report."""

import json
import math
from argparse import Namespace
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from importlib.util import find_spec
from pathlib import Path
from time import perf_counter

from gaitwright import compiled_ahead
from gaitwright.cli.console import Simulating, remark, show_pairs, working
from gaitwright.cli.mechanics_check import Checks
from gaitwright.cli.output import check_folder, check_json, write_json, write_whole
from gaitwright.control.numerical import Method
from gaitwright.description.load import load_robot_and_notes
from gaitwright.driving import Memories
from gaitwright.errors import WrongUse, told
from gaitwright.ground.scene import Scene
from gaitwright.locomotion import Brain, Lap
from gaitwright.model.camera import Camera
from gaitwright.model.robot import Robot
from gaitwright.navigation.known_field import is_blocked
from gaitwright.navigation.room_needed import half_width
from gaitwright.numerics.compiled import is_warm
from gaitwright.perception.estimated_state import Sensing
from gaitwright.perception.known_ground import map_of
from gaitwright.plant.faults import FaultyPlant, breakdown
from gaitwright.plant.imperfections import NOISE, Imperfections
from gaitwright.plant.registry import make_plant
from gaitwright.plant.seeing import SeeingPlant
from gaitwright.record.recording import INTERRUPTED, Recording, Report
from gaitwright.session import DT, Push, Session, record, scene_for, walk
from gaitwright.signals import Mission
from gaitwright.stages import Chooser, Plant
from gaitwright.studio.page_build import built_page

WITHOUT_MECHANICS = ("kinematic", "programmed")
"""Drivers that say where the robot goes, beside their torques: what plant `kinematic` follows."""


@dataclass(frozen=True)
class Setting:
    """A robot in a scene, with its brain."""

    brain: Brain
    scene: Scene
    varied: bool = True
    """Whether the start has small differences, drawn from the seed."""
    camera: Camera | None = None
    """What it sees the ground with; `None`: nothing."""

    @property
    def robot(self) -> Robot:
        return self.brain.robot


# --- before the run --------------------------------------------------------------------------------
def check_outputs(args: Namespace) -> None:
    """`WrongUse` where a result could not be written; nothing is made yet. `args.out` leads there."""
    check_json(args.json)
    args.out = check_folder(args.out)


def find_robot(asked: str, packages: Iterable[tuple[str, str]] = ()) -> Robot:
    """The robot of that name or file; what its file left open is told on the standard error."""
    with working(f"loading {told(asked)}", worth_a_line=False):
        robot, notes = load_robot_and_notes(asked, dict(packages))
    for note in notes:
        remark(f"{robot.name}: {note}")
    return robot


def find_scene(asked: str, seed: int, robot: Robot, start: list[float] | None = None) -> Scene:
    """The scene of that name or file, in the robot's size, with `start` (x, y, yaw) where given."""
    with working(f"reading scene {told(asked)}", worth_a_line=None):
        scene = scene_for(robot, asked, seed)
    for note in scene.notes:
        remark(f"{scene.name}: {note}")
    if start is None:
        return scene
    x, y, yaw = start
    check_inside("start", (x, y), scene)
    if abs(yaw) > 2 * math.pi:
        raise WrongUse(f"the start's yaw is in radians, from -6.28 to 6.28, not {yaw:g}")
    return replace(scene, start=(x, y, yaw))


def check_inside(what: str, point: tuple[float, float], scene: Scene) -> None:
    """`WrongUse` for a point outside the scene."""
    x_min, y_min, x_max, y_max = scene.bounds
    if not (x_min < point[0] < x_max and y_min < point[1] < y_max):
        raise WrongUse(
            f"the {what} ({point[0]:g}, {point[1]:g}) lies outside scene {scene.name}, which goes from "
            f"({x_min:g}, {y_min:g}) to ({x_max:g}, {y_max:g})"
        )


def set_up(
    robot: Robot,
    scene: Scene,
    chooser: Chooser,
    distribution: Method,
    sensing: Sensing = "true",
    sight: Camera | str = "known",
) -> Setting:
    """The brain of a robot in a scene; `sight`: known, blind, or its camera. Raises `WrongUse` where the
    start is no place to stand."""
    x, y, _ = scene.start
    camera = sight if isinstance(sight, Camera) else None
    with working(f"mapping scene {scene.name}", worth_a_line=None):
        sees = sight != "blind"
        brain = Brain.of(robot, scene, chooser, DT, distribution, sees=sees, sensing=sensing, camera=camera)
        # A camera has seen nothing yet, and what moves is in no map.
        is_told = camera is None and not scene.movers
        true = brain.perception.ground if is_told else map_of(scene.at(0.0), robot)
        on_obstacle = is_blocked(true, half_width(robot), (x, y))
    if on_obstacle:
        raise WrongUse(
            f"the start ({x:g}, {y:g}) is on an obstacle of scene {scene.name}, or too near to one"
        )
    return Setting(brain, scene, camera=camera)


def check_mechanics(driver: str, args: Namespace) -> None:
    """`WrongUse` for what needs mechanics on the plant that has none."""
    if args.plant != "kinematic":
        return
    if driver not in WITHOUT_MECHANICS:
        raise WrongUse(
            f"plant kinematic has no mechanics, so the torques of driver {driver} move nothing there; "
            f"drivers {' and '.join(WITHOUT_MECHANICS)} do"
        )
    if getattr(args, "fault", None):
        raise WrongUse("plant kinematic has no motors and sensors that could fail; plant mujoco has")
    if getattr(args, "sensing", "true") != "true" or sensors_of(args) != Imperfections():
        raise WrongUse("plant kinematic has no sensors: leave --sensing, --sensors and --late out")
    if getattr(args, "push", None):
        raise WrongUse("plant kinematic has no mechanics, so a push moves nothing there; plant mujoco has")


def sensors_of(args: Namespace) -> Imperfections:
    """How good the sensors are: exact for a robot that is told its state, else those of a Go2."""
    name = getattr(args, "sensors", None)
    if name is None:
        name = "go2" if getattr(args, "sensing", "true") == "estimated" else "exact"
    return replace(NOISE[name], late=round(getattr(args, "late", 0.0) / (1e3 * DT)))


# --- the run ---------------------------------------------------------------------------------------
def run(
    setting: Setting,
    mission: Mission,
    args: Namespace,
    push: Push | None = None,
    after: Callable[[Recording, Memories], None] = lambda recording, memories: None,
) -> int:
    """Simulates, reports, leaves the files in `args.out`; returns the exit code. `after` gets what was
    recorded and what the robot remembers, also where the rest is broken off."""
    check_mechanics(mission.driver, args)
    compiled_ahead.begin()
    broken = [breakdown(setting.robot, *asked) for asked in getattr(args, "fault", [])]
    senses = sensors_of(args)
    cold = args.plant == "armstrong" and not is_warm("integrators.advance")
    what = (
        "compiling the plant's kernels (first run only, up to two minutes)" if cold else "building the world"
    )
    with working(what, worth_a_line=cold or None):
        plant = make_plant(
            args.plant,
            setting.robot,
            setting.scene,
            DT,
            args.integrator,
            args.timestep,
            args.check,
            args.refresh,
        )
    warm_up(setting, plant, mission)
    checks = Checks.of(setting.robot, plant) if args.check else None
    began = perf_counter()
    with Simulating(args.seconds) as progress:

        def watch(lap: Lap) -> None:
            progress(lap)
            if checks:
                checks.add(lap)

        is_faulty = broken or senses != Imperfections()
        whole = FaultyPlant(plant, setting.robot, broken, senses) if is_faulty else plant
        whole = SeeingPlant(whole, setting.camera, setting.scene) if setting.camera else whole
        session = Session(setting.brain, whole, mission, args.seconds, args.seed, setting.varied, lowers=True)
        if push:
            session.push(push)
        recording = record(session, args.seed, setting.scene.name, watch, previews=args.out is not None)
    if not len(recording):
        raise KeyboardInterrupt
    try:
        return finish(setting, recording, args, perf_counter() - began, checks)
    finally:
        after(recording, session.mind.memories)


def warm_up(setting: Setting, plant: Plant, mission: Mission) -> None:
    """Three ticks whose result is thrown away: compiles the kernels, or loads them from numba's cache."""
    cold = not is_warm()
    what = "compiling kernels (first run only, up to two minutes)" if cold else "loading compiled kernels"
    with working(what, worth_a_line=cold or None):
        walk(setting.brain, plant, mission, 3 * DT)


# --- after the run ---------------------------------------------------------------------------------
def finish(
    setting: Setting, recording: Recording, args: Namespace, wall: float, checks: Checks | None = None
) -> int:
    """Writes and prints the report, leaves the files that were asked for; returns the exit code."""
    report = recording.report()
    aside = args.json == "-" or getattr(args, "aside", False)
    text, checked = as_json(report, checks), checks.table() if checks else []
    kept = keep(recording, text, Path(args.out)) if args.out else []
    write_json(args.json, text)
    title = f"{report.robot} in {report.scene}, seed {report.seed}: {report.stopped_because}"
    goal = report.arrived or not recording.done
    show_pairs(title, [*table_of(report, wall, goal), *checked, *kept], to_stderr=aside)
    if report.stopped_because == INTERRUPTED:
        also = f", and the recording in {args.out}" if args.out else ""
        remark(f"gaitwright: interrupted after {report.duration_s:.1f} s; kept: the report{also}")
        return 130
    if args.out:
        show_pairs("", illustrate(setting, recording, Path(args.out)), to_stderr=aside)
    return 0 if recording.done and not recording.fell else 1


def table_of(report: Report, wall: float, goal: bool) -> list[tuple[str, str]]:
    """The report for people; `wall` is how long the run took [s], `goal` whether there was one."""
    drivers = ", ".join(f"{name} {share:.0%}" for name, share in report.driver_share.items())
    pace = f"{report.duration_s / wall:.1f} × real time" if wall > 0 else ""
    paces = [
        f"{'a control step' if name == 'lap' else f'{name} gait and control'} {took['median']:.0f} µs, "
        f"99 of 100 within {took['p99']:.0f} µs"
        for name, took in report.tick_us.items()
    ]
    degrees = math.degrees
    arrived = [("arrived", "yes" if report.arrived else "no")] if goal else []
    return [
        ("driver", drivers),
        *arrived,
        ("falls", str(report.falls)),
        *[
            ("fault", f"{fault['sentence']}; noticed at {fault['noticed']:.2f} s, {fault['answer']}")
            for fault in report.faults
        ],
        ("time", f"{report.duration_s:.2f} s"),
        ("distance", f"{report.distance_m:.2f} m"),
        ("mean speed", f"{report.speed_mean_mps:.3f} m/s"),
        (
            "velocity error",
            f"{report.velocity_error_mps:.4f} m/s, yaw rate {report.yaw_rate_error_radps:.4f} rad/s",
        ),
        ("cost of transport", f"{report.cost_of_transport:.2f}, {report.energy_j_per_m:.0f} J/m"),
        ("roll, pitch (std)", f"{degrees(report.roll_std_rad):.2f}°, {degrees(report.pitch_std_rad):.2f}°"),
        ("skills", " → ".join(report.skills)),
        ("desirability", f"{report.desirability:.3f}"),
        ("computing", "; of it ".join(paces)),
        ("simulated in", f"{wall:.1f} s, {pace}"),
    ]


def as_json(report: Report, checks: Checks | None) -> str:
    """The report as JSON, with what `--check` found under `checks` where that was asked for."""
    if not checks:
        return report.to_json()
    figures = {**json.loads(report.to_json()), "checks": checks.numbers()}
    return json.dumps(figures, indent=2, ensure_ascii=False)


def keep(recording: Recording, report: str, folder: Path) -> list[tuple[str, str]]:
    """Leaves recording and report in a folder; what each is, and where."""
    write_whole(folder / "report.json", report + "\n")
    saved = recording.save(folder / "recording.npz")
    return [("report", str(folder / "report.json")), ("recording", str(saved))]


def illustrate(setting: Setting, recording: Recording, folder: Path) -> list[tuple[str, str]]:
    """Leaves the recording for other programs and a picture in a folder, as far as the extras are there."""
    files = []
    if has("mcap_ros2", "the recording for Foxglove and Rerun (.mcap)", "record"):
        with working("writing the recording for Foxglove and Rerun", worth_a_line=False):
            from gaitwright.record.mcap_export import export_mcap  # noqa: PLC0415 - an extra

            path = export_mcap(recording, folder / "recording.mcap", setting.scene)
            files.append(("for Foxglove, Rerun", str(path)))
    if has("matplotlib", "the picture", "plot"):
        with working("drawing the picture", worth_a_line=False):
            from gaitwright.pictures import trip_picture  # noqa: PLC0415 - an extra, and slow to import

            files.append(("picture", str(trip_picture(recording, setting.scene, folder / "trip.png"))))
    page = built_page()
    if page is not None:
        with working("writing the replay", worth_a_line=False):
            from gaitwright.studio.replay import write_replay  # noqa: PLC0415 - only here

            replay = write_replay(recording, folder / "replay.html", page, setting.scene)
            files.append(("replay, opens by a double click", str(replay)))
    return files


def has(module: str, what: str, extra: str) -> bool:
    """Whether an extra is installed; says how to get it where it is not."""
    if find_spec(module):
        return True
    remark(f"{what} is left out: it needs `pip install 'gaitwright[{extra}]'`")
    return False
