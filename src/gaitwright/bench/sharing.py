"""Claim: sharing the load over the feet is quick and exact, by quadratic and by linear program (row N3)."""
