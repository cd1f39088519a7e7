"""The curve editor of a room: what a page asks of curves → edits of the run that is under way (row S4)."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from gaitwright.errors import WrongUse
from gaitwright.session import Session
from gaitwright.skillbook.writer import Ledger
from gaitwright.studio import messages as m
from gaitwright.studio.curves import Curves
from gaitwright.studio.live_run import LiveRun
from gaitwright.studio.recordings import plain_name

FOLDER = "leg-cycles"
"""Edited leg cycles are kept in this folder beside the recordings, those of each robot in their own."""


class CurveDesk:
    """Curves of the robot that runs. `say` is told of every edit, and when the legs follow it."""

    run: LiveRun

    def __init__(self, ledger: Ledger, folder: Path, say: Callable[[dict[str, Any]], None]) -> None:
        self.ledger, self.folder, self.say = ledger, folder, say
        self.curves: Curves | None = None
        self.edits = 0
        """Counts what changed the curves, so that a page knows when to look again."""
        self.told: tuple[int, bool] | None = None
        self.does: dict[type[m.Message], Callable[[Any], dict[str, Any] | None]] = {
            m.Curve: self.show, m.Edit: self.edit, m.Undo: self.undo, m.Redo: self.redo, m.Save: self.save,
        }  # fmt: skip

    def attend(self, run: LiveRun) -> None:
        """From now on it is about this run; edits go along to one of the same robot."""
        if self.curves is None or self.curves.robot.name != run.robot.name:
            self.curves = Curves(run.robot, self.ledger, self.folder / FOLDER / plain_name(run.robot.name))
        self.run = run
        run.session.brain = self.curves.fit(run.session.brain)
        self.changed()

    def after(self) -> None:
        """To be called after every lap: an edit takes effect when a cycle begins."""
        curves, session = self.at_work()
        if self.run.over is None:
            curves.after(session)
        self.tell()

    # --- what a page asks -----------------------------------------------------------------------------
    def show(self, said: m.Curve) -> dict[str, Any]:
        """A curve as it is now; with no skill that of the skill in use."""
        curves, session = self.at_work()
        skill = said.skill or session.mind.call.skill
        return {"curve": curves.show(said.kind, skill, self.leg(said.leg), session)}

    def edit(self, said: m.Edit) -> dict[str, Any]:
        """Whether an edit is taken, why not, what was seen of it, and the curve as it then is."""
        curves, session = self.at_work()
        leg = self.leg(said.leg)
        if said.obstacle and said.kind != "cycle":
            raise WrongUse("how a foot gets over an obstacle is said by its path: edit the leg cycle")
        if said.obstacle:
            answer = curves.edit_ahead(said.skill, leg, said.points, session)
        else:
            answer = curves.edit(said.kind, said.skill, leg, said.points, said.mirror, session)
        what = f"{said.kind} of {leg} in {said.skill}"
        self.run.note("edit", answer.get("learned") or f"{what}: {answer['because'] or 'other points'}")
        if answer["taken"]:
            self.changed()
        return answer | {"curve": curves.show(said.kind, said.skill, leg, session)}

    def undo(self, said: m.Undo) -> None:
        curves, session = self.at_work()
        curves.undo(session)
        self.run.note("edit", "undone")
        self.changed()

    def redo(self, said: m.Redo) -> None:
        curves, session = self.at_work()
        curves.redo(session)
        self.run.note("edit", "done again")
        self.changed()

    def save(self, said: m.Save) -> dict[str, Any]:
        """What was kept, a sentence for each."""
        return {"sentences": self.at_work()[0].keep()}

    # --- helpers --------------------------------------------------------------------------------------
    def at_work(self) -> tuple[Curves, Session]:
        assert self.curves is not None, "a room attends to a run from its start"
        return self.curves, self.run.session

    def leg(self, number: int) -> str:
        """The name of a leg. Raises `WrongUse` for one that the robot has not."""
        legs = self.at_work()[0].robot.legs
        if number >= len(legs):
            raise WrongUse(f"there is no leg {number}: the legs are 0 to {len(legs) - 1}, {', '.join(legs)}")
        return legs[number]

    def changed(self) -> None:
        """Something is another curve than before."""
        self.edits += 1
        self.tell()

    def tell(self) -> None:
        """Says how things are, where that is not what was said last."""
        curves, _ = self.at_work()
        if self.run.over is not None:
            curves.change.drop()
        now = self.edits, curves.change.is_pending
        if now != self.told:
            was_pending = self.told is not None and self.told[1]
            self.told = now
            edits, pending = now
            if was_pending and not pending:
                self.run.note("edit", "the legs follow what was edited")
            more = {"operators": curves.operators, "faults": curves.faults}
            self.say({"say": "curve", "edits": edits, "pending": pending, **more})
