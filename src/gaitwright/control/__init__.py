"""MotionTarget + Sensed → Torques (numerical, learned, kinematic and programmed control)."""
