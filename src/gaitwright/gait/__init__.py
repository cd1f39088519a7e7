"""SkillCall + Sensed → MotionTarget (joint coordination control)."""
