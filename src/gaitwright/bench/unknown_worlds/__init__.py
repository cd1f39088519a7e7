"""Unknown ground, tried: random worlds, exact eyes, a disc that walks, an oracle, planners to compare with.

Nothing here is shared with the learned map that it tests.
"""
