"""Tables and paragraphs on a screen: nothing wider than it, and no word broken."""

import io

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.cells import cell_len

from gaitwright.screen import WIDTH, Column, folded, paragraph, table, width_of, wrapped

WORDS = st.text(st.sampled_from("abc-é猫"), min_size=1, max_size=9)
SENTENCES = st.lists(WORDS, max_size=30).map(" ".join)


@given(st.lists(st.tuples(WORDS, WORDS, SENTENCES, SENTENCES), min_size=1, max_size=4), st.integers(24, 120))
def test_a_table_fits_its_screen_and_keeps_every_word(rows: list[tuple[str, ...]], width: int):
    columns = [
        Column("name"),
        Column("figure", right=True),
        Column("about", prose=True),
        Column("", prose=True),
    ]
    lines = [line.plain for line in table(columns, rows, width)]
    assert max(map(cell_len, lines)) <= max(width, 9 * 2 + 4)
    shown = " ".join(lines).split()
    for row in rows:
        for word in " ".join(row).split():
            assert word in shown


@given(SENTENCES, st.integers(1, 60))
def test_a_paragraph_has_the_words_of_its_text_in_order(text: str, width: int):
    lines = [line.plain for line in wrapped(text, width)]
    assert " ".join(lines).split() == text.split()
    assert all(cell_len(line) <= width or " " not in line for line in lines)


def test_what_does_not_fit_goes_below_its_row():
    columns = [Column("name"), Column("about", prose=True)]
    rows = [("turn-right", "an arc to the right, in trot"), ("trot", "diagonal pairs")]
    assert [line.plain for line in table(columns, rows, 30)] == [
        "name",
        "    about",
        "─" * 27,
        "turn-right",
        "    an arc to the right, in",
        "    trot",
        "trot",
        "    diagonal pairs",
    ]
    assert [line.plain for line in table(columns, rows, 36)][2:] == [
        "turn-right  an arc to the right, in",
        "            trot",
        "trot        diagonal pairs",
    ]


def test_a_path_that_is_longer_than_a_line_stays_whole():
    path = "runs/" + "deep/" * 20 + "recording.npz"
    columns = (Column(), Column(prose=True))
    lines = [line.plain for line in table(columns, [("recording", path), ("falls", "0")], 80, head=False)]
    assert lines == ["recording", f"    {path}", "falls      0"]
    assert [line.plain for line in paragraph(f"written: {path}", 80)] == ["written:", path]


def test_a_table_of_numbers_is_cut_between_columns_that_do_not_belong_together():
    columns = [Column("leg"), *(Column(name, right=True) for name in ("ours", "theirs", "ours", "theirs"))]
    lines = [line.plain for line in folded(columns, [("FL", "1", "2", "3", "4")], 22, together=2)]
    assert lines == [
        "leg  ours  theirs", "─────────────────", "FL      1       2", "",
        "leg  ours  theirs", "─────────────────", "FL      3       4",
    ]  # fmt: skip


def test_a_pipe_is_80_columns_wide_unless_columns_says_otherwise(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.delenv("COLUMNS", raising=False)
    assert width_of(io.StringIO()) == WIDTH == 80
    for said, width in (("120", 120), ("0", 80), ("", 80), ("wide", 80), ("-5", 80)):
        monkeypatch.setenv("COLUMNS", said)
        assert width_of(io.StringIO()) == width
