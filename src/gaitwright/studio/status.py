"""A run → what the page says of it: who drives, why, what is asked, what became of it."""

from collections import Counter
from typing import Any

import numpy as np

from gaitwright.gait.coordinator import Coordinator
from gaitwright.gait.operators import Operator
from gaitwright.missions import Steering
from gaitwright.signals import Scan
from gaitwright.skills.vocabulary import RULE_IN_USE
from gaitwright.studio.live_run import LiveRun
from gaitwright.studio.setup import who_drives

WAITS = "it waits to be told where to go"


def status_of(run: LiveRun, ticks: Counter[str]) -> dict[str, Any]:
    """What is so now. `ticks`: how many each driver had so far."""
    session, mind, lap = run.session, run.session.mind, run.lap
    route, call, outcome = mind.route, mind.call, session.outcome
    whole = max(1, ticks.total())
    return {
        "say": "status",
        "time": round(run.time, 3),
        "driver": run.driver,
        "controller": "" if session.closed else who_drives((lap or mind).call.driver or run.driver),
        "skill": call.skill,
        "held": "" if isinstance(mind.mission.guidance, Steering) else run.held,
        "velocity": [*call.velocity, call.turn],
        "because": WAITS if waits(run) else call.because,
        "rule": str(call.memory.get(RULE_IN_USE, "")) if call.ruled else "",
        "firm": call.firm,
        "route": [list(point) for point in route.path],
        "goal": list(mind.mission.waypoints[-1]) if mind.mission.waypoints else None,
        "no_way": route.no_way,
        "pause": route.pause,
        "halt": call.halt or route.halt,
        "outcome": outcome.because if outcome else None,
        "over": run.over,
        "arrived": bool(outcome and outcome.arrived),
        "fell": bool(lap and lap.fell),
        "faults": [fault.sentence for fault in lap.faults] if lap else [],
        "obstacle": faced(route.ahead),
        "operators_in_use": operators_in_use(run),
        "share": {name: count / whole for name, count in ticks.items()},
        "recording": run.recorder is not None,
        "recorded": run.recorder.laps * run.recorder.dt if run.recorder else 0.0,
        "setup": {name: getattr(run.setup, name) for name in ("robot", "scene", "seed", "sight")},
    }


def waits(run: LiveRun) -> bool:
    """Whether it stands because nobody asks it to go."""
    guidance = run.session.mind.mission.guidance
    return isinstance(guidance, Steering) and not any(map(any, guidance.velocities))


def operators_in_use(run: LiveRun) -> list[dict[str, Any]]:
    """Legs that a terrain operator moves now: by which, how much of an obstacle it answers [m], and why; with
    no name where none is for what is ahead."""
    coordinator, lap = run.session.brain.coordinator, run.lap
    if lap is None or not isinstance(coordinator, Coordinator):
        return []
    known, used = coordinator.operators, []
    rows = zip(run.robot.legs, lap.target.operator.tolist(), lap.target.reach.tolist(), strict=True)
    for leg, number, reach in rows:
        if number < 0.0:
            because = f"something is in the way of {leg}, and nothing that was taught is for it"
            used.append({"leg": leg, "name": "", "reach": 0.0, "because": because})
        elif 0.0 < number <= len(known) and reach > 0.0:
            operator = known[int(number) - 1]
            because = f"a {' or '.join(operator.kinds)} is in the way of {leg}: {moved(operator, reach)}"
            used.append({"leg": leg, "name": operator.name, "reach": reach, "because": because})
    return used


def moved(operator: Operator, reach: float) -> str:
    """What an operator does to a foot where it answers so much of an obstacle [m]."""
    heights = reach * operator.path[:, 1]
    peak = 100.0 * float(heights[np.abs(heights).argmax()])
    raised = f"the foot is {'raised' if peak >= 0.0 else 'lowered'} by up to {abs(peak):.1f} cm"
    farther = 100.0 * reach * operator.landing
    return f"{raised} and lands {farther:.1f} cm farther" if farther > 0.05 else raised


def faced(ahead: Scan | None) -> str:
    """What lies ahead, in a few words; empty: nothing that matters."""
    if ahead is None:
        return ""
    seen = [
        (ahead.obstacle < 3.0, f"an obstacle in {ahead.obstacle:.1f} m"),
        (ahead.gap > 0.0, f"a gap of {100 * ahead.gap:.0f} cm"),
        (ahead.step_up > 0.02, f"a step up of {100 * ahead.step_up:.0f} cm"),
        (ahead.step_down > 0.02, f"a step down of {100 * ahead.step_down:.0f} cm"),
        (abs(ahead.slope) > 0.1, f"a slope of {ahead.slope:.2f} rad"),
    ]
    return ", ".join(words for there, words in seen if there)
