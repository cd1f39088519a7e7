"""Situation → Decision, by rules a person can read. Knows nothing of robots."""
