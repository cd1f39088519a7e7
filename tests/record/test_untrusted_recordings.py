"""Recordings of unknown origin: whatever cannot have come of a walk is a `BadFile` with a sentence."""

import io
import json
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gaitwright.bench.fuzz.originals import recordings
from gaitwright.errors import BadFile
from gaitwright.record.recording import load


@pytest.fixture(scope="module")
def members() -> dict[str, np.ndarray]:
    """What is in the file of a sound recording."""
    with np.load(io.BytesIO(recordings()[0])) as archive:
        return dict(archive)


def saved(members: dict[str, np.ndarray], folder: Path) -> Path:
    np.savez_compressed(folder / "a.npz", **members)
    return folder / "a.npz"


def with_header(members: dict[str, np.ndarray], **changed: Any) -> dict[str, np.ndarray]:
    header = json.loads(members["header"].tobytes())
    robot = header["robot"] | changed.pop("robot", {})
    content = json.dumps(header | changed | {"robot": robot}).encode()
    return members | {"header": np.frombuffer(content, dtype=np.uint8)}


def test_a_sound_one_is_read(members: dict[str, np.ndarray], tmp_path: Path):
    assert load(saved(members, tmp_path)).report().robot == "go2"


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ({"stopped_because": [1]}, "stopped_because"),
        ({"dt": 0.0}, "dt"),
        ({"dt": "x"}, "dt"),
        ({"skills": "walk"}, "skills"),
        ({"skills": []}, "0 names of skills"),
        ({"drivers": []}, "0 names of drivers"),
        ({"fell": 1}, "fell"),
        ({"robot": {"legs": []}}, "legs"),
        ({"robot": {"hip": [[0.0] * 3] * 3}}, "hip"),
        ({"robot": {"tau_max": [["x"] * 3] * 4}}, "tau_max"),
        ({"robot": {"base_mass": 0.0}}, "masses"),
        ({"robot": {"wings": 2}}, "wings"),
    ],
)
def test_a_header_of_another_kind_is_refused(
    changed: dict, told: str, members: dict[str, np.ndarray], tmp_path: Path
):
    with pytest.raises(BadFile, match=rf"a\.npz is not a recording: .*{told}"):
        load(saved(with_header(members, **changed), tmp_path))


@pytest.mark.parametrize(
    ("channel", "value", "told"),
    [
        ("skill", 7.0, "a tick with number 7"),
        ("skill", 0.5, "a tick with number 0.5"),
        ("driver", np.nan, "a tick with number nan"),
        ("period", 0.0, "period"),
        ("time", np.nan, "none of its ticks"),
        ("route_points", 1e9, "points"),
        ("memory", 7.0, "a tick with number 7"),
        ("memory", -1.0, "a tick with number -1"),
    ],
)
def test_numbers_that_mean_nothing_are_refused(
    channel: str, value: float, told: str, members: dict[str, np.ndarray], tmp_path: Path
):
    with pytest.raises(BadFile, match=told):
        load(saved(members | {channel: np.full_like(members[channel], value)}, tmp_path))


def test_one_without_ticks_is_refused(members: dict[str, np.ndarray], tmp_path: Path):
    none = {name: array if name == "header" else array[:0] for name, array in members.items()}
    with pytest.raises(BadFile, match="0 ticks"):
        load(saved(none, tmp_path))


def test_what_unpacks_to_far_more_than_a_walk_is_refused(members: dict[str, np.ndarray], tmp_path: Path):
    path = saved(members, tmp_path)
    with zipfile.ZipFile(path, "a", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("more.npy", bytes(100_000_000))
    with pytest.raises(BadFile, match="which no walk does"):
        load(path)


def test_damaged_bytes_are_told(tmp_path: Path):
    content = bytearray(recordings()[0])
    content[len(content) // 2] ^= 0xFF
    (tmp_path / "a.npz").write_bytes(content)
    with pytest.raises(BadFile, match="is not a recording"):
        load(tmp_path / "a.npz")
