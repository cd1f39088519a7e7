"""Claim: a robot with a camera finds its way where it has never been, and puts no foot into a hole."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from gaitwright.bench.context import Context
from gaitwright.bench.evidence.seen_courses import Course, Crossed, crossed
from gaitwright.bench.measurement import Figure, count
from gaitwright.bench.trial import robot_named
from gaitwright.control.learned.profile import Profile
from gaitwright.learning.profile_books import profile_of
from gaitwright.learning.profile_school import Task, learn
from gaitwright.model.camera import Camera

FAMILIES = (
    "blocks",
    "holes",
    "trench",
    "hills",
    "waves",
    "forest",
    "streets",
    "rooms",
    "maze",
    "bugtrap",
    "mixed",
)
STARTS = 5
"""Courses of each family."""
FEET = ("stairs:0.1", "gap:0.2", "ramp:20")
"""Ground that feet must get over."""
FEET_STARTS, BESIDE = 20, 0.05
"""Starts on each of them, and how far below those with the ground known may be those with a camera."""
NOISE, LOST = 0.02, 0.3
"""Of a bad camera: standard deviation of a range [m], share of the rays that are lost."""
SKILLS = ("stand", "stop", "turn-in-place", "turn-left", "turn-right", "walk", "trot")
"""Skills that such missions are made of: their profiles are taken, on level ground."""
NOTE = (
    "Go2, five courses of each family as it comes (difficulty 0.5), start to goal 6 to 15 m. Nothing is "
    "known but the bounds of the field; the camera is the one that fits the robot. A foot is in a hole where "
    "it stands deeper than all eight places around it."
)


def measure(context: Context) -> Iterator[Figure]:
    """Missions with a good camera by either controller, with a bad one, and the ground known."""
    camera = Camera.for_robot(robot_named("go2"))
    bad = replace(camera, noise=NOISE, dropouts=LOST)
    yield from missions(context, "camera", camera, 0.9)
    yield from missions(context, "camera, learned controller", camera, 0.9, taught(context))
    yield from missions(context, f"camera with {100 * NOISE:g} cm noise, {LOST:.0%} of the rays lost", bad)
    yield from missions(context, "ground known", None)
    for scene in FEET:
        yield over(context, scene, camera)


def taught(context: Context) -> dict[str, list[Profile]]:
    """The profiles of the skills that missions are made of."""
    robot = robot_named("go2")
    found = context.each("profiles", learn, [Task(robot, skill, context.seed) for skill in SKILLS])
    return {
        learned.skill: [profile_of(notes, robot, "this bench") for notes in learned.profiles]
        for learned in found
    }


def missions(
    context: Context,
    what: str,
    camera: Camera | None,
    least: float | None = None,
    profiles: dict[str, list[Profile]] | None = None,
) -> Iterator[Figure]:
    """The figures of all families."""
    courses = [
        Course(family, seed, camera, profiles or {})
        for family in FAMILIES
        for seed in context.seeds(STARTS, quick=1)
    ]
    return figures(what, courses, context.each(what, crossed, courses), least)


def figures(
    what: str, courses: Sequence[Course], found: Sequence[Crossed], least: float | None
) -> Iterator[Figure]:
    """How many of these arrived, and how many never put a foot into a hole."""
    metres, seconds = (sum(getattr(f, name) for f in found if f.arrived) for name in ("metres", "seconds"))
    note = "; ".join([f"{metres:.0f} m in {seconds:.0f} s", *lost(courses, found)])
    if any(course.profiles for course in courses):
        share = sum(f.learned * f.seconds for f in found) / sum(f.seconds for f in found)
        note = f"it drove {share:.0%} of the time; {note}"
    every = {"each": [vars(f) for f in found]}
    good, n = sum(f.is_good for f in found), len(found)
    yield count(f"{what}: arrived without a fall", good, n, least, note, every)
    clean = sum(f.in_holes == 0 for f in found)
    yield count(f"{what}: never a foot in a hole", clean, n, None if least is None else 0.95, "", {})


def lost(courses: Sequence[Course], found: Sequence[Crossed]) -> list[str]:
    """The courses that went wrong, and why."""
    return [f"{c.scene} {c.seed}: {f.why}" for c, f in zip(courses, found, strict=True) if not f.is_good]


def over(context: Context, scene: str, camera: Camera) -> Figure:
    """How many get over ground that asks for footholds, beside those that know it."""
    seeds = context.seeds(FEET_STARTS, quick=2)
    seen, known = (
        context.each(f"{scene}, {what}", crossed, [Course(scene, seed, eyes) for seed in seeds])
        for what, eyes in (("camera", camera), ("ground known", None))
    )
    courses = [Course(scene, seed, camera) for seed in seeds]
    good, beside = (sum(f.is_good for f in some) for some in (seen, known))
    note = "; ".join([f"ground known {beside} of {len(known)}", *lost(courses, seen)])
    every = {"camera": [vars(f) for f in seen], "known": [vars(f) for f in known]}
    least = max(0.0, beside / len(known) - BESIDE)
    return count(f"{scene} by camera: over it without a fall", good, len(seen), least, note, every)
