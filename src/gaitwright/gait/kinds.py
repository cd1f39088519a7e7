"""Kinds of obstacles by their names, as commands list them. Imports nothing."""

KINDS = ("block", "step up", "step down", "hole", "slope")
"""As `gait.obstacle` tells them apart; the place of each is its number."""
