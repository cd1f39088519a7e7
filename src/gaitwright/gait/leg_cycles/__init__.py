"""JSON points ↔ LegCycle: the closed path of a foot (row J3)."""
