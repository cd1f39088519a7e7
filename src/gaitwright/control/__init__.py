"""MotionTarget + Sensed → MotorCommand (numerical, learned, kinematic and programmed control)."""
