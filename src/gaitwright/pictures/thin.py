"""Hours in the pixels of a picture: as many points as a chart can show."""

import numpy as np

from gaitwright.record.rows import PART, Lazy, Series, filled, parts

MOST = 60_000
"""Ticks that are drawn one by one."""
FEW = 20_000
"""Points of longer trips, of which a chart has fewer pixels."""


def step(length: int) -> int:
    """Every how many ticks there is a point."""
    return 1 if length <= MOST else -(-length // FEW)


def shown(series: Series) -> np.ndarray:
    """What a series is at the ticks that are drawn."""
    every = step(len(series))
    # A copy of each: a view would keep all of its part in memory.
    pieces = [series[part][-part.start % every :: every].copy() for part in parts(len(series))]
    return np.concatenate(pieces)


def column(series: Series, number: int) -> Lazy:
    """One column of a series."""
    return Lazy(len(series), lambda ticks: series[ticks][:, number])


def spread(time: Series, values: Series) -> tuple[np.ndarray, np.ndarray]:
    """Times and values of a line that covers what all ticks would: of a long trip the lowest and the highest
    value of each short while, since single ticks would beat with the gait."""
    every = step(len(values))
    if every == 1:
        return time[:], filled(values)
    ends = []
    for part in parts(len(values), 2 * every * (PART // (2 * every))):
        new = values[part]
        groups = new[: len(new) - len(new) % (2 * every)].reshape(-1, 2 * every)
        ends.append(np.stack([groups.min(axis=1), groups.max(axis=1)], axis=1).ravel())
    line = np.concatenate(ends)
    return np.repeat(shown(time)[::2], 2)[: len(line)], line
