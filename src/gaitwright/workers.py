"""Work side by side: one process for each core, the same outcomes for any number of them."""

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from types import TracebackType
from typing import TypeVar

Given = TypeVar("Given")
Found = TypeVar("Found")
MOST = 8
"""Processes at most: each takes some 300 MB."""


def cores() -> int:
    """Cores that this process may use."""
    if sys.platform == "linux":
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class Workers:
    """Processes that work for this one; a context manager, after which none is left."""

    def __init__(self, number: int | None = None) -> None:
        self.number = number or min(MOST, cores())
        self._pool: ProcessPoolExecutor | None = None

    def __enter__(self) -> "Workers":
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: BaseException | TracebackType | None) -> None:
        if kind is not None:
            for child in multiprocessing.active_children():
                child.terminate()
        if self._pool:
            self._pool.shutdown(wait=True, cancel_futures=True)

    def as_done(self, task: Callable[[Given], Found], given: Iterable[Given]) -> Iterator[Found]:
        """What the task makes of each thing given, as soon as it is there."""
        for future in as_completed(self._begun(task, given)):
            yield future.result()

    def each(
        self, task: Callable[[Given], Found], given: Sequence[Given], tell: Callable[[int], None]
    ) -> list[Found]:
        """What the task makes of each thing given, in their order; `tell` hears how many are done."""
        futures = self._begun(task, given)
        for done, future in enumerate(as_completed(futures), start=1):
            future.result()
            tell(done)
        return [future.result() for future in futures]

    def _begun(self, task: Callable[[Given], Found], given: Iterable[Given]) -> list[Future[Found]]:
        if self._pool is None:
            context = multiprocessing.get_context("spawn")
            self._pool = ProcessPoolExecutor(self.number, context, initializer=obey)
        return [self._pool.submit(task, one) for one in given]


def obey() -> None:
    """In a worker: Ctrl-C is for the parent to act on, and without a parent there is nothing to do."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=lambda: (parent.join(), os._exit(1)), daemon=True).start()
