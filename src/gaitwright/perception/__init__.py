"""Measured + memory → Sensed and what is known of the ground."""
