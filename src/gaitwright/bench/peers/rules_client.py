"""A peer that gets its problem as a JSON file and answers line by line; `reason` says why where it cannot."""

import json
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from gaitwright.bench.peers.environment import PeerUnavailable, peer_python
from gaitwright.bench.peers.script import Script

TIMEOUT_S = 120.0
SCRIPTS = {
    "clips": Path(__file__).with_name("clips_rules.py"),
    "paths": Path(__file__).with_name("paths_planners.py"),
    "sklearn": Path(__file__).with_name("sklearn_teachers.py"),
}


class RulesPeer:
    """A rule engine or learner in an environment of its own; a context."""

    def __init__(
        self,
        name: str,
        problem: Mapping[str, Any],
        timeout_s: float = TIMEOUT_S,
    ) -> None:
        """`timeout_s`: how long an answer may take [s]."""
        self.name, self.problem = name, problem
        self.script, self.timeout_s = SCRIPTS[name], timeout_s
        self.reason: str | None = None
        self.greeting: dict = {}
        self._script: Script | None = None

    def __enter__(self) -> "RulesPeer":
        self._folder = tempfile.TemporaryDirectory(prefix="gaitwright-peer-")
        try:
            self._start(Path(self._folder.name))
        except PeerUnavailable as problem:
            self.reason = str(problem)
        return self

    def __exit__(self, *_: object) -> None:
        if self._script:
            self._script.close()
        self._folder.cleanup()

    def _start(self, folder: Path) -> None:
        """Starts the script and hears its first message."""
        python = peer_python(self.name)
        (folder / "problem.json").write_text(json.dumps(dict(self.problem)), encoding="utf-8")
        command = [str(python), str(self.script), str(folder / "problem.json")]
        self._script = Script(command, folder / "stderr.txt")
        self.greeting = self._script.hear(self.timeout_s)

    def ask(self, command: str) -> dict | None:
        """The answer to a line; `None`, and `reason` set for good, where there is none."""
        if self._script is None or self.reason is not None:
            return None
        try:
            return self._script.ask(command, self.timeout_s)
        except PeerUnavailable as problem:
            self.reason = str(problem)
            return None
