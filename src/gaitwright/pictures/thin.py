"""Hours in the pixels of a picture: as many points as a chart can show."""

import numpy as np

from gaitwright.record.rows import Lazy, Series, filled, parts

MOST = 100_000
"""Ticks that are drawn one by one; of longer trips there are about as many points."""


def step(length: int) -> int:
    """Every how many ticks there is a point."""
    return -(-length // MOST)


def shown(series: Series) -> np.ndarray:
    """What a series is at the ticks that are drawn."""
    every = step(len(series))
    pieces = [series[part][-part.start % every :: every] for part in parts(len(series))]
    return np.concatenate(pieces)


def column(series: Series, number: int) -> np.ndarray:
    """One column of a series at every tick."""
    return filled(Lazy(len(series), lambda ticks: series[ticks][:, number]))


def spread(time: Series, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Times and values of a line that covers what all ticks would: of a long trip the lowest and the highest
    value of each short while, since single ticks would beat with the gait."""
    every = step(len(values))
    if every == 1:
        return time[:], values
    whiles = len(values) // (2 * every)
    groups = values[: whiles * 2 * every].reshape(whiles, 2 * every)
    ends = np.stack([groups.min(axis=1), groups.max(axis=1)], axis=1).ravel()
    return np.repeat(shown(time)[::2][:whiles], 2), ends
