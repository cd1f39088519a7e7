"""Route + Sensed → SkillCall (the library of skills, and which of them when)."""
