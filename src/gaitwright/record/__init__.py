"""Laps ↔ file: recordings, and the figures made of them."""
