"""`gaitwright balance`: rules told, one taken out, and learned; `--balance` where profiles are played."""

import json

import pytest

from gaitwright.cli import balance, main
from gaitwright.control.balance_file import as_text, load_balance
from gaitwright.control.balance_rules import ACTIONS, BalanceRule, BalanceRules
from gaitwright.control.comparator import QUANTITIES
from gaitwright.learning.balance_lessons import Lesson

STOP = BalanceRule((0, 0, 0, 0, 1, 0), "stop", ("walk",), 40, 9, 1)
RULES = BalanceRules(dict.fromkeys(QUANTITIES, 0.2), (STOP, BalanceRule((0,) * 6, "quicker")))


@pytest.fixture
def mine(tmp_path) -> str:
    path = tmp_path / "mine.json"
    path.write_text(as_text(RULES))
    return str(path)


def test_the_rules_are_told_and_one_is_taken_out(mine, capsys, tmp_path):
    assert main(["balance", mine]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert (
        "1. walk:left+:stop: IF in walk it drifts left (or the mirror image) THEN ask for no velocity" in told
    )
    rest = str(tmp_path / "rest.json")
    assert main(["balance", mine, "--forget", "walk:left+:stop", "--out", rest, "--json", "-"]) == 0
    assert [one["name"] for one in json.loads(capsys.readouterr().out)["rules"]] == ["anything:quicker"]
    assert load_balance(rest).rules == RULES.rules[1:] and load_balance(mine) == RULES


@pytest.mark.parametrize(
    ("more", "what"),
    [
        (("--runs", "4"), "--learn"),
        (("--forget", "left+:stop"), "--out"),
        (("--forget", "walk", "--out", "new.json"), "walk:left+:stop"),
        (("--learn", "go2.skills"), "exists"),
    ],
)
def test_what_does_not_go_together_is_refused(mine, capsys, tmp_path, monkeypatch, more, what: str):
    monkeypatch.chdir(tmp_path)
    assert main(["balance", mine, *more]) == 2
    assert what in capsys.readouterr().err


def test_what_is_learned_is_in_a_new_file(capsys, tmp_path, monkeypatch):
    lesson = Lesson("walk", STOP.when, True, {action: action != "stop" for action in ACTIONS})
    monkeypatch.setattr(balance, "learned", lambda *_: (RULES, [lesson]))
    monkeypatch.setattr(balance, "played_by", lambda *_: {})
    monkeypatch.setattr(balance, "robot_of", lambda _: None)
    new = str(tmp_path / "new.json")
    assert main(["balance", new, "--learn", "go2.skills"]) == 0
    told = capsys.readouterr()
    assert "stop: 1 saved, 0 lost" in told.err and "walk:left+:stop" in told.out
    assert load_balance(new) == RULES


def test_rules_are_for_who_plays_profiles(mine, capsys):
    assert main(["skill", "--balance", mine, "--seconds", "0.1"]) == 2
    assert "--skillbook" in capsys.readouterr().err
