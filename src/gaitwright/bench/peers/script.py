"""A peer's script as a running child: ask it a line, get its JSON answer, or one sentence why not."""

import json
import queue
import subprocess
import threading
from collections.abc import Sequence
from pathlib import Path
from typing import IO

from gaitwright.bench.peers.environment import PeerUnavailable, clean_env


class Script:
    """A child that speaks the line protocol of `tick_protocol.py`. Close it after use."""

    def __init__(self, command: Sequence[str], errors: Path) -> None:
        self._errors = errors
        with errors.open("w", encoding="utf-8") as sink:
            self._process = subprocess.Popen(
                command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=sink,
                text=True,
                env=clean_env(),
            )
        if self._process.stdin is None or self._process.stdout is None:
            raise AssertionError("both are pipes, as asked")
        self._stdin: IO[str] = self._process.stdin
        self._stdout: IO[str] = self._process.stdout
        self._lines: queue.SimpleQueue[str | None] = queue.SimpleQueue()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        """Pass the child's lines on, and None at their end."""
        for line in self._stdout:
            self._lines.put(line)
        self._lines.put(None)

    def hear(self, timeout_s: float) -> dict:
        """The child's next message; raises `PeerUnavailable` where it is silent for `timeout_s` or dead."""
        try:
            line = self._lines.get(timeout=timeout_s)
        except queue.Empty as problem:
            raise PeerUnavailable(f"its script said nothing for {timeout_s:.0f} s") from problem
        if line is None:
            raise self._ended()
        return json.loads(line)

    def ask(self, command: str, timeout_s: float) -> dict:
        """Send one line and hear its answer; raises as `hear`."""
        try:
            print(command, file=self._stdin, flush=True)
        except BrokenPipeError as problem:
            raise self._ended() from problem
        return self.hear(timeout_s)

    def _ended(self) -> PeerUnavailable:
        code = self._process.wait()
        said = [
            line.strip() for line in self._errors.read_text(errors="replace").splitlines() if line.strip()
        ]
        return PeerUnavailable(f"its script ended early: {said[-1] if said else f'exit code {code}'}")

    def close(self) -> None:
        """End the child, however it is."""
        self._process.kill()
        self._process.wait()
        self._reader.join()
        self._stdout.close()
        try:
            self._stdin.close()
        except BrokenPipeError:
            return  # what it never read is of no use to anyone now
