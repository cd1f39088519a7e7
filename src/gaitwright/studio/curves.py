"""The curve editor's side of the server: curves shown, edited, checked, previewed, undone and kept (row S4).

All that goes out is plain JSON values. It must be told of every step (`after`) and of every new brain
(`fit`), and is used from the thread that steps the session.
"""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from gaitwright.errors import WrongUse, unknown
from gaitwright.gait.coordinator import Coordinator
from gaitwright.gait.leg_cycles.files import cycle_of
from gaitwright.learning import operator_books
from gaitwright.locomotion import Brain
from gaitwright.model.robot import Robot
from gaitwright.session import Session
from gaitwright.skillbook.writer import Ledger
from gaitwright.studio.curve_angle import AngleCurve
from gaitwright.studio.curve_brain import edited_parts, operators_of, torques_of
from gaitwright.studio.curve_change import Change, Parts
from gaitwright.studio.curve_checks import Refusal, Rows
from gaitwright.studio.curve_cycle import CycleCurve
from gaitwright.studio.curve_history import History, Snapshot, with_one
from gaitwright.studio.curve_keeping import Keeper
from gaitwright.studio.curve_measured import LastLaps, angles_of, path_of
from gaitwright.studio.curve_measured import torques_of as torques_measured
from gaitwright.studio.curve_obstacle import Obstacle, next_ahead, operator_from
from gaitwright.studio.curve_preview import Wish, previewed
from gaitwright.studio.curve_torque import TorqueCurve
from gaitwright.studio.curve_walk import Walk

MEASURED = {"cycle": path_of, "torque": torques_measured, "angle": angles_of}
"""The kinds of curves, and what is measured for each."""
Curve = CycleCurve | TorqueCurve | AngleCurve
Message = dict[str, Any]


