"""A run → what the page says of it: who drives, why, what is asked, what became of it."""

from collections import Counter
from typing import Any

from gaitwright.signals import Scan
from gaitwright.skills.vocabulary import RULE_IN_USE
from gaitwright.studio.live_run import LiveRun
from gaitwright.studio.setup import who_drives


def status_of(run: LiveRun, ticks: Counter[str]) -> dict[str, Any]:
    """What is so now. `ticks`: how many each driver had so far."""
    session, mind, lap = run.session, run.session.mind, run.lap
    route, call, outcome = mind.route, mind.call, session.outcome
    whole = max(1, ticks.total())
    return {
        "say": "status",
        "time": round(run.time, 3),
        "driver": run.driver,
        "controller": who_drives((lap.call.driver if lap else call.driver) or run.driver),
        "skill": call.skill,
        "held": run.held,
        "velocity": [*call.velocity, call.turn],
        "because": call.because,
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
        "share": {name: count / whole for name, count in ticks.items()},
        "recording": run.recorder is not None,
        "recorded": run.recorder.laps * run.recorder.dt if run.recorder else 0.0,
        "setup": {name: getattr(run.setup, name) for name in ("robot", "scene", "seed", "sight")},
    }


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
