"""MotorCommand → Measured by MuJoCo."""
