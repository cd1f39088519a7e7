"""Peers (TSID, PlaCo) timed on our robot and states, each in an environment of its own."""
