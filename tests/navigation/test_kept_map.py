"""A map that was kept is the map that it was; bytes that are no map are told to be none."""

import math

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from plane_world import RADIUS, box_at, fence_edges, look, ring_edges

from gaitwright.errors import BadFile
from gaitwright.navigation.kept_map import KeptMap, of_bytes, to_bytes
from gaitwright.navigation.learned_map import LearnedMap

BOUNDS = (0.0, 0.0, 6.0, 5.0)


def learned() -> LearnedMap:
    edges = np.vstack([ring_edges([box_at(3.0, 2.5, 1.0, 1.0, 0.3)]), fence_edges(BOUNDS)])
    made = LearnedMap.of(BOUNDS, RADIUS, noise=0.002)
    for eye in ((1.0, 1.0), (5.0, 4.0)):
        made = made.seen(look(edges, eye))
    return made.walked([(1.0, 1.0), (1.0, 4.0), (5.0, 4.0)]).felt((2.0, 2.0), 0.3)


def test_what_was_kept_is_the_same() -> None:
    made = learned()
    again = of_bytes(to_bytes(made))
    assert to_bytes(again) == to_bytes(made)
    assert again.rows.tobytes() == made.rows.tobytes() and again.trips == made.trips
    assert (again.raster.cells == made.raster.cells).all()
    assert again.way((1.0, 1.0), (5.0, 4.0)) == made.way((1.0, 1.0), (5.0, 4.0))
    assert len(again.joined(made).rows) == len(made.rows)


@given(st.integers(0, 10_000), st.binary(min_size=1, max_size=4))
def test_bytes_that_were_changed_are_a_map_or_told_to_be_none(at: int, other: bytes) -> None:
    data = bytearray(to_bytes(learned()))
    at %= len(data)
    data[at : at + len(other)] = other
    try:
        again = of_bytes(bytes(data))
    except BadFile:
        return
    assert np.isfinite(again.rows).all() and math.isfinite(again.radius)


@pytest.mark.parametrize(
    "change, sentence",
    [
        ({"strategy": "best"}, "no strategy 'best'"),
        ({"radius": -1.0}, "makes no sense"),
        ({"rows": b"12345678"}, "cut off"),
        ({"rows": np.full((1, 8), math.nan).tobytes()}, "no finite number"),
        ({"rows": np.array([[0.0, 0, 1, 1, 2, 0, 1, 0]]).tobytes()}, "a kind"),
        ({"rows": np.array([[0.0, 0, 1, 1, 1, 0, 99, 0]]).tobytes()}, "1 to 20 times"),
        ({"known": b""}, "not that of its field"),
        ({"trips": (((0.0, math.inf),),)}, "no finite number"),
        ({"trips": (((0.0, 1e9),),)}, "too far away"),
    ],
)
def test_data_that_make_no_sense_are_told(change: dict, sentence: str) -> None:
    kept = msgspec.msgpack.decode(to_bytes(learned()), type=KeptMap)
    data = msgspec.msgpack.encode(msgspec.structs.replace(kept, **change))
    with pytest.raises(BadFile, match=sentence):
        of_bytes(data)


def test_no_map_at_all() -> None:
    for data in (b"", b"\xc1", msgspec.msgpack.encode({"bounds": 1}), b"x" * (64 * 1024 * 1024 + 1)):
        with pytest.raises(BadFile):
            of_bytes(data)
