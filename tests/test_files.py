"""The door for files of users, and sentences that may be printed."""

import os
from pathlib import Path

import msgspec
import pytest

from gaitwright.errors import LONGEST_NAME, BadFile, short
from gaitwright.files import content_of, json_of, opened_file


def test_what_is_no_file_is_refused_and_not_waited_for(tmp_path: Path):
    os.mkfifo(tmp_path / "pipe")
    for path, what in (
        (tmp_path / "pipe", "a pipe"),
        (tmp_path, "directory|folder"),
        (Path("/dev/zero"), "a device"),
    ):
        with pytest.raises(BadFile, match=what):
            opened_file(tmp_path / path, "scene file", 100)


def test_no_more_than_the_limit_is_read(tmp_path: Path):
    (tmp_path / "a").write_bytes(b"x" * 101)
    with pytest.raises(BadFile, match=r"is larger than the limit of 0\.1 kB"):
        content_of(tmp_path / "a", "scene file", 100)
    assert content_of(tmp_path / "a", "scene file", 101, first=3) == b"xxx"


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b'{"a": 1, "b": {"c": 1, "c": 2}}', "'c' is told twice"),
        (b'{"a": "\xe4"}', "is not JSON: it is no text in UTF-8: .* at byte 7"),
        (b'{"a": ', "is not JSON"),
        (b'{"a":' * 100_000, "is not JSON"),
        (b'{"a": NaN}', "is not JSON"),
    ],
)
def test_json_that_is_none_is_told(content: bytes, told: str):
    with pytest.raises(BadFile, match=told):
        json_of(content, dict, "file")


def test_json_of_another_kind_is_the_callers_to_tell():
    with pytest.raises(msgspec.ValidationError):
        json_of(b"[1]", dict, "file")


def test_a_sentence_does_nothing_to_a_terminal():
    assert str(BadFile("no \x1b[31mred\n\ud800 thing")) == r"no \x1b[31mred\n\ud800 thing"


def test_a_long_name_is_told_by_its_beginning_and_end():
    told = str(BadFile(f"no file {'a' * 5000}.json"))
    assert len(told) <= LONGEST_NAME + len("no file ") and told.endswith(".json")
    assert short("b" * LONGEST_NAME) == "b" * LONGEST_NAME
