"""`gaitwright skill`: one skill for a time, with a push where asked for."""

from argparse import Namespace
from dataclasses import replace

from gaitwright.assess.motor_requirements import HOPELESS, shortage, too_wide
from gaitwright.cli import trips
from gaitwright.cli.console import remark, working
from gaitwright.cli.driving import balance_for, by_book, profiles_of_skill
from gaitwright.cli.sight_arguments import sight_of
from gaitwright.control.takeover import HYBRID, LEARNED
from gaitwright.errors import WrongUse
from gaitwright.gait.climb.climber import Climber, climb_call
from gaitwright.gait.climb.plan import climb
from gaitwright.gait.leg_cycles.files import load_cycle
from gaitwright.gait.leg_cycles.leg_cycle import LegCycle
from gaitwright.ground.scene import Scene
from gaitwright.model.robot import Robot
from gaitwright.session import DT, Push
from gaitwright.signals import Mission, SkillCall
from gaitwright.skills.chooser import HeldSkill, fixed_skill
from gaitwright.skills.library import check_turn, find_skill

PLANNED = ("climb", "descend")
"""Skills that are planned beforehand on the plant without mechanics."""


def run(args: Namespace) -> int:
    trips.check_outputs(args)
    if args.driver == HYBRID:
        raise WrongUse("driver hybrid chooses skills by rules; one skill that is held needs none")
    if (args.driver == LEARNED) != (args.skillbook is not None):
        raise WrongUse("driver learned and --skillbook FILE go together: it plays the profiles of that book")
    balance = balance_for(args)  # a file that cannot be read is told before anything is made
    robot = trips.find_robot(args.robot, args.package)
    sight = sight_of(args, robot)
    skill = find_skill(args.skill, robot)
    scene = trips.find_scene(args.scene, args.seed, robot)
    if args.plant == "kinematic" and skill.name in PLANNED:
        return climb_by_plan(robot, scene, args)
    chooser = fixed_skill(robot, args.skill, args.speed, args.lateral, args.turn, args.driver)
    check_turn(skill, robot, chooser.skill_call.turn)
    cycle = load_cycle(args.cycle) if args.cycle else None
    check_motors(robot, chooser.skill_call, cycle)
    push = Push(*args.push, at=args.seconds / 2) if args.push else None
    setting = trips.set_up(robot, scene, chooser, args.distribution, args.sensing, sight)
    if args.skillbook:
        profiles = profiles_of_skill(robot, args.skillbook, skill.name)
        brain = by_book(setting.brain, args.skillbook, profiles)
        setting = replace(setting, brain=brain.with_balance(balance))
    if cycle:
        setting = replace(setting, brain=setting.brain.with_cycle(skill.name, cycle))
    return trips.run(setting, Mission((), args.speed, args.driver), args, push)


def climb_by_plan(robot: Robot, scene: Scene, args: Namespace) -> int:
    """Up and down what the scene holds, every pose planned beforehand: the thesis's kinematic stairway."""
    with working("planning the climb", worth_a_line=False):
        ascent = climb(robot, scene)
    if ascent.faults:
        raise WrongUse(f"{robot.name} cannot climb {scene.name}: {ascent.faults[0]}")
    chooser = HeldSkill(climb_call(ascent, args.driver))
    setting = trips.set_up(robot, scene, chooser, args.distribution)
    brain = replace(setting.brain, chooser=chooser, coordinator=Climber(ascent, DT))
    args.seconds = len(ascent.steps) * ascent.seconds
    return trips.run(replace(setting, brain=brain, varied=False), Mission((), driver=args.driver), args)


def check_motors(robot: Robot, call: SkillCall, cycle: LegCycle | None = None) -> None:
    """`WrongUse` where body or motors are far from fit for a skill; a remark where nothing is to spare.

    `cycle`: the leg cycle that the feet follow, where it is not the skill's own.
    """
    motion = robot, call.gait, call.velocity, call.turn
    told = too_wide(robot, call.gait) or shortage(*motion, HOPELESS, cycle)
    if told:
        raise WrongUse(told)
    told = shortage(*motion, cycle=cycle)
    if told:
        remark(f"{told}: it may not keep up")