class Curves:
    """The curves of one robot. `ledger`, `folder`: where edits are kept; `who` makes them. Leg cycles that
    were kept before count from the start, and can be undone; `faults` says which could not be read."""

    def __init__(
        self, robot: Robot, ledger: Ledger | None = None, folder: Path | None = None, who: str = "a person"
    ) -> None:
        self.robot, self.who = robot, who
        self.history, self.change, self.keeper = History(), Change(), Keeper(ledger, folder)
        self.origin: Parts | None = None
        self.laps: LastLaps | None = None
        kept, self.faults = self.keeper.found(robot)
        if kept.cycles:
            self.history.add(kept)

    # --- beside the session ------------------------------------------------------------------------
    def fit(self, brain: Brain) -> Brain:
        """A new brain, with the edits that count; as it comes it is what all of them start from."""
        self.origin, self.change, self.laps = None, Change(), None
        if not isinstance(brain.coordinator, Coordinator):  # a climb that was planned has none
            return brain
        return self.parts(brain, self.history.now).within(brain)

    def after(self, session: Session) -> None:
        """To be called after every step: notes what the legs do, and lets an edit take effect in time."""
        if self.laps is None:
            self.laps = LastLaps(session.plant.dt)
        if session.lap is not None:
            self.laps.add(session.lap)
        self.change.after(session)

    # --- what is seen --------------------------------------------------------------------------------
    def show(self, kind: str, skill: str, leg: str, session: Session) -> Message:
        """A curve in the words of the message `curve`. Raises `WrongUse` for one that there is not."""
        curve = self.curve(kind, skill, leg, session, self.history.now)
        walk = curve.walk
        laps = self.laps.cycle(walk.skill) if self.laps is not None else []
        ahead = next_ahead(walk, curve.leg, session)
        return {
            "kind": kind,
            "skill": walk.skill,
            "leg": leg,
            "legs": list(self.robot.legs),
            "points": curve.points,
            "line": curve.line(),
            "limits": curve.limits(),
            "stance": [0.0, walk.gait.duty],
            "offset": walk.gait.offsets[curve.leg],
            "period": walk.gait.period,
            "velocity": [*walk.velocity, walk.turn],
            "measured": MEASURED[kind](walk, laps, curve.leg) if laps else [],
            "undo": bool(self.history.before),
            "redo": bool(self.history.behind),
            "edited": self.is_edited(curve),
            "pending": self.change.is_pending,
            "ahead": None if ahead is None else {"kind": ahead.kind, "size": ahead.size},
        }

    def curve(self, kind: str, skill: str, leg: str, session: Session, snapshot: Snapshot) -> Curve:
        """The curve of a kind. Raises `WrongUse` for a kind, skill or leg that there is not."""
        if kind not in MEASURED:
            raise unknown("kind of curve", kind, MEASURED)
        walk = Walk.of(self.robot, skill, session)
        number = walk.leg(leg)
        origin = self.known(session)
        if kind == "torque":
            return TorqueCurve(walk, torques_of(walk, origin, snapshot)[1], number)
        cycle = snapshot.cycles.get(walk.skill) or origin.coordinator.cycles.get(walk.skill)
        path = CycleCurve(walk, cycle or cycle_of(walk.skill), number)
        return path if kind == "cycle" else AngleCurve(walk, path.cycle, number)

    def is_edited(self, curve: Curve) -> bool:
        """Whether a person changed it."""
        if isinstance(curve, TorqueCurve):
            return curve.leg in curve.edit.points
        return curve.walk.skill in self.history.now.cycles

    # --- what is changed -----------------------------------------------------------------------------
    def edit(self, kind: str, skill: str, leg: str, points: Rows, mirror: bool, session: Session) -> Message:
        """Checks other points of a curve, sees them in physics, and has them take effect at the next cycle.

        `taken`, and where not: `because` and the number of the `point`, where it is about one. `preview`:
        what was seen (`curve_preview.Preview.facts`). Raises `WrongUse` as `show` does.
        """
        now = self.history.now
        curve = self.curve(kind, skill, leg, session, now)
        if isinstance(curve, TorqueCurve):
            found = curve.edited(points, mirror, self.who)
            key, _ = torques_of(curve.walk, self.known(session), now)
            if not isinstance(found, Refusal):
                found = replace(now, torques=with_one(now.torques, key, found))
        else:
            found = curve.edited(points, mirror)
            if not isinstance(found, Refusal):
                found = replace(now, cycles=with_one(now.cycles, curve.walk.skill, found))
        return self.taken(curve, found, session)

    def edit_ahead(self, skill: str, leg: str, points: Rows, session: Session) -> Message:
        """`edit_at` what is ahead of a leg now. Raises `WrongUse` where nothing is."""
        walk = Walk.of(self.robot, skill, session)
        obstacle = next_ahead(walk, walk.leg(leg), session)
        if obstacle is None:
            raise WrongUse(
                f"nothing is ahead of leg {leg} that its foot has to get over: bring it to something"
            )
        return self.edit_at(obstacle, skill, leg, points, session)

    @property
    def operators(self) -> list[Message]:
        """What was learned at obstacles, by a person and from the book, in the order in which it is tried."""
        if self.origin is None:
            return []
        return [
            {
                "name": one.name,
                "kinds": list(one.kinds),
                "largest": one.largest,
                "strategy": one.strategy,
                "taught": one.taught,
                "sentence": operator_books.sentence(one),
            }
            for one in operators_of(self.origin, self.history.now)
        ]

    def edit_at(self, obstacle: Obstacle, skill: str, leg: str, points: Rows, session: Session) -> Message:
        """The path of a foot with an obstacle ahead of its leg becomes a terrain operator, tried before all
        others; answers as `edit` does, with what was `learned` as a sentence. Takes about a second."""
        now = self.history.now
        curve = self.curve("cycle", skill, leg, session, now)
        assert isinstance(curve, CycleCurve)
        found = operator_from(curve, points, obstacle, self.who)
        if isinstance(found, Refusal):
            return self.taken(curve, found, session)
        others = (one for one in now.operators if one.name != found.name)
        answer = self.taken(curve, replace(now, operators=(found, *others)), session, obstacle.size)
        return answer | {"learned": operator_books.sentence(found)} if answer["taken"] else answer

    def taken(
        self, curve: Curve, found: Snapshot | Refusal, session: Session, imagined: float = 0.0
    ) -> Message:
        """An edit that passed its checks is seen in physics, and takes effect."""
        if isinstance(found, Refusal):
            return {"taken": False, "because": found.because, "point": found.point, "preview": None}
        parts = self.parts(session.brain, found)
        wish = Wish(curve.walk, curve.leg, parts, isinstance(curve, TorqueCurve), imagined)
        seen = previewed(session, wish)
        if seen.failed:
            because = f"in the preview, {seen.at:.2f} s after it takes effect: {seen.failed}"
            return {"taken": False, "because": because, "point": None, "preview": seen.facts()}
        self.history.add(found)
        self.change.ask(parts)
        return {"taken": True, "because": "", "point": None, "preview": seen.facts()}

    def undo(self, session: Session) -> None:
        """One edit back, from the next cycle on. Raises `WrongUse` where there is none."""
        self.change.ask(self.parts(session.brain, self.history.undo()))

    def redo(self, session: Session) -> None:
        """One undone edit again, from the next cycle on. Raises `WrongUse` where there is none."""
        self.change.ask(self.parts(session.brain, self.history.redo()))

    def keep(self) -> list[str]:
        """Writes the edits that count; a sentence for each. Raises `WrongUse` where there is no place for
        them, or nothing to keep."""
        usual: Mapping = {} if self.origin is None else self.origin.coordinator.cycles
        return self.keeper.keep(self.history.now, usual)

    def parts(self, brain: Brain, snapshot: Snapshot) -> Parts:
        """The parts of a brain with the edits of a snapshot."""
        origin = self.origin = self.origin or Parts.of(brain)
        return edited_parts(brain, origin, snapshot)

    def known(self, session: Session) -> Parts:
        """What all edits start from."""
        self.origin = self.origin or Parts.of(session.brain)
        return self.origin
