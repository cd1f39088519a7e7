"""A teacher's words → a rulebook: the school, the pupil of skills, and books of what she was told (§5.4.2, §6.4)."""
