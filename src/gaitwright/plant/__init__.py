"""Torques → Sensed (MuJoCo, Armstrong, replay)."""
