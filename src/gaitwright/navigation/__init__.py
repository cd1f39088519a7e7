"""Mission + Sensed → Route (learned map, shortest paths, local strategy)."""
