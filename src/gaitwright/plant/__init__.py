"""MotorCommand → Measured (MuJoCo, Armstrong, replay)."""
