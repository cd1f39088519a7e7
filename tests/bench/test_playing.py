"""A ratio is that of rounds in which both were timed; a peer that is not there is said to be not measured."""

import math

import numpy as np
import pytest

from gaitwright import bench
from gaitwright.bench.claims.playing import PEERS, RATIOS, over, tick_of
from gaitwright.bench.peers.client import SCRIPTS
from gaitwright.bench.peers.environment import RECIPES

ROUNDS = [
    {"learned": np.array([10.0, 12.0, 11.0]), "numerical": np.array([22.0, 21.0, 400.0])},
    {"learned": np.array([6.0, 6.0, 6.0]), "numerical": np.array([20.0, 20.0, 20.0])},
    {"learned": np.array([9.0, 9.0, 9.0])},
]


def test_a_ratio_is_taken_round_by_round_and_an_outlier_does_not_matter() -> None:
    figure = over(RATIOS[0], ROUNDS, "")
    assert figure.numbers["each_round"] == [0.5, 0.3] and figure.starts == 2
    assert figure.measured == pytest.approx(0.4) and figure.reached is False
    assert tick_of("learned", ROUNDS, "").measured == 9.0


def test_a_peer_that_is_not_there_is_not_measured_and_says_why() -> None:
    of_tsid = next(ratio for ratio in RATIOS if ratio.theirs == "tsid")
    figure = over(of_tsid, ROUNDS, "it cannot be installed")
    assert math.isnan(figure.measured) and figure.reached is False and figure.note == "it cannot be installed"
    assert tick_of("tsid", ROUNDS, "no uv").measured_text == "not measured"


def test_the_claim_is_of_the_group_and_its_peers_can_be_made() -> None:
    assert ("takeover", "playing") in bench.claims_named(["takeover"])
    assert set(PEERS) <= set(RECIPES) & set(SCRIPTS) and all(SCRIPTS[name].exists() for name in PEERS)
